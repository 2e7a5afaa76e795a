/* A run that is taken all at once, or in pieces of some steps, has the bits of one taken step by step: the motion, the
 * counters, and the rows of its table. */
#include "test/given.h"

#include <stdbool.h>

typedef struct outcome {
    double x[4], v[4], t;
    int64_t steps, evaluations, rows;
    double times[512];
} outcome;

/* pieces of so many steps; 0: all at once */
static outcome run_in(const char *text, const char *method, const char *machine, int64_t piece)
{
    motus_system *s = given_text(text);
    motus_run_def def = motus_default_run();
    motus_error err = motus_default_error();
    motus_run *r = NULL;
    outcome out = {.t = NAN};
    def.method = method, def.machine = machine;
    def.error = MOTUS_BARS_NONE;
    must(motus_run_create(s, &def, &r, &err), &err, text);
    while (piece && !motus_run_done(r)) must(motus_run_step(r, piece, &err), &err, text);
    must(motus_run_finish(r, &err), &err, text);
    must(motus_run_state(r, out.x, out.v, &err), &err, text);
    out.t = motus_run_time(r);
    out.steps = motus_run_steps(r);
    out.evaluations = motus_run_now(r).evaluations;
    out.rows = motus_run_events(r);
    for (int64_t k = 0; k < out.rows && k < 512; k++) {
        motus_event_row row = motus_default_event_row();
        assert_int_equal(motus_run_event(r, k, &row), MOTUS_OK);
        out.times[k] = row.time;
    }
    motus_run_destroy(r);
    motus_system_destroy(s);
    return out;
}

#define STAR                                                                                            \
    "V = (x^2 + y^2)/2 + x^2 y - y^3/3\nx'' = -x - 2 x y\ny'' = -y - x^2 + y^2\nx(0) = 0\ny(0) = 0.1\n" \
    "x'(0) = 0.49\ny'(0) = 0\nuntil 300\n"
#define SUN "r = sqrt(x^2 + y^2)\nx'' = -x/r^3\ny'' = -y/r^3\nx(0) = 1\ny(0) = 0\nx'(0) = 0\ny'(0) = 0.2\nuntil 40\n"
static const char *const models[] = {
    STAR "when x = 0 rising: record\n",
    STAR "when x = 0 rising: record\nwhen y > 0.3 and x' < 0: record\n",
    "x'' = -x - 0.1 x' + max(0, x - 0.5)\nx(0) = 1\nx'(0) = 0\nuntil 100\n",
    /* near the Sun candidates are refused */
    SUN "when y = 0: record\nwhen x = 0.01: record\nwhen x' = y: record\n",
    "x'' = -1\nwhen x = 0 falling: x' = -0.9 x', record\nx(0) = 1\nx'(0) = 0\nuntil 10\n",
};
static const int least_rows[] = {40, 40, 0, 20, 3};

static void the_same_bits(void **state)
{
    (void)state;
    static const char *const methods[] = {"taylor", "dop853", "dopri5", "radau15"};
    static const char *const machines[] = {"interpreter", "compiled"};
    for (size_t m = 0; m < sizeof models / sizeof *models; m++)
        for (size_t k = 0; k < sizeof methods / sizeof *methods; k++) {
            const outcome one = run_in(models[m], methods[k], "interpreter", 1);
            if (one.rows < least_rows[m]) fail_msg("model %zu by %s: %lld rows", m, methods[k], (long long)one.rows);
            for (size_t i = 0; i < 2; i++)
                for (int64_t piece = 0; piece <= 7; piece += 7) {
                    const outcome many = run_in(models[m], methods[k], machines[i], piece);
                    assert_int_equal(many.steps, one.steps);
                    assert_int_equal(many.evaluations, one.evaluations);
                    assert_int_equal(many.rows, one.rows);
                    assert_memory_equal(&many, &one, sizeof one);
                }
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(the_same_bits)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
