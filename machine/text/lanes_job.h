/* The arguments of the compiled text of lanes: a block of trajectories, GROUPS vectors of them.
 *
 * In the library `real` is a double here, and every array is longer by the factor WIDTH. The arrays of a group are
 * contiguous, and the groups follow one another. No member is a `clock`, which is a double in the library and may be a
 * vector in the text.
 */
typedef struct lanes_record {
    int how;
    int from;
    whole element;
} lanes_record; /* from: LANES_TIME, LANES_X, LANES_V, LANES_OUT */
enum { LANES_TIME, LANES_X, LANES_V, LANES_OUT };

/* The clock of a lane, as in work.h. STOP: the number of steps after which motus_lanes_run returns. EVENT: of a watched
 * lane the time of an event that is known beforehand; infinite where there is none. A lane without a trajectory has NaN
 * in STOP and in UNTIL. */
enum {
    LANES_T0,
    LANES_H,
    LANES_N,
    LANES_T,
    LANES_LOST,
    LANES_NEXT,
    LANES_BEFORE,
    LANES_RISE,
    LANES_SHORTEST,
    LANES_LONGEST,
    LANES_REFUSED,
    LANES_SPAN,
    LANES_UNTIL,
    LANES_STOP,
    LANES_EVENT,
    LANES_CLOCKS
};

typedef struct lanes_job {
    compiled_host host;                     /* `own` and `bound` of the first group */
    size_t own_size, bound_size;            /* elements of each group: 0 where there are none */
    size_t nx, nv, stride;                  /* of a workspace, as in work.h */
    real *clocks;                           /* LANES_CLOCKS of each group, where every lane has its own clock */
    double relative, absolute, least, most; /* of error control */
    int variables;
    const size_t *variable; /* of error control: the variables, as in work.h */
    /* Adaptive: the accelerations at the present states, nv of each group, and of each group whether they are known;
     * motus_lanes_run reads and writes them. NULL: none are. */
    real *known;
    bool *fresh;
    double t0, h;        /* with a shared clock: the leg */
    whole n;             /* with a shared clock: the steps taken since t0 */
    const double *table; /* of the values that depend on time alone, from step `first_row` on */
    whole first_row;

    const real *values;  /* the values that vary: value_count of each group */
    const whole *places; /* where the values go in the pool */
    whole value_count;
    const whole *from_x, *from_v; /* places of the pool where x and v start */
    const double *x0, *v0;        /* the values at the start that all lanes share: where from_x[k] < 0 */

    real *carry;   /* what a trajectory carries from step to step: CARRIED arrays of each group */
    real *room;    /* ARRAYS arrays of each group, where they are not local */
    real *lost;    /* of each group: NaN in lanes that failed to take a step in this call; infinite where the row does
                     * not admit the lane's parameters; else 0 */
    char *solving; /* room for motus_lanes_solving bytes of each group */
    real *x, *v, *a, *out; /* the observed state; quantities, out_size of each group */
    size_t out_size;

    whole record_count;     /* of the text's records; 0: this observation records nothing */
    bool first_observation; /* no observation before this one recorded anything */
    bool ends;              /* it is the observation at the end, whose time is `until` */
    bool begins;            /* own clocks: every lane is at the first step of its leg */
    double until;
    /* Of each group of watched lanes: what `carry` and `clocks` were before the latest candidate of each lane, nv
     * bounds on the accelerations within it, the largest sizes of x and then v with which steps began, and a nonzero
     * number if the bounds of some function of the rules are not positive on its box. shown: with fixed steps x, v and
     * the accelerations at the start of the latest step, then at its end. */
    real *before, *before_clocks, *bounds, *largest, *met, *shown;
    real *where; /* own clocks, of each group: 1 in the lanes that are observed, else 0 */
    real *kept;  /* REDUCE_KEPT numbers of each record of each group */
} lanes_job;
