/* Runs that pass a singularity of the force are told from those that come near to one. */
#include "test/given.h"

#include <stdbool.h>

/* What is said of the run, and the time of the step in *at. */
static motus_status said(const char *text, const char *method, double *at, bool *failed)
{
    motus_system *s = given_text(text);
    motus_run_def def = motus_default_run();
    motus_error err = motus_default_error();
    motus_run *r = NULL;
    def.method = method;
    *at = NAN;
    *failed = motus_run_create(s, &def, &r, &err) == MOTUS_METHOD; /* it admits no force of the velocity */
    if (*failed) return motus_system_destroy(s), MOTUS_OK;
    const motus_status end = motus_run_finish(r, &err);
    motus_run_destroy(r);
    const motus_status status = motus_run_singular(s, &def, &err);
    motus_system_destroy(s);
    if (status != MOTUS_OK && status != MOTUS_SINGULAR && status != MOTUS_UNRESOLVED)
        fail_msg("%s: %s", text, err.message);
    *at = status != MOTUS_OK ? err.time : NAN;
    *failed = end != MOTUS_OK; /* it says so itself */
    if (status != MOTUS_OK && ((!strstr(err.message, "singularity") &&
                                !strstr(err.message, "undefined at the start")) == (status == MOTUS_SINGULAR) ||
                               err.status != status || !err.hint[0]))
        fail_msg("%s", err.message);
    return status;
}

/* Whether the run is accused of a singularity. A run that fails by itself needs no accusation. */
static bool accused(const char *text, const char *method, double *at)
{
    bool failed;
    const motus_status status = said(text, method, at, &failed);
    if (status != MOTUS_SINGULAR) *at = NAN;
    return status == MOTUS_SINGULAR || failed;
}

static const char *const methods[] = {"verlet", "velocity-verlet", "symplectic-euler", "explicit-euler", "rk4",
                                      "rk3",    "pefrl",           "kahan-li8",        "gauss4"};

/* When: by energy, pi/(2 sqrt 2) = 1.1107 from 1 for -1/r^2, sqrt(pi/2) = 1.2533 for -1/x. */
static void passing_a_pole(void **unused)
{
    (void)unused;
    static const struct {
        const char *text;
        double when;
    } cases[] = {
        {"x'' = -1/x^2\nx(0) = 1\nx'(0) = 0\nstep 0.001\nuntil 2\n", 1.1107207345395915},
        {"x'' = -x^(-2)\nx(0) = 1\nx'(0) = 0\nstep 0.001\nuntil 2\n", 1.1107207345395915},
        {"r'' = -r/|r|^3\nr(0) = (0.6, 0.8)\nr'(0) = (0, 0)\nstep 0.001\nuntil 2\n", 1.1107207345395915},
        {"r'' = -r/|r|^3\nr(0) = (0.48, 0.64, 0.6)\nr'(0) = (0, 0, 0)\nstep 0.001\nuntil 2\n", 1.1107207345395915},
        {"x'' = -1/x\nx(0) = 1\nx'(0) = 0\nstep 0.001\nuntil 3\n", 1.2533141373155003},
        {"x'' = -x + 1/(t - 1.2345)\nx(0) = 0.5\nx'(0) = 0\nstep 0.01\nuntil 3\n", 1.2345},
        /* the velocity at x is sqrt(2 log(cos 1/cos x)) */
        {"x'' = tan(x)\nx(0) = 1\nx'(0) = 0\nstep 0.001\nuntil 3\n", NAN},
        {"x'' = log(x)\nx(0) = 0.5\nx'(0) = 0\nstep 0.001\nuntil 3\n", NAN},
        /* repelled, and yet on the other side after a step of 0.3 */
        {"x'' = 1/x^2\nx(0) = 1\nx'(0) = -30\nstep 0.01\nuntil 1\n", NAN},
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++)
        for (size_t m = 0; m < sizeof methods / sizeof *methods; m++) {
            double at;
            if (!accused(cases[k].text, methods[m], &at)) fail_msg("%s by %s", cases[k].text, methods[m]);
            /* the first-order methods come late by a few steps */
            if (!isnan(at) && !isnan(cases[k].when) && fabs(at - cases[k].when) > 0.01)
                fail_msg("%s by %s: at %g", cases[k].text, methods[m], at);
        }
}

static void coming_near_to_a_pole(void **unused)
{
    (void)unused;
    static const char *const texts[] = {
        "r'' = -r/|r|^3\nr(0) = (0.1, 0)\nr'(0) = (0, sqrt(1.9/0.1))\nstep 0.002\nuntil 20\n",
        "x'' = 1/x^2\nx(0) = 1\nx'(0) = -3\nstep 0.001\nuntil 3\n",
        "x'' = -x/(x^2 + 0.0001)^1.5\nx(0) = 1\nx'(0) = 0\nstep 0.0005\nuntil 5\n",
        /* a pole in the branch that is not taken, and a force that is infinite but can be integrated */
        "eps = 0.01\nx'' = if(|x| < eps, -x/eps^3, -x/|x|^3)\nx(0) = 1\nx'(0) = 0\nstep 0.0001\nuntil 3\n",
        "x'' = -sign(x)/sqrt(|x|)\nx(0) = 1\nx'(0) = 0\nstep 0.001\nuntil 5\n",
        /* repelled, by steps that are far too long: shorter ones converge, and none passes the pole */
        "x'' = 1/x - 1\nx(0) = 1e-3\nx'(0) = 0\nstep 0.01\nuntil 3\n",
        "x'' = 1/x - 1\nx(0) = 1e-3\nx'(0) = 0\nstep 0.005\nuntil 3\n",
        "r'' = -r/|r|^3\nr(0) = (1, 0)\nr'(0) = (0, 0.2)\nstep 0.04\nuntil 1\n",
        "x'' = -x/3\nx(0) = 1\nx'(0) = 0\nstep 0.01\nuntil 5\n",
    };
    for (size_t k = 0; k < sizeof texts / sizeof *texts; k++)
        for (size_t m = 0; m < sizeof methods / sizeof *methods; m++) {
            double at;
            /* a method that cannot solve its equations says so itself */
            if (accused(texts[k], methods[m], &at) && !isnan(at))
                fail_msg("%s by %s is accused at %g", texts[k], methods[m], at);
        }
}

/* However weak a pole is, no motion passes it: its potential is infinite. */
static void passing_a_weak_pole(void **unused)
{
    (void)unused;
    static const char *const forces[] = {
        "-x + 1e-12/(x - 0.5)^2", "-x - 1e-9/(x - 0.5)^2", "-x + 1e-20/(x - 0.5)^2", "-x - 1e-14/|x - 0.5|^1.5",
        "-x + 1e-10/(x - 0.5)",   "-x + 1e-12*tan(pi*x)",  "-x + 1e-9/(t - 1.05)",   "-x + 1e-9/(x' + 0.5)^2",
    };
    for (size_t k = 0; k < sizeof forces / sizeof *forces; k++)
        for (size_t m = 0; m < sizeof methods / sizeof *methods; m++) {
            char text[256];
            double at;
            bool failed;
            snprintf(text, sizeof text, "x'' = %s\nx(0) = 1\nx'(0) = 0\nstep 0.1\nuntil 3\n", forces[k]);
            if (said(text, methods[m], &at, &failed) != MOTUS_SINGULAR && !failed)
                fail_msg("%s by %s", text, methods[m]);
        }
}

/* Methods that read the force only later on go over it. */
static void beginning_on_a_pole(void **unused)
{
    (void)unused;
    double at;
    bool failed;
    const char *const text = "x'' = 1/x\nx(0) = 0\nx'(0) = 1\nstep 0.5\nuntil 2\n";
    motus_system *s = given_text(text);
    motus_run_def def = motus_default_run();
    motus_error err = motus_default_error();
    def.method = "leapfrog";
    assert_int_equal(said(text, "leapfrog", &at, &failed), MOTUS_SINGULAR);
    assert_true(at == 0);
    assert_int_equal(motus_run_singular(s, &def, &err), MOTUS_SINGULAR);
    assert_string_equal(err.message,
                        "the motion is undefined at the start, t = 0: x' has no finite rate of change there; "
                        "what follows is not the motion");
    motus_system_destroy(s);
}

/* A force that is bounded, or has an integral, has no such singularity, although a divisor passes 0. */
static void forces_without_a_pole(void **unused)
{
    (void)unused;
    static const char *const forces[] = {
        "-x/(x^2 + 1e-6)^1.5",
        "-x/(|x|^3 + 1e-9)",
        "-x + 1000/(1 + ((x - 0.5)/0.0001)^2)",
        "-x/(|x|^2.5 + 1e-9)",
        "-sin(20*x)/x",
        "-x + (1 - cos(x))/x^2",
        "-x - 0.1*x'/|x'|",
        "-x - 0.1*x'/sqrt(|x'|)",
        "-x + (exp(x) - 1)/x",
        "-x + (1 - exp(-x))/x",
        "-x + 0.1/sqrt(|x - 0.5|)",
        "-x + 0.1/|x - 0.5|^0.4",
        "-x + 0.1*log(|x - 0.5|)",
        "-x + (x^2 - 0.25)/(x - 0.5)",
    };
    static const double steps[] = {0.1, 0.01, 0.001};
    for (size_t k = 0; k < sizeof forces / sizeof *forces; k++)
        for (size_t i = 0; i < sizeof steps / sizeof *steps; i++)
            for (size_t m = 0; m < sizeof methods / sizeof *methods; m++) {
                char text[256];
                double at;
                bool failed;
                snprintf(text, sizeof text, "x'' = %s\nx(0) = 1\nx'(0) = 0\nstep %g\nuntil 3\n", forces[k], steps[i]);
                if (said(text, methods[m], &at, &failed) == MOTUS_SINGULAR)
                    fail_msg("%s by %s: at %g", text, methods[m], at);
            }
}

/* Steps that lead elsewhere than smaller ones; and such that do not. */
static void steps_that_do_not_resolve(void **unused)
{
    (void)unused;
    static const struct {
        const char *text;
        motus_status status;
    } cases[] = {
        {"x'' = -x/(x^2 + 1e-6)^1.5\nx(0) = 1\nx'(0) = 0\nstep 0.01\nuntil 3\n", MOTUS_UNRESOLVED},
        {"x'' = -x/(x^2 + 1e-6)^1.5\nx(0) = 1\nx'(0) = 0\nstep 0.000001\nuntil 1.2\n", MOTUS_OK},
        {"x'' = -x/(|x|^3 + 1e-9)\nx(0) = 1\nx'(0) = 0\nstep 0.01\nuntil 3\n", MOTUS_UNRESOLVED},
        {"x'' = -x + 1000/(1 + ((x - 0.5)/0.0001)^2)\nx(0) = 1\nx'(0) = 0\nstep 0.1\nuntil 3\n", MOTUS_UNRESOLVED},
        {"x'' = -x/(x^2 + 0.01)^1.5\nx(0) = 1\nx'(0) = 0\nstep 0.001\nuntil 3\n", MOTUS_OK},
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        double at;
        bool failed;
        const motus_status status = said(cases[k].text, "verlet", &at, &failed);
        if (status != cases[k].status) fail_msg("%s: %s", cases[k].text, motus_status_word(status));
    }
}

/* Example models as they stand. */
static void no_example_is_accused(void **unused)
{
    (void)unused;
    static const char *const names[] = {
        "arenstorf", "charged-particle", "comet",           "crossed-fields", "damped-cubic", "double-pendulum",
        "duffing",   "kepler",           "pendulum",        "penning-trap",   "projectile",   "resonance",
        "spring",    "thrown-ball",      "thrown-ball-air", "ueda",           "van-der-pol"};
    for (size_t k = 0; k < sizeof names / sizeof *names; k++) {
        char path[1024];
        motus_error err = motus_default_error();
        snprintf(path, sizeof path, "%s/models/%s.motus", MOTUS_SOURCE_DIR, names[k]);
        char *text = given_file(path);
        motus_system *s = given_text(text);
        motus_run_def def = motus_default_run();
        must(motus_run_singular(s, &def, &err), &err, names[k]);
        motus_system_destroy(s);
        free(text);
    }
}

/* ---- arguments and memory ---- */

typedef struct purse {
    long left, refused, open;
} purse;

static void *spend(void *context, size_t bytes)
{
    purse *p = context;
    if (p->left == 0) return p->refused++, NULL;
    if (p->left > 0) p->left--;
    p->open++;
    return malloc(bytes);
}

static void spare(void *context, void *block)
{
    purse *p = context;
    p->open--;
    free(block);
}

static void wrong_requests(void **unused)
{
    (void)unused;
    purse p = {-1, 0, 0};
    motus_text_def text = motus_default_text();
    motus_run_def def = motus_default_run();
    motus_error err = motus_default_error();
    motus_system *s;
    text.text = "x'' = -1/x^2\nx(0) = 1\nx'(0) = 0\nstep 0.01\nuntil 2\n";
    text.allocator = (motus_allocator){spend, spare, &p};
    assert_int_equal(motus_run_singular(NULL, &def, &err), MOTUS_ARGUMENT);
    must(motus_system_from_text(&text, &s, &err), &err, "text");
    def.step = -1;
    assert_int_equal(motus_run_singular(s, &def, &err), MOTUS_ARGUMENT);
    def.step = NAN;
    motus_status status = MOTUS_MEMORY;
    for (long k = 0; status != MOTUS_SINGULAR || p.refused; k++) {
        motus_system *t;
        must(motus_system_from_text(&text, &t, &err), &err, "text");
        p.left = k;
        p.refused = 0;
        status = motus_run_singular(t, &def, &err);
        p.left = -1;
        /* without memory for the diagnosis the verdict stands alone */
        assert_true(status == MOTUS_SINGULAR || (p.refused && status == MOTUS_MEMORY));
        motus_system_destroy(t);
    }
    assert_int_equal(motus_run_singular(s, NULL, &err), MOTUS_SINGULAR); /* everything is the model's */
    motus_system_destroy(s);
    assert_int_equal(p.open, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(passing_a_pole),        cmocka_unit_test(coming_near_to_a_pole),
        cmocka_unit_test(passing_a_weak_pole),   cmocka_unit_test(beginning_on_a_pole),
        cmocka_unit_test(forces_without_a_pole), cmocka_unit_test(steps_that_do_not_resolve),
        cmocka_unit_test(no_example_is_accused), cmocka_unit_test(wrong_requests),
    };
    return cmocka_run_group_tests_name("singular", tests, NULL, NULL);
}
