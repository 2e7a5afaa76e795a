/* LAWS OF STRUCTURE: reversibility, symplecticity, volume, and the number of evaluations.
 *
 * Invariant: each law is tested both ways: rows that declare a property have it to the last digits, rows that do not
 * must visibly violate it.
 */
#include "core/rows.h"
#include "test/laws.h"

#include <stdio.h>

static quad_state start_of(const quad_problem *p)
{
    quad_state s = {0};
    for (size_t k = 0; k < p->nx; k++) s.x[k] = p->x[k];
    for (size_t k = 0; k < p->nv; k++) s.v[k] = p->v[k];
    return s;
}

/* There and back: the second run gets only the state and the time at the end of the first. */
static void reversal(method m, const quad_problem *p)
{
    enum { STEPS = 12 };
    const motus_method *card = row_card(m);
    /* The error of a high order shows at long steps alone, as far as its equations have solutions there. */
    const bool high = !card->reversible && card->order > 8;
    const quad_state start = start_of(p);
    quad_state s = start;
    quad_count count = {.bad = 1};
    quad off = 1;
    for (quad h = high ? Q(1.0) : Q(0.0625); (count.bad || !(off < Q(0.1))) && h > Q(0.01); h /= 2) {
        s = start;
        count = quad_run(m, NULL, p, 0, h, STEPS, &s);
        if (!count.bad) count = quad_run(m, NULL, p, STEPS * h, -h, STEPS, &s);
        off = quad_distance(p, &s, &start);
    }
    char law[64];
    snprintf(law, sizeof law, "%s on %s", card->reversible ? "reversal" : "no reversal", p->name);
    /* Reversible rows return up to rounding, and as exactly as their drifts reach the middle of the step, which time-
     * dependent forces depend on. The others miss by their errors, of which the smallest, at order 12, is far above. */
    const quad bound = Q(1e-28) + quad_looseness(m);
    judge(!count.bad && (card->reversible ? off < bound : off > (high ? Q(1e2) : Q(1e6)) * bound), card->name, law,
          "returns within %.1e", (double)off);
}

/* J' S J - S for the map over some steps, J by central differences: truncation d², rounding epsilon/d. Also det J. */
static void canonical(method m, const quad_problem *p)
{
    enum { STEPS = 3 };
    const motus_method *card = row_card(m);
    const bool keeps = card->symplectic || methods_table[m].density; /* its steps have one size here */
    /* at long steps the errors of a high order are visible */
    const quad d = Q(1e-11), h = !keeps && card->order > 9 ? Q(1.0) : Q(0.25);
    const int n = (int)p->nx;
    quad j[2 * DIMENSIONS][2 * DIMENSIONS], most = 0;
    for (int c = 0; c < 2 * n; c++) {
        quad_state ends[2];
        for (int side = 0; side < 2; side++) {
            ends[side] = start_of(p);
            *(c < n ? &ends[side].x[c] : &ends[side].v[c - n]) += side ? d : -d;
            quad_run(m, NULL, p, 0, h, STEPS, &ends[side]);
        }
        for (int r = 0; r < n; r++) {
            j[r][c] = (ends[1].x[r] - ends[0].x[r]) / (2 * d);
            j[n + r][c] = (ends[1].v[r] - ends[0].v[r]) / (2 * d);
        }
    }
    for (int a = 0; a < 2 * n; a++)
        for (int b = 0; b < 2 * n; b++) {
            quad sum = (b == a + n) - (a == b + n);
            for (int k = 0; k < n; k++) sum -= j[k][a] * j[n + k][b] - j[n + k][a] * j[k][b];
            if (quad_abs(sum) > most) most = quad_abs(sum);
        }
    char law[64];
    snprintf(law, sizeof law, "%s on %s", keeps ? "symplectic" : "not symplectic", p->name);
    judge(keeps ? most < Q(1e-17) : most > Q(1e-14), card->name, law, "J'SJ - S: %.1e", (double)most);
}

/* With a force E + v × B implicit kicks preserve volume as drifts do, though they are not symplectic: such a kick is
 * the Cayley form of an antisymmetric matrix, whose determinant is 1 [Qin13]. */
static void volume(method m, const quad_problem *p)
{
    enum { N = 6 };
    const quad d = Q(1e-11);
    quad j[N][N], determinant = 1;
    for (int c = 0; c < N; c++) {
        quad_state ends[2];
        for (int side = 0; side < 2; side++) {
            ends[side] = start_of(p);
            *(c < 3 ? &ends[side].x[c] : &ends[side].v[c - 3]) += side ? d : -d;
            quad_run(m, NULL, p, 0, Q(0.25), 3, &ends[side]);
        }
        for (int r = 0; r < 3; r++) {
            j[r][c] = (ends[1].x[r] - ends[0].x[r]) / (2 * d);
            j[3 + r][c] = (ends[1].v[r] - ends[0].v[r]) / (2 * d);
        }
    }
    for (int k = 0; k < N; k++) {
        int p_row = k;
        for (int r = k; r < N; r++)
            if (quad_abs(j[r][k]) > quad_abs(j[p_row][k])) p_row = r;
        for (int c = 0; c < N; c++) {
            quad keep = j[k][c];
            j[k][c] = j[p_row][c];
            j[p_row][c] = keep;
        }
        determinant *= p_row == k ? j[k][k] : -j[k][k];
        for (int r = k + 1; r < N; r++) {
            const quad f = j[r][k] / j[k][k];
            for (int c = k; c < N; c++) j[r][c] -= f * j[k][c];
        }
    }
    const quad off = quad_abs(determinant - 1);
    const bool keeps = methods_table[m].family == SPLITTING;
    judge(keeps ? off < Q(1e-17) : off > Q(1e-14), row_card(m)->name, keeps ? "volume" : "no volume", "det J - 1: %.1e",
          (double)off);
}

/* Exactly `evaluations` a step, and one more at the start where a step ends with the first evaluation of the next. A
 * linear velocity term costs neither more nor an iteration. */
static void evaluations(method m, const quad_problem *p)
{
    const motus_method *card = row_card(m);
    const row *r = &methods_table[m];
    int each = card->evaluations, kicks = r->composition.count;
    for (int i = 0; i < r->splitting.stages; i++) kicks += r->splitting.kick[i] != 0;
    if (r->density) each = kicks; /* steps of one size look nowhere else; laws_density.c counts the others */
    if (p->quadrature && r->family == SPLITTING) { /* each kick evaluates at its beginning, and at one node or two */
        each = kicks * (card->order <= 2 || r->composition.count ? 2 : 3);
    } else if (!card->evaluations || (p->velocity && !p->linear && r->family != RUNGE_KUTTA)) {
        return;
    }
    quad_state s = start_of(p);
    const int64_t steps = 37;
    const quad_count count = quad_run(m, NULL, p, 0, Q(0.03125), steps, &s);
    char law[64];
    snprintf(law, sizeof law, "evaluations on %s", p->name);
    const int64_t first = r->tableau.ending || r->tableau.closing;
    judge(count.evaluations == steps * each + first && count.iterations == 0, card->name, law,
          "%lld in %lld steps, %lld iterations", (long long)count.evaluations, (long long)steps,
          (long long)count.iterations);
}

/* Free fall is a parabola: methods of order 2 and more follow it to round-off, the Euler methods miss it by -+ g h
 * t/2. */
static void parabola(method m)
{
    const motus_method *card = row_card(m);
    const quad_problem *p = &quad_problems[FREE_FALL];
    const quad h = Q(0.0625);
    const int64_t steps = 48;
    const quad t = h * (quad)steps;
    quad_state s = start_of(p);
    quad_run(m, NULL, p, 0, h, steps, &s);
    const quad miss = s.x[1] - (p->v[1] * t - Q(9.81) * t * t / 2);
    quad expected = 0;
    if (card->order == 1) {
        const bool explicit_euler = methods_table[m].family == RUNGE_KUTTA,
                   kick_first = methods_table[m].family == SPLITTING && methods_table[m].splitting.kick[0] != 0;
        expected = (explicit_euler || !kick_first ? 1 : -1) * Q(9.81) * h * t / 2;
    }
    /* Coefficients of 15 digits give the sums of products for t²/2 to as many digits. */
    judge(quad_abs(miss - expected) < Q(1e-13), card->name, "parabola", "misses by %.3e, expected %.3e", (double)miss,
          (double)expected);
}

void laws_of_structure(void)
{
    for (method m = 0; m < row_count(); m++) {
        static const int reversed[] = {HENON_HEILES, DRIVEN, RIDER, FOLLOWER, DAMPED, TANGLED, MAGNET, CUBIC, PARTICLE};
        for (size_t i = 0; i < sizeof reversed / sizeof *reversed; i++)
            if (quad_admits(m, &quad_problems[reversed[i]])) reversal(m, &quad_problems[reversed[i]]);
        if (quad_admits(m, &quad_problems[HENON_HEILES])) canonical(m, &quad_problems[HENON_HEILES]);
        const bool turns = methods_table[m].family == SPLITTING && quad_admits(m, &quad_problems[MAGNET]);
        if (turns || methods_table[m].family == RUNGE_KUTTA) volume(m, &quad_problems[MAGNET]);
        for (int p = 0; p < PROBLEMS; p++)
            if (quad_admits(m, &quad_problems[p])) evaluations(m, &quad_problems[p]);
        if (quad_admits(m, &quad_problems[FREE_FALL])) parabola(m);
    }
}
