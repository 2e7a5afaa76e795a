/* A row: a method's family and its coefficients.
 *
 * Before this text the includer defines coef, a number, and ROW_CARD, the members that come first, and declares
 * `row`; step/families.def stands before it. The coefficients are lists of any length, so no row is larger than its
 * method.
 */
#define FAMILY_NAME(NAME, name, shared, facts) NAME,
typedef enum family { FAMILIES(FAMILY_NAME) } family;
#undef FAMILY_NAME

/* What is true of all rows of a family. Every user of a fact does what is right of any family where it is not said. */
typedef enum family_fact {
    /* its states are a formula of the time and of the start: no step adds an error, and there are no steps to watch */
    FORMULA = 1 << 0,
    /* stage i is a kick by constant i of the plan and then a drift; a quadrature costs it no order, unless a row says
     * nystrom */
    KICKS = 1 << 1,
    /* where steps have one size, dense output follows from the ends of a step (lift.h), unless a row has its own */
    FROM_ENDS = 1 << 2,
    /* where steps have one size and no equation is solved, a step may be taken for a part of the numbers and the
     * neighbours that they read (tiled.h) */
    BY_NUMBER = 1 << 3,
    /* where steps adapt, name_swing tells its bounds, and what it takes stays until the next candidate: steps may be
     * watched (watch.h) */
    SWINGS = 1 << 4,
    /* where steps adapt, a candidate evaluates every stage of the plan once */
    COUNTS = 1 << 5,
    /* a step multiplies what has the rate λ by a function of h λ alone, whatever the force is made of, unless the row
     * has coefficients of its own for the positions */
    RATES = 1 << 6
} family_fact;

struct row {
    ROW_CARD /* the description for users */
        family family;
    int arguments;    /* newmark takes two */
    bool compensated; /* compensated addition: x and v carry error words, because truncation is below round-off */
    bool uniform;     /* every step must have the same size: no shorter last one */
    /* a step is a candidate that is accepted or refused, and the step size follows from its error */
    bool adaptive;
    bool sizes;        /* adaptive: the step finds its own size */
    bool expands;      /* its steps need the Taylor series of the equations, so these must be formulas */
    bool orders;       /* adaptive: the step finds its own order, and the size of the next one with it */
    bool density;      /* adaptive: steps follow the time scale of the motion, and can be taken backward (density.h) */
    const char *alone; /* the row that takes a single step in its place, since its own first step has a lower order */
    bool gyroscopic;   /* the kick is implicit in v; only for a = E(x, t) + v × B(x, t) */
    struct {           /* SPLITTING: v += kick[i] h a, then x += drift[i] h v, for i = 0 … stages-1 */
        int stages;
        const coef *kick, *drift;
    } splitting;
    /* SPLITTING: its order needs kicks that are free of v; others keep it with first-order variables that read v */
    bool nystrom;
    /* SPLITTING as well: drift-kick-drift steps of w[0] h, w[1] h, … w[count-1] h, symmetric: the first half is
     * given */
    struct {
        int count;
        const coef *weight;
    } composition;
    /* c: abscissae. a, row by row, below the diagonal: 1 + 2 + … numbers. IMPLICIT and RADAU have the stages alone:
     * their coefficients are generated (collocation.h). aa (like a) and bb are those of a Nyström method for the
     * positions; a NULL: its forces are free of v. Of adaptive rows: the weights of the error of the velocities, and
     * of the positions (NULL: they follow from a), b minus that of the embedded method; second: those of another
     * estimate, or NULL; ending: weights have one more entry, for the acceleration at the end of the step; closing: the
     * last stage is the acceleration there; order: of the embedded method. dense (continuous.h; terms 0: the row has
     * none of its own): how many further stages, their c and, row by row, a; the terms of the series, from the second
     * on, one coefficient for each column. */
    struct {
        int stages;
        const coef *c, *a, *b, *aa, *bb, *error, *error_x, *second;
        bool ending, closing;
        int order;
        struct {
            int more, terms;
            const coef *c, *a, *series;
        } dense;
    } tableau;
    int lines;    /* STORMER and GRAGG: where any error is allowed, the line of the scheme that ends a step */
    int series;   /* TAYLOR: the order, at most SERIES_ORDER_MOST; 0: as the tolerance wants it */
    bool newmark; /* IMPLICIT: the tableau follows from the arguments */
};
