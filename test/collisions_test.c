/* Balls of equal mass on a line between two walls, which exchange their velocities where they meet: many collisions at
 * once, and of one ball with two others. The truth moves ghosts, which pass through one another, and counts how often
 * neighbours meet by the rules in the order of the text; its times are quotients of small whole numbers, so what is
 * nearer than CLOSE is at once. Every event is told, none twice, in this order.
 */
#include "test/given.h"

#include <stdbool.h>

enum { BALLS_MOST = 5, EVENTS_MOST = 400, MODELS = 300 };
#define CLOSE 1e-12
#define UNTIL 8.037 /* no collision is there */

typedef struct happening {
    double t;
    int which; /* 0: the left wall, 1: the right one, 1 + i: balls i and i + 1, which count from 1 */
} happening;

typedef struct balls {
    int n;
    long double x[BALLS_MOST], v[BALLS_MOST];
} balls;

/* A generator of Lehmer's, the same everywhere. */
static int drawn(uint64_t *seed, int below)
{
    *seed = *seed * 48271 % 2147483647;
    return (int)(*seed % (uint64_t)below);
}

static balls random_balls(uint64_t *seed)
{
    balls b = {.n = 2 + drawn(seed, BALLS_MOST - 1)};
    int at = 0;
    for (int i = 0; i < b.n; i++) {
        at += 1 + drawn(seed, 15 / b.n - 1);
        b.x[i] = at / 16.0L;
        b.v[i] = (drawn(seed, 7) - 3) / 4.0L;
    }
    return b;
}

/* How long it is until number `which` may happen; below 0: never. */
static long double due(const balls *b, int which)
{
    const int i = which - 2;
    if (which == 0) return b->v[0] < 0 ? -b->x[0] / b->v[0] : -1;
    if (which == 1) return b->v[b->n - 1] > 0 ? (1 - b->x[b->n - 1]) / b->v[b->n - 1] : -1;
    const long double closing = b->v[i] - b->v[i + 1];
    return closing > 0 ? (b->x[i + 1] - b->x[i]) / closing : -1;
}

static void act(balls *b, int which)
{
    const int i = which - 2;
    if (which < 2) {
        b->v[which ? b->n - 1 : 0] *= -1;
        return;
    }
    const long double kept = b->v[i];
    b->v[i] = b->v[i + 1], b->v[i + 1] = kept;
}

static int simulate(balls b, happening *out)
{
    long double t = 0;
    int count = 0;
    for (;;) {
        long double next = INFINITY;
        for (int k = 0; k <= b.n; k++) {
            const long double wait = due(&b, k);
            if (wait >= 0 && wait < next) next = wait;
        }
        if (!(t + next < UNTIL)) return count;
        t += next;
        for (int i = 0; i < b.n; i++) b.x[i] += b.v[i] * next;
        for (bool again = true; again;) { /* the first in the order of the text, then all are asked again */
            again = false;
            for (int k = 0; k <= b.n && !again; k++) {
                const long double wait = due(&b, k);
                if (!(fabsl(wait) <= CLOSE)) continue;
                assert_true(count < EVENTS_MOST);
                out[count++] = (happening){(double)t, k};
                act(&b, k);
                again = true;
            }
        }
    }
}

static void text_of(const balls *b, char *out, size_t size)
{
    size_t at = (size_t)snprintf(out, size, "N = %d\nx[i]'' = 0 for i = 1..N\n", b->n);
    for (int i = 0; i < b->n; i++)
        at += (size_t)snprintf(out + at, size - at, "x[%d](0) = %.17g\nx[%d]'(0) = %.17g\n", i + 1, (double)b->x[i],
                               i + 1, (double)b->v[i]);
    at += (size_t)snprintf(
        out + at, size - at,
        "when x[1] = 0 falling as left: x[1]' = -x[1]', record\n"
        "when x[N] = 1 rising as right: x[N]' = -x[N]', record\n"
        "when x[i+1] - x[i] = 0 falling as c: x[i]' = x[i+1]', x[i+1]' = x[i]', record for i = 1..N-1\n");
    assert_true(at < size);
}

static int number_of(const motus_event_row *row)
{
    return !strcmp(row->name, "left") ? 0 : !strcmp(row->name, "right") ? 1 : 1 + atoi(strchr(row->instance, '[') + 1);
}

static void every_collision_is_told(void **state)
{
    (void)state;
    static const struct {
        const char *method;
        double step;
    } rows[] = {{"verlet", 0.0625}, {"rk4", 0.1},     {"dop853", NAN},           {"taylor", NAN},
                {"gauss4", 0.3},    {"radau15", NAN}, {"symplectic-euler", 0.25}};
    uint64_t seed = 20261126;
    int collisions = 0;
    for (int model = 0; model < MODELS; model++) {
        const balls b = random_balls(&seed);
        happening truth[EVENTS_MOST];
        const int count = simulate(b, truth);
        char text[2048];
        text_of(&b, text, sizeof text);
        const size_t m = (size_t)model % (sizeof rows / sizeof *rows);
        motus_system *s = given_text(text);
        motus_error err = motus_default_error();
        motus_run_def def = motus_default_run();
        motus_run *r = NULL;
        def.method = rows[m].method, def.step = rows[m].step, def.until = UNTIL, def.machine = "interpreter";
        must(motus_run_create(s, &def, &r, &err), &err, text);
        must(motus_run_finish(r, &err), &err, text);
        if (motus_run_events(r) != count)
            fail_msg("%s, %s: %d events, not %d", text, rows[m].method, (int)motus_run_events(r), count);
        for (int k = 0; k < count; k++) {
            motus_event_row row = motus_default_event_row();
            assert_int_equal(motus_run_event(r, k, &row), MOTUS_OK);
            near(row.time, truth[k].t, CLOSE, text);
            /* at once: the order is that of the text, unless rounding tells their times apart */
            bool found = false;
            for (int i = 0; i < count; i++)
                found |= fabs(truth[i].t - truth[k].t) <= CLOSE && truth[i].which == number_of(&row);
            if (!found) fail_msg("%s, %s: event %d is %s%s", text, rows[m].method, k, row.name, row.instance);
        }
        collisions += count;
        motus_run_destroy(r);
        motus_system_destroy(s);
    }
    assert_true(collisions > 20 * MODELS);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_collision_is_told)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
