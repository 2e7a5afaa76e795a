/* Runs by adaptive methods where the force jumps or has kinks: every step ends there, so the order of the method and
 * its steps are those of smooth forces; and forces that hold the motion at a jump, as dry friction that sticks. */
#include "test/given.h"

#define PI 3.14159265358979323846

typedef struct outcome {
    double x[16], v[16];
    motus_run_statistics did;
    motus_status status;
    motus_cause cause;
    double time; /* of the failure */
    char message[MOTUS_TEXT_MAX];
} outcome;

/* A run to its end. Where not NULL, errors: of the first position and velocity, why: why switches are not located. */
static outcome done(const char *text, const motus_run_def *def, double errors[2], char *why, size_t size)
{
    const size_t columns[2] = {1, 2};
    double values[2];
    motus_system *s = given_text(text);
    motus_error err = motus_default_error();
    motus_run *r = NULL;
    outcome out = {.did = motus_run_now(NULL)};
    out.status = motus_run_create(s, def, &r, &err);
    if (out.status == MOTUS_OK) out.status = motus_run_finish(r, &err);
    if (out.status) {
        snprintf(out.message, sizeof out.message, "%s", err.message);
        out.cause = err.cause;
        out.time = err.time;
    }
    if (r) {
        must(motus_run_state(r, out.x, out.v, &err), &err, text);
        out.did = motus_run_now(r);
        if (errors) must(motus_run_errors(r, columns, 2, values, errors, &err), &err, text);
        if (why) snprintf(why, size, "%s", out.did.not_located);
    }
    motus_run_destroy(r);
    motus_system_destroy(s);
    return out;
}

static outcome run_of(const char *text, const char *method, double tolerance, double until)
{
    motus_run_def def = motus_default_run();
    def.method = method;
    def.tolerance = tolerance;
    def.until = until;
    def.machine = "interpreter";
    def.switches = MOTUS_SWITCHES_LOCATE;
    return done(text, &def, NULL, NULL, 0);
}

static outcome sound(outcome o, const char *text, const char *method)
{
    if (o.status) fail_msg("%s: %s by %s: %s", text, motus_status_word(o.status), method, o.message);
    return o;
}

static outcome finished(const char *text, const char *method, double tolerance, double until)
{
    return sound(run_of(text, method, tolerance, until), text, method);
}

#define NEAR(value, expected, within) near(value, expected, within, #value)

static const char *const methods[] = {"dop853", "taylor", "tsit5", "verner9", "radau15"};
enum { METHODS = sizeof methods / sizeof *methods };

/* Half periods of frequency 1 and 2. */
static double one_sided(double t)
{
    const double period = 1.5 * PI, s = fmod(t, period);
    return s < PI / 2 ? sin(2 * s) / 2 : -sin(s - PI / 2);
}

static void kinks(void **state)
{
    (void)state;
    static const char *const text = "x'' = -x - 3 max(0, x)\nx(0) = 0\nx'(0) = 1\n";
    for (int m = 0; m < METHODS; m++) {
        const outcome o = finished(text, methods[m], 1e-12, 20);
        NEAR(o.x[0], one_sided(20), 1e-10);
    }
    const outcome o = finished(text, "dop853", 1e-13, 100);
    NEAR(o.x[0], 0.436648648606997, 1e-13);
    const double slow = (double)finished("x'' = -x\nx(0) = 0\nx'(0) = 1\n", "dop853", 1e-13, 100).did.steps,
                 fast = (double)finished("x'' = -4 x\nx(0) = 0\nx'(0) = 1\n", "dop853", 1e-13, 100).did.steps;
    assert_true((double)o.did.steps <= 1.5 * (slow * 2 / 3 + fast / 3));
    assert_int_equal(o.did.switches,
                     42); /* 21 whole periods, and more than a quarter of the next: x > 0 from its start */
}

/* Jumps at whole numbers, which steps of a force that is constant between them do not see. */
static void jumps_in_time(void **state)
{
    (void)state;
    static const char *const texts[] = {"x'' = sign(sin(pi t))\nx(0) = 0\nx'(0) = 0\n",
                                        "x'' = 1 - 2 mod(floor(t), 2)\nx(0) = 0\nx'(0) = 0\n",
                                        "x'' = if(mod(t, 2) < 1, 1, -1)\nx(0) = 0\nx'(0) = 0\n"};
    for (size_t k = 0; k < sizeof texts / sizeof *texts; k++)
        for (int m = 0; m < METHODS; m++) {
            const outcome o = finished(texts[k], methods[m], 1e-12, 100);
            NEAR(o.x[0], 50, 50 * (strcmp(methods[m], "dop853") ? 2e-13 : 1e-13));
            NEAR(o.v[0], 0, 1e-12);
        }
}

/* E6: it turns at whole multiples of pi, and sticks where the spring pulls less than friction holds. */
static void sticks(void **state)
{
    (void)state;
    static const char *const text = "x'' = -x - f sign(x')\nf = 0.1\nx(0) = 1.05\nx'(0) = 0\n";
    for (int m = 0; m < METHODS; m++) {
        const outcome o = finished(text, methods[m], 1e-13, 100), twice = finished(text, methods[m], 1e-13, 200);
        NEAR(o.x[0], -0.05, 1e-13);
        NEAR(o.v[0], 0, 0);
        NEAR(twice.x[0], o.x[0], 0);
        assert_true(twice.did.steps <= o.did.steps + 2);
        const outcome before = finished(text, methods[m], 1e-13, 4.5 * PI);
        NEAR(before.x[0], 0.1, 1e-12);
    }
    assert_true(finished(text, "taylor", 1e-13, 100).did.steps < 100);
}

/* A block that slides to rest: it stops at v^2 / (2 mu g). */
static void comes_to_rest(void **state)
{
    (void)state;
    for (int m = 0; m < METHODS; m++) {
        const outcome o =
            finished("x'' = -mu g sign(x')\nmu = 0.25\ng = 9.81\nx(0) = 0\nx'(0) = 3\n", methods[m], 1e-12, 10);
        NEAR(o.x[0], 1.834862385321100917, 1e-14);
        NEAR(o.v[0], 0, 0);
    }
}

/* On a belt: with it as far as friction holds, x = f; then on a circle about f, which touches the belt's speed. */
static void slips_from_a_belt(void **state)
{
    (void)state;
    static const char *const text = "x'' = -x + f sign(V - x')\nf = 0.6\nV = 0.5\nx(0) = 0\nx'(0) = 0.5\n";
    const double slip = 0.6 / 0.5;
    for (int m = 0; m < METHODS; m++) {
        const outcome stuck = finished(text, methods[m], 1e-12, 1), o = finished(text, methods[m], 1e-12, 30);
        NEAR(stuck.x[0], 0.5, 1e-15);
        NEAR(stuck.v[0], 0.5, 0);
        NEAR(o.x[0], 0.6 + 0.5 * sin(30 - slip), 1e-10);
    }
}

/* A relay with the rate in its argument: it slides along x + x' = 0, where x falls as exp(-t). */
static void relay(void **state)
{
    (void)state;
    static const char *const text = "x'' = -sign(x + x')\nx(0) = 0.4\nx'(0) = 0\n";
    /* from rest under -1 to the line: 0.4 - t^2/2 - t = 0 */
    const double t = sqrt(1.8) - 1, x = 0.4 - t * t / 2;
    for (int m = 0; m < METHODS; m++) {
        const outcome o = finished(text, methods[m], 1e-12, 5);
        NEAR(o.x[0], x * exp(t - 5), 1e-12);
        NEAR(o.v[0], -o.x[0], 1e-12);
    }
}

/* Arguments that leave 0 with a derivative of 0, at the start or after they have stuck there, each to the side that its
 * first derivative says that is not 0. The numbers are those of the classical method of order 4 in steps of 1e-4 on the
 * side that is known. */
static void leaves_without_slope(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        double until, x, v;
    } cases[] = {
        {"x'' = sin(t) - |x'| x'\nx(0) = 0\nx'(0) = 0\n", 4, 2.16188407704518, 0.14481977380395},
        {"x'' = -max(0, t - 1)^2 - |x'| x'\nx(0) = 0\nx'(0) = 0\n", 4, -3.25918092910797, -2.81361972954188},
        {"x'' = 1.2 sin(t) - sign(x') - 0.5 |x'| x'\nx(0) = 0\nx'(0) = 0\n", 2, 0.06631510686895, 0.14447530119832},
        {"a = t - 1 - 0.5 |x'| x'\nx'' = if(x <= 0 and a < 0, 0, a)\nx(0) = 0\nx'(0) = 0\n", 3, 1.13136198297093,
         1.46515336962322},
        {"x'' = -t - if(x < 0, t/2, 0)\nx(0) = 0\nx'(0) = 0\n", 2, -2, -3},
    };
    const size_t count = sizeof cases / sizeof *cases;
    for (size_t k = 0; k < count; k++)
        for (int m = 0; m < METHODS; m++) {
            const outcome o = finished(cases[k].text, methods[m], 1e-11, cases[k].until);
            NEAR(o.x[0], cases[k].x, 1e-9);
            NEAR(o.v[0], cases[k].v, 1e-9);
        }
}

/* Each by itself: bodies that stop at different times. */
static void many(void **state)
{
    (void)state;
    static const char *const text =
        "x[i]'' = -x[i] - 0.1 sign(x[i]') for i = 1..4\nx[i](0) = 0.3 i + 0.05 for i = 1..4\n"
        "x[i]'(0) = 0 for i = 1..4\n";
    for (int m = 0; m < METHODS; m++) {
        const outcome o = finished(text, methods[m], 1e-12, 60);
        for (int i = 1; i <= 4; i++) {
            double at = 0.3 * i + 0.05;
            while (fabs(at) > 0.1) at = -(at - copysign(0.2, at));
            NEAR(o.x[i - 1], at, 1e-11);
            NEAR(o.v[i - 1], 0, 0);
        }
    }
}

/* Two bodies that rub on one another go on together. */
static void together(void **state)
{
    (void)state;
    static const char *const text =
        "x'' = -sign(x' - y')\ny'' = sign(x' - y')/3\nx(0) = 0\nx'(0) = 4\ny(0) = 0\ny'(0) = 0\n";
    for (int m = 0; m < METHODS; m++) {
        const outcome o = finished(text, methods[m], 1e-12, 10);
        NEAR(o.v[0], 1, 1e-14); /* momentum 4 of masses 1 and 3, after 3 units of time */
        NEAR(o.v[1], 1, 1e-14);
        NEAR(o.x[0], 3 * 2.5 + 7, 1e-13);
        NEAR(o.x[1], 3 * 0.5 + 7, 1e-13);
    }
}

/* Two relays: from x = A each swing takes 2 sqrt(A)/(1 - f)^(1/2) and what brakes it, and ends at -A (1 - f)/(1 + f).
 * The swings come to an end, and there both signs hold the motion. */
static double swings_end(double f)
{
    const double there = sqrt(2 / (1 - f)), back = sqrt(2 * (1 - f)) / (1 + f);
    return (there + back) / (1 - sqrt((1 - f) / (1 + f)));
}

static void comes_to_rest_by_swings(void **state)
{
    (void)state;
    static const char *const text = "x'' = -sign(x) - 0.5 sign(x')\nx(0) = 1\nx'(0) = 0\n";
    const double end = swings_end(0.5);
    for (int m = 0; m < METHODS; m++) {
        const double fifth = end * (1 - pow(3, -2.5));
        NEAR(finished(text, methods[m], 1e-12, fifth).x[0], -1 / 243.0, 1e-13);
        const outcome o = finished(text, methods[m], 1e-12, end + 1e-9), later = finished(text, methods[m], 1e-12, 100);
        NEAR(o.x[0], 0, 0);
        NEAR(later.x[0], 0, 0);
        NEAR(later.v[0], 0, 0);
        assert_true(later.did.switches < 90);
    }
    static const char *const slow[] = {"x'' = -sign(x) - 0.1 sign(x')\nx(0) = 1\nx'(0) = 0\n",
                                       "x'' = -sign(x) - 0.01 sign(x')\nx(0) = 1\nx'(0) = 0\n",
                                       "x'' = -sign(x) - 0.1 sign(x') - x/10\nx(0) = 1\nx'(0) = 0\n",
                                       "x'' = -2 sign(x) - sign(x') + 0.3 sin(t)\nx(0) = 1\nx'(0) = 0\n"};
    for (size_t k = 0; k < sizeof slow / sizeof *slow; k++) {
        NEAR(finished(slow[k], "dop853", 1e-9, 1000).x[0], 0, 0);
        NEAR(finished(slow[k], "taylor", 1e-9, 1000).x[0], 0, 0);
    }
}

/* What stands at 0 leaves when the force is more than both signs together: 0.4 t = 1.5. */
static void leaves_the_rest(void **state)
{
    (void)state;
    static const char *const texts[] = {"x'' = -sign(x) - 0.5 sign(x') + 0.4 t\nx(0) = 0\nx'(0) = 0\n",
                                        "x'' = -sign(x) - 0.5 sign(x') + 0.4 t\nx(0) = 0.001\nx'(0) = 0\n",
                                        "x'' = -sign(x) - 0.5 sign(x') + 0.4 t\nx(0) = 0\nx'(0) = 0.01\n",
                                        "x'' = -0.5 sign(x) - sign(x') + 0.4 t\nx(0) = 0\nx'(0) = 0\n",
                                        "x'' = -0.1 sign(x) - 1.4 sign(x') + 0.4 t\nx(0) = 0\nx'(0) = 0\n",
                                        "x'' = sign(-x) + 0.5 sign(-x') + 0.4 t\nx(0) = 0.001\nx'(0) = 0\n"};
    for (size_t k = 0; k < sizeof texts / sizeof *texts; k++)
        for (int m = 0; m < METHODS; m++) {
            NEAR(finished(texts[k], methods[m], 1e-12, 3.74).x[0], 0, 0);
            NEAR(finished(texts[k], methods[m], 1e-12, 5).x[0], 0.4 * pow(1.25, 3) / 6, 1e-13);
        }
    static const char *const down = "x'' = -sign(x) - 0.5 sign(x') - 0.4 t\nx(0) = 0.001\nx'(0) = 0\n";
    NEAR(finished(down, "dop853", 1e-12, 5).x[0], -0.4 * pow(1.25, 3) / 6, 1e-13);
    static const char *const three = "x[i]'' = -sign(x[i]) - 0.5 sign(x[i]') + 0.4 t (i - 1) for i = 1..3\n"
                                     "x[i](0) = 0.001 for i = 1..3\nx[i]'(0) = 0 for i = 1..3\n";
    const outcome o = finished(three, "dop853", 1e-12, 3);
    NEAR(o.x[0], 0, 0);
    NEAR(o.x[1], 0, 0);
    NEAR(o.x[2], 0.8 * pow(3 - 1.875, 3) / 6, 1e-13);
}

/* Frictions that act on one another: both rest at last. */
static void coupled(void **state)
{
    (void)state;
    for (int m = 0; m < METHODS; m++) {
        /* stacked: with 1/3 from t = 1/3 on, at rest from t = 1 on */
        const outcome o = finished("x'' = -sign(x') - sign(x' - y')\ny'' = sign(x' - y')\nx(0) = 0\nx'(0) = 1\n"
                                   "y(0) = 0\ny'(0) = 0\n",
                                   methods[m], 1e-12, 10);
        NEAR(o.x[0], 1 / 3.0, 1e-14);
        NEAR(o.x[1], 1 / 6.0, 1e-14);
        NEAR(o.v[0], 0, 0);
        NEAR(o.v[1], 0, 0);
        /* x stops at 2/3 and goes on to brake y with half of its force */
        const outcome each = finished("x'' = -sign(x') - sign(y')/2\ny'' = -sign(y') - sign(x')/2\nx(0) = 0\n"
                                      "x'(0) = 1\ny(0) = 0\ny'(0) = 1.5\n",
                                      methods[m], 1e-12, 10);
        NEAR(each.x[0], 1 / 3.0, 1e-14);
        NEAR(each.x[1], 5 / 6.0, 1e-14);
        NEAR(each.v[0], 0, 0);
        NEAR(each.v[1], 0, 0);
        /* pulled above: both rest until t = 1/2, go on as one, and part at 3/2, where the upper friction is all used */
        const outcome pulled = finished("x'' = -0.5 sign(x') - sign(x' - y')\ny'' = sign(x' - y') + t\nx(0) = 0\n"
                                        "x'(0) = 0\ny(0) = 0\ny'(0) = 0\n",
                                        methods[m], 1e-12, 3);
        NEAR(pulled.v[0], 1, 1e-13);
        NEAR(pulled.v[1], 2.125, 1e-13);
    }
}

/* A block on a plank on a rough floor: both rest, exactly, until the push exceeds what the floor holds, and then go
 * together. No number of the model is exact in binary but those of the push. */
static void stacked(void **state)
{
    (void)state;
    static const char *const texts[] = {
        "a = 2.943; b = 2.943\nx1'' = a sign(x2' - x1')\nx2'' = (12 t - a sign(x2' - x1') - b sign(x2'))/2\n",
        "a = 2.943; b = 2.943; m = 1; M = 2\nx2'' = 12 t/M - a/M sign(x2' - x1') - b/M sign(x2')\n"
        "x1'' = a/m sign(x2' - x1')\n",
        "a = 2.943; b = 2.943\nx0'' = a sign(x1' - x0')\n"
        "x1'' = a/0.3 sign(x2' - x1') - a/0.3 sign(x1' - x0')\n"
        "x2'' = (12 t - a sign(x2' - x1') - b sign(x2'))/1.7\nx0(0) = 0; x0'(0) = 0\n"};
    for (size_t k = 0; k < sizeof texts / sizeof *texts; k++)
        for (int m = 0; m < METHODS; m++) {
            char text[400];
            snprintf(text, sizeof text, "%sx1(0) = 0; x1'(0) = 0; x2(0) = 0; x2'(0) = 0\n", texts[k]);
            const outcome rests = finished(text, methods[m], 1e-9, 0.2), goes = finished(text, methods[m], 1e-9, 0.7);
            const double late = 0.7 - 2.943 / 12, v = 2 * late * late;
            for (int i = 0; i < 2; i++) {
                NEAR(rests.x[i], 0, 0);
                NEAR(rests.v[i], 0, 0);
                NEAR(goes.x[i], v * late / 3, 1e-12);
                NEAR(goes.v[i], v, 1e-12);
            }
        }
}

/* One surface, whatever forms it is written in, has one value: the friction of a block on another, which slides on ice,
 * and of three on one another. They go on as one once they are equally fast, from t = 1 and from t = 5/6 on. */
static void written_twice(void **state)
{
    (void)state;
    static const char *const two[][2] = {{"sign(x' - y')", "sign(y' - x')"},
                                         {"sign(x' - y')", "-sign(2 x' - 2 y')"},
                                         {"if(x' > y', 1, -1)", "-sign((x' - y')/3)"},
                                         {"if(x' > y', 1, -1)", "if(y' > x', 1, -1)"},
                                         {"-sign(y' - x')", "if(y' <= x', -1, 1)"},
                                         {"sign(x' - y')", "sign(k (y' - x'))"},
                                         {"sign((x' - y')/k)", "-sign(k x' - k y')"},
                                         {"-sign(n y' n - n^2 x')", "-sign(n (y' - x'))"},
                                         {"(x' - y')/|x' - y'|", "sign(y' - x')"},
                                         {"k (x' - y')/(k abs(x' - y'))", "(y' - x')/sqrt((y' - x')^2)"},
                                         {"-n (x' - y')/|n (x' - y')|", "sign(n (x' - y'))"},
                                         {"if(x' > y', 1, if(x' < y', -1, 0))", "if(y' < x', -1, if(y' > x', 1, 0))"},
                                         {"if(x' == y', 0, if(x' > y', 1, -1))", "if(not (y' <= x'), 1, -1)"},
                                         {"if(x' - y' == 0, 0, sign(x' - y'))", "if(y' != x', -sign(x' - y'), 0.3)"}};
    static const char *const start = "k = 2.5\nn = -3\nx(0) = 0\nx'(0) = 1\ny(0) = 0\ny'(0) = 0\n";
    for (size_t k = 0; k < sizeof two / sizeof *two; k++)
        for (int m = 0; m < METHODS; m++) {
            char text[400];
            snprintf(text, sizeof text, "x'' = 0.5 - (%s) - 0 |y' - x'|\ny'' = -(%s)/2\n%s", two[k][0], two[k][1],
                     start);
            const outcome o = finished(text, methods[m], 1e-12, 4);
            NEAR(o.x[0], 3, 1e-13);
            NEAR(o.x[1], 2.5, 1e-13);
            NEAR(o.v[0], 1, 1e-14);
            NEAR(o.v[1], 1, 1e-14);
        }
    const outcome o =
        finished("x'' = 0.3 - sign(x' - y')\ny'' = -sign(y' - x') - if(y' > z', 1, -1)\n"
                 "z'' = sign(2 y' - 2 z')\nx(0) = 0\nx'(0) = 1\ny(0) = 0\ny'(0) = 0\nz(0) = 0\nz'(0) = 0\n",
                 "dop853", 1e-12, 4);
    NEAR(o.x[0], 217 / 90.0, 1e-13);
    NEAR(o.x[1], 359 / 180.0, 1e-13);
    NEAR(o.x[2], 359 / 180.0, 1e-13);
    NEAR(o.v[0], 2.2 / 3, 1e-14);
}

/* A comparison that drives its own argument back is held between both branches: a third of the one with -2 and two
 * thirds of the one with 1 hold s, and y moves by as much of 5 and of 2. */
static void between_branches(void **state)
{
    (void)state;
    static const char *const rest[] = {
        "s' = if(s > 0, -2, 1)\nz' = if(s > 0, 5, 2)\n", "s' = if(s >= 0, -2, 1)\nz' = 2 + 3 if(s >= 0, 1, 0)\n",
        "s' = if(s < 0, 1, -2)\nz' = if(s < 0, 2, 5)\n", "s' = 1 - 3 if(s <= 0, 0, 1)\nz' = if(s <= 0, 2, 5)\n"};
    for (size_t k = 0; k < sizeof rest / sizeof *rest; k++)
        for (int m = 0; m < METHODS; m++) {
            char text[300];
            snprintf(text, sizeof text, "x'' = 0\nx(0) = 0\nx'(0) = 0\n%ss(0) = 1\nz(0) = 0\n", rest[k]);
            const outcome o = finished(text, methods[m], 1e-12, 10.5);
            NEAR(o.v[1], 0, 1e-15);
            NEAR(o.v[2], 2.5 + 30, 1e-13); /* half a unit of time at 5, ten at 3 */
        }
    for (int m = 0; m < METHODS; m++) {
        const outcome dry =
            finished("x'' = -x - 0.1 if(x' > 0, 1, -1)\nx(0) = 1.05\nx'(0) = 0\n", methods[m], 1e-13, 100);
        NEAR(dry.x[0], -0.05, 1e-13);
        NEAR(dry.v[0], 0, 0);
        /* as on the belt above */
        const outcome o =
            finished("x'' = -x + if(x' <= 0.5, 0.6, -0.6)\nx(0) = 0\nx'(0) = 0.5\n", methods[m], 1e-12, 30);
        NEAR(o.x[0], 0.6 + 0.5 * sin(30 - 1.2), 1e-10);
    }
}

/* Hertz's contact: the power is undefined beyond the switch, and a step that ends there rounds to either side. */
static void undefined_beyond(void **state)
{
    (void)state;
    const outcome o = finished("x'' = -9.16 + 1e5 max(0, -x)^1.5\nx(0) = 1.6\nx'(0) = 0\n", "dop853", 1e-12, 4.0704);
    NEAR(o.x[0], 0.6523677066442, 1e-9);
}

static void refused(const char *text, const char *says, double time)
{
    const outcome o = run_of(text, "dop853", 1e-9, 10);
    assert_int_equal(o.status, MOTUS_SOLVE);
    assert_int_equal(o.cause, MOTUS_CAUSE_DISCONTINUOUS);
    NEAR(o.time, time, 1e-9);
    if (!strstr(o.message, says)) fail_msg("%s: it says %s", text, o.message);
}

static void refusals(void **state)
{
    (void)state;
    refused("x'' = sign(x')\nx(0) = 0\nx'(0) = 0\n", "not unique", 0);
    refused("x'' = sign(x)\nx(0) = 0\nx'(0) = 0\n", "not unique", 0);
    /* held until t = 1, when the force begins to drive it away */
    refused("x'' = (t - 1) sign(x')\nx(0) = 0\nx'(0) = 0.1\n", "where x' = 0, at t = 0.9999999999999999", 1);
    refused("s' = (t - 1) sign(s)\ns(0) = 0.1\nx'' = 0\nx(0) = 0\nx'(0) = 0\n",
            "where s = 0, at t = 0.9999999999999999", 1);
    refused("s' = if(t < 1, -sign(s), sign(s))\ns(0) = 0.1\nx'' = 0\nx(0) = 0\nx'(0) = 0\n",
            "the force drives it away to both sides where s = 0, at t = 1", 1);
    refused("x'' = if(x' > 0 or t > 20, -1, 1)\nx(0) = 0\nx'(0) = 1\n", "slides along a jump of the force", 1);
    refused("x'' = if(x' > 0, -1, 1) (if(x' > 0, 1, 2) + 1)\nx(0) = 0\nx'(0) = 1\n", "no value between those of both",
            0.5);
}

/* Swings that become ever shorter and have no end: their speed falls as exp(-t/6). */
static void multiplies(void **state)
{
    (void)state;
    const outcome o = run_of("x'' = -sign(x) - x'/2\nx(0) = 1\nx'(0) = 0\n", "dop853", 1e-9, 100);
    assert_int_equal(o.status, MOTUS_EVENTS);
    if (!strstr(o.message, "jumps where x = 0 ever more often")) fail_msg("it says %s", o.message);
    (void)finished("x'' = -sign(x) - x'/2\nx(0) = 1\nx'(0) = 0\n", "dop853", 1e-9, 40);
}

/* A run that is told nothing of switches. */
static outcome usual(const char *text, motus_switches switches, double errors[2], char *why, size_t size)
{
    motus_run_def def = motus_default_run();
    def.method = "taylor";
    def.tolerance = 1e-13;
    def.until = 100;
    def.machine = "interpreter";
    def.error = errors ? MOTUS_BARS_CHEAP : MOTUS_BARS_NONE;
    if (switches != MOTUS_SWITCHES_USUAL) def.switches = switches;
    return sound(done(text, &def, errors, why, size), text, def.method);
}

static void by_default(void **state)
{
    (void)state;
    static const char *const bouncing = "x'' = -x - 3 max(0, x)\nx(0) = 0\nx'(0) = 1\n";
    static const char *const contact = "x'' = 1 - 5 max(0, x)^1.5\nx(0) = -1\nx'(0) = 0\n";
    char why[200];
    const outcome own = usual(bouncing, MOTUS_SWITCHES_USUAL, NULL, why, sizeof why),
                  asked = usual(bouncing, MOTUS_SWITCHES_LOCATE, NULL, NULL, 0),
                  step = usual(bouncing, MOTUS_SWITCHES_STEP, NULL, NULL, 0);
    assert_string_equal(why, "");
    assert_int_equal(own.did.switches, 42);
    assert_int_equal(step.did.switches, -1);
    NEAR(own.x[0], asked.x[0], 0);
    NEAR(own.x[0], one_sided(100), 1e-12);
    assert_int_equal(usual(contact, MOTUS_SWITCHES_USUAL, NULL, why, sizeof why).did.switches, -1);
    assert_non_null(strstr(why, "undefined"));
}

/* A companion comes to rest where the run does, with a velocity that is not 0 to the bit. */
static void bars_of_what_sticks(void **state)
{
    (void)state;
    static const char *const text = "x'' = -x - f sign(x')\nf = 0.1\nx(0) = 1.05\nx'(0) = 0\n";
    double errors[2];
    const outcome o = usual(text, MOTUS_SWITCHES_USUAL, errors, NULL, 0);
    NEAR(o.x[0], -0.05, errors[0]);
    assert_true(errors[0] < 1e-13);
}

/* What a run leaves: its last state and how it got there. */
static outcome by_machine(const char *text, const char *method, const char *machine)
{
    motus_run_def def = motus_default_run();
    def.method = method;
    given_step(&def, 0.1);
    def.until = 30;
    def.machine = machine;
    return sound(done(text, &def, NULL, NULL, 0), text, method);
}

/* Rows that solve an equation for their stages keep what the force leaves unwritten: the sides, and modes of events. */
static void on_every_machine(void **state)
{
    (void)state;
    static const char *const sides = "x'' = -x - 3 max(x, 0) - 0.1 sign(x')\nx(0) = 1\nx'(0) = 0\n";
    static const char *const mode = "s = 1\nx'' = -x - 3 s x - 0.1 x'\nx(0) = 1\nx'(0) = 0\n"
                                    "when x = 0 falling: s = 0\nwhen x = 0 rising: s = 1\n";
    static const struct {
        const char *text, *method;
    } runs[] = {{sides, "dop853"}, {sides, "radau15"}, {sides, "taylor"}, {mode, "gauss4"}, {mode, "radau15-fixed"}};
    for (size_t k = 0; k < sizeof runs / sizeof *runs; k++) {
        const outcome a = by_machine(runs[k].text, runs[k].method, "interpreter"),
                      b = by_machine(runs[k].text, runs[k].method, "compiled");
        NEAR(b.x[0], a.x[0], 0);
        NEAR(b.v[0], a.v[0], 0);
        assert_true(a.did.steps == b.did.steps && a.did.switches == b.did.switches);
    }
}

typedef struct surface {
    const char *operation, *surface;
    size_t count;
    motus_sliding sliding;
} surface;

static void lists(const char *text, const surface *expected, size_t count, const char *not_located)
{
    motus_system *s = given_text(text);
    motus_switch w = motus_default_switch();
    for (size_t k = 0; k < count; k++) {
        assert_int_equal(motus_switch_at(s, k, &w), MOTUS_OK);
        assert_string_equal(w.operation, expected[k].operation);
        assert_string_equal(w.surface, expected[k].surface);
        assert_int_equal(w.count, expected[k].count);
        assert_int_equal(w.sliding, expected[k].sliding);
        assert_int_equal(w.located, !*not_located);
        if (!strstr(w.not_located, not_located)) fail_msg("%s: not located, since %s", text, w.not_located);
    }
    assert_int_equal(motus_switch_at(s, count, &w), MOTUS_ARGUMENT);
    motus_system_destroy(s);
}

/* What the force changes on: the time too, and families cell by cell. */
static void surfaces(void **state)
{
    (void)state;
    static const surface all[] = {{"sign(V - x')", "V - x' = 0", 1, MOTUS_SLIDING_HELD},
                                  {"max(0, x)", "x = 0", 1, MOTUS_SLIDING_NEVER},
                                  {"mod(t, 2)", "t/2 = a whole number", 1, MOTUS_SLIDING_NEVER},
                                  {"t > 3", "t = 3", 1, MOTUS_SLIDING_NEVER},
                                  {"abs(u[i])", "u[i] = 0", 3, MOTUS_SLIDING_NEVER},
                                  {"floor(u[i]')", "u[i]' = a whole number", 3, MOTUS_SLIDING_ENDS}};
    lists("V = 1\nx'' = sign(V - x') + max(0, x) + mod(t, 2) + if(t > 3, 1, 0)\nu[i]'' = -abs(u[i]) - floor(u[i]') for "
          "i = "
          "1..3\nx(0) = 0\nx'(0) = 0\nu[i](0) = 1 for i = 1..3\nu[i]'(0) = 0 for i = 1..3\n",
          all, sizeof all / sizeof *all, "");
    static const surface many[] = {{"abs(x[i])", "x[i] = 0", 65, MOTUS_SLIDING_NEVER}};
    lists("x[i]'' = -abs(x[i]) for i = 1..65\nx[i](0) = 1 for i = 1..65\nx[i]'(0) = 0 for i = 1..65\n", many, 1,
          "many");
    static const surface beyond[] = {{"max(0, x)", "x = 0", 1, MOTUS_SLIDING_NEVER}};
    lists("x'' = 1 - max(0, x)^1.5\nx(0) = -1\nx'(0) = 0\n", beyond, 1, "undefined");
    static const surface too_many[] = {{"abs(x[i])", "x[i] = 0", 0, MOTUS_SLIDING_UNKNOWN}};
    lists("x[i]'' = -abs(x[i]) for i = 1..65537\nx[i](0) = 1 for i = 1..65537\nx[i]'(0) = 0 for i = 1..65537\n",
          too_many, 1, "too many");
    static const surface steep[] = {{"cbrt(x)", "x = 0", 1, MOTUS_SLIDING_UNKNOWN}};
    lists("x'' = -cbrt(x)\nx(0) = 1\nx'(0) = 0\n", steep, 1, "infinite slope");
    lists("x'' = -x\nx(0) = 1\nx'(0) = 0\nloud = abs(x)\n", NULL, 0, "");
    motus_switch w = motus_default_switch();
    assert_int_equal(motus_switch_at(NULL, 0, &w), MOTUS_ARGUMENT);
}

/* What an ensemble does at switches, and why it does not locate them: what a run says. */
static void ensemble_says(const char *text, const char *method, motus_switches asked, motus_switches does,
                          const char *reason)
{
    static const motus_record x = {MOTUS_REDUCE_FINAL, 1};
    motus_system *s = given_text(text);
    motus_error err = motus_default_error();
    motus_ensemble_def def = motus_default_ensemble();
    motus_ensemble *e = NULL;
    def.records = &x, def.record_count = 1;
    def.method = method, def.until = 1, def.machine = "interpreter";
    if (!strcmp(method, "rk4")) def.step = 0.01;
    def.switches = asked;
    const motus_status status = motus_ensemble_create(s, &def, &e, &err);
    if (does == MOTUS_SWITCHES_RESOLVE) { /* refused */
        assert_int_equal(status, MOTUS_UNAVAILABLE);
        assert_null(e);
        if (!strstr(err.message, reason)) fail_msg("%s: %s", text, err.message);
    } else {
        must(status, &err, text);
        if (motus_ensemble_now(e).switches != does)
            fail_msg("%s by %s: it does %d at switches", text, method, (int)motus_ensemble_now(e).switches);
        const char *said = motus_ensemble_now(e).not_located;
        if (!*reason != !*said || !strstr(said, reason)) fail_msg("%s: not located, since \"%s\"", text, said);
        motus_run_def run = motus_default_run();
        motus_run *r = NULL;
        run.method = method, run.until = 1, run.machine = "interpreter", run.step = def.step, run.switches = asked;
        must(motus_run_create(s, &run, &r, &err), &err, text);
        assert_string_equal(motus_run_now(r).not_located, said);
        motus_run_destroy(r);
    }
    motus_ensemble_destroy(e);
    motus_system_destroy(s);
}

static void ensembles_say_why(void **state)
{
    (void)state;
    static const motus_switches usual = MOTUS_SWITCHES_USUAL, locate = MOTUS_SWITCHES_LOCATE,
                                step = MOTUS_SWITCHES_STEP, refused = MOTUS_SWITCHES_RESOLVE;
    static const char
        kink[] = "x'' = -abs(x)\nx(0) = 1\nx'(0) = 0\n",
        smooth[] = "x'' = -x\nx(0) = 1\nx'(0) = 0\n",
        many[] = "x[i]'' = -abs(x[i]) for i = 1..65\nx[i](0) = 1 for i = 1..65\nx[i]'(0) = 0 for i = 1..65\n",
        beyond[] = "x'' = 1 - max(0, x)^1.5\nx(0) = -1\nx'(0) = 0\n",
        too_many[] =
            "x[i]'' = -abs(x[i]) for i = 1..65537\nx[i](0) = 1 for i = 1..65537\nx[i]'(0) = 0 for i = 1..65537\n";
    ensemble_says(kink, "dop853", usual, locate, "");
    ensemble_says(kink, "dop853", step, step, "");
    ensemble_says(kink, "rk4", usual, step, "");
    ensemble_says(kink, "rk4", locate, locate, "");
    ensemble_says(beyond, "rk4", locate, locate, "");
    ensemble_says(kink, "dop853", refused, refused, "does not resolve");
    ensemble_says(smooth, "dop853", usual, usual, "");
    ensemble_says(many, "dop853", usual, step, "there are many");
    ensemble_says(many, "dop853", locate, locate, "");
    ensemble_says(beyond, "dop853", usual, step, "may be undefined beyond one");
    ensemble_says(beyond, "dop853", locate, locate, "");
    ensemble_says(too_many, "dop853", usual, step, "cannot be located");
    ensemble_says(too_many, "dop853", locate, step, "cannot be located");
}

/* The list follows numbers that are set, and leaves runs as they are. */
static void surfaces_beside_runs(void **state)
{
    (void)state;
    motus_system *s = given_text("V = 1\nx'' = -x + sign(V - x')\nx(0) = 0\nx'(0) = 0\nmethod dop853\nuntil 3\n");
    motus_error err = motus_default_error();
    motus_switch w = motus_default_switch();
    motus_run_def def = motus_default_run();
    motus_run *r = NULL;
    double x[2][1], v[1];
    for (int k = 0; k < 2; k++) {
        if (k) assert_int_equal(motus_switch_at(s, 0, &w), MOTUS_OK);
        must(motus_system_set(s, "V", (double[]){2}, 1, &err), &err, "V");
        if (k) assert_int_equal(motus_switch_at(s, 0, &w), MOTUS_OK);
        must(motus_run_create(s, &def, &r, &err), &err, "run");
        if (k) assert_int_equal(motus_switch_at(s, 0, &w), MOTUS_OK);
        must(motus_run_finish(r, &err), &err, "run");
        must(motus_run_state(r, x[k], v, &err), &err, "run");
        motus_run_destroy(r);
    }
    NEAR(x[1][0], x[0][0], 0);
    motus_system_destroy(s);
}

static const char *const in_plane[] = {"dop853", "tsit5", "verner9", "radau15", "gragg"};
enum { IN_PLANE = sizeof in_plane / sizeof *in_plane };

/* Friction in a plane, along r'/|r'|: a straight way to rest, v^2/(2 f), is a root of the speed. On others the
 * direction turns towards the other force with a power of the time that is no whole number; the end of these has been
 * computed in 40 digits, by the time s with dt = |r'| ds. */
static void stops_in_plane(void **state)
{
    (void)state;
    static const char *const straight = "r'' = -2.943 r'/|r'|\nr(0) = (0, 0)\nr'(0) = (1, 0.5)\n",
                             *const turning[] = {"r'' = (0.3, -0.2) - 0.9 r'/|r'|\nr(0) = (0, 0)\nr'(0) = (1, 0.5)\n",
                                                 "x'' = 0.3 - 0.9 x'/hypot(x', y')\ny'' = -0.2 - 0.9/hypot(x', y') y'\n"
                                                 "x(0) = 0\nx'(0) = 1\ny(0) = 0\ny'(0) = 0.5\n"},
                             *const spring = "r'' = (0.035, -0.769) - 0.734 r - 2.027 r'/|r'|\nr(0) = (0, -0.857)\n"
                                             "r'(0) = (-1.613, -1.176)\n";
    for (int m = 0; m < IN_PLANE; m++) {
        const outcome one = finished(straight, in_plane[m], 1e-12, 2), three = finished(spring, in_plane[m], 1e-12, 3);
        NEAR(one.x[0], 0.18994801032108305, 1e-15);
        NEAR(one.x[1], 0.09497400516054152, 1e-15);
        const double stop = hypot(1, 0.5) / 2.943, before = 0x1p-27; /* which no step resolves */
        const outcome nearly = finished(straight, in_plane[m], 1e-12, stop - before);
        NEAR(hypot(nearly.v[0], nearly.v[1]), 2.943 * before, 1e-15);
        NEAR(three.x[0], -0.68811647015455082, 1e-11);
        NEAR(three.x[1], -1.38981155265790713, 1e-11);
        for (int k = 0; k < 2; k++) {
            const outcome two = finished(turning[k], in_plane[m], 1e-12, 4);
            NEAR(two.x[0], 0.89634804961160052, 1e-11);
            NEAR(two.x[1], 0.23240399362702919, 1e-11);
            NEAR(two.v[0], 0, 0);
            NEAR(two.v[1], 0, 0);
            assert_true(two.did.steps < 1000);
        }
    }
}

/* Uphill and straight back, where friction does not hold; and from rest, where it does not or does. */
static void leaves_in_plane(void **state)
{
    (void)state;
    static const char *const hill = "r'' = (-0.8, -0.4) - 0.5 r'/|r'|\nr(0) = (0, 0)\nr'(0) = (1, 0.5)\n",
                             *const rest = "r'' = (0.8, 0.6) - f r'/|r'|\nf = 0.5\nr(0) = (0, 0)\nr'(0) = (0, 0)\n";
    const double h = sqrt(0.8), up = h + 0.5, down = h - 0.5, turn = sqrt(1.25) / up, after = 4 - turn;
    for (int m = 0; m < IN_PLANE; m++) {
        const outcome o = finished(hill, in_plane[m], 1e-12, 4), at_rest = finished(rest, in_plane[m], 1e-12, 2);
        const double way = 1.25 / (2 * up) - down * after * after / 2;
        NEAR(o.x[0], way * 2 / sqrt(5), 1e-12);
        NEAR(o.x[1], way / sqrt(5), 1e-12);
        NEAR(at_rest.x[0], 0.8, 1e-12);
        NEAR(at_rest.x[1], 0.6, 1e-12);
    }
}

/* One block on another, with friction written on each; a ball that slides and then rolls; blocks of a family. */
static void slides_on_another(void **state)
{
    (void)state;
    static const char *const lower[] = {"(a' - b')/|a' - b'|", "-(b' - a')/|b' - a'|", "-(b' - a')/|a' - b'|",
                                        "(2 a' - 2 b')/|2 a' - 2 b'|"};
    static const char *const ball = "mu = 0.2; g = 9.81; R = 0.028575\nk = (0, 0, 1)\nslip = r' + R cross(k, w)\n"
                                    "r'' = -mu g slip/|slip|\nw' = 5/2 mu g/R cross(k, slip)/|slip|\nr(0) = (0, 0, 0)\n"
                                    "r'(0) = (2, 0.5, 0)\nw(0) = (0, 40, 10)\n";
    for (size_t k = 0; k < sizeof lower / sizeof *lower; k++) {
        char text[400];
        snprintf(text, sizeof text,
                 "a'' = (0.1, 0) - 0.7 (a' - b')/|a' - b'|\nb'' = 0.35 (%s)\na(0) = (0, 0)\nb(0) = (0, 0)\n"
                 "a'(0) = (1, 0.4)\nb'(0) = (0, 0.1)\n",
                 lower[k]);
        for (int m = 0; m < IN_PLANE; m++) {
            const outcome o = finished(text, in_plane[m], 1e-12, 4);
            for (int block = 0; block < 2; block++) { /* the momentum of masses 1 and 2 */
                NEAR(o.v[2 * block], 1.4 / 3, 1e-13);
                NEAR(o.v[2 * block + 1], 0.2, 1e-13);
            }
        }
    }
    const outcome o = finished(ball, "dop853", 1e-12, 2);
    const double stop = hypot(2 - 0.028575 * 40, 0.5) / (3.5 * 0.2 * 9.81),
                 v[2] = {2 - (2 - 0.028575 * 40) / 3.5, 0.5 - 0.5 / 3.5};
    NEAR(o.x[0], (2 + v[0]) / 2 * stop + v[0] * (2 - stop), 1e-12);
    NEAR(o.x[1], (0.5 + v[1]) / 2 * stop + v[1] * (2 - stop), 1e-12);
    NEAR(o.v[0], v[0], 1e-12);
    NEAR(o.v[1], v[1], 1e-12);
    const outcome family = finished("b[i]'' = -i b[i]'/|b[i]'| for i = 1..2\nb[i](0) = (0, 0) for i = 1..2\n"
                                    "b[i]'(0) = (0.6, -0.8) for i = 1..2\n",
                                    "dop853", 1e-12, 3);
    for (int i = 0; i < 2; i++) {
        NEAR(family.x[2 * i], 0.3 / (i + 1), 1e-15);
        NEAR(family.x[2 * i + 1], -0.4 / (i + 1), 1e-15);
    }
}

/* A stack of blocks in the plane: those that have come to rest on one another slide on the ground as one, straight on
 * and slower by the friction of the lowest over all masses. More than four are not held at once, which is said. */
static void stacks_in_plane(void **state)
{
    (void)state;
    static const char *const stack =
        "b1'' = -0.4 b1'/|b1'| + 0.5 (b2' - b1')/|b2' - b1'|\nb2'' = -0.5 (b2' - b1')/|b2' - b1'|\nb1(0) = (0, 0)\n"
        "b2(0) = (0, 0)\nb1'(0) = (0.1, -0.13)\nb2'(0) = (0.2, 0.08)\n";
    const outcome early = finished(stack, "dop853", 1e-12, 0.4), late = finished(stack, "dop853", 1e-12, 0.6);
    const double before = hypot(early.v[0], early.v[1]), after = hypot(late.v[0], late.v[1]);
    NEAR(before - after, 0.2 * 0.2, 1e-13);
    NEAR(late.v[0] / after, early.v[0] / before, 1e-11);
    NEAR(late.x[0] - early.x[0], (early.v[0] + late.v[0]) / 2 * 0.2, 1e-13);
    NEAR(late.v[2], late.v[0], 1e-13);
    NEAR(late.v[3], late.v[1], 1e-13);
    char text[1000];
    int used = 0;
    for (int k = 1; k <= 5; k++) {
        used += snprintf(text + used, sizeof text - (size_t)used, "b%d'' = -0.4 (b%d' - (%s%d'))/|b%d' - (%s%d')|", k,
                         k, k > 1 ? "b" : "0 b", k > 1 ? k - 1 : 1, k, k > 1 ? "b" : "0 b", k > 1 ? k - 1 : 1);
        if (k < 5)
            used += snprintf(text + used, sizeof text - (size_t)used, " + 0.4 (b%d' - b%d')/|b%d' - b%d'|", k + 1, k,
                             k + 1, k);
        used += snprintf(text + used, sizeof text - (size_t)used, "\nb%d(0) = (0, 0)\nb%d'(0) = (0.1, %d.07)\n", k, k,
                         k * k);
    }
    const outcome five = run_of(text, "dop853", 1e-9, 100);
    assert_int_equal(five.status, MOTUS_SOLVE);
    assert_non_null(strstr(five.message, "more than are held at once"));
}

/* Directions beside a switch that is far from its side; and directions within a direction, which are none. */
static void beside_others(void **state)
{
    (void)state;
    static const char *const block =
        "x'' = -x'/hypot(x', y')%s\ny'' = -y'/hypot(x', y')\nx(0) = 0\ny(0) = 0\nx'(0) = 1\n"
        "y'(0) = 0.5\n";
    char text[600];
    snprintf(text, sizeof text, block, " - 0.1 sign(x - 5)");
    const outcome one = finished(text, "dop853", 1e-12, 0.5);
    strcat(text, "p'' = -p'/hypot(p', q')\nq'' = -q'/hypot(p', q')\np(0) = 0\nq(0) = 0\np'(0) = 1\nq'(0) = -0.3\n");
    const outcome two = finished(text, "dop853", 1e-12, 0.5);
    NEAR(two.x[0], one.x[0], 1e-11);
    NEAR(two.x[1], one.x[1], 1e-11);
    snprintf(text, sizeof text, block, "*0.5/hypot(x', y')");
    run_of(text, "dop853", 1e-9, 0.3);
}

/* sign(v) as |v|/v and v/|v|, with factors, also at the start and at rest at v = 0. */
static void one_sign_in_many_forms(void **state)
{
    (void)state;
    static const char *const forms[] = {"0.3 sign(x')",   "0.3 x'/|x'|",     "0.3 |x'|/x'",       "-0.3 |x'|/(-x')",
                                        "0.15 |2 x'|/x'", "0.6 |x'|/(2 x')", "0.3 sqrt(x'^2)/x'", "0.3 |v|/v",
                                        "k |x'|/(m x')",  "|k x'|/(m x')",   "-|3 x'|/(-10 x')"};
    for (size_t k = 0; k < sizeof forms / sizeof *forms; k++) {
        char text[300];
        snprintf(text, sizeof text, "k = -0.6; m = -2\nv = x'\nx'' = if(t < 1, 1, 0) - (%s)\nx(0) = 0\nx'(0) = 0\n",
                 forms[k]);
        if (!strcmp(forms[k], "|k x'|/(m x')")) memcpy(text, "k = -0.6; m =  2", 16);
        const outcome o = finished(text, "dop853", 1e-9, 5);
        if (fabs(o.x[0] - 0.35 - 0.49 / 0.6) > 1e-9 || o.v[0] != 0) fail_msg("%s: x = %.17g", forms[k], o.x[0]);
    }
}

/* One direction that text after text writes with a factor that does not move, as the other block's. */
static void one_direction_in_many_forms(void **state)
{
    (void)state;
    static const struct {
        const char *factors, *on_b;
    } forms[] = {
        {"k = 2", "-k (b' - a')/|k (b' - a')|"},
        {"k = -2", "(k (b' - a'))/|k (b' - a')|"},
        {"k = -2; m = 3", "(k/m b' - k/m a')/|k/m b' - k/m a'|"},
        {"k = -2; m = 3", "-(m b' k^2 - m a' k^2)/|m k^2 b' - k^2 m a'|"},
        {"k = 2", "k (a' - b')/sqrt((k b'.x - k a'.x)^2 + (k b'.y - k a'.y)^2)"},
        {"k = -2; m = 3", "m (a' - b')/(2 m |b' - a'|) + 0.5 (k b' - k a')/|k (b' - a')|"},
        {"k = 2", "((a'.x - b'.x)/hypot(k a'.y - k b'.y, k (a'.x - b'.x)) k, "
                  "(a'.y - b'.y)/hypot(k a'.y - k b'.y, k (a'.x - b'.x)) k)"},
    };
    for (size_t k = 0; k < sizeof forms / sizeof *forms; k++) {
        char text[400];
        snprintf(text, sizeof text,
                 "%s\na'' = -(a' - b')/|a' - b'|\nb'' = %s\na(0) = (0, 0)\nb(0) = (0, 0)\na'(0) = (0.6, 0.8)\n"
                 "b'(0) = (0, 0)\n",
                 forms[k].factors, forms[k].on_b);
        const outcome o = finished(text, "dop853", 1e-9, 2);
        const double at[] = {0.675, 0.9, 0.525, 0.7}, by[] = {0.3, 0.4, 0.3, 0.4};
        for (int i = 0; i < 4; i++) {
            NEAR(o.x[i], at[i], 1e-13);
            NEAR(o.v[i], by[i], 1e-13);
        }
    }
}

/* A branch that is not taken, in which the direction has no value, is no singularity. */
static void rests_by_an_event(void **state)
{
    (void)state;
    motus_system *s = given_text("rest = 0\nr'' = if(rest > 0, (0, 0), -2 r'/|r'|)\nr(0) = (0, 0)\nr'(0) = (0.6, 0.8)\n"
                                 "when dot(r', r') < 1e-16: rest = 1, r' = (0, 0)\nuntil 2\n");
    motus_error err = motus_default_error();
    motus_run_def def = motus_default_run();
    def.method = "dop853";
    must(motus_run_singular(s, &def, &err), &err, "rest");
    motus_system_destroy(s);
}

/* Where steps do not lead on, a sentence says so soon. */
static void refused_in_plane(void **state)
{
    (void)state;
    refused("r'' = (0.9 sin(t), 0.3 cos(2 t)) - 0.5 r - 0.6 r'/|r'|\nr(0) = (0, 0)\nr'(0) = (0.5, 0.4)\n",
            "breaks loose along a direction that turns", 3.246718351);
    refused("r'' = -(r'.x, 2 r'.y)/|r'|\nr(0) = (0, 0)\nr'(0) = (1, 1)\n", "drives its vector not straight back",
            1.147793528);
    refused("k = 2\na'' = -(a' - b')/|a' - b'|\nb'' = -((k + 1) b' - (k a' + a'))/|(k + 1) b' - (k a' + a')|\n"
            "a(0) = (0, 0)\nb(0) = (0, 0)\na'(0) = (0.6, 0.8)\nb'(0) = (0, 0)\n",
            "one direction in two forms", 0);
    const outcome o = run_of("r'' = -r'/|r'|\nr(0) = (0, 0)\nr'(0) = (1, 1)\n", "taylor", 1e-9, 2);
    assert_int_equal(o.status, MOTUS_UNAVAILABLE);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(stops_in_plane),
        cmocka_unit_test(leaves_in_plane),
        cmocka_unit_test(slides_on_another),
        cmocka_unit_test(stacks_in_plane),
        cmocka_unit_test(beside_others),
        cmocka_unit_test(one_direction_in_many_forms),
        cmocka_unit_test(one_sign_in_many_forms),
        cmocka_unit_test(rests_by_an_event),
        cmocka_unit_test(refused_in_plane),
        cmocka_unit_test(kinks),
        cmocka_unit_test(jumps_in_time),
        cmocka_unit_test(sticks),
        cmocka_unit_test(comes_to_rest),
        cmocka_unit_test(slips_from_a_belt),
        cmocka_unit_test(relay),
        cmocka_unit_test(leaves_without_slope),
        cmocka_unit_test(many),
        cmocka_unit_test(together),
        cmocka_unit_test(comes_to_rest_by_swings),
        cmocka_unit_test(leaves_the_rest),
        cmocka_unit_test(coupled),
        cmocka_unit_test(stacked),
        cmocka_unit_test(written_twice),
        cmocka_unit_test(between_branches),
        cmocka_unit_test(undefined_beyond),
        cmocka_unit_test(refusals),
        cmocka_unit_test(multiplies),
        cmocka_unit_test(by_default),
        cmocka_unit_test(bars_of_what_sticks),
        cmocka_unit_test(on_every_machine),
        cmocka_unit_test(surfaces),
        cmocka_unit_test(ensembles_say_why),
        cmocka_unit_test(surfaces_beside_runs),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
