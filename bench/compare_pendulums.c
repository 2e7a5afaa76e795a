/* Ten thousand driven pendulums to a given accuracy, one core: lanes with a step of their own each, against one after
 * the other. */
#define NUMBER long double
#define ABSOLUTE fabsl
#define POWER powl
#include "bench/bench.h"
#include "bench/peers/peers.h"
#include "motus.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { COUNT = 10000, ROUNDS = 7, MOST = 2, COLUMNS = 10 };
#include "bench/extrapolation.h"

static const double LIMIT = 0.12, ERROR = 1e-9, UNTIL = 20;

typedef struct fleet {
    double F[COUNT], theta[COUNT], x[COUNT], v[COUNT], truth_x[COUNT], truth_v[COUNT];
    const char *method;
    double tolerance;
} fleet;

static NUMBER strength;
static void pendulum(const NUMBER *x, const NUMBER *v, NUMBER t, NUMBER *a)
{
    a[0] = -0.1 * v[0] - sinl(x[0]) + strength * cosl(2 * t / 3);
}

static double by_ours(void *p)
{
    fleet *f = p;
    return ours_pendulums("bench/driven-pendulum.motus", f->method, f->tolerance, COUNT, f->F, f->theta, f->x, f->v);
}

static double by_odeint(void *p)
{
    fleet *f = p;
    const double start = thread_seconds();
    const int good = peer_odeint_pendulums(COUNT, f->F, f->theta, f->tolerance, f->x, f->v);
    return good ? thread_seconds() - start : NAN;
}

static double median_error(const fleet *f)
{
    double *off = malloc(COUNT * sizeof *off);
    if (!off) return NAN;
    for (int k = 0; k < COUNT; k++) off[k] = fmax(fabs(f->x[k] - f->truth_x[k]), fabs(f->v[k] - f->truth_v[k]));
    const double middle = middle_of(off, COUNT);
    free(off);
    return middle;
}

/* F from 0.5 to 1.5 in order, theta(0) from 1 to 3 in another. */
static void fill(fleet *f)
{
    for (int k = 0; k < COUNT; k++) {
        f->F[k] = 0.5 + (double)k / (COUNT - 1);
        f->theta[k] = 1 + 2 * fmod(0.618033988749895 * k, 1);
        NUMBER y[2] = {f->theta[k], 0};
        strength = f->F[k];
        solve(pendulum, 1, UNTIL, 0.5, y, COLUMNS, 1e-17L);
        f->truth_x[k] = (double)y[0], f->truth_v[k] = (double)y[1];
    }
}

/* The fastest method and tolerance with this median error. */
static bool choose(fleet *f)
{
    const char *method = NULL;
    double least = INFINITY, tolerance = NAN;
    for (size_t m = 0; m < motus_method_count(); m++) {
        if (!motus_method_at(m)->adaptive || motus_method_at(m)->order < 5) continue;
        f->method = motus_method_at(m)->name;
        if (!strncmp(f->method, "dep", 3)) continue; /* forces that are free of v */
        for (int k = 0; k < 8; k++) {
            f->tolerance = (k % 2 ? 3e-8 : 1e-7) * pow(10, -(k / 2));
            const double took = fmin(by_ours(f), by_ours(f));
            if (isnan(took) || took >= least || median_error(f) > ERROR) continue;
            least = took, method = f->method, tolerance = f->tolerance;
            break;
        }
    }
    f->method = method, f->tolerance = tolerance;
    return method != NULL;
}

void compare_driven_pendulums(void)
{
    fleet *ours = malloc(sizeof *ours), *other = malloc(sizeof *other);
    char name[80];
    report_section("Accuracy: 10 000 driven pendulums, t = 20, one core", "all of them");
    if (ours && other) {
        fill(ours);
        *other = *ours;
        other->tolerance = 1e-8;
        if (choose(ours)) {
            side sides[] = {SIDE(by_ours, ours), SIDE(by_odeint, other)};
            measure(sides, 2, ROUNDS);
            snprintf(name, sizeof name, "odeint, tolerance 1e-8; ours %s, tolerance %.0e", ours->method,
                     ours->tolerance);
            report_at_most(name, &sides[0], &sides[1], LIMIT, "ms");
            report_error("its median error", median_error(ours), median_error(other), ERROR);
        }
    }
    free(ours), free(other);
}
