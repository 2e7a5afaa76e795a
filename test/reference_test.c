/* References and what they claim about themselves, on motions whose truth is known. */
#include "test/given.h"

#define NEAR(a, b, tolerance) assert_true(fabs((a) - (b)) <= (tolerance))

/* The state of the reference at a time; its claimed error. */
static double reference_at(const char *text, double t, double *x, double *v)
{
    motus_system *s = given_text(text);
    motus_reference *r = NULL;
    motus_error e = motus_default_error();
    must(motus_reference_create(s, NULL, &r, &e), &e, text);
    must(motus_reference_at(r, &t, 1, x, v, &e), &e, text);
    const double error = motus_reference_error(r);
    motus_reference_destroy(r);
    motus_system_destroy(s);
    return error;
}

/* What the reference of a force that is not smooth claims about itself, at the end of the motion, where it is known. */
static void references_of_forces_that_jump(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        double until, x, v; /* x, v: to 17 digits */
    } rows[] = {
        {"x'' = -|x| x\nx(0) = 1\nx'(0) = 0\nuntil 5\nstep 0.078125\n", 5, -0.12403380220720711, 0.81571719623355746},
        {"x'' = -sign(x)\nx(0) = 1\nx'(0) = 0\nuntil 5\nstep 0.078125\n", 5, 0.78427124746190098, 0.6568542494923802},
        {"x'' = -x + if(t > 5.003, if(t < 5.0031, 1000, 0), 0)\nx(0) = 1\nx'(0) = 0\nuntil 10\nstep 0.1\n", 10,
         -0.93505002731567308, 0.57209472603533875},
    };
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
        motus_system *s = given_text(rows[k].text);
        motus_reference *r = NULL;
        motus_error e = motus_default_error();
        double x, v;
        assert_int_equal(motus_reference_create(s, NULL, &r, &e), MOTUS_OK);
        assert_int_equal(motus_reference_at(r, &rows[k].until, 1, &x, &v, &e), MOTUS_OK);
        NEAR(x, rows[k].x, 1e-12);
        NEAR(v, rows[k].v, 1e-12);
        assert_true(motus_reference_error(r) >= 0.1 * fmax(fabs(x - rows[k].x), fabs(v - rows[k].v)));
        assert_non_null(strstr(motus_reference_name(r), "where the force is not smooth"));
        motus_reference_destroy(r);
        motus_comparison *c = NULL;
        must(motus_compare(s, NULL, &c, &e), &e, "compare");
        assert_non_null(strstr(c->remarks, "The force is not smooth along the motion"));
        motus_comparison_destroy(c);
        motus_system_destroy(s);
    }
}

static void a_pulse_at_rest_has_a_reference(void **state)
{
    (void)state;
    motus_system *s = given_text("x'' = -x + exp(-((t-5)/0.1)^2)\nx(0) = 0\nx'(0) = 0\nuntil 10\nstep 0.1\n");
    motus_reference *r = NULL;
    motus_error e = motus_default_error();
    const double end = 10;
    double x;
    assert_int_equal(motus_reference_create(s, NULL, &r, &e), MOTUS_OK);
    assert_int_equal(motus_reference_at(r, &end, 1, &x, NULL, &e), MOTUS_OK);
    NEAR(x, 0.1 * sqrt(acos(-1)) * exp(-0.0025) * sin(5), 1e-12); /* ∫ sin(10 - s) exp(-((s-5)/0.1)²) ds */
    assert_true(motus_reference_error(r) < 1e-11);
    motus_reference_destroy(r);
    motus_system_destroy(s);
}

/* A tolerance saves evaluations, and the error that is claimed then is true: measured against the best reference. */
static void a_tolerance_saves_work(void **state)
{
    (void)state;
    static const char *const texts[] = {
        "x'' = -x + 0.3 sin(t)\nx(0) = 1\nx'(0) = 0\nuntil 30\nstep 3\n",
        ("x'' = -x/(x^2 + y^2)^1.5\ny'' = -y/(x^2 + y^2)^1.5\nx(0) = 0.4\ny(0) = 0\nx'(0) = 0\ny'(0) = 2\n"
         "until 20\nstep 2\n"),
        "x'' = -sign(x)\nx(0) = 1\nx'(0) = 0\nuntil 5\nstep 0.078125\n",
    };
    for (size_t k = 0; k < sizeof texts / sizeof *texts; k++) {
        motus_system *s = given_text(texts[k]);
        motus_study_def def = motus_default_study();
        motus_reference *best = NULL, *draft = NULL;
        motus_error e = motus_default_error();
        must(motus_reference_create(s, NULL, &best, &e), &e, texts[k]);
        def.tolerance = 1e-5;
        must(motus_reference_create(s, &def, &draft, &e), &e, texts[k]);
        double times[50], x[100], v[100], other_x[100], other_v[100], far = 0;
        const double until = k == 0 ? 30 : k == 1 ? 20 : 5;
        for (int i = 0; i < 50; i++) times[i] = until * (i + 0.5) / 50;
        must(motus_reference_at(best, times, 50, x, v, &e), &e, texts[k]);
        must(motus_reference_at(draft, times, 50, other_x, other_v, &e), &e, texts[k]);
        for (size_t i = 0; i < 50 * motus_positions(s); i++)
            far = fmax(far, fmax(fabs(x[i] - other_x[i]), fabs(v[i] - other_v[i])));
        assert_true(far <= 2 * motus_reference_error(draft) + 2 * motus_reference_error(best));
        assert_true(motus_reference_error(draft) < 1e-3);
        /* a force with jumps needs all the work in any case */
        if (k < 2) assert_string_not_equal(motus_reference_name(best), motus_reference_name(draft));
        motus_reference_destroy(best);
        motus_reference_destroy(draft);
        def.tolerance = -1;
        assert_int_equal(motus_reference_create(s, &def, &draft, &e), MOTUS_ARGUMENT);
        assert_non_null(strstr(e.message, "the tolerance of the study is -1"));
        def.tolerance = NAN;
        assert_int_equal(motus_reference_create(s, &def, &draft, &e), MOTUS_ARGUMENT);
        motus_system_destroy(s);
    }
}

/* What cannot be resolved has no reference: a fall into the centre, friction that sticks. */
static void no_reference(void **state)
{
    (void)state;
    static const char *const texts[] = {"x'' = -1/x^2\nx(0) = 1\nx'(0) = 0\nuntil 2\nstep 0.001\n",
                                        "x'' = -x - 0.3 sign(x')\nx(0) = 1\nx'(0) = 0\nuntil 20\nstep 0.01\n"};
    for (size_t k = 0; k < sizeof texts / sizeof *texts; k++) {
        motus_system *s = given_text(texts[k]);
        motus_reference *r = NULL;
        motus_error e = motus_default_error();
        assert_int_equal(motus_reference_create(s, NULL, &r, &e), MOTUS_DIVERGED);
        assert_null(r);
        motus_system_destroy(s);
    }
}

/* Forces that two methods can miss together, in a family, in a sum, and on a driven boundary. */
static void narrow_forces_in_families_are_seen(void **state)
{
    (void)state;
    static const char *const bumps[] = {
        "x[i]'' = 1e5*exp(-((x[i]-1.0317)/1e-4)^2) for i = 1..2\n",
        "x[i]'' = sum(j = 1..2, j == i: 1e5*exp(-((x[j]-1.0317)/1e-4)^2)) for i = 1..2\n",
    };
    const double end = 5, area = 10 * sqrt(acos(-1)); /* of the force, which is the energy gained */
    for (size_t k = 0; k < 2; k++) {
        char text[512];
        snprintf(text, sizeof text, "%sx[1](0) = 0\nx[2](0) = 0.5\nx[1]'(0) = 1\nx[2]'(0) = 0\nstep 0.1\nuntil 5\n",
                 bumps[k]);
        double x[2], v[2];
        assert_true(reference_at(text, end, x, v) < 1e-8);
        NEAR(v[0], sqrt(1 + 2 * area), 1e-9);
        NEAR(x[1], 0.5, 0);
    }
    double y, w;
    assert_true(reference_at("x[i]'' = x[i-1] - x[i] for i = 1..1\nx[0] = 1e4*exp(-((t-1.0317)/1e-4)^2)\n"
                             "x[1](0) = 0\nx[1]'(0) = 0\nstep 0.1\nuntil 5\n",
                             end, &y, &w) < 1e-7);
    NEAR(y, sqrt(acos(-1)) * sin(end - 1.0317), 1e-8);
}

/* Walls at 1 and -1 that push back by 1000 s^1.5: beyond them the force is not defined on the inner side's formula, and
 * stages of a step lie beyond. The contact takes 2 d/v times the integral of (1 - z^2.5)^-1/2 from 0 to 1. */
static void a_force_that_is_defined_on_one_side(void **state)
{
    (void)state;
    const double end = 20, depth = pow(0.00125, 0.4), pi = acos(-1),
                 contact = 2 * depth * 0.4 * sqrt(pi) * tgamma(0.4) / tgamma(0.9);
    const int contacts = (int)floor((end - 1) / (2 + contact));
    const double flight = end - 1 - contacts * (2 + contact) - contact; /* since the last of them */
    double x, v;
    const double error = reference_at("x'' = -1000*max(x-1,0)^1.5 + 1000*max(-1-x,0)^1.5\nx(0) = 0\nx'(0) = 1\n"
                                      "step 0.01\nuntil 20\n",
                                      end, &x, &v);
    assert_true(flight > 0 && contacts == 8 && error < 1e-9);
    NEAR(x, 1 - flight, 10 * error);
    NEAR(v, -1, 10 * error);
}

/* Halvings of one method agree by the same last piece; another method does not agree. */
static void a_second_method_makes_the_first_one_go_on(void **state)
{
    (void)state;
    motus_system *s = given_text("x'' = -9.81 + if(x < 0, -1e4*x, 0)\nx(0) = 1\nx'(0) = 0\nstep 0.01\nuntil 3\n");
    motus_study_def def = motus_default_study();
    motus_convergence *c = NULL;
    motus_error e = motus_default_error();
    const char *const methods[] = {"rk4"};
    def.methods = methods;
    def.method_count = 1;
    must(motus_converge(s, &def, &c, &e), &e, "converge");
    assert_true(c->reference_error < 1e-9);
    motus_convergence_destroy(c);
    motus_system_destroy(s);
}

/* A force of 500 000 jumps: the work has a bound, and the message says so. */
static void a_reference_does_not_take_for_ever(void **state)
{
    (void)state;
    motus_system *s = given_text("x'' = -x + mod(1e5*t, 1)\nx(0) = 1\nx'(0) = 0\nstep 0.1\nuntil 5\n");
    motus_reference *r = NULL;
    motus_error e = motus_default_error();
    assert_int_equal(motus_reference_create(s, NULL, &r, &e), MOTUS_DIVERGED);
    assert_non_null(strstr(e.message, "too long"));
    motus_system_destroy(s);
}

#define OTHER_NUMBERS 2e-11 /* by which motions differ whose texts round the times of kicks of 1000 differently */

/* One motion written in two ways, of which the first hides what decides the force: each reference's error covers the
 * distance between the two. */
static void no_way_of_writing_hides_a_force(void **state)
{
    (void)state;
    static const struct {
        const char *hidden, *plain;
        double until;
    } rows[] = {
        {"-0.01*x + if((t-5.003)^2 < 1e-8, 1000, 0) + if(t > 5.006, 1, 0)",
         "-0.01*x + if(t > 5.0029, if(t < 5.0031, 1000, 0), 0) + if(t > 5.006, 1, 0)", 10},
        {"-x + if(mod(t, 2) < 0.001, 1000, 0)",
         "-x + if(t < 0.001, 1000, 0) + if(t > 2, if(t < 2.001, 1000, 0), 0) + if(t > 4, if(t < 4.001, 1000, 0), 0)",
         5},
        {"-0.01*x + 1000*((t-5.003)^4 < 1e-16)", "-0.01*x + if(t > 5.0029, if(t < 5.0031, 1000, 0), 0)", 10},
        {"-0.01*x + 1000*(log((t-5.003)^2) < -18.420680743952367)",
         "-0.01*x + if(t > 5.0029, if(t < 5.0031, 1000, 0), 0)", 10},
        {"-x + 10*((((cos(0.5*(t-1.172323))^64)^64)^64)^64)", "-x + 10*exp(16777216*log(cos(0.5*(t-1.172323))))", 3},
        {"-x + 0.3*sign(x+1e6-1000000.3)", "-x + 0.3*sign(x-0.3)", 5},
        {"-x*sqrt(|x|)", "-x*abs(x)^0.5", 10},
    };
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
        double x[2], v[2], error[2];
        for (int form = 0; form < 2; form++) {
            char text[512];
            snprintf(text, sizeof text, "x'' = %s\nx(0) = 1\nx'(0) = 0\nstep 0.1\nuntil %g\n",
                     form ? rows[k].plain : rows[k].hidden, rows[k].until);
            error[form] = reference_at(text, rows[k].until, &x[form], &v[form]);
            assert_true(error[form] < 1e-8);
        }
        if (!(fabs(x[0] - x[1]) <= error[0] + error[1] + OTHER_NUMBERS))
            fail_msg("%s: %g", rows[k].hidden, fabs(x[0] - x[1]));
    }
}

/* A failed trial of an implicit method leaves nothing behind in cells without an equation. */
static void contacts_in_a_family(void **state)
{
    (void)state;
    double x, v, y, w;
    const double end = 10,
                 error = reference_at("x[i]'' = -x[i] + max(-x[i]-0.5, 0)^1.5 for i = 1..1\nx[0] = 0\n"
                                      "x[2] = 0\nx[1](0) = 1\nx[1]'(0) = 0\nuntil 10\nstep 0.1\n",
                                      end, &x, &v),
                 other = reference_at("x'' = -x + max(-x-0.5, 0)^1.5\nx(0) = 1\nx'(0) = 0\nuntil 10\nstep 0.1\n", end,
                                      &y, &w);
    assert_true(error < 1e-10 && other < 1e-10 && fabs(x - y) <= error + other);
}

/* The pendulum upright, 1e-16 beside its equilibrium: all runs round this alike, and the motion makes 1e-16 great. */
static void rounding_that_all_runs_share(void **state)
{
    (void)state;
    motus_system *s = given_text("x'' = -sin(x)\nx(0) = pi\nx'(0) = 0\nuntil 38\nstep 0.1\n");
    motus_reference *r = NULL;
    motus_error e = motus_default_error();
    assert_int_equal(motus_reference_create(s, NULL, &r, &e), MOTUS_DIVERGED);
    assert_non_null(strstr(e.message, "rounding"));
    motus_system_destroy(s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(references_of_forces_that_jump),
        cmocka_unit_test(a_pulse_at_rest_has_a_reference),
        cmocka_unit_test(a_tolerance_saves_work),
        cmocka_unit_test(no_reference),
        cmocka_unit_test(narrow_forces_in_families_are_seen),
        cmocka_unit_test(a_force_that_is_defined_on_one_side),
        cmocka_unit_test(a_second_method_makes_the_first_one_go_on),
        cmocka_unit_test(a_reference_does_not_take_for_ever),
        cmocka_unit_test(no_way_of_writing_hides_a_force),
        cmocka_unit_test(contacts_in_a_family),
        cmocka_unit_test(rounding_that_all_runs_share),
    };
    return cmocka_run_group_tests_name("reference", tests, NULL, NULL);
}
