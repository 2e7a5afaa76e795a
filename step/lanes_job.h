/* What the library gives to the compiled text of lanes: one block of trajectories, side by side. In the library `real` is a
 * double there, and every array as many times as long as there are lanes in a block.
 */
typedef struct lanes_record { int how; int from; whole element; } lanes_record;      /* from: LANES_TIME, LANES_X, LANES_V, LANES_OUT */
enum { LANES_TIME, LANES_X, LANES_V, LANES_OUT };

typedef struct lanes_job {
    compiled_host host;              /* its own and bound are this block's */
    work plan;                       /* time, step, coefficients; sizes; n: steps taken */
    const clock *table;              /* of what depends on time alone, from step `first` on */
    whole first;

    const real *values;              /* of what varies */
    const whole *places;             /* of the pool where they go */
    whole value_count;
    const whole *from_x, *from_v;    /* places of the pool where x and v start */
    const double *x0, *v0;           /* and their values where no lane has its own: from_x[k] < 0 */

    real *carry;                     /* what a trajectory carries from step to step */
    real *room;                      /* arrays of a workspace, where they are not local */
    real *x, *v, *a, *out;           /* the state when it was looked at; quantities */

    const lanes_record *records;
    int record_count;
    bool first_look, ends;           /* the first look of all; the last look of this call is the end, at the time `until` */
    clock until;
    real *kept;
} lanes_job;
