/* What a row is: a method's family and its coefficients.
 *
 * Before this text the includer defines coef, a number, and ROW_CARD, the members that come first (or nothing), and declares `row`.
 */
typedef enum family { SPLITTING, RUNGE_KUTTA, TWO_STEP, IMPLICIT, EXACT } family;
typedef enum two_step { VERLET, VERLET_LITERAL, BEEMAN } two_step;

enum { KICKS_MAX = 18, WEIGHTS_MAX = 9, STAGES_MAX = 4 };

struct row {
    ROW_CARD                  /* what people see; a machine that only steps leaves it out */
    family family;
    int arguments;            /* newmark takes two */
    bool compensated;         /* x and v carry error words: where truncation is so small that round-off would rule */
    bool uniform;             /* every step must have the same size: no shorter last one */
    bool gyroscopic;          /* the kick is implicit in v; only for a = E(x, t) + v × B(x, t) */
    struct {                  /* SPLITTING: v += kick[i] h a, then x += drift[i] h v, for i = 0 … stages-1 */
        int stages;
        coef kick[KICKS_MAX], drift[KICKS_MAX];
    } splitting;
    struct {                  /* SPLITTING as well: drift-kick-drift steps of w[0] h, w[1] h, …, symmetric: w[count-1-i] = w[i] */
        int count;
        coef weight[WEIGHTS_MAX];
    } composition;
    struct {                  /* RUNGE_KUTTA; a is strictly lower. IMPLICIT: collocation, a is full. c: times of the stages */
        int stages;
        coef c[STAGES_MAX], a[STAGES_MAX][STAGES_MAX], b[STAGES_MAX];
    } tableau;
    two_step two_step;        /* TWO_STEP: which recurrence */
    bool newmark;             /* IMPLICIT: the tableau follows from the arguments */
};
