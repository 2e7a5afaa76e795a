/* The reciprocals 1/n that Taylor series multiply by: a division in every order would make the next one wait. They are
 * as long a table as the longest series; the includer defines coef. */
#ifndef RECIPROCAL
#define RECIPROCALS_FROM(n)                                                                            \
    (coef)1 / (n), (coef)1 / ((n) + 1), (coef)1 / ((n) + 2), (coef)1 / ((n) + 3), (coef)1 / ((n) + 4), \
        (coef)1 / ((n) + 5), (coef)1 / ((n) + 6), (coef)1 / ((n) + 7)
static const coef reciprocals[] = {0,
                                   RECIPROCALS_FROM(1),
                                   RECIPROCALS_FROM(9),
                                   RECIPROCALS_FROM(17),
                                   RECIPROCALS_FROM(25),
                                   RECIPROCALS_FROM(33),
                                   RECIPROCALS_FROM(41)};
#define RECIPROCAL(n) reciprocals[n]
#endif
