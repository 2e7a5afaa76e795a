/* LAWS OF DENSE OUTPUT: the order of the state between steps, of every row and every kind of force.
 *
 * Three laws. In one step the interpolant's own error has at least the power dense_order + 1 of the step: of an
 * interpolant through the ends, which are exact then, or of one made of the stages. In a run the error of a state
 * between steps has the order of the method, or dense_order + 1 where that is less. And continuous weights satisfy the
 * order conditions at so many parts of the step that the polynomials in the part do, with value and slope at both ends.
 */
#include "core/rows.h"
#include "test/laws_proof.h"

#include <math.h>
#include <stdio.h>

/* Forces that read positions alone, first-order variables too; velocities in these, in the force, in both; v × B. */
static const int problems[] = {HENON_HEILES, RIDER, FOLLOWER, DAMPED, TANGLED, MAGNET};
enum { PROBLEMS_HERE = sizeof problems / sizeof *problems };

/* The exact motion of a problem: from START at the parts of steps of several sizes, and at their ends; and from 0
 * to SPAN. */
enum { PARTS = 4, SIZES = 5 };
static const double part_of[PARTS] = {0.15, 0.4, 0.55, 0.8};
#define START Q(0.75)
#define SPAN Q(1.25)
typedef struct exact_motion {
    const quad_problem *problem;
    quad_state start, at[SIZES][PARTS], end[SIZES], whole;
} exact_motion;

/* Steps of sizes `from` … SIZES - 1. Of high orders the errors are small enough in longer steps. */
static quad size_of(int i) { return Q(0.5) / (1 << i); }
static int wider_of(int order) { return order > 20 ? 0 : order > 9 ? 2 : 3; }

static void follow(const quad_problem *p, int from, exact_motion *e)
{
    *e = (exact_motion){.problem = p, .whole = quad_motion(p, SPAN)};
    for (size_t k = 0; k < p->nx; k++) e->start.x[k] = p->x[k];
    for (size_t k = 0; k < p->nv; k++) e->start.v[k] = p->v[k];
    for (int i = from; i < SIZES; i++) {
        const quad h = size_of(i);
        e->end[i] = e->start;
        quad_reference(p, START, START + h, &e->end[i]);
        for (int k = 0; k < PARTS; k++) {
            e->at[i][k] = e->start;
            quad_reference(p, START, START + (quad)part_of[k] * h, &e->at[i][k]);
        }
    }
}

/* The largest error at several parts of one step. */
static quad within(method m, const exact_motion *e, int size)
{
    quad most = 0;
    for (int k = 0; k < PARTS; k++) {
        quad_state is = e->start;
        if (quad_dense(m, e->problem, START, size_of(size), 0, (quad)part_of[k], &e->end[size], &is).bad) return -1;
        const quad error = quad_distance(e->problem, &is, &e->at[size][k]);
        if (error > most) most = error;
    }
    return most;
}

static void in_one_step(method m, const exact_motion *e)
{
    const motus_method *card = row_card(m);
    const int wider = wider_of(card->dense_order);
    const quad wide = within(m, e, wider), narrow = within(m, e, wider + 1);
    const double falls = quad_log2(wide / narrow);
    /* of Hermite's polynomial, which these rows have, it is the velocity's or the first-order variables' own */
    const bool hermite = card->order < 4 && methods_table[m].tableau.dense.terms == 0;
    const int due = hermite ? (e->problem->nv > e->problem->nx ? 4 : 5) : card->dense_order + 1;
    char law[64];
    snprintf(law, sizeof law, "within a step on %s", e->problem->name);
    judge(narrow > 0 && falls > due - 0.5 && (!hermite || falls < due + 0.5), card->name, law,
          "the error falls by %.2f orders, due %d, declared %d + 1", falls, due, card->dense_order);
}

/* The time at which the error is taken is the same for all steps; it lies within the last. */
static void in_a_run(method m, const exact_motion *e)
{
    const motus_method *card = row_card(m);
    const int order = card->order <= card->dense_order ? card->order : card->dense_order + 1;
    const bool high = order > 9;
    const quad part = Q(0.4), floor = (high ? Q(1e-29) : Q(1e-26)) + 2000 * coefficients_unit(m);
    enum { POINTS_MAX = 14 };
    double errors[POINTS_MAX] = {0}, sizes[POINTS_MAX] = {0}, last = NAN, margin = 0;
    int points = 0;
    bool close = false;
    const int64_t most = 65536 / card->stages < 8192 ? 65536 / card->stages : 8192; /* as in laws_order.c */
    for (int64_t n = high ? 2 : 4; points < POINTS_MAX && !(close && (high || n > (order > 2 ? 64 : 256))) && n <= most;
         n *= 2) {
        quad_state end = e->start;
        if (quad_dense(m, e->problem, 0, SPAN / ((quad)n + part), n, part, NULL, &end).bad) continue;
        const quad error = quad_distance(e->problem, &end, &e->whole);
        if (error < floor && points >= 3) break;
        if (error < Q(0.1)) sizes[points] = -log2((double)((quad)n + part)), errors[points++] = quad_log2(error);
        if (points < 3) continue;
        const int k = points - 1;
        const double before = (errors[k - 2] - errors[k - 1]) / (sizes[k - 2] - sizes[k - 1]);
        last = (errors[k - 1] - errors[k]) / (sizes[k - 1] - sizes[k]);
        margin = high ? 0.5 : fmin(0.5, 1.5 * fabs(last - before) + 0.02);
        close = last >= order - margin;
    }
    char law[64];
    snprintf(law, sizeof law, "between steps on %s", e->problem->name);
    judge(close, card->name, law, "observed %.3f, due %d, margin %.3f", last, order, margin);
}

/* At both ends the weights have the value and the slope that make the state and its derivative continuous. */
static void ends(method m)
{
    const motus_method *card = row_card(m);
    quad slope[SCHEME_STAGES_MAX], size[SCHEME_STAGES_MAX];
    scheme now;
    for (int end = 0; end < 2; end++) {
        if (!quad_continuous_of(m, end, &now) || !quad_slopes_of(m, end, slope, size)) return;
        const int stages = methods_table[m].tableau.stages, ending = stages - methods_table[m].tableau.closing;
        quad worst = 0;
        for (int j = 0; j < now.stages; j++) {
            const quad bound = 16 * (size[j] + 1) * (QUAD_EPSILON + coefficients_dense_unit(m) + coefficients_unit(m));
            const quad b = end && j < stages ? (quad)methods_table[m].tableau.b[j] : 0;
            const quad value = quad_abs(now.bv[j] - b), rounded = (quad)0x1p-52 * quad_abs(b),
                       tilt = quad_abs(slope[j] - (j == (end ? ending : 0)));
            if (value > rounded + bound || !(tilt / bound <= worst))
                worst = value > rounded + bound ? 1e9 : tilt / bound;
        }
        judge(worst <= 1, card->name, end ? "joins the next step" : "leaves the start",
              "value and slope of %d weights, %.3f of their bound", now.stages, (double)worst);
    }
}

static void weights(method m)
{
    const row *r = &methods_table[m];
    scheme now;
    char name[64];
    quad slope[SCHEME_STAGES_MAX], terms[SCHEME_STAGES_MAX];
    const int parts = r->tableau.dense.terms + 2; /* more than the degree of any weight */
    for (int i = 1; i <= parts; i++) {
        if (!quad_continuous_of(m, (quad)i / (parts + 1), &now)) return;
        const trees_kind kind = coefficients_trees(m);
        quad size = 0;
        now.places = kind == TREES_ROOTED;
        quad_slopes_of(m, true, slope, terms);
        for (int j = 0; j < now.stages; j++) size += 1 + terms[j];
        for (int j = 0; j < now.stages; j++)
            for (int l = 0; l < j; l++) size += quad_abs(now.bv[j] * now.av[j][l]);
        snprintf(name, sizeof name, "%s, dense, part %d/%d", row_card(m)->name, i, parts + 1);
        proof_of_digits(name, kind, &now, row_card(m)->dense_order,
                        size * r->tableau.dense.terms *
                            (coefficients_dense_unit(m) + coefficients_unit(m) + QUAD_EPSILON));
    }
}

void laws_of_dense(void)
{
    static exact_motion e;
    for (method m = 0; m < row_count(); m++) {
        weights(m);
        ends(m);
    }
    for (int i = 0; i < PROBLEMS_HERE; i++) {
        follow(&quad_problems[problems[i]], 2, &e);
        for (method m = 0; m < row_count(); m++) {
            if (!quad_admits(m, e.problem)) continue;
            in_one_step(m, &e);
            in_a_run(m, &e);
        }
    }
    for (method m = 0; m < row_count(); m++) {
        if (!methods_table[m].expands) continue;
        follow(&quad_expanded[POLE], 0, &e);
        in_one_step(m, &e);
        follow(&quad_expanded[EVERYTHING], SIZES, &e);
        in_a_run(m, &e);
    }
}
