/* Reductions of a number over the observations of a trajectory: its last value, extremes, mean, and the time at which
 * an extreme occurred first.
 *
 * The includer defines `real` and `clock`, LEAST(a, b) and MOST(a, b), which propagate NaN, and CHOOSE(condition, a,
 * b). kept[0] is the value, kept[1] the time of an extreme. Invariant: both depend only on the numbers and their order.
 */
enum { REDUCE_FINAL, REDUCE_MIN, REDUCE_MAX, REDUCE_MEAN, REDUCE_TIME_OF_MIN, REDUCE_TIME_OF_MAX, REDUCE_KEPT = 2 };

static inline void reduce_first(real *kept, real value, real t)
{
    kept[0] = value;
    kept[1] = t;
}

static inline void reduce_next(real *kept, int how, real value, real t)
{
    switch (how) {
    case REDUCE_MIN: kept[0] = LEAST(kept[0], value); break;
    case REDUCE_MAX: kept[0] = MOST(kept[0], value); break;
    case REDUCE_MEAN: kept[0] = kept[0] + value; break;
    case REDUCE_TIME_OF_MIN:
        kept[1] = CHOOSE(value < kept[0], t, kept[1]);
        kept[0] = LEAST(kept[0], value);
        break;
    case REDUCE_TIME_OF_MAX:
        kept[1] = CHOOSE(value > kept[0], t, kept[1]);
        kept[0] = MOST(kept[0], value);
        break;
    default: kept[0] = value;
    }
}

/* Returns the result after `count` observations. */
static inline real reduce_last(const real *kept, int how, clock count)
{
    return how == REDUCE_MEAN                                       ? kept[0] / count
           : how == REDUCE_TIME_OF_MIN || how == REDUCE_TIME_OF_MAX ? kept[1]
                                                                    : kept[0];
}
