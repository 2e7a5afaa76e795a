/* What the tests of the stepper share. */
#ifndef TEST_STEPPER_TEST_H
#define TEST_STEPPER_TEST_H

#include "core/stepper.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#undef fail /* cmocka defines a macro `fail`; here it is the function of base/error.h */
#define explain(...) (print_error(__VA_ARGS__), print_error("\n"), _fail(__FILE__, __LINE__))
#define assert_near(a, b, margin) \
    (fabs((a) - (b)) <= (margin) ? (void)0 : explain(#a " is %.17g, not %.17g within %g", (a), (b), (margin)))

static inline stepper *begin(const problem *p, const char *method, double t0, double h, const double *x,
                             const double *v)
{
    chosen c;
    stepper *s = NULL;
    motus_error err = {0};
    assert_int_equal(row_choose(method, &c, NULL, &err), MOTUS_OK);
    c.first = c.most = fabs(h); /* of an adaptive method, so that its steps are no longer than those of others */
    if (stepper_create(&(machine){.problem = p}, &c, t0, h, x, v, NULL, &s, &err))
        explain("%s: %s", method, err.message);
    return s;
}

static inline bool admitted(const problem *p, size_t k)
{
    chosen c;
    return !row_choose(row_card(k)->name, &c, NULL, NULL) && !row_admits(&c, &p->traits, NULL);
}

typedef struct outcome {
    double x[3], v[3], time;
    int64_t evaluations, iterations;
} outcome;

static inline outcome finish(stepper *s)
{
    outcome o = {0};
    assert_int_equal(stepper_sync(s, o.x, o.v, NULL, NULL), MOTUS_OK);
    o.time = stepper_time(s);
    o.evaluations = stepper_evaluations(s);
    o.iterations = stepper_iterations(s);
    stepper_destroy(s);
    return o;
}

#endif
