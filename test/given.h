/* What tests share: a system from a text or a model file, a run of it, numbers by their names.
 *
 * A function here that fails ends the test with the library's message.
 */
#ifndef TEST_GIVEN_H
#define TEST_GIVEN_H

#include "motus.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#define UNUSED __attribute__((unused))
#define ROUNDING 0x1p-53 /* of one operation, relative */

UNUSED static void must(motus_status status, const motus_error *err, const char *what)
{
    if (status != MOTUS_OK) fail_msg("%s: %s: %s (%s)", what, motus_status_word(status), err->message, err->hint);
}

/* With `count` settings of parameters or initial values. */
UNUSED static motus_system *given_text_with(const char *text, const char *const *set, size_t count, const char *what)
{
    motus_error err = motus_default_error();
    motus_text_def def = motus_default_text();
    motus_system *s = NULL;
    def.text = text;
    def.set = set;
    def.set_count = count;
    must(motus_system_from_text(&def, &s, &err), &err, what);
    return s;
}

UNUSED static motus_system *given_text(const char *text) { return given_text_with(text, NULL, 0, text); }

/* A progress hook that checks that fractions grow, and cancels at call number cancel_at. */
typedef struct given_progress {
    int calls, cancel_at;
    double last;
} given_progress;

UNUSED static int given_observe(void *context, double fraction)
{
    given_progress *w = context;
    assert_true(fraction >= w->last && fraction <= 1);
    w->last = fraction;
    return ++w->calls == w->cancel_at;
}

/* The bytes of a file, to be freed. */
UNUSED static char *given_file(const char *path)
{
    FILE *f = fopen(path, "rb");
    if (!f) fail_msg("cannot open %s", path);
    size_t room = 1 << 20, n = 0;
    char *text = malloc(room);
    assert_non_null(text);
    n = fread(text, 1, room - 1, f);
    fclose(f);
    text[n] = 0;
    return text;
}

UNUSED static void given_path(char *out, size_t size, const char *folder, const char *name)
{
    snprintf(out, size, "%s/%s/%s", MOTUS_SOURCE_DIR, folder, name);
}

/* A model of models/, with `count` settings of parameters. */
UNUSED static motus_system *given_model(const char *name, const char *const *set, size_t count)
{
    char path[1024];
    given_path(path, sizeof path, "models", name);
    char *text = given_file(path);
    motus_system *s = given_text_with(text, set, count, name);
    free(text);
    return s;
}

/* NULL and NaN: the model's. By the interpreter, so that the test needs no compiler. */
UNUSED static int given_adaptive(const char *method)
{
    const motus_method *card = NULL;
    return method && motus_method_find(method, &card, NULL) == MOTUS_OK && card->adaptive;
}

/* Of an adaptive method the longest step, so that it takes about as many. */
UNUSED static void given_step(motus_run_def *def, double step)
{
    const int adaptive = given_adaptive(def->method);
    def->step = adaptive ? NAN : step;
    def->longest_step = adaptive ? fabs(step) : 0;
}

UNUSED static void given_ensemble_step(motus_ensemble_def *def, double step)
{
    const int adaptive = given_adaptive(def->method);
    def->step = adaptive ? NAN : step;
    def->longest_step = adaptive ? fabs(step) : 0;
}

UNUSED static motus_run *given_run(motus_system *s, const char *method, double step, double until)
{
    motus_error err = motus_default_error();
    motus_run_def def = motus_default_run();
    motus_run *r = NULL;
    def.method = method;
    given_step(&def, step);
    def.until = until;
    def.machine = "interpreter";
    must(motus_run_create(s, &def, &r, &err), &err, method ? method : "run");
    return r;
}

UNUSED static void finish(motus_run *r)
{
    motus_error err = motus_default_error();
    must(motus_run_finish(r, &err), &err, motus_run_now(r).method);
    assert_true(motus_run_done(r));
}

UNUSED static void take_steps(motus_run *r, int64_t n)
{
    motus_error err = motus_default_error();
    must(motus_run_step(r, n, &err), &err, motus_run_now(r).method);
}

UNUSED static size_t column(const motus_system *s, const char *name)
{
    size_t first = 0, count = 0;
    motus_error err = motus_default_error();
    must(motus_column_find(s, name, &first, &count, &err), &err, name);
    return first;
}

UNUSED static double value(const motus_system *s, motus_run *r, const char *name)
{
    size_t k = column(s, name);
    double out = NAN;
    motus_error err = motus_default_error();
    must(motus_run_values(r, &k, 1, &out, &err), &err, name);
    return out;
}

/* The state, x then v; *count numbers, to be freed. */
UNUSED static double *whole_state(const motus_system *s, motus_run *r, size_t *count)
{
    size_t nx = motus_positions(s), nv = motus_velocities(s);
    double *y = malloc((nx + nv + 1) * sizeof *y);
    assert_non_null(y);
    motus_error err = motus_default_error();
    must(motus_run_state(r, y, y + nx, &err), &err, "state");
    if (count) *count = nx + nv;
    return y;
}

UNUSED static void same_state(const motus_system *s, motus_run *a, motus_run *b, const char *what)
{
    size_t n = 0;
    double *p = whole_state(s, a, &n), *q = whole_state(s, b, NULL);
    for (size_t k = 0; k < n; k++)
        if (memcmp(&p[k], &q[k], sizeof *p))
            fail_msg("%s, %s: number %zu is %a in one and %a in the other", what, motus_run_now(a).method, k, p[k],
                     q[k]);
    free(p);
    free(q);
}

/* |got - expected| <= bound, and got is a number. */
UNUSED static void near(double got, double expected, double bound, const char *what)
{
    if (!(fabs(got - expected) <= bound))
        fail_msg("%s is %.17g, expected %.17g: off by %.3g, allowed %.3g", what, got, expected, fabs(got - expected),
                 bound);
}

#endif
