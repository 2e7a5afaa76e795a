/* What the library gives to the compiled text of lanes: a block of trajectories, GROUPS vectors of them. In the
 * library `real` is a double there, and every array as many times as long as a vector is wide. The arrays of a group
 * lie together, the groups one after the other.
 */
/* from: LANES_TIME, LANES_X, LANES_V, LANES_OUT */
typedef struct lanes_record {
    int how;
    int from;
    whole element;
} lanes_record;
enum { LANES_TIME, LANES_X, LANES_V, LANES_OUT };

typedef struct lanes_job {
    compiled_host host;          /* its own and bound are the first group's */
    size_t own_size, bound_size; /* elements of each group: 0 where there are none */
    const work *plan;            /* time, step, coefficients; sizes; n: steps taken */
    const clock *table;          /* of what depends on time alone, from step `first` on */
    whole first;

    const real *values;  /* of what varies: value_count of each group */
    const whole *places; /* of the pool where they go */
    whole value_count;
    const whole *from_x, *from_v; /* places of the pool where x and v start */
    const double *x0, *v0;        /* and their values where no lane has its own: from_x[k] < 0 */

    real *carry; /* what a trajectory carries from step to step: CARRIED arrays of each group */
    real *room;  /* ARRAYS arrays of each group, where they are not local */
    /* of each group: NaN in lanes whose equation could not be solved in this call; infinite where the row does not
     * admit the lane's parameters; else 0 */
    real *lost;
    char *solving;         /* room for motus_lanes_solving bytes of each group */
    real *x, *v, *a, *out; /* the state when it was looked at; quantities, out_size of each group */
    size_t out_size;

    whole record_count;    /* of the text's records; 0: nothing is recorded in this look */
    bool first_look, ends; /* the first look of all; the look at the end, at the time `until` */
    clock until;
    real *kept;
} lanes_job;
