/* Events of callbacks: times and states against closed forms, order through events, instants with several events.
 *
 * The truths are closed forms, or numbers of 30 digits that were computed by two independent ways.
 */
#include "given.h"
#include "test/fit.h"

#include <stdbool.h>

static const double MANY = 1e300;

typedef struct ball {
    double g, e, drag;
} ball;

static int fall(void *ctx, double t, const double *x, const double *v, double *a)
{
    const ball *b = ctx;
    (void)t, (void)x;
    a[0] = b->drag > 0 ? -b->g - b->drag * v[0] * fabs(v[0]) : -b->g;
    return 0;
}

static int height(void *ctx, double t, const double *x, const double *v, double *g)
{
    (void)ctx, (void)t;
    g[0] = x[0];
    g[1] = v[0];
    return 0;
}

static int bounce(void *ctx, size_t event, double t, double *x, double *v)
{
    const ball *b = ctx;
    (void)event, (void)t, (void)x;
    v[0] = -b->e * v[0];
    return 0;
}

/* With a step and a tolerance: steps that adapt and are as long as that at most, by an absolute tolerance. */
static motus_run *run_by(motus_system *s, const char *method, double step, double tolerance, double until)
{
    motus_error err = motus_default_error();
    motus_run_def def = motus_default_run();
    motus_run *r = NULL;
    def.method = method;
    if (isnan(tolerance))
        def.step = step;
    else if (!isnan(step))
        def.longest_step = step, def.absolute = 1;
    def.tolerance = tolerance;
    def.until = until;
    def.error = MOTUS_BARS_NONE;
    must(motus_run_create(s, &def, &r, &err), &err, method);
    return r;
}

static motus_event_row event_at(motus_run *r, int64_t k)
{
    motus_event_row e = motus_default_event_row();
    assert_int_equal(motus_run_event(r, k, &e), MOTUS_OK);
    return e;
}

static const struct {
    const char *method;
    double step, tolerance;
} ways[] = {{"verlet", 0.01, NAN},  {"rk4", 0.01, NAN},      {"gauss8", 0.02, NAN},
            {"dop853", NAN, 1e-13}, {"radau15", NAN, 1e-13}, {"dopri5", NAN, 1e-12},
            {"tsit5", NAN, 1e-12},  {"verner9", NAN, 1e-13}, {"gragg", NAN, 1e-13}};

/* A callback system of n positions with events. */
typedef struct problem_def {
    size_t n;
    const double *x, *v;
    int (*accel)(void *, double, const double *, const double *, double *);
    int velocity, time;
    size_t events;
    const motus_event_def *event;
    int (*functions)(void *, double, const double *, const double *, double *);
    int (*action)(void *, size_t, double, double *, double *);
    void *ctx;
} problem_def;

static motus_system *given_problem(const problem_def *p)
{
    motus_error err = motus_default_error();
    motus_system *s = NULL;
    motus_callback_def def = motus_default_callback();
    def.positions = p->n;
    def.x = p->x, def.v = p->v;
    def.acceleration = p->accel;
    def.depends_on_velocity = p->velocity;
    def.depends_on_time = p->time;
    def.context = p->ctx;
    def.events = p->event;
    def.event_count = p->events;
    def.event_functions = p->functions;
    def.event_action = p->action;
    must(motus_system_from_callback(&def, &s, &err), &err, "system");
    return s;
}

static motus_run *finished(motus_system *s, const char *method, double step, double tolerance, double until)
{
    motus_error err = motus_default_error();
    motus_run *r = run_by(s, method, step, tolerance, until);
    must(motus_run_finish(r, &err), &err, method);
    return r;
}

static motus_system *given_ball(ball *b, double h, double v, int drag)
{
    const motus_event_def events[] = {{.name = "bounce", .direction = -1, .assigns = 1},
                                      {.name = "top", .direction = -1}};
    const double x0[] = {h}, v0[] = {v};
    return given_problem(&(problem_def){1, x0, v0, fall, drag, 0, 2, events, height, bounce, b});
}

/* Bounce n of a ball let fall from h: t_1 = sqrt(2 h/g), t_{n+1} = t_n + 2 e^n v_1/g. */
static void bounces_of_a_ball(void **state)
{
    (void)state;
    ball b = {9.81, 0.8, 0};
    for (size_t k = 0; k < sizeof ways / sizeof *ways; k++) {
        motus_error err = motus_default_error();
        motus_system *s = given_ball(&b, 1, 0, 0);
        motus_run *r = run_by(s, ways[k].method, ways[k].step, ways[k].tolerance, 10);
        must(motus_run_finish(r, &err), &err, ways[k].method);
        long double t = sqrtl(2 / 9.81L), v = sqrtl(2 * 9.81L);
        int n = 0;
        double worst = 0;
        for (int64_t i = 0; i < motus_run_events(r); i++) {
            const motus_event_row e = event_at(r, i);
            if (strcmp(e.name, "bounce")) continue;
            n++;
            const double ulp = nextafter((double)t, 10) - (double)t, off = fabs((double)(e.time - t)) / ulp;
            if (getenv("SHOW") && off > 2) printf("%d %.17g %.3g\n", n, e.time, off);
            if (n <= 100) worst = fmax(worst, off);
            v *= 0.8L;
            t += 2 * v / 9.81L;
        }
        int gathers;
        double limit, error;
        const char *ended = motus_run_ended(r, &gathers, &limit, &error);
        printf("%s: %d bounces, worst %.1f ulp, ended by %s at %.17g +- %.1e, steps %lld\n", ways[k].method, n, worst,
               ended, limit, error, (long long)motus_run_steps(r));
        assert_true(n >= 100);
        assert_true(worst <= 64);
        assert_string_equal(ended, "bounce");
        assert_true(gathers);
        assert_true(fabs(limit - 4.06371276887157814) <= error);
        motus_run_destroy(r);
        motus_system_destroy(s);
    }
}

/* The zeros of x'' = -x + x^3 + 0.1 cos t from x = x' = 0, of which the start, a double one, is no event. */
static const double zeros[] = {
    3.146126371519089563543618799, 6.33871996271640648011776202,  9.642644084488746690939382588,
    13.18606336669535296143955121, 17.31722771995645706816759923, 21.39203715022197633513287579,
    24.91396289908009393035922124, 28.20368896104338093934710691, 31.37300455084850691545310845,
    34.13597712583383084755092755, 34.82699058047161404077155746, 37.74033531653721834303421747,
    40.91978874724300560066758204, 44.22591147074615785116511396, 47.78327516176203224249566815,
    51.94434009751141061253044162, 55.95279115592935478950282338, 59.44909051557361151409976735,
    62.71567361867488415029261358, 65.83295243736391971960319547, 68.36544755301903132998160633,
    69.59255278543016858307518392, 72.37836879125700818791167277, 75.52678956336539180001109546,
    78.82790550538158379295420422, 82.39361250419038691819493478, 86.55836923161170286201415062,
    90.5038803392817178241238474,  93.97442115897192456100793978, 97.21508087240897634411483622};
enum { ZEROS = sizeof zeros / sizeof *zeros };

static int driven(void *ctx, double t, const double *x, const double *v, double *a)
{
    (void)ctx, (void)v;
    a[0] = -x[0] + x[0] * x[0] * x[0] + 0.1 * cos(t);
    return 0;
}

static int position(void *ctx, double t, const double *x, const double *v, double *g)
{
    (void)ctx, (void)t, (void)v;
    g[0] = x[0];
    return 0;
}

/* By every row that adapts its steps and admits the force, with a tolerance of 1e-6. */
static void zeros_by_every_adaptive_row(void **state)
{
    (void)state;
    const double zero = 0;
    const motus_event_def event = {.name = "zero"};
    int rows = 0;
    for (size_t k = 0; k < motus_method_count(); k++) {
        motus_error err = motus_default_error();
        const motus_method *m = motus_method_at(k);
        /* a callback has no series, and the tolerance of reversible steps is a part of the time scale */
        if (!m->adaptive || m->reversible || !strcmp(m->name, "taylor")) continue;
        motus_system *s = given_problem(&(problem_def){1, &zero, &zero, driven, 0, 1, 1, &event, position, NULL, NULL});
        motus_run *r = run_by(s, m->name, NAN, 1e-6, 100);
        must(motus_run_finish(r, &err), &err, m->name);
        double worst = 0;
        for (int64_t i = 0; i < motus_run_events(r) && i < ZEROS; i++)
            worst = fmax(worst, fabs(event_at(r, i).time - zeros[i]));
        printf("%s: %lld zeros to %.1e\n", m->name, (long long)motus_run_events(r), worst);
        assert_int_equal(motus_run_events(r), ZEROS);
        assert_true(worst <= 1e-3);
        rows++;
        motus_run_destroy(r);
        motus_system_destroy(s);
    }
    assert_true(rows >= 17);
}

static void zeros_of_a_driven_oscillator(void **state)
{
    (void)state;
    const double zero = 0;
    const motus_event_def event = {.name = "zero"};
    const struct {
        const char *method;
        double step, tolerance, within;
    } by[] = {{"dop853", NAN, 1e-13, 2e-12}, {"radau15", NAN, 1e-13, 2e-13}, {"dopri5", NAN, 1e-6, 1e-3},
              {"dop853", NAN, 1e-6, 1e-3},   {"verner9", NAN, 1e-6, 1e-3},   {"rk4", 0.05, NAN, 1e-3},
              {"verlet", 0.01, NAN, 1e-3}};
    for (size_t k = 0; k < sizeof by / sizeof *by; k++) {
        motus_system *s = given_problem(&(problem_def){1, &zero, &zero, driven, 0, 1, 1, &event, position, NULL, NULL});
        motus_run *r = finished(s, by[k].method, by[k].step, by[k].tolerance, 100);
        double worst = 0;
        if (motus_run_events(r) != ZEROS) printf("%s: %lld zeros\n", by[k].method, (long long)motus_run_events(r));
        for (int64_t i = 0; i < motus_run_events(r) && i < ZEROS; i++) {
            const double off = fabs(event_at(r, i).time - zeros[i]);
            if (off > worst) printf("  zero %lld off %.2e %.17g\n", (long long)i + 1, off, event_at(r, i).time);
            worst = fmax(worst, off);
        }
        printf("%s %g: worst %.2e in %lld steps\n", by[k].method, by[k].tolerance, worst,
               (long long)motus_run_steps(r));
        assert_int_equal(motus_run_events(r), ZEROS);
        assert_true(worst <= by[k].within);
        motus_run_destroy(r);
        motus_system_destroy(s);
    }
}

/* Small closed forms ----------------------------------------------------------------------------------------------- */

static int thrown(void *ctx, double t, const double *x, const double *v, double *a)
{
    (void)ctx, (void)t, (void)x, (void)v;
    a[0] = -2;
    return 0;
}

static int above(void *ctx, double t, const double *x, const double *v, double *g)
{
    (void)t, (void)v;
    g[0] = x[0] - *(const double *)ctx;
    return 0;
}

/* y = 2 t - t^2 touches 1 at t = 1; 1 - 2^-30 it passes at 1 -+ 2^-15; 1 + 2^-30 it does not reach. */
static void a_touch_and_what_is_near_one(void **state)
{
    (void)state;
    const double zero = 0, two = 2;
    for (size_t k = 0; k < sizeof ways / sizeof *ways; k++)
        for (int direction = -1; direction <= 1; direction++)
            for (int side = -1; side <= 1; side++) {
                double level = 1 + side * 0x1p-30;
                const motus_event_def event = {.name = "top", .direction = direction};
                motus_system *s =
                    given_problem(&(problem_def){1, &zero, &two, thrown, 0, 0, 1, &event, above, NULL, &level});
                motus_run *r = finished(s, ways[k].method, isnan(ways[k].step) ? NAN : 0.25, ways[k].tolerance, 1.75);
                const int64_t count = motus_run_events(r), expected = side > 0   ? 0
                                                                      : side < 0 ? (direction ? 1 : 2)
                                                                                 : !direction;
                if (count != expected)
                    printf("%s: %d %d: %lld events\n", ways[k].method, side, direction, (long long)count);
                assert_int_equal(count, expected);
                for (int64_t i = 0; i < count; i++) {
                    const motus_event_row e = event_at(r, i);
                    const double t = side == 0 ? 1 : direction < 0 || i == 1 ? 1 + 0x1p-15 : 1 - 0x1p-15;
                    if (fabs(e.time - t) > 1e-9) printf("%s: %.17g not %.17g\n", ways[k].method, e.time, t);
                    assert_true(fabs(e.time - t) <= 1e-9);
                    assert_int_equal(e.touched, side == 0);
                }
                motus_run_destroy(r);
                motus_system_destroy(s);
            }
}

static int cubic(void *ctx, double t, const double *x, const double *v, double *a)
{
    (void)ctx, (void)x, (void)v;
    a[0] = 6 * t + 12;
    return 0;
}

static int quartic(void *ctx, double t, const double *x, const double *v, double *a)
{
    (void)ctx, (void)x, (void)v;
    a[0] = 12 * t * t;
    return 0;
}

/* x = (t - 2)(t + 2)(t + 6): zeros at -6, the start, and at -2 and 2. x = t^4 touches 0; near there it is less than
 * what the steps before it have rounded, 1e-16, which decides whether it touches, passes twice or does neither. */
static void several_roots_in_a_step(void **state)
{
    (void)state;
    motus_error err = motus_default_error();
    const motus_event_def event = {.name = "zero"};
    for (size_t k = 0; k < sizeof ways / sizeof *ways; k++)
        for (int flat = 0; flat < 2; flat++) {
            const double x = flat, v = flat ? -4 : 32;
            motus_callback_def def = motus_default_callback();
            def.positions = 1;
            def.start = flat ? -1 : -6;
            def.x = &x, def.v = &v;
            def.acceleration = flat ? quartic : cubic;
            def.events = &event;
            def.event_count = 1;
            def.event_functions = position;
            motus_system *s = NULL;
            must(motus_system_from_callback(&def, &s, &err), &err, "system");
            if (!strcmp(ways[k].method, "verlet")) { /* its order is 2 */
                motus_system_destroy(s);
                continue;
            }
            motus_run *r = finished(s, ways[k].method,
                                    isnan(ways[k].step) ? NAN
                                    : flat              ? 2
                                                        : 12,
                                    ways[k].tolerance, flat ? 1 : 6);
            const int64_t count = motus_run_events(r);
            if (count != (flat ? 1 : 2)) printf("%s %d: %lld\n", ways[k].method, flat, (long long)count);
            for (int64_t i = 0; i < count; i++) {
                const motus_event_row e = event_at(r, i);
                printf("%s %d: %.17g touched %d\n", ways[k].method, flat, e.time, e.touched);
                assert_true(fabs(e.time - (flat ? 0 : i ? 2 : -2)) <= (flat ? 1e-3 : 1e-13));
                assert_int_equal(e.touched, flat && count == 1);
            }
            assert_true(flat ? count <= 2 : count == 2);
            motus_run_destroy(r);
            motus_system_destroy(s);
        }
}

static int free_motion(void *ctx, double t, const double *x, const double *v, double *a)
{
    (void)t, (void)x, (void)v;
    for (size_t k = 0; k < *(const size_t *)ctx; k++) a[k] = 0;
    return 0;
}

static int walls(void *ctx, double t, const double *x, const double *v, double *g)
{
    (void)ctx, (void)t, (void)v;
    g[0] = x[0] - 1;
    g[1] = x[1] - 1;
    return 0;
}

static int reflect(void *ctx, size_t event, double t, double *x, double *v)
{
    (void)ctx, (void)t, (void)x;
    v[event] = -v[event];
    return 0;
}

static void a_corner(void **state)
{
    (void)state;
    motus_error err = motus_default_error();
    size_t two = 2;
    const double x0[] = {0, 0}, v0[] = {1, 1};
    const motus_event_def events[] = {{.name = "right", .direction = 1, .assigns = 1},
                                      {.name = "top", .direction = 1, .assigns = 1}};
    for (size_t k = 0; k < sizeof ways / sizeof *ways; k++) {
        motus_system *s = given_problem(&(problem_def){2, x0, v0, free_motion, 0, 0, 2, events, walls, reflect, &two});
        motus_run *r = finished(s, ways[k].method, isnan(ways[k].step) ? NAN : 0.3, ways[k].tolerance, 2);
        double x[2], v[2];
        must(motus_run_state(r, x, v, &err), &err, "state");
        printf("%s: %lld events, %g %g %g %g\n", ways[k].method, (long long)motus_run_events(r), x[0], x[1], v[0],
               v[1]);
        assert_int_equal(motus_run_events(r), 2);
        assert_true(event_at(r, 0).time == event_at(r, 1).time);
        assert_true(fabs(event_at(r, 0).time - 1) <= 0x1p-51);
        assert_true(fabs(v[0] + 1) < 1e-14 && fabs(v[1] + 1) < 1e-14 && fabs(x[0]) < 1e-14 && fabs(x[1]) < 1e-14);
        motus_run_destroy(r);
        motus_system_destroy(s);
    }
}

static int swing(void *ctx, double t, const double *x, const double *v, double *a)
{
    (void)ctx, (void)t, (void)v;
    a[0] = -x[0];
    return 0;
}

static int peak(void *ctx, double t, const double *x, const double *v, double *g)
{
    (void)ctx, (void)t, (void)v;
    g[0] = 1 - x[0];
    return 0;
}

/* x = cos(t) touches 1 at 2 pi. The slope of a callback's function is a difference quotient, which the error of the
 * touch's time counts. */
static void a_touch_of_a_callback(void **state)
{
    (void)state;
    motus_error err = motus_default_error();
    const double x0[] = {1}, v0[] = {0};
    const motus_event_def event = {.name = "peak"};
    motus_system *s = given_problem(&(problem_def){1, x0, v0, swing, 0, 0, 1, &event, peak, NULL, NULL});
    motus_run_def def = motus_default_run();
    motus_run *r = NULL;
    def.method = "gauss8", def.step = 0.1, def.until = 7, def.error = MOTUS_BARS_CHEAP;
    must(motus_run_create(s, &def, &r, &err), &err, "a touch");
    must(motus_run_finish(r, &err), &err, "a touch");
    assert_int_equal(motus_run_events_significant(r), 1);
    const motus_event_row e = event_at(r, 0);
    assert_true(e.touched && fabs(e.time - 6.28318530717958648) <= e.error);
    if (!(e.error < 1e-6)) fail_msg("the time of the touch has the error %g", e.error);
    motus_run_destroy(r);
    motus_system_destroy(s);
}

/* A run of a callback says, too, that it is not reversible across an event that assigns. */
static void cuts_of_a_callback(void **state)
{
    (void)state;
    ball b = {9.81, 0.8, 0};
    motus_system *s = given_ball(&b, 1, 0, 0);
    motus_run *cut = run_by(s, "verlet-reversible", NAN, 1e-6, 1), *whole = run_by(s, "verlet", 0.01, NAN, 1);
    assert_non_null(strstr(motus_run_now(cut).cut, "reversible only between"));
    assert_string_equal(motus_run_now(whole).cut, "");
    motus_run_destroy(cut);
    motus_run_destroy(whole);
    motus_system_destroy(s);
}

enum { BALLS = 4 };

static int contacts(void *ctx, double t, const double *x, const double *v, double *g)
{
    (void)ctx, (void)t, (void)v;
    for (int k = 0; k + 1 < BALLS; k++) g[k] = x[k + 1] - x[k] - 1;
    return 0;
}

static int exchange(void *ctx, size_t event, double t, double *x, double *v)
{
    (void)ctx, (void)t, (void)x;
    const double kept = v[event];
    v[event] = v[event + 1];
    v[event + 1] = kept;
    return 0;
}

static void a_cradle(void **state)
{
    (void)state;
    motus_error err = motus_default_error();
    size_t n = BALLS;
    const double x0[] = {0, 2, 3, 4}, v0[] = {1, 0, 0, 0};
    const motus_event_def events[] = {
        {.direction = -1, .assigns = 1}, {.direction = -1, .assigns = 1}, {.direction = -1, .assigns = 1}};
    for (size_t k = 0; k < sizeof ways / sizeof *ways; k++) {
        motus_system *s =
            given_problem(&(problem_def){n, x0, v0, free_motion, 0, 0, 3, events, contacts, exchange, &n});
        motus_run *r = finished(s, ways[k].method, isnan(ways[k].step) ? NAN : 0.3, ways[k].tolerance, 2);
        double x[BALLS], v[BALLS];
        must(motus_run_state(r, x, v, &err), &err, "state");
        printf("%s: %lld events, %g %g %g %g\n", ways[k].method, (long long)motus_run_events(r), v[0], v[1], v[2],
               v[3]);
        assert_int_equal(motus_run_events(r), 3);
        for (int i = 0; i < 3; i++) assert_true(fabs(event_at(r, i).time - 1) <= 0x1p-51);
        assert_true(fabs(v[0]) < 1e-14 && fabs(v[1]) < 1e-14 && fabs(v[2]) < 1e-14 && fabs(v[3] - 1) < 1e-14);
        motus_run_destroy(r);
        motus_system_destroy(s);
    }
}

static int clacks(void *ctx, double t, const double *x, const double *v, double *g)
{
    (void)ctx, (void)t, (void)v;
    g[0] = x[1] - x[0];
    g[1] = x[0];
    return 0;
}

typedef struct masses {
    size_t n;
    double m;
} masses;

static int collide(void *ctx, size_t event, double t, double *x, double *v)
{
    const double m = ((const masses *)ctx)->m, a = v[0], b = v[1];
    (void)t, (void)x;
    if (event) {
        v[0] = -a;
        return 0;
    }
    v[0] = ((1 - m) * a + 2 * m * b) / (1 + m);
    v[1] = ((m - 1) * b + 2 * a) / (1 + m);
    return 0;
}

/* Masses 1 and 100^n before a wall: as many contacts as the first digits of pi say. */
static void counting_pi(void **state)
{
    (void)state;
    const double x0[] = {1, 2}, v0[] = {0, -1};
    const motus_event_def events[] = {{.direction = -1, .assigns = 1}, {.direction = -1, .assigns = 1}};
    static const int64_t expected[] = {3, 31, 314, 3141};
    masses of = {2, 1};
    for (int n = 0; n < 4; n++, of.m *= 100)
        for (size_t k = 0; k < sizeof ways / sizeof *ways; k++) {
            motus_system *s =
                given_problem(&(problem_def){2, x0, v0, free_motion, 0, 0, 2, events, clacks, collide, &of});
            motus_run *r = finished(s, ways[k].method, isnan(ways[k].step) ? NAN : 0.3, ways[k].tolerance, 20);
            if (motus_run_events(r) != expected[n])
                printf("%s %d: %lld\n", ways[k].method, n, (long long)motus_run_events(r));
            if (motus_run_events(r) != expected[n])
                for (int64_t i = 0; i < motus_run_events(r) && i < 5; i++)
                    printf("   %s %.17g\n", event_at(r, i).name, event_at(r, i).time);
            assert_int_equal(motus_run_events(r), expected[n]);
            motus_run_destroy(r);
            motus_system_destroy(s);
        }
}

static int kick(void *ctx, size_t event, double t, double *x, double *v)
{
    (void)ctx, (void)event, (void)t;
    v[0] += sin(x[0]);
    return 0;
}

/* The standard map: a kick sin(x) at every whole time. */
static void kicks_by_the_clock(void **state)
{
    (void)state;
    motus_error err = motus_default_error();
    size_t one = 1;
    const double x0 = 1, v0 = 0;
    const motus_event_def event = {.name = "kick", .every = 1, .assigns = 1};
    for (size_t k = 0; k < sizeof ways / sizeof *ways; k++) {
        motus_system *s = given_problem(&(problem_def){1, &x0, &v0, free_motion, 0, 0, 1, &event, NULL, kick, &one});
        motus_run *r = finished(s, ways[k].method, isnan(ways[k].step) ? NAN : 0.3, ways[k].tolerance, 10.5);
        double x = 1, p = 0, xr, vr;
        for (int n = 1; n <= 10; n++) {
            x += p;
            p += sin(x);
            assert_true(event_at(r, n - 1).time == n);
        }
        x += p / 2;
        must(motus_run_state(r, &xr, &vr, &err), &err, "state");
        if (fabs(xr - x) > 1e-11) printf("%s: %.17g not %.17g\n", ways[k].method, xr, x);
        assert_int_equal(motus_run_events(r), 10);
        assert_true(fabs(xr - x) <= 1e-11);
        motus_run_destroy(r);
        motus_system_destroy(s);
    }
}

/* A clock that only records ends no step: several of its times may lie in one. */
static void ticks_within_a_step(void **state)
{
    (void)state;
    size_t one = 1;
    const double x0 = 1, v0 = 0.5;
    const motus_event_def events[] = {{.name = "slow", .every = 0.25}, {.name = "fast", .every = 0.0625}};
    for (size_t k = 0; k < sizeof ways / sizeof *ways; k++) {
        motus_system *s = given_problem(&(problem_def){1, &x0, &v0, free_motion, 0, 0, 2, events, NULL, NULL, &one});
        motus_run *r = finished(s, ways[k].method, isnan(ways[k].step) ? NAN : 0.75, ways[k].tolerance, 12);
        int slow = 0, fast = 0;
        for (int64_t i = 0; i < motus_run_events(r); i++) {
            const motus_event_row e = event_at(r, i);
            assert_true(e.time == (strcmp(e.name, "slow") ? ++fast * 0.0625 : ++slow * 0.25));
        }
        assert_int_equal(slow, 48);
        assert_int_equal(fast, 192);
        motus_run_destroy(r);
        motus_system_destroy(s);
    }
}

/* A ball in air, y'' = -9.81 - 0.1 y'|y'| from 10: time and speed of each impact, time and height of the top after it.
 * The sign of y' is a mode, so that the force is smooth between events and every order shows. */
static const long double air[][4] = {{1.67342826210498117805025072070L, 9.20997332865238513255188L,
                                      2.31917718571354813934045647975L, 2.20218345138801825930868L},
                                     {3.01406938887196200883075732888L, 5.91165045891323862230571L,
                                      3.46384065372593160645385330443L, 1.02692049899296036902495L},
                                     {3.92927159289860139617730243101L, 4.26776152467321008594599L,
                                      4.26442644437248918121569052811L, 0.56139933279541286174674L},
                                     {4.60591186327090975855926811612L, 3.22781672479663609444124L,
                                      4.86340652458095330054787897888L, 0.328806627776468257015965L},
                                     {5.12373885465642749855106438208L, 2.49872788907544831363513L,
                                      5.32480768974839619797871131777L, 0.199627488374567236044489L},
                                     {5.52721893942831152667921653909L, 1.95947280074136101201535L,
                                      5.68569832538051997280595154988L, 0.123701815133255886890827L}};
enum { IMPACTS = sizeof air / sizeof *air };

/* The largest error of all impacts and tops until 5.6, and that of impact 6. */
static double ball_in_air(const char *method, double step, double tolerance, double *sixth)
{
    motus_error err = motus_default_error();
    motus_system *s = given_text("up = -1; y'' = -9.81 - 0.1 up y'^2; y(0) = 10; y'(0) = 0\n"
                                 "when y = 0 falling as impact: y' = -0.8 y', up = 1, record\n"
                                 "when y' = 0 falling as top: up = -1, record");
    motus_run *r = finished(s, method, step, tolerance, 5.7);
    const size_t columns[] = {column(s, "y"), column(s, "y'")};
    double worst = 0;
    int impacts = 0, tops = 0;
    for (int64_t i = 0; i < motus_run_events(r); i++) {
        const motus_event_row e = event_at(r, i);
        const bool top = !strcmp(e.name, "top");
        const int n = top ? tops++ : impacts++;
        double y[2];
        must(motus_run_event_values(r, i, 0, columns, 2, y, &err), &err, "values");
        assert_true(n < IMPACTS);
        const double off = (double)fabsl(e.time - air[n][top ? 2 : 0]);
        worst = fmax(worst, fmax(off, (double)fabsl((top ? y[0] : -y[1]) - air[n][top ? 3 : 1])));
        if (!top && n == IMPACTS - 1) *sixth = off;
    }
    assert_int_equal(impacts, IMPACTS);
    assert_int_equal(tops, IMPACTS);
    motus_run_destroy(r);
    motus_system_destroy(s);
    return worst;
}

static void a_ball_in_air(void **state)
{
    (void)state;
    static const struct {
        const char *method;
        double step, tolerance;
    } exact[] = {{"gauss8", 0.02, NAN}, {"dop853", NAN, 1e-15}, {"taylor", NAN, 1e-15}};
    double sixth;
    for (size_t k = 0; k < sizeof exact / sizeof *exact; k++) {
        const double worst = ball_in_air(exact[k].method, exact[k].step, exact[k].tolerance, &sixth);
        printf("%s: worst %.1e\n", exact[k].method, worst);
        assert_true(worst <= 1e-13);
    }
}

/* Impact 6 by steps of one size. Taylor series that may be off by anything have 6 terms, and those of velocities end
 * one power before those of positions, so their order is 5. */
static void order_in_air(void **state)
{
    (void)state;
    enum { SIZES = 9 };
    static const struct {
        const char *method;
        int order;
        double step, tolerance;
    } rows[] = {{"verlet", 2, 0.005, NAN}, {"rk4", 4, 0.02, NAN}, {"gauss8", 8, 0.25, NAN}, {"taylor", 5, 0.06, 1e300}};
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
        double x[SIZES], y[SIZES], sixth, twice;
        for (int i = 0; i < SIZES; i++) {
            x[i] = log2(rows[k].step) - i / 4.0;
            ball_in_air(rows[k].method, exp2(x[i]), rows[k].tolerance, &sixth);
            y[i] = log2(sixth);
        }
        const double observed = line_slope(x, y, SIZES, &twice);
        printf("%s: slope %.3f\n", rows[k].method, observed);
        assert_true(fabs(observed - rows[k].order) <= 0.15);
    }
}

/* By dop853 terms of order 8 and 9 cancel where steps are 0.2 long, and from 0.1 on little but rounding is left: no
 * slope shows there. But an error estimate goes with h^(p+1) and the error with h^p, so the error of all impacts and
 * tops goes with the power p/(p + 1) of the tolerance at least. */
static void tolerance_in_air(void **state)
{
    (void)state;
    enum { SIZES = 25, ORDER = 8 };
    double x[SIZES], y[SIZES], sixth, twice;
    for (int i = 0; i < SIZES; i++) {
        x[i] = log2(1e-3) - 1.25 * i;
        y[i] = log2(ball_in_air("dop853", NAN, exp2(x[i]), &sixth));
    }
    const double power = line_slope(x, y, SIZES, &twice);
    printf("dop853: error with the power %.3f +- %.3f of the tolerance\n", power, twice);
    assert_true(power >= ORDER / (ORDER + 1.0) - twice);
}

int main(void)
{
    (void)MANY;
    const struct CMUnitTest tests[] = {cmocka_unit_test(bounces_of_a_ball),
                                       cmocka_unit_test(zeros_of_a_driven_oscillator),
                                       cmocka_unit_test(zeros_by_every_adaptive_row),
                                       cmocka_unit_test(a_touch_and_what_is_near_one),
                                       cmocka_unit_test(several_roots_in_a_step),
                                       cmocka_unit_test(a_corner),
                                       cmocka_unit_test(a_touch_of_a_callback),
                                       cmocka_unit_test(cuts_of_a_callback),
                                       cmocka_unit_test(a_cradle),
                                       cmocka_unit_test(counting_pi),
                                       cmocka_unit_test(kicks_by_the_clock),
                                       cmocka_unit_test(ticks_within_a_step),
                                       cmocka_unit_test(a_ball_in_air),
                                       cmocka_unit_test(order_in_air),
                                       cmocka_unit_test(tolerance_in_air)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
