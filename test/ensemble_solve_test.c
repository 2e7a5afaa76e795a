/* Equations solved in lanes: each lane makes the iterations, chooses the pivots and fails as it would alone.
 *
 * Invariant: results are compared with the interpreter, one trajectory at a time: every bit, and the time at which a
 * trajectory stops.
 */
#include "test/ensemble_given.h"
#include "test/share.h"

#include <stdbool.h>

enum { COUNT = 37 };

typedef struct question {
    const char *text, *method, *vary;
    double from, by; /* of what varies */
    int stops;       /* lower bounds on how many trajectories stop, and at how many times; not all may stop */
    int times;
} question;

/* Each record is observed at states whose velocities need an equation solved, and at others. Case k has the records and
 * the width of its number for all steps, since every other text costs a compiler run. */
static void ask(const question *q, size_t k, double steps, int64_t every)
{
    static const int widths[] = {1, 0, 2, 4, 0, 8, 16};
    const int lanes = widths[k % (sizeof widths / sizeof *widths)];
    char what[300];
    motus_system *s = given_text(q->text);
    const motus_record records[] = {
        {MOTUS_REDUCE_FINAL, column(s, "x")},
        {MOTUS_REDUCE_FINAL, column(s, strstr(q->text, "\ns' =") ? "s" : "x'")},
        {MOTUS_REDUCE_MAX, column(s, "x")},
        {k % 2 ? MOTUS_REDUCE_TIME_OF_MAX : MOTUS_REDUCE_MIN, column(s, k % 3 ? "x" : "x'")}};
    enum { RECORDS = sizeof records / sizeof *records };
    double values[COUNT];
    const double *list[] = {values};
    for (int i = 0; i < COUNT; i++) values[i] = q->from + q->by * (i * 5 % COUNT);
    motus_settings set = motus_default_settings();
    motus_settings_of(s, &set);
    motus_ensemble_def def = motus_default_ensemble();
    def.vary = &q->vary;
    def.vary_count = 1;
    def.records = records;
    def.record_count = RECORDS;
    def.method = q->method;
    def.until = set.from + set.step * steps;
    def.every = every;
    def.threads = 1;
    def.machine = "interpreter";
    motus_ensemble *alone = given_ensemble(s, &def, q->method);
    def.machine = "compiled";
    def.lanes = lanes;
    motus_ensemble *fast = given_ensemble(s, &def, q->method);
    snprintf(what, sizeof what, "%s, %g steps, every %lld, %d lanes: %s", q->method, steps, (long long)every, lanes,
             q->text);
    if (motus_ensemble_now(fast).note[0]) fail_msg("%s: %s", what, motus_ensemble_now(fast).note);
    outcome a = go(alone, COUNT, RECORDS, list, what), b = go(fast, COUNT, RECORDS, list, what);
    same_outcome(&a, &b, what);
    int stops = 0, times = 0;
    for (int i = 0; i < COUNT; i++) {
        bool met = isnan(a.stopped[i]);
        stops += !met;
        for (int k = 0; k < i; k++) met |= a.stopped[k] == a.stopped[i];
        times += !met;
    }
    if (steps > 20 && (stops < q->stops || times < q->times || stops == COUNT))
        fail_msg("%s: %d stop, at %d times", what, stops, times);
    forget(&a);
    forget(&b);
    motus_ensemble_destroy(alone);
    motus_ensemble_destroy(fast);
    motus_system_destroy(s);
}

static void ask_all(const question *list, size_t count)
{
    static const struct {
        double steps;
        int64_t every;
    } shapes[] = {{60, 1}, {41.4, 3}, {600, 7}, {1, 1}, {40, 2}, {33, 1000}, {0.5, 1}};
    int turn = 0;
    for (size_t k = 0; k < count; k++)
        for (size_t i = 0; i < sizeof shapes / sizeof *shapes; i++)
            if (share_takes(&turn) && (!strstr(list[k].method, "literal") || floor(shapes[i].steps) == shapes[i].steps))
                ask(&list[k], k, shapes[i].steps, shapes[i].every);
}
#define ASK(list) ask_all(list, sizeof(list) / sizeof *(list))

/* Forces that are not linear in v: Newton's method at every kick, with a number of iterations that differs between
 * lanes. */
static void friction_that_is_not_linear(void **state)
{
    (void)state;
    static const char square[] = "c = 1\nx'' = -x - c x' |x'|\nx(0) = 1\nx'(0) = 2\nstep 0.1\nuntil 1\n";
    static const char coupled[] = "c = 1\nx'' = -x - c x'^3 - y'\ny'' = -y + sin(c x' y')\nx(0) = 1\nx'(0) = 2\ny(0) = "
                                  "0\ny'(0) = 1\nstep 0.1\nuntil 1\n";
    static const question list[] = {
        {square, "verlet", "c", 0, 0.3, 0, 0},       {square, "verlet-literal", "c", 0, 0.3, 0, 0},
        {square, "newmark", "c", 0, 0.3, 0, 0},      {square, "newmark(0, 1/2)", "c", 0, 0.3, 0, 0},
        {coupled, "verlet", "c", 0, 0.05, 0, 0},     {coupled, "gauss4", "c", 0, 0.3, 0, 0},
        {coupled, "gauss10", "c", 0, 0.6, 0, 0},     {square, "kahan-li6", "c", 0, 0.1, 0, 0},
        {coupled, "forest-ruth", "c", 0, 0.05, 0, 0}};
    ASK(list);
}

/* Nothing is solved where first-order variables only follow the motion. */
static void variables_that_follow(void **state)
{
    (void)state;
    static const char text[] = "c = 1\nx'' = -c x^3 + 0.1 cos(t)\nx(0) = 1\nx'(0) = 0\ns' = c x'^2 + t x\ns(0) = 0.5\n"
                               "step 0.1\nuntil 1\n";
    static const question list[] = {{text, "velocity-verlet", "c", 0, 0.1, 0, 0},
                                    {text, "blanes-moan4", "c", 0, 0.1, 0, 0},
                                    {text, "kahan-li8", "c", 0, 0.1, 0, 0}};
    ASK(list);
}

/* In some lanes the matrix is larger off the diagonal than on it. */
static void pivots_of_its_own(void **state)
{
    (void)state;
    static const char pair[] = "c = 1\nx'' = c y - x\ny'' = c x - 2 y + 0.1 cos(t)\nx(0) = 1\nx'(0) = 0\ny(0) = "
                               "0\ny'(0) = 1\nstep 0.5\nuntil 1\n";
    static const char three[] = "c = 1\nx'' = c y' - x\ny'' = -c x' + 2 c z' - y^3\nz'' = -z - 2 c y'\nx(0) = 1\nx'(0) "
                                "= 0\ny(0) = 0\ny'(0) = 1\nz(0) = 0\nz'(0) = 0\nstep 0.2\nuntil 1\n";
    static const char line[] = "c = 1\nx'' = c (y - 2 x)\ny'' = c (x - 2 y + z) - y^3\nz'' = c (y - 2 z)\nx(0) = "
                               "1\nx'(0) = 0\ny(0) = 0\ny'(0) = 1\nz(0) = 0\nz'(0) = 0\nstep 0.2\nuntil 1\n";
    static const question list[] = {{pair, "implicit-midpoint", "c", -40, 2.3, 0, 0},
                                    {pair, "gauss4", "c", -40, 2.3, 0, 0},
                                    {pair, "newmark", "c", -40, 2.3, 0, 0},
                                    {three, "verlet", "c", -20, 1.3, 0, 0},
                                    {three, "verlet-literal", "c", -20, 1.3, 0, 0},
                                    {three, "leapfrog", "c", -20, 1.3, 0, 0},
                                    {three, "forest-ruth", "c", -20, 1.3, 0, 0},
                                    {three, "gauss6", "c", -4, 0.3, 0, 0},
                                    {line, "gauss4", "c", 0, 3, 0, 0}};
    ASK(list);
}

/* Motions that diverge in finite time: each lane at its own step, while the others continue. */
static void lanes_that_fail(void **state)
{
    (void)state;
    static const char runaway[] = "x'' = x^3\nx(0) = 1\nx'(0) = 0\nstep 0.05\nuntil 1\n";
    static const char brake[] = "c = 1\nx'' = c exp(x'^2) - x\nx(0) = 1\nx'(0) = 0\nstep 0.1\nuntil 1\n";
    static const question list[] = {
        {runaway, "gauss4", "x(0)", 0, 0.1, 3, 3},       {runaway, "gauss6", "x(0)", 0, 0.1, 3, 3},
        {runaway, "gauss16", "x(0)", 0, 0.1, 3, 3},      {runaway, "newmark", "x(0)", 0, 0.1, 3, 3},
        {brake, "verlet", "c", -1, 0.1, 3, 3},           {brake, "verlet-literal", "c", -1, 0.1, 3, 3},
        {brake, "implicit-midpoint", "c", -1, 0.1, 3, 3}};
    ASK(list);
}

/* A matrix that is singular in one lane, from the start or from a certain time on. */
static void singular_in_one_lane(void **state)
{
    (void)state;
    static const char one[] = "g = 1\nx'' = -x + g x'\nx(0) = 1\nx'(0) = 0\nstep 0.5\nuntil 1\n";
    static const char two[] =
        "g = 1\nx'' = g y'\ny'' = g x' - y\nx(0) = 1\nx'(0) = 0\ny(0) = 0\ny'(0) = 1\nstep 0.5\nuntil 1\n";
    static const char later[] = "g = 1\nx'' = -x + g t x'\nx(0) = 1\nx'(0) = 0\nstep 0.5\nuntil 1\n";
    static const question list[] = {{one, "verlet", "g", -8, 1, 1, 1},
                                    {one, "verlet-literal", "g", -8, 1, 1, 1},
                                    {one, "implicit-midpoint", "g", -8, 1, 0, 0},
                                    {one, "leapfrog", "g", -8, 1, 1, 1},
                                    {later, "leapfrog", "g", 0, 1, 1, 1},
                                    {two, "verlet", "g", -9, 1, 1, 1},
                                    {two, "verlet-literal", "g", -9, 1, 1, 1},
                                    {later, "verlet", "g", -3.5, 0.25, 2, 2},
                                    {later, "verlet-literal", "g", -3.5, 0.25, 2, 2},
                                    {later, "newmark(0, 1/2)", "g", -3.5, 0.25, 2, 2}};
    ASK(list);
}

/* Some trajectories have friction, which the Boris rotation does not admit, on any machine. */
static void turns_or_brakes(void **state)
{
    (void)state;
    static const char text[] = "k = 0\nB = 2\nx'' = B y' - k x'\ny'' = -B x'\nx(0) = 1\nx'(0) = 0\ny(0) = 0\ny'(0) = "
                               "1\nmethod boris\nstep 0.1\nuntil 3\n";
    motus_system *s = given_text(text);
    const char *const names[] = {"B", "k"};
    const double B[3] = {1, 2, -3}, none[3] = {0, 0, 0}, some[3] = {0, 0, 0.25};
    const double *const turns[] = {B, none}, *const brakes[] = {B, some};
    const motus_record records[] = {{MOTUS_REDUCE_FINAL, column(s, "x")}, {MOTUS_REDUCE_MAX, column(s, "x'")}};
    motus_ensemble_def def = motus_default_ensemble();
    def.vary = names;
    def.vary_count = 2;
    def.records = records;
    def.record_count = 2;
    def.machine = "interpreter";
    motus_ensemble *alone = given_ensemble(s, &def, "boris");
    def.machine = "compiled";
    motus_ensemble *fast = given_ensemble(s, &def, "boris");
    assert_true(motus_ensemble_now(fast).lanes > 1);
    for (int again = 0; again < 2; again++) {
        outcome a = go(alone, 3, 2, turns, "turns"), b = go(fast, 3, 2, turns, "turns");
        same_outcome(&a, &b, "turns");
        motus_error one = motus_default_error(), many = motus_default_error();
        assert_int_equal(motus_ensemble_run(alone, 3, brakes, a.at, a.stopped, &one), MOTUS_METHOD);
        assert_int_equal(motus_ensemble_run(fast, 3, brakes, b.at, b.stopped, &many), MOTUS_METHOD);
        assert_string_equal(one.message, many.message);
        forget(&a);
        forget(&b);
    }
    motus_ensemble_destroy(alone);
    motus_ensemble_destroy(fast);
    motus_system_destroy(s);
}

int main(void)
{
    open_shared_cache();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(variables_that_follow), cmocka_unit_test(friction_that_is_not_linear),
        cmocka_unit_test(pivots_of_its_own),     cmocka_unit_test(lanes_that_fail),
        cmocka_unit_test(singular_in_one_lane),  cmocka_unit_test(turns_or_brakes)};
    int failed = cmocka_run_group_tests_name("equations in lanes", tests, NULL, NULL);
    close_cache();
    return failed;
}
