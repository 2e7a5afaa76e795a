/* Thread safety: different handles may be used from different threads at once. Threads with their own systems,
 * running the same models by the same methods at the same time, get the bits of a single thread; errors stay with the
 * thread that made them.
 *
 * Built with a thread sanitizer, this test also detects shared state.
 */
#include "test/given.h"

#include <pthread.h>

enum { THREADS = 4, ROUNDS = 10 };

static const char *const texts[] = {
    "k = 1.5\nx'' = -k sin(x) + 0.1 cos(t)\nx(0) = 1\nx'(0) = 0\nspeed = |x'|\n",
    "r'' = -r/|r|^3 - 0.1 |r'| r'\nr(0) = (1, 0)\nr'(0) = (0, 1)\nL = r.x r'.y - r.y r'.x\n",
    ("x[i]'' = x[i+1] - 2 x[i] + x[i-1] + (x[i+1] - x[i])^3 for i = 1..20\nx[0] = 0\nx[21] = sin(t)\nx[i](0) = sin(i) "
     "for i = 1..20\n"
     "x[i]'(0) = 0 for i = 1..20\n"),
    "y'' = 1/(y - 1)^2\ny(0) = 2\ny'(0) = -1.5\n", /* diverges, or nearly */
};
static const char *const methods[] = {"verlet", "rk4", "gauss6", "kahan-li6", "newmark", "no such method"};

static uint64_t mix(uint64_t h, const void *bytes, size_t n)
{
    for (size_t i = 0; i < n; i++) h = (h ^ ((const unsigned char *)bytes)[i]) * 1099511628211u;
    return h;
}

/* A hash of all results of a thread. Without cmocka's assertions, which belong to the main thread. */
static uint64_t walk(uint64_t h, motus_system *s, const char *method)
{
    motus_error err = motus_default_error();
    motus_run_def def = motus_default_run();
    motus_run *r = NULL;
    double out[64], t = 0.777;
    size_t columns[64], count = motus_column_count(s) < 64 ? motus_column_count(s) : 64;
    for (size_t k = 0; k < count; k++) columns[k] = k;
    def.method = method;
    def.step = 0.01;
    def.until = 1.505;
    motus_status status = motus_run_create(s, &def, &r, &err);
    if (status == MOTUS_OK) status = motus_run_sample(r, &t, 1, columns, count, out, &err);
    if (status == MOTUS_OK) {
        h = mix(h, out, count * sizeof *out);
        status = motus_run_finish(r, &err);
    }
    if (status == MOTUS_OK) status = motus_run_values(r, columns, count, out, &err);
    h = status == MOTUS_OK ? mix(h, out, count * sizeof *out)
                           : mix(mix(h, err.message, strlen(err.message)), err.hint, strlen(err.hint));
    motus_run_destroy(r);
    return mix(h, &status, sizeof status);
}

static uint64_t everything(void)
{
    uint64_t h = 14695981039346656037u;
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        motus_error err = motus_default_error();
        motus_text_def def = motus_default_text();
        motus_system *s = NULL;
        def.text = texts[i];
        if (motus_system_from_text(&def, &s, &err) != MOTUS_OK) return 0;
        const char *words = motus_explain(s);
        h = mix(h, words, strlen(words));
        for (size_t k = 0; k < sizeof methods / sizeof *methods; k++) h = walk(h, s, methods[k]);
        motus_system_destroy(s);
        def.text = "x'' = -kk x";
        motus_status status = motus_system_from_text(&def, &s, &err);
        h = mix(mix(h, &status, sizeof status), err.message, strlen(err.message));
    }
    return h;
}

typedef struct worker {
    pthread_barrier_t *start;
    uint64_t seen[ROUNDS];
} worker;

static void *work(void *argument)
{
    worker *w = argument;
    pthread_barrier_wait(w->start);
    for (int i = 0; i < ROUNDS; i++) w->seen[i] = everything();
    return NULL;
}

static void threads_see_what_one_thread_sees(void **state)
{
    (void)state;
    pthread_barrier_t start;
    pthread_t threads[THREADS];
    worker workers[THREADS];
    assert_int_equal(pthread_barrier_init(&start, NULL, THREADS), 0);
    for (int i = 0; i < THREADS; i++) {
        workers[i].start = &start;
        assert_int_equal(pthread_create(&threads[i], NULL, work, &workers[i]), 0);
    }
    for (int i = 0; i < THREADS; i++) assert_int_equal(pthread_join(threads[i], NULL), 0);
    pthread_barrier_destroy(&start);
    uint64_t alone = everything();
    assert_true(alone != 0);
    for (int i = 0; i < THREADS; i++)
        for (int k = 0; k < ROUNDS; k++)
            if (workers[i].seen[k] != alone)
                fail_msg("thread %d, round %d: %016llx instead of %016llx", i, k,
                         (unsigned long long)workers[i].seen[k], (unsigned long long)alone);
}

/* Several runs of one system on one thread, in turns, do not affect each other. */
static void runs_of_one_system_take_turns(void **state)
{
    (void)state;
    enum { RUNS = 5 };
    for (size_t i = 0; i < 3; i++) {
        motus_system *s = given_text(texts[i]);
        motus_run *turns[RUNS], *alone[RUNS];
        const char *admitted[RUNS] = {"verlet", "rk4", "gauss6", "newmark", "rk4-38"};
        for (int k = 0; k < RUNS; k++) {
            alone[k] = given_run(s, admitted[k], 0.01, 1);
            finish(alone[k]);
        }
        for (int k = 0; k < RUNS; k++) turns[k] = given_run(s, admitted[k], 0.01, 1);
        for (int n = 0; n < 100; n++)
            for (int k = 0; k < RUNS; k++) take_steps(turns[k], 1);
        for (int k = 0; k < RUNS; k++) {
            same_state(s, turns[k], alone[k], "in turns and alone");
            motus_run_destroy(turns[k]);
            motus_run_destroy(alone[k]);
        }
        motus_system_destroy(s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(threads_see_what_one_thread_sees),
        cmocka_unit_test(runs_of_one_system_take_turns),
    };
    return cmocka_run_group_tests_name("threads", tests, NULL, NULL);
}
