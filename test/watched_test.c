/* Many steps at once, of which bounds tell that nothing happens in them, lead to the bits of as many steps taken one by
 * one: the motion, the counters, the rows of the table and the restart state; also where a part of a run is taken in
 * pieces, where a run may take no more steps, and where it fails or crawls. */
#include "test/given.h"

#include <stdbool.h>

enum { ROWS_MOST = 512, STATE_MOST = 1 << 18 };

typedef struct outcome {
    motus_status status;
    double x[4], v[4], t, failed_at;
    int64_t steps, evaluations, rows;
    double times[ROWS_MOST];
    char state[STATE_MOST];
} outcome;

static void look(motus_run *r, outcome *out)
{
    motus_error err = motus_default_error();
    const char *state;
    size_t length;
    must(motus_run_state(r, out->x, out->v, &err), &err, "state");
    out->t = motus_run_time(r);
    out->steps = motus_run_steps(r);
    out->evaluations = motus_run_now(r).evaluations;
    out->rows = motus_run_events(r);
    for (int64_t k = 0; k < out->rows && k < ROWS_MOST; k++) {
        motus_event_row row = motus_default_event_row();
        assert_int_equal(motus_run_event(r, k, &row), MOTUS_OK);
        out->times[k] = row.time;
    }
    must(motus_run_save(r, &state, &length, &err), &err, "save");
    assert_true(length < STATE_MOST);
    memcpy(out->state, state, length);
}

typedef struct subject {
    const char *text;
    int64_t most_steps, rows; /* rows: at least so many */
    motus_status status;
} subject;

/* step: of rows of fixed steps; NAN: they adapt. pieces of so many steps; 0: all at once */
static outcome *run_in(const subject *u, const char *method, double step, const char *machine, int64_t piece)
{
    motus_system *s = given_text(u->text);
    motus_run_def def = motus_default_run();
    motus_error err = motus_default_error();
    motus_run *r = NULL;
    outcome *out = calloc(1, sizeof *out);
    assert_non_null(out);
    def.method = method, def.machine = machine;
    def.error = MOTUS_BARS_NONE;
    def.most_steps = u->most_steps;
    def.step = step;
    must(motus_run_create(s, &def, &r, &err), &err, u->text);
    while (piece && !out->status && !motus_run_done(r)) out->status = motus_run_step(r, piece, &err);
    if (!out->status) out->status = motus_run_finish(r, &err);
    out->failed_at = out->status ? err.time : 0;
    look(r, out);
    motus_run_destroy(r);
    motus_system_destroy(s);
    return out;
}

static void compare(const subject *u, const char *method, double step)
{
    static const char *const machines[] = {"interpreter", "compiled"};
    outcome *one = run_in(u, method, step, "interpreter", 1);
    if (one->rows < u->rows) fail_msg("%s by %s: %lld rows", u->text, method, (long long)one->rows);
    if (one->status != u->status) fail_msg("%s by %s: %s", u->text, method, motus_status_word(one->status));
    for (size_t i = 0; i < 2; i++)
        for (int64_t piece = 0; piece <= 7; piece += 7) {
            outcome *many = run_in(u, method, step, machines[i], piece);
            assert_int_equal(many->status, one->status);
            assert_int_equal(many->steps, one->steps);
            assert_int_equal(many->evaluations, one->evaluations);
            assert_int_equal(many->rows, one->rows);
            assert_string_equal(many->state, one->state);
            assert_memory_equal(many, one, sizeof *one);
            free(many);
        }
    free(one);
}

#define STAR                                                                                            \
    "V = (x^2 + y^2)/2 + x^2 y - y^3/3\nx'' = -x - 2 x y\ny'' = -y - x^2 + y^2\nx(0) = 0\ny(0) = 0.1\n" \
    "x'(0) = 0.49\ny'(0) = 0\nuntil 300\n"
#define SECTIONS "when x = 0 rising: record\nwhen y = 0.1 falling: record\nwhen x' = y rising: record\n"
static const subject subjects[] = {
    {.text = STAR "when x = 0 rising: record\n", .rows = 40},
    {.text = STAR SECTIONS, .rows = 120},
    {.text = STAR "when x = 0 rising: record\nwhen y > 0.3 and x' < 0: record\n", .rows = 40},
    {.text = "x'' = -x - 0.1 x' + max(0, x - 0.5)\nx(0) = 1\nx'(0) = 0\nuntil 100\n"},
    /* near the Sun candidates are refused */
    {.text = "r = sqrt(x^2 + y^2)\nx'' = -x/r^3\ny'' = -y/r^3\nx(0) = 1\ny(0) = 0\nx'(0) = 0\ny'(0) = 0.2\nuntil 40\n"
             "when y = 0: record\nwhen x = 0.01: record\nwhen x' = y: record\n",
     .rows = 20},
    {.text = "x'' = -1\nwhen x = 0 falling: x' = -0.9 x', record\nx(0) = 1\nx'(0) = 0\nuntil 10\n", .rows = 3},
    /* it may take no more steps: before it passes 0, as it does, and long after */
    {.text = STAR SECTIONS, .most_steps = 30, .status = MOTUS_STEPS},
    {.text = STAR SECTIONS, .most_steps = 31, .status = MOTUS_STEPS},
    {.text = STAR SECTIONS, .most_steps = 32, .status = MOTUS_STEPS},
    {.text = STAR "when x = 0 rising: record\n", .most_steps = 290, .status = MOTUS_STEPS},
    /* it leaves the finite numbers, at rest and in a spin */
    {.text = "x'' = x^2\nx(0) = 1\nx'(0) = -0.5\nuntil 20\nwhen x' = 0 rising: record\nwhen x = 100 falling: record\n",
     .rows = 1,
     .status = MOTUS_DIVERGED},
    {.text = "x'' = x^3\ny'' = -400 y\nx(0) = 1\nx'(0) = 1\ny(0) = 1\ny'(0) = 0\nuntil 20\n"
             "when y = 0 falling: record\nwhen x = -1 rising: record\n",
     .rows = 1,
     .status = MOTUS_DIVERGED},
};

static void the_same_bits(void **state)
{
    (void)state;
    static const char *const methods[] = {"taylor", "dop853", "dopri5", "radau15"};
    for (size_t m = 0; m < sizeof subjects / sizeof *subjects; m++)
        for (size_t k = 0; k < sizeof methods / sizeof *methods; k++) compare(&subjects[m], methods[k], NAN);
}

static void fixed_steps(void **state)
{
    (void)state;
    static const char *const methods[] = {"verlet", "rk4", "forest-ruth"};
    for (size_t m = 0; m < sizeof subjects / sizeof *subjects; m++)
        for (size_t k = 0; k < sizeof methods / sizeof *methods && !subjects[m].most_steps; k++) {
            subject u = subjects[m];
            if (u.status && k == 0) continue; /* verlet has no state where its velocity is not finite */
            u.rows = u.rows < 3 ? u.rows : 3; /* these steps are coarse near the Sun */
            compare(&u, methods[k], 0.0079);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(the_same_bits), cmocka_unit_test(fixed_steps)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
