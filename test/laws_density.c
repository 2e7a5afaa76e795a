/* LAWS OF THE DENSITY: rows whose steps follow the time scale of the motion (step/density.h).
 *
 * Their steps, taken backward, lead back to the start up to rounding, which no step that follows from errors does; they
 * keep the order of the method; and the energy of a planet on a long ellipse is after ten thousand periods as far off
 * as after ten, where that of every other adaptive row is lost.
 */
#include "core/rows.h"
#include "core/stepper.h"
#include "test/laws.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* The tolerance that asks for steps of this part of the time scale, or up to ten times as long. */
static quad tolerance_of(method m, quad part)
{
    quad tolerance = part;
    for (int i = 0; i < row_card(m)->order; i++) tolerance *= part;
    return tolerance;
}

static quad_state start_of(const quad_problem *p)
{
    quad_state s = {0};
    for (size_t k = 0; k < p->nx; k++) s.x[k] = p->x[k];
    for (size_t k = 0; k < p->nv; k++) s.v[k] = p->v[k];
    return s;
}

/* Forward, and back by as many steps. Backward the step before the last state is the one that follows it: one more
 * step forward tells how long that is. */
static void reversal(method m, const quad_problem *p)
{
    enum { STEPS = 40 };
    /* with longer steps forty would go further, to places where the control begins anew */
    const quad tolerance = tolerance_of(m, row_card(m)->order > 9 ? Q(0.01) : Q(0.02));
    const quad_state start = start_of(p);
    quad_state end = start, beyond = start;
    quad_control there = {0}, further = {0};
    quad_count count = quad_adapt(m, p, tolerance, (quad)INFINITY, STEPS, &end, &there);
    if (!count.bad) count = quad_adapt(m, p, tolerance, (quad)INFINITY, STEPS + 1, &beyond, &further);
    const quad apart = quad_abs(further.next / there.next - 1);
    there.next = -further.next;
    if (!count.bad) count = quad_adapt(m, p, tolerance, -(quad)INFINITY, STEPS, &end, &there);
    const quad off = quad_distance(p, &end, &start) + quad_abs(there.t);
    char law[64];
    snprintf(law, sizeof law, "%s on %s", methods_table[m].density ? "steps in reverse" : "no steps in reverse",
             p->name);
    /* that steps differ is what is tested; a rounding of the state is one of the time scale, and so of every step */
    const quad bound = Q(1e-27) + 100 * quad_looseness(m);
    judge(!count.bad &&
              (methods_table[m].density ? off < bound && !there.refused && apart > Q(1e-4) : off > 1000 * bound),
          row_card(m)->name, law, "returns within %.1e, steps differ by %.1e", (double)off, (double)apart);
}

/* Errors at the same time, from steps of half the length, which a tolerance smaller by 2^(order + 1) asks for. */
static void order(method m, const quad_problem *p)
{
    enum { HALVINGS = 4, MOST = 8192 }; /* a row whose steps become ever shorter fails soon */
    const motus_method *card = row_card(m);
    quad_state reference = start_of(p);
    quad tolerance = tolerance_of(m, Q(0.02));
    double errors[HALVINGS];
    int64_t bad = 0;
    quad_reference(p, 0, Q(1.25), &reference);
    for (int i = 0; i < HALVINGS; i++, tolerance /= (quad)(1 << (card->order + 1))) {
        quad_state end = start_of(p);
        quad_control control = {0};
        bad += quad_adapt(m, p, tolerance, Q(1.25), MOST, &end, &control).bad || control.t != Q(1.25);
        errors[i] = quad_log2(quad_distance(p, &end, &reference));
    }
    /* the middle one of three: where an error changes its sign the slopes beside it tell nothing */
    const double a = errors[0] - errors[1], b = errors[1] - errors[2], c = errors[2] - errors[3];
    const double slope = fmax(fmin(a, b), fmin(fmax(a, b), c));
    char law[64];
    snprintf(law, sizeof law, "order of controlled steps on %s", p->name);
    /* The length of a step is known to 0.2 %, and its halving to the fraction 1/steps that the last step takes. Beyond
     * order 9 the digits end before slopes settle, as in laws_order.c. */
    judge(!bad && fabs(slope - card->order) < (card->order > 9 ? 0.5 : 0.15), card->name, law,
          "observed %.3f, declared %d", slope, card->order);
}

/* Two looks around, the force at the state where no kick ends there, and the kicks or the turns of all stages; at first
 * a look at the scale. */
static void evaluations(method m, const quad_problem *p)
{
    const motus_method *card = row_card(m);
    quad_state s = start_of(p);
    quad_control control = {0};
    const int64_t steps = 37;
    const quad tolerance = tolerance_of(m, Q(0.02));
    const quad_count count = quad_adapt(m, p, tolerance, (quad)INFINITY, steps, &s, &control);
    char law[64];
    snprintf(law, sizeof law, "controlled evaluations on %s", p->name);
    const row *r = &methods_table[m];
    const bool solved = r->family == IMPLICIT;
    const int64_t first = 2 + (!solved && !r->composition.count && r->splitting.kick[0] != 0 && !r->compensated),
                  each = solved ? 3 : card->evaluations, turns = count.iterations * r->tableau.stages;
    judge(!count.bad && !control.refused && count.evaluations == steps * each + turns + first, card->name, law,
          "%lld in %lld steps, %lld turns", (long long)count.evaluations, (long long)steps,
          (long long)count.iterations);
}

/* The largest error of the energy in this many periods, and in the first ten, after every step; of a row that does not
 * keep it only until that is seen. Because an orbit that shrinks may need ever more steps they are bounded, at three
 * times those of verlet-reversible, the most of all rows. */
static bool follow(stepper *s, double periods, bool keeps, double *soon, double *late)
{
    enum { MOST = 1 << 22 };
    stepper_stop why = STOP_STEPS;
    while (why == STOP_STEPS && (keeps || *late <= 2 * *soon)) {
        if (stepper_steps(s) >= MOST) return false;
        double x[2], v[2];
        if (stepper_advance(s, (stepper_limit){1, 2 * M_PI * periods}, &why, NULL) || stepper_sync(s, x, v, NULL, NULL))
            return false;
        *late = fmax(*late, fabs((v[0] * v[0] + v[1] * v[1]) / 2 - 1 / hypot(x[0], x[1]) + 0.5));
        if (stepper_time(s) < 2 * M_PI * 10) *soon = *late;
    }
    return true;
}

static void energy(method m)
{
    const problem p = {.nx = 2, .nv = 2, .accel = laws_kepler, .traits = {.gradient = true, .smooth = true}};
    const double e = 0.9, x[2] = {1 - e, 0}, v[2] = {0, sqrt((1 + e) / (1 - e))};
    double soon = 0, late = 0;
    const bool keeps = methods_table[m].density;
    chosen c;
    stepper *s = NULL;
    bool ran = !row_choose(row_card(m)->name, &c, NULL, NULL);
    c.relative = 1e-4;
    ran = ran && !stepper_create(&(machine){.problem = &p}, &c, 0, 1, x, v, NULL, &s, NULL) &&
          follow(s, 10000, keeps, &soon, &late);
    judge(ran && (keeps ? late <= 2 * soon && soon < 0.05 : late > 2 * soon), row_card(m)->name,
          keeps ? "energy over 10 000 periods" : "no energy over 10 000 periods", "off by %.1e after 10, then %.1e",
          soon, late);
    stepper_destroy(s);
}

/* The tolerance is what a step on a circular orbit errs, to the power order + 1 of the twentieth by which the time
 * scale there differs from 1 and of the hundredth by which the step is known; at the length at which plans measure
 * it. */
static void circle(method m)
{
    const problem p = {.nx = 2, .nv = 2, .accel = laws_kepler, .traits = {.gradient = true, .smooth = true}};
    const int power = row_card(m)->order + 1;
    const double arc = methods_table[m].family == IMPLICIT ? 0.5 : 0.25, most = pow(1.06, power);
    double x[2] = {1, 0}, v[2] = {0, 1}, off = NAN, tolerance;
    chosen c;
    stepper *s = NULL;
    stepper_stop why;
    bool ran = !row_choose(row_card(m)->name, &c, NULL, NULL);
    c.relative = tolerance = stepper_tolerance_most(&c) / 1.05 * pow(arc / 0.5, power);
    ran = ran && !stepper_create(&(machine){.problem = &p}, &c, 0, 1, x, v, NULL, &s, NULL) &&
          !stepper_advance(s, (stepper_limit){1, 100}, &why, NULL) && !stepper_sync(s, x, v, NULL, NULL);
    if (ran) {
        const double t = stepper_time(s);
        off = fmax(fmax(fabs(x[0] - cos(t)), fabs(x[1] - sin(t))), fmax(fabs(v[0] + sin(t)), fabs(v[1] - cos(t))));
    }
    judge(ran && off < most * tolerance && off > tolerance / most, row_card(m)->name, "error of a step on a circle",
          "%.2e, tolerance %.2e", off, tolerance);
    stepper_destroy(s);
}

void laws_of_density(void)
{
    static const int problems[] = {HENON_HEILES, DRIVEN, RIDER, DAMPED, TANGLED, MAGNET, CUBIC, PARTICLE};
    for (method m = 0; m < row_count(); m++) {
        const row *r = &methods_table[m];
        if (!r->density && strcmp(row_card(m)->name, "dop853") != 0) continue; /* dop853: as others are */
        for (size_t i = 0; i < sizeof problems / sizeof *problems; i++) {
            const quad_problem *p = &quad_problems[problems[i]];
            if (!quad_admits(m, p)) continue;
            if (r->density || problems[i] == HENON_HEILES) reversal(m, p);
            if (!r->density) continue;
            /* on the others errors change their sign where slopes would settle */
            if (problems[i] != DRIVEN && problems[i] != DAMPED && problems[i] != CUBIC) order(m, p);
            if (!p->velocity) evaluations(m, p);
        }
        energy(m);
        if (r->density) circle(m);
    }
}
