/* LAWS OF ORDER: the observed slope of the error of every row; the proof of the order is in laws_proof.c.
 *
 * Invariant: slopes are taken in 33 digits, over steps where the error is above what the row's own digits allow; the
 * margin is the change of the slope from one halving to the next, which is the distance of an asymptotic series from
 * its limit. Beyond order 8 the digits end before that, and half a unit tells one order from the next.
 */
#include "core/rows.h"
#include "test/laws_proof.h"

#include <math.h>
#include <stdio.h>

/* The coefficients of reversible rows are palindromes. */
static void palindrome(method m)
{
    const motus_method *card = row_card(m);
    quad kick[SPLITTING_MAX], drift[SPLITTING_MAX], skew = 0;
    const int n = quad_splitting_of(m, kick, drift);
    if (!n) return;
    quad sequence[2 * SPLITTING_MAX];
    int length = 0;
    for (int i = 0; i < n; i++) {
        sequence[length++] = kick[i];
        sequence[length++] = drift[i];
    }
    int first = 0, last = length - 1;
    while (sequence[first] == 0) first++;
    while (sequence[last] == 0) last--;
    if ((last - first) % 2) skew = 1; /* then the mirror of a kick is a drift */
    for (; first < last; first++, last--) skew = fmax((double)skew, (double)quad_abs(sequence[first] - sequence[last]));
    judge(card->reversible ? skew < Q(1e-30) : skew > Q(0.01), card->name,
          card->reversible ? "palindrome" : "no palindrome", "asymmetry %.1e", (double)skew);
}

/* A row at line `line`, as quad_line takes it, or of Taylor series to this order; 0: as its card says. */
static quad_count run(method m, const double *argument, int line, const quad_problem *p, quad h, int64_t n,
                      quad_state *end)
{
    if (!line) return quad_run(m, argument, p, 0, h, n, end);
    if (methods_table[m].expands) return quad_expand(m, line, p, 0, h, n, end);
    return quad_line(m, line, p, 0, h, n, end, NULL);
}

/* line: as `run` takes it. */
static void slope(method m, const double *argument, int line, const char *name, int order, const quad_problem *p)
{
    enum { POINTS_MAX = 16 };
    /* The error from the coefficients' digits: half units of some twenty coefficients, over a hundred steps. */
    const bool high = order > 9;
    const quad span = Q(1.25), floor = (high ? Q(1e-29) : Q(1e-26)) + 2000 * coefficients_unit(m);
    const quad_state reference = quad_motion(p, span);
    quad_state start = {0};
    for (size_t k = 0; k < p->nx; k++) start.x[k] = p->x[k];
    for (size_t k = 0; k < p->nv; k++) start.v[k] = p->v[k];
    double errors[POINTS_MAX] = {0}, last = NAN, margin = 0;
    int points = 0;
    bool close = false;
    /* High orders leave room for few halvings: they take 2, 3, 4, 6, 8, 12, … steps, each half of the next but one. */
    const int apart = high ? 2 : 1;
    /* at least so many steps; and more where the slope is not settled, as long as the error is above rounding: of many
     * stages fewer, so that a row whose coefficients are wrong fails soon */
    const int64_t most = 65536 / row_card(m)->stages < 16384 ? 65536 / row_card(m)->stages : 16384;
    for (int64_t n = high ? 2 : 4; points < POINTS_MAX && !(close && n > (order > 2 ? 1024 : 4096)) && n <= most;
         n += high ? (n & (n - 1) ? n / 3 : n / 2) : n) {
        quad_state end = start;
        if (run(m, argument, line, p, span / (quad)n, n, &end).bad) continue;
        const quad error = quad_distance(p, &end, &reference);
        if (error < floor && points >= 3) break;
        if (error < Q(0.1)) errors[points++] = quad_log2(error);
        if (points < 3) continue;
        const double before = errors[points - 3] - errors[points - 2];
        last = errors[points - 1 - apart] - errors[points - 1];
        margin = high ? 0.5 : fmin(0.5, 1.5 * fabs(last - before) + 0.02);
        close = fabs(last - order) <= margin;
    }
    char law[64];
    snprintf(law, sizeof law, "order on %s", p->name);
    judge(close, name, law, "observed %.3f, declared %d, margin %.3f", last, order, margin);
}

void laws_of_order(void)
{
    for (method m = 0; m < row_count(); m++) {
        const motus_method *card = row_card(m);
        palindrome(m);
        static const int problems[] = {HENON_HEILES, DRIVEN, RIDER, FOLLOWER, DAMPED, TANGLED, MAGNET, CUBIC, PARTICLE};
        for (size_t i = 0; i < sizeof problems / sizeof *problems; i++)
            /* CUBIC is stiff: a method of order 1 would need too many steps, and the errors of the pairs of high order
             * change their sign where their slopes would settle */
            if (quad_admits(m, &quad_problems[problems[i]]) &&
                (problems[i] != CUBIC || (card->order > 1 && !(methods_table[m].adaptive && card->order > 5))))
                slope(m, NULL, 0, card->name, card->order, &quad_problems[problems[i]]);
        for (int line = 2; line < quad_lines(m); line++) { /* of the last the digits end before its slope settles */
            static const int some[] = {HENON_HEILES, DRIVEN, TANGLED};
            char name[64];
            snprintf(name, sizeof name, "%s, line %d", card->name, line);
            for (size_t i = 0; i < sizeof some / sizeof *some; i++)
                if (quad_admits(m, &quad_problems[some[i]]))
                    slope(m, NULL, line, name, 2 * line, &quad_problems[some[i]]);
        }
        for (int order = 4; methods_table[m].expands && order <= 12; order++) { /* laws_series.c has the others */
            char name[64];
            snprintf(name, sizeof name, "%s, order %d", card->name, order);
            slope(m, NULL, order + 1, name, order, &quad_expanded[EVERYTHING]); /* velocities end one power before */
        }
    }
    /* Newmark's arguments: order 2 for every beta with gamma = 1/2, and 1 for any other gamma. */
    static const double betas[][2] = {{0, 0.5}, {1.0 / 12, 0.5}, {1.0 / 6, 0.5}, {0.3025, 0.6}};
    static const char *const names[] = {"newmark(0, 1/2)", "newmark(1/12, 1/2)", "newmark(1/6, 1/2)",
                                        "newmark(0.3025, 0.6)"};
    for (method m = 0; m < row_count(); m++)
        for (int i = 0; row_card(m)->name[0] == 'n' && i < 4; i++)
            for (int p = DAMPED; p <= TANGLED; p++)
                slope(m, betas[i], 0, names[i], betas[i][1] == 0.5 ? 2 : 1, &quad_problems[p]);
}
