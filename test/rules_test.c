/* What a model's `when` statements supply to the engine of events: core/rules.h. Functions, their rates and bounds, and
 * what actions do, are compared with their formulas at states that are set by hand. */
#include "api/system/system.h"
#include "test/given.h"

static const rules *rules_of(motus_system *s)
{
    motus_error err = motus_default_error();
    const rules *r = NULL;
    must(system_rules(s, &r, &err), &err, "rules");
    return r;
}

static size_t rule_named(const rules *r, const char *name)
{
    for (size_t k = 0; k < r->count; k++)
        if (!strcmp(r->rule[k].name, name)) return k;
    fail_msg("there is no rule %s", name);
    return 0;
}

/* The place of a number in x or v. */
static double *number_of(motus_system *s, const char *name, double *x, double *v)
{
    for (int in_v = 0; in_v < 2; in_v++)
        for (size_t k = 0; k < (in_v ? s->problem.nv : s->problem.nx); k++) {
            char is[128];
            s->problem.name(s->problem.ctx, in_v, k, is, sizeof is);
            if (!strcmp(is, name)) return in_v ? &v[k] : &x[k];
        }
    fail_msg("there is no number %s", name);
    return NULL;
}

static void act_on(const rules *r, const char *name, size_t instance, double t, double *x, double *v)
{
    bool in_v;
    size_t which;
    assert_int_equal(r->act(r->ctx, rule_named(r, name), instance, t, x, v, &in_v, &which), 0);
}

#define BALL "e = 0.8\ny'' = -9.81\ny(0) = 1\ny'(0) = 0\n"
#define PAIR "x'' = 0\nx(0) = 1\nx'(0) = 2\nz'' = 0\nz(0) = 3\nz'(0) = 4\ns' = x\ns(0) = 5\n"

static void one_event(void **state)
{
    (void)state;
    motus_system *s = given_text(BALL "when y = 0 falling as bounce: y' = -e y', record");
    const rules *r = rules_of(s);
    assert_int_equal(r->count, 1);
    assert_int_equal(r->functions, 1);
    const rule *b = &r->rule[0];
    assert_string_equal(b->name, "bounce");
    assert_int_equal(b->kind, RULE_ROOT);
    assert_int_equal(b->direction, -1);
    assert_true(b->records && b->assigns && !b->keeps && b->stop == 0);
    assert_int_equal(b->leaves, 1);
    assert_int_equal(b->instances, 1);
    double x = 0.25, v = -3, a = -9.81, out = 0;
    r->values(r->ctx, 0, &x, &v, &out);
    assert_true(out == 0.25);
    r->rates(r->ctx, 0, &x, &v, &a, &out);
    assert_true(out == -3);
    r->rounding(r->ctx, 0, &x, &v, &out);
    assert_true(out == 0.25 * 0x1p-53);
    act_on(r, "bounce", 0, 0, &x, &v);
    assert_true(x == 0.25 && v == -(0.8 * -3.0));
    char name[64];
    r->name(r->ctx, 0, 0, name, sizeof name);
    assert_string_equal(name, "bounce");
    motus_system_destroy(s);
}

/* Names, kinds and numbers of the rules of a text, in its order. */
static void all_kinds(void **state)
{
    (void)state;
    motus_system *s = given_text(PAIR "when x - z = s t: record, stop after 3\nwhen every 1/4 as tick: s = 0\n"
                                      "when x = z rising: x' = z', z' = x'\n"
                                      "when event3 accumulates: stop\nwhen z > 2 as high:\n  record,\n  x = 0");
    const rules *r = rules_of(s);
    assert_int_equal(r->count, 5);
    const char *const names[] = {"event1", "tick", "event3", "event4", "high"};
    const rule_kind kinds[] = {RULE_ROOT, RULE_CLOCK, RULE_ROOT, RULE_ACCUMULATES, RULE_CONDITION};
    for (size_t k = 0; k < 5; k++) {
        assert_string_equal(r->rule[k].name, names[k]);
        assert_int_equal(r->rule[k].kind, kinds[k]);
    }
    assert_int_equal(r->rule[0].stop, 3);
    assert_true(r->rule[1].period == 0.25);
    assert_int_equal(r->rule[2].direction, 1);
    assert_int_equal(r->rule[3].of, 2);
    assert_int_equal(r->rule[3].stop, 1);
    assert_int_equal(r->functions, 3);
    double x[] = {1, 3}, v[] = {2, 4, 5}, a[] = {0, 0, 1}, out[3];
    r->values(r->ctx, 2, x, v, out);
    assert_true(out[0] == -12 && out[1] == -2 && out[2] == 1);
    r->rates(r->ctx, 2, x, v, a, out); /* (x - z - s t)' = x' - z' - s' t - s */
    assert_true(out[0] == 2 - 4 - 1 * 2 - 5 && out[1] == -2 && out[2] == 4);
    act_on(r, "event3", 0, 2, x, v); /* all right sides see the state before */
    assert_true(v[0] == 4 && v[1] == 2 && v[2] == 5 && x[0] == 1 && x[1] == 3);
    act_on(r, "tick", 0, 2, x, v);
    assert_true(v[2] == 0 && v[0] == 4);
    act_on(r, "high", 0, 2, x, v);
    assert_true(x[0] == 0 && x[1] == 3);
    motus_system_destroy(s);
}

/* A number in [-1, 1], by a congruence that is the same everywhere. */
static double random_sign(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(int64_t)(*state >> 11 << 11) * 0x1p-63;
}

/* What a box of states has of a function and its rate at least, compared with points of the box, its corners among
 * them; and on a small box the bound is close to the value. */
static void least_on_boxes(void **state)
{
    (void)state;
    static const char text[] =
        PAIR "when x = 0.3: record\nwhen x^2 + z^2 = 1: record\nwhen x z = sin(x): record\nwhen exp(x) = 2: record\n"
             "when sqrt(x^2 + 1) = z: record\nwhen hypot(x, z) = 2: record\nwhen x/z = 1: record\n"
             "when log(3 + x) = cos(z): record\nwhen max(x, z) = min(x', z'): record\nwhen abs(x') = tanh(z): record\n"
             "when atan(x) = z': record\nwhen x + 1000000000 = 1000000001: record\nwhen s = x': record\n"
             "when -x/(z^2 + 1) + 3 x^3 = s: record\nwhen sum(j = 1..20: sin(j x)/j) = z: record\n";
    enum { FUNCTIONS = 15, BOXES = 20000, POINTS = 12 };
    motus_system *system = given_text(text);
    const rules *r = rules_of(system);
    uint64_t seed = 7;
    int told[2][FUNCTIONS] = {{0}};
    assert_int_equal(r->functions, FUNCTIONS);
    for (int box = 0; box < BOXES; box++) {
        double at[2][5], width[2][5], a[5] = {0}, least[2][FUNCTIONS], g[2][FUNCTIONS];
        for (int k = 0; k < 10; k++) {
            const double size = pow(10, -3 - 3 * random_sign(&seed));
            at[k / 5][k % 5] = 2 * random_sign(&seed);
            width[k / 5][k % 5] = box % 2 ? 1e-9 : fabs(size * random_sign(&seed));
        }
        r->least(r->ctx, at[0], at[1], width[0], width[1], least[0]);
        r->least_rates(r->ctx, at[0], at[1], width[0], width[1], least[1]);
        for (int point = 0; point <= POINTS; point++) {
            double x[5], v[5];
            for (int k = 0; k < 5; k++) {
                const bool corner = point < POINTS / 2;
                const double px = point == POINTS ? 0 : random_sign(&seed),
                             pv = point == POINTS ? 0 : random_sign(&seed);
                x[k] = at[0][k] + width[0][k] * (corner ? copysign(1, px) : px);
                v[k] = at[1][k] + width[1][k] * (corner ? copysign(1, pv) : pv);
                a[k] = random_sign(&seed);
            }
            r->values(r->ctx, 0, x, v, g[0]);
            r->rates(r->ctx, 0, x, v, a, g[1]);
            for (int f = 0; f < 2 * FUNCTIONS; f++) {
                const double value = g[f / FUNCTIONS][f % FUNCTIONS], bound = least[f / FUNCTIONS][f % FUNCTIONS];
                if (bound > 0 && !(fabs(value) >= bound)) fail_msg("function %d is %g, not %g", f, value, bound);
            }
        }
        for (int f = 0; f < 2 * FUNCTIONS && box % 2; f++) { /* the last point is the centre */
            const double value = fabs(g[f / FUNCTIONS][f % FUNCTIONS]), bound = least[f / FUNCTIONS][f % FUNCTIONS];
            told[f / FUNCTIONS][f % FUNCTIONS] += bound > 0.99 * value - 1e-5;
        }
    }
    /* rates with branches, and of functions of velocities, which depend on accelerations */
    static const bool unbounded[FUNCTIONS] = {
        [4] = true, [5] = true, [8] = true, [9] = true, [10] = true, [12] = true, [13] = true};
    for (int f = 0; f < FUNCTIONS; f++) {
        if (told[0][f] < 9 * BOXES / 20) fail_msg("of function %d a bound is told in %d boxes", f, told[0][f]);
        if (!unbounded[f] && told[1][f] < 9 * BOXES / 20) fail_msg("of rate %d in %d boxes", f, told[1][f]);
    }
    motus_system_destroy(system);
}

static void conditions(void **state)
{
    (void)state;
    motus_system *s = given_text(PAIR "when x > 1 and not (z <= 2 or s == 3) or t != 4 and 5 >= x: record");
    const rules *r = rules_of(s);
    const rule *c = &r->rule[0];
    /* leaves in the order of the text: x - 1, 2 - z, s - 3, t - 4, 5 - x */
    const int formula[] = {0, 1, 2, RULE_OR, RULE_NOT, RULE_AND, 3, 4, RULE_AND, RULE_OR};
    const rule_comparison compares[] = {RULE_ABOVE, RULE_AT_LEAST, RULE_AT, RULE_OFF, RULE_AT_LEAST};
    assert_int_equal(c->words, 10);
    for (int k = 0; k < 10; k++) assert_int_equal(c->formula[k], formula[k]);
    assert_int_equal(c->leaves, 5);
    for (int k = 0; k < 5; k++) assert_int_equal(c->compares[k], compares[k]);
    double x[] = {10, 20}, v[] = {0, 0, 30}, out[5];
    r->values(r->ctx, 40, x, v, out);
    assert_true(out[0] == 9 && out[1] == -18 && out[2] == 27 && out[3] == 36 && out[4] == -5);
    motus_system_destroy(s);
}

#define ROW "N = 4\nx[i]'' = 0 for i = 1..N\nx[i](0) = i^2 for i = 1..N\nx[i]'(0) = 10 i for i = 1..N\n"

/* An event for every pair i < j: the others have no function. */
static void families(void **state)
{
    (void)state;
    motus_system *s = given_text(ROW "when x[j] = x[i] as contact: x[i]' = x[j]', x[j]' = x[i]', x[i] = x[i] + 1"
                                     " for i = 1..N, j = i+1..N\n"
                                     "when x[i+1] = 7 t as pass: x[i+1]' = -x[i]' for i = 1..N-1");
    const rules *r = rules_of(s);
    const rule *c = &r->rule[0];
    assert_int_equal(c->instances, 12); /* i = 1..4, j = 2..4 */
    assert_int_equal(r->rule[1].instances, 3);
    assert_int_equal(r->functions, 15);
    double x[4] = {1, 4, 9, 16}, v[4] = {10, 20, 30, 40}, out[15], bound[15];
    r->values(r->ctx, 1, x, v, out);
    r->rounding(r->ctx, 1, x, v, bound);
    for (int i = 1; i <= 4; i++)
        for (int j = 2; j <= 4; j++) {
            const int k = 3 * (i - 1) + j - 2;
            char name[64], is[64];
            r->name(r->ctx, 0, (size_t)k, name, sizeof name);
            snprintf(is, sizeof is, "contact[%d,%d]", i, j);
            assert_string_equal(name, is);
            if (i < j)
                assert_true(out[k] == j * j - i * i && bound[k] > 0);
            else
                assert_true(isnan(out[k]) && isnan(bound[k]));
        }
    for (int i = 1; i <= 3; i++) assert_true(out[12 + i - 1] == (i + 1) * (i + 1) - 7);
    act_on(r, "contact", 3 * 1 + 2, 1, x, v); /* [2,4] */
    assert_true(v[0] == 10 && v[1] == 40 && v[2] == 30 && v[3] == 20);
    assert_true(x[0] == 1 && x[1] == 5 && x[2] == 9 && x[3] == 16);
    act_on(r, "pass", 2, 1, x, v);
    assert_true(v[3] == -30 && v[2] == 30 && v[1] == 40 && v[0] == 10);
    motus_system_destroy(s);
}

/* Indices that no function reads run within each event. */
static void over_indices(void **state)
{
    (void)state;
    motus_system *s = given_text(ROW "when every 1 as kick: x[i]' = x[i]' + x[i] for i = 1..N\n"
                                     "when x[i] = 5 as row: x[j]' = i + j for i = 1..N, j = 2..3\n"
                                     "when row accumulates as end: x[i] = 0 for i = 1..N");
    const rules *r = rules_of(s);
    assert_int_equal(r->rule[0].instances, 1);
    assert_int_equal(r->rule[1].instances, 4);
    assert_int_equal(r->rule[2].instances, 4);
    double x[4] = {1, 4, 9, 16}, v[4] = {10, 20, 30, 40};
    act_on(r, "kick", 0, 1, x, v);
    for (int i = 0; i < 4; i++) assert_true(v[i] == 10 * (i + 1) + x[i]);
    act_on(r, "row", 3, 1, x, v);
    assert_true(v[0] == 11 && v[1] == 6 && v[2] == 7 && v[3] == 56);
    act_on(r, "end", 1, 1, x, v);
    assert_true(x[0] == 1 && x[1] == 0 && x[2] == 9 && x[3] == 16);
    motus_system_destroy(s);
}

static void vectors(void **state)
{
    (void)state;
    motus_system *s = given_text("r'' = (0, -1)\nr(0) = (1, 2)\nr'(0) = (3, 4)\n"
                                 "when |r| = 5 as wall: r' = r' - 2 dot(r', r)/dot(r, r) r\n"
                                 "when r.y = 0 as floor_: r'.y = -r'.y, r.x = 7");
    const rules *r = rules_of(s);
    double x[] = {3, 4}, v[] = {1, 1};
    act_on(r, "wall", 0, 0, x, v); /* r' = (1, 1) - 2 (7/25) (3, 4) */
    assert_true(fabs(v[0] - (1 - 42.0 / 25)) < 1e-15 && fabs(v[1] - (1 - 56.0 / 25)) < 1e-15);
    v[1] = -2;
    const double before = v[0];
    act_on(r, "floor_", 0, 0, x, v);
    assert_true(v[0] == before && v[1] == 2 && x[0] == 7 && x[1] == 4);
    motus_system_destroy(s);
}

/* What is not finite is not assigned, and nothing else is. */
static void not_finite(void **state)
{
    (void)state;
    motus_system *s = given_text(PAIR "when x = 1: z = 2, s = 1/(x - 1), x' = 0");
    const rules *r = rules_of(s);
    double x[] = {1, 3}, v[] = {2, 4, 5};
    bool in_v = false;
    size_t which = 99;
    assert_int_not_equal(r->act(r->ctx, 0, 0, 0, x, v, &in_v, &which), 0);
    assert_true(in_v && &v[which] == number_of(s, "s", x, v));
    assert_true(x[0] == 1 && x[1] == 3 && v[0] == 2 && v[1] == 4 && v[2] == 5);
    motus_system_destroy(s);
}

/* Parameters that are set count from then on. */
static void set(void **state)
{
    (void)state;
    motus_system *s = given_text(BALL "when y = e: y' = -e y'");
    const rules *r = rules_of(s);
    motus_error err = motus_default_error();
    const double e = 0.5;
    must(motus_system_set(s, "e", &e, 1, &err), &err, "set");
    double x = 2, v = -4, out;
    r->values(r->ctx, 0, &x, &v, &out);
    assert_true(out == 1.5);
    act_on(r, "event1", 0, 0, &x, &v);
    assert_true(v == 2);
    motus_system_destroy(s);
}

/* Ensembles follow events. */
static void ensembles(void **state)
{
    (void)state;
    motus_system *s = given_text(BALL "when y = 0: y' = -e y'");
    motus_error err = motus_default_error();
    motus_ensemble_def many = motus_default_ensemble();
    const motus_record record = {MOTUS_REDUCE_MIN, 1};
    motus_ensemble *e = NULL;
    many.method = "rk4";
    many.step = 0.1;
    many.until = 2;
    many.records = &record;
    many.record_count = 1;
    must(motus_ensemble_create(s, &many, &e, &err), &err, "ensemble");
    double lowest = -1, *results[] = {&lowest};
    must(motus_ensemble_run(e, 1, NULL, results, NULL, &err), &err, "ensemble");
    assert_true(lowest >= -1e-15);
    motus_ensemble_destroy(e);
    assert_false(motus_has_exact(s)); /* the motion ends at the first event */
    motus_system_destroy(s);
    s = given_text(BALL "when y = 0: record");
    assert_true(motus_has_exact(s));
    motus_system_destroy(s);
}

/* Modes ------------------------------------------------------------------------------------------------------------ */

#define SWITCHED                                                                                   \
    "stuck = 0\nn = 5\nlast = 2 n\nk[i] = 2 i for i = 1..3\nw = (1, 2)\n"                          \
    "y'' = if(stuck == 1, 0, -9.81) - k[2] y\ny(0) = 1 + stuck + n\ny'(0) = 0\ns' = y\ns(0) = 7\n" \
    "q = 2 stuck + n\n"                                                                            \
    "when y = 0 as bounce: n = n + 1, last = t, record\n"                                          \
    "when y > 3 as high: stuck = 1 - stuck, w = (w.y, w.x), n = q\n"                               \
    "when t = 2 as one: k[1] = k[1] + 1, w.y = 9\n"                                                \
    "when y = 2 as all: k[i] = k[i] + i for i = 1..3"

static void modes_are_positions(void **state)
{
    (void)state;
    motus_system *s = given_text(SWITCHED);
    const rules *r = rules_of(s);
    const problem *p = &s->problem;
    assert_int_equal(p->nx, 1 + 1 + 1 + 1 + 3 + 2); /* y, then the modes in the order in which events assign them */
    assert_int_equal(p->nv, p->nx + 1);
    assert_int_equal(motus_positions(s), 1); /* to the public calls, they are no state */
    assert_int_equal(motus_velocities(s), 2);
    assert_int_equal(motus_variable_count(s), 2);
    assert_int_equal(motus_initial_count(s), 3);
    double x[9], v[10], a[10] = {0};
    memcpy(x, s->x0, sizeof x);
    memcpy(v, s->v0, sizeof v);
    assert_true(x[0] == 6 && v[0] == 0 && v[9] == 7);
    static const char *const names[] = {"n", "last", "stuck", "w.x", "w.y", "k[1]", "k[2]", "k[3]"};
    const double starts[] = {5, 10, 0, 1, 2, 2, 4, 6};
    for (int i = 0; i < 8; i++) {
        double *at = number_of(s, names[i], x, v);
        assert_true(at > x && at < x + 9 && *at == starts[i] && v[at - x] == 0);
    }
    p->accel(p->ctx, 0, x, v, a);
    assert_true(a[0] == -9.81 - 4.0 * 6);
    for (int i = 1; i < 9; i++) assert_true(a[i] == 0);
    assert_true(a[9] == 6);
    /* a condition on modes alone never switches on the way */
    assert_true(p->traits.smooth && !p->traits.constant && !p->traits.affine && !p->traits.has_exact);
    double out[4];
    assert_int_equal(r->functions, 4);
    x[0] = 3.5;
    r->rates(r->ctx, 0, x, v, a, out);
    for (int i = 0; i < 4; i++) assert_true(out[i] == (i == 2 ? 1 : 0));
    motus_system_destroy(s);
}

static void modes_are_assigned(void **state)
{
    (void)state;
    motus_system *s = given_text(SWITCHED);
    const rules *r = rules_of(s);
    double x[9], v[10];
    memcpy(x, s->x0, sizeof x);
    memcpy(v, s->v0, sizeof v);
#define IS(name, value) assert_true(*number_of(s, name, x, v) == (value))
    act_on(r, "bounce", 0, 2.5, x, v);
    IS("n", 6);
    IS("last", 2.5);
    act_on(r, "high", 0, 0, x, v); /* n = q = 2 stuck + n, with the mode before the event */
    IS("stuck", 1);
    IS("n", 6);
    IS("w.x", 2);
    IS("w.y", 1);
    act_on(r, "high", 0, 0, x, v);
    IS("n", 8);
    IS("stuck", 0);
    act_on(r, "one", 0, 2, x, v);
    IS("k[1]", 3);
    IS("w.y", 9);
    act_on(r, "all", 0, 2, x, v);
    IS("k[1]", 4);
    IS("k[2]", 6);
    IS("k[3]", 9);
    assert_true(x[0] == 6 && v[9] == 7);
    for (int i = 0; i < 9; i++) assert_true(v[i] == 0);
    /* Neither the force nor an event reads n, `last` and w: what changes them alone ends no step. */
    assert_true(r->rule[0].keeps && !r->rule[0].assigns);
    assert_true(r->rule[1].assigns && !r->rule[1].keeps);
    assert_true(r->rule[2].assigns && r->rule[3].assigns);
    assert_int_equal(r->kept_count, 2);
    assert_ptr_equal(&x[r->kept[0]], number_of(s, "n", x, v));
    assert_ptr_equal(&x[r->kept[1]], number_of(s, "last", x, v));
    motus_system_destroy(s);
    /* A chain: m is read by an event's function, n by what is assigned to m; o by nothing. */
    s = given_text(BALL "m = 1\nn = 1\no = 1\nwhen y = m: o = n\nwhen y = 0: n = 2\nwhen t = 1: m = n");
    r = rules_of(s);
    assert_true(r->rule[0].keeps && r->rule[1].assigns && r->rule[2].assigns);
    assert_int_equal(r->kept_count, 1);
    motus_system_destroy(s);
}

/* Whoever reads or sets the numbers of a model meets a mode as a parameter, and as a quantity. */
static void modes_in_public(void **state)
{
    (void)state;
    const char *const set[] = {"n=7"};
    motus_system *s = given_text_with(SWITCHED, set, 1, "set");
    motus_error err = motus_default_error();
    const double one = 1, three[] = {1, 2, 3};
    assert_true(s->x0[0] == 8);
    assert_true(*number_of(s, "last", s->x0, s->v0) == 14);
    must(motus_system_set(s, "stuck", &one, 1, &err), &err, "stuck");
    must(motus_system_set(s, "k", three, 3, &err), &err, "k");
    assert_true(s->x0[0] == 9);
    assert_true(*number_of(s, "stuck", s->x0, s->v0) == 1);
    assert_true(*number_of(s, "k[3]", s->x0, s->v0) == 3);
    double x[9], v[10], out[5];
    memcpy(x, s->x0, sizeof x);
    memcpy(v, s->v0, sizeof v);
    *number_of(s, "n", x, v) = 100;
    static const char *const names[] = {"q", "n", "w.y", "k[2]", "y"};
    size_t columns[5], count;
    for (int i = 0; i < 5; i++) {
        motus_column c = motus_default_column();
        must(motus_column_find(s, names[i], &columns[i], &count, &err), &err, names[i]);
        assert_int_equal(motus_column_at(s, columns[i], &c), MOTUS_OK);
        assert_string_equal(c.name, names[i]);
        assert_int_equal(c.kind, i < 4 ? MOTUS_COLUMN_QUANTITY : MOTUS_COLUMN_POSITION);
    }
    must(system_values(s, 0, x, v, columns, 5, out, &err), &err, "values");
    assert_true(out[0] == 102 && out[1] == 100 && out[2] == 2 && out[3] == 2 && out[4] == 9);
    size_t numbers = 0;
    assert_string_equal(motus_quantity_name(s, 3, &numbers), "k");
    assert_int_equal(numbers, 3);
    int parameters = 0;
    motus_parameter p = motus_default_parameter();
    while (motus_parameter_at(s, (size_t)parameters, &p) == MOTUS_OK) parameters++;
    assert_int_equal(parameters, 5);
    motus_system_destroy(s);
}

/* A boundary line and an invariant may read modes; the invariant holds between events. */
static void modes_elsewhere(void **state)
{
    (void)state;
    motus_system *s = given_text("wall = 3\nu[i]'' = u[i-1] - 2 u[i] + u[i+1] for i = 1..2\nu[0] = wall\nu[3] = 0\n"
                                 "u[i](0) = i for i = 1..2\nu[i]'(0) = 0 for i = 1..2\n"
                                 "g = 2\ny'' = -g\ny(0) = 1\ny'(0) = 0\ninvariant E = y'^2/2 + g y\n"
                                 "when t = 1: wall = 4, g = -g");
    const problem *p = &s->problem;
    double x[8], v[8], a[8] = {0};
    memcpy(x, s->x0, p->nx * sizeof *x);
    memcpy(v, s->v0, p->nv * sizeof *v);
    *number_of(s, "wall", x, v) = 10;
    p->accel(p->ctx, 0, x, v, a);
    double *first = number_of(s, "u[1]", x, v);
    assert_true(a[first - x] == 10 - 2 * 1 + 2);
    motus_system_destroy(s);
}

/* What events keep ------------------------------------------------------------------------------------------------- */

#define KEEPING                                                                                            \
    BALL "r'' = -r\nr(0) = (1, 2)\nr'(0) = (0, 1)\ns' = y\ns(0) = 3\n"                                     \
         "n = count(bounce)\nfirst = time(bounce)\nthird = time(bounce, 3)\nlatest = time(bounce, last)\n" \
         "v2 = at(bounce, 2, y'^2 + s)\nwhere = at(bounce, last, r)\nv1 = at(bounce, y')\nagain = 2 "      \
         "time(bounce, 1)\nd(q) = at(bounce, last, q - r.x)\nd1 = d(y)\nd2 = d(s)\n"                       \
         "when y = 0 falling as bounce: y' = -y', s = 2 s, record\n"

static double quantity(motus_system *s, const char *name, double t, double *x, double *v)
{
    motus_error err = motus_default_error();
    size_t first, count;
    double out = 0;
    must(motus_column_find(s, name, &first, &count, &err), &err, name);
    must(system_values(s, t, x, v, &first, 1, &out, &err), &err, name);
    return out;
}

static void kept_numbers(void **state)
{
    (void)state;
    motus_system *s = given_text(KEEPING);
    const rules *r = rules_of(s);
    const size_t nx = s->problem.nx;
    /* count, times 1, 3 and last, v2, where, v1, d1 and d2: the same call again is the same number */
    assert_int_equal(s->problem.modes, 10);
    assert_int_equal(nx, 3 + 10);
    assert_int_equal(s->problem.nv, nx + 1);
    assert_int_equal(motus_positions(s), 3);
    double x[13], v[14], a[14] = {0};
    memcpy(x, s->x0, sizeof x);
    memcpy(v, s->v0, sizeof v);
    assert_true(*number_of(s, "s", x, v) == 3 && number_of(s, "s", x, v) == &v[nx]);
    s->problem.accel(s->problem.ctx, 0, x, v, a);
    assert_true(a[nx] == 1 && a[0] == -9.81);
    assert_true(*number_of(s, "count(bounce)", x, v) == 0 && *number_of(s, "time(bounce, 3)", x, v) == 0);
#define VALUE(name) quantity(s, name, 9, x, v)
    assert_true(VALUE("n") == 0);
    static const char *const unknown[] = {"first", "third", "latest", "v2", "where.x", "v1", "d1", "again"};
    for (size_t k = 0; k < sizeof unknown / sizeof *unknown; k++) assert_true(isnan(VALUE(unknown[k])));
    for (int event = 1; event <= 4; event++) {
        x[0] = 0.5 * event, v[0] = -event, x[1] = 10 * event, x[2] = 20 * event;
        const double before = v[nx];
        act_on(r, "bounce", 0, 100 * event, x, v);
        /* what is kept is the state on arrival */
        assert_true(v[0] == event && v[nx] == 2 * before);
        assert_true(VALUE("n") == event && VALUE("first") == 100 && VALUE("again") == 200);
        assert_true(VALUE("latest") == 100 * event && VALUE("v1") == -1);
        assert_true(VALUE("where.x") == 10 * event && VALUE("where.y") == 20 * event);
        assert_true(VALUE("d1") == -9.5 * event && VALUE("d2") == before - 10 * event);
        assert_true(event < 2 ? isnan(VALUE("v2")) : VALUE("v2") == 4 + 6);
        assert_true(event < 3 ? isnan(VALUE("third")) : VALUE("third") == 300);
    }
    assert_true(r->rule[0].assigns && !r->rule[0].keeps && r->kept_count == 0);
    motus_system_destroy(s);
}

/* Where only observers ask, an event that does nothing else ends no step; where the force does, it does. */
static void kept_for_observers(void **state)
{
    (void)state;
    motus_system *s = given_text(BALL "n = count(down)\nt2 = time(down, 2)\nwhen y = 0 as down: record");
    const rules *r = rules_of(s);
    assert_true(r->rule[0].keeps && !r->rule[0].assigns && r->rule[0].records);
    assert_int_equal(r->kept_count, 2);
    assert_int_equal(r->kept[0], 1);
    assert_int_equal(r->kept[1], 2);
    assert_true(motus_has_exact(s)); /* the motion goes on */
    motus_system_destroy(s);
    s = given_text("y'' = -count(down)\ny(0) = 1\ny'(0) = 0\nt2 = time(down, 2)\nwhen y = 0 as down: record");
    r = rules_of(s);
    assert_true(r->rule[0].assigns && !r->rule[0].keeps && !motus_has_exact(s));
    motus_system_destroy(s);
    /* an event that waits for what another has kept */
    s = given_text(BALL "when y = 0 as down: record\nwhen t = time(down, 1) + 1 as late: record");
    r = rules_of(s);
    assert_true(r->rule[0].assigns && !r->rule[1].assigns && !r->rule[1].keeps);
    double x[3] = {0, 0, 0}, v[3] = {0}, out[2];
    r->values(r->ctx, 5, x, v, out);
    assert_true(isnan(out[1]));
    act_on(r, "down", 0, 3, x, v);
    r->values(r->ctx, 5, x, v, out);
    assert_true(out[1] == 1);
    motus_system_destroy(s);
}

/* A family's events are counted together; sums in what is kept stand behind the indices of the event. */
static void kept_of_families(void **state)
{
    (void)state;
    motus_system *s = given_text(ROW "total = at(hit, last, sum(k = 1..N: x[k]))\nn = count(hit)\n"
                                     "swept = at(row, last, sum(k = 1..N: k x[k]))\n"
                                     "when x[i] = x[j] as hit: x[i] = 0 for i = 1..N, j = i+1..N\n"
                                     "when t = 1 as row: x[i] = 1 for i = 1..N");
    const rules *r = rules_of(s);
    double x[8], v[8];
    memcpy(x, s->x0, s->problem.nx * sizeof *x);
    memcpy(v, s->v0, s->problem.nv * sizeof *v);
    assert_int_equal(s->problem.modes, 4);
    act_on(r, "hit", 0, 1, x, v);     /* [1,2] */
    act_on(r, "hit", 3 + 2, 1, x, v); /* [2,4] */
    assert_true(VALUE("n") == 2 && VALUE("total") == 4 + 9 + 16);
    assert_true(x[0] == 0 && x[1] == 0 && x[2] == 9 && isnan(VALUE("swept")));
    act_on(r, "row", 0, 1, x, v);
    assert_true(VALUE("swept") == 3 * 9 + 4 * 16 && x[0] == 1 && x[3] == 1);
    motus_system_destroy(s);
}

/* Numbers on the stack where the functions that are called next have theirs, so that one which is never written is not
 * 0 by luck. */
__attribute__((noinline)) static void fill_stack(void)
{
    volatile double numbers[1 << 14];
    for (size_t k = 0; k < sizeof numbers / sizeof *numbers; k++) numbers[k] = 0.75;
}

/* A run: bounce k of a ball that falls from 1 happens at T (2 (1 - e^k)/(1 - e) - 1), T = sqrt(2/g), with the speed
 * e^(k - 1) g T. */
static void along_a_run(void **state)
{
    (void)state;
    static const struct {
        const char *method, *machine;
    } by[] = {{"rk4", "interpreter"}, {"rk4", "compiled"}, {"gauss8", "compiled"}, {"verlet", "interpreter"}};
    motus_system *s = given_text(BALL "k = 0\nc = count(bounce)\nt3 = time(bounce, 3)\nlast = time(bounce, last)\n"
                                      "v2 = at(bounce, 2, y')\nwhen y = 0 falling as bounce: y' = -e y', k = k + 1, "
                                      "record");
    for (size_t i = 0; i < sizeof by / sizeof *by; i++) {
        motus_run_def def = motus_default_run();
        motus_error err = motus_default_error();
        motus_run *run = NULL;
        def.method = by[i].method;
        def.machine = by[i].machine;
        def.step = 0.1;
        def.until = 3;
        def.error = MOTUS_BARS_NONE;
        must(motus_run_create(s, &def, &run, &err), &err, "run");
        fill_stack();
        must(motus_run_finish(run, &err), &err, "run");
        const double T = sqrt(2 / 9.81);
        static const char *const names[] = {"k", "c", "t3", "last", "v2"};
        const double expected[] = {6, 6, T * (1 + 2 * 0.8 + 2 * 0.64), T * (2 * (1 - pow(0.8, 6)) / 0.2 - 1),
                                   -0.8 * 9.81 * T};
        for (int k = 0; k < 5; k++) {
            size_t first, count;
            double value;
            must(motus_column_find(s, names[k], &first, &count, &err), &err, names[k]);
            must(motus_run_values(run, &first, 1, &value, &err), &err, names[k]);
            if (fabs(value - expected[k]) > 64 * ROUNDING * fabs(expected[k]))
                fail_msg("%s, %s: %s is %.17g, not %.17g", by[i].method, by[i].machine, names[k], value, expected[k]);
        }
        motus_run_destroy(run);
    }
    motus_system_destroy(s);
}

/* Who defines a function of the same name means that. */
static void own_words(void **state)
{
    (void)state;
    motus_system *s = given_text(BALL "count(q) = 2 q\ntime = 3\nc = count(y)\nd = time (y)\nwhen y = 0 as y0: record");
    assert_int_equal(s->problem.modes, 0);
    double x[] = {4}, v[] = {0};
    assert_true(VALUE("c") == 8 && VALUE("d") == 12);
    motus_system_destroy(s);
}

static void in_words(void **state)
{
    (void)state;
    motus_system *s =
        given_text(ROW "n = 0\ny'' = -9.81\ny(0) = 0\ny'(0) = 3\nwhen y = 0 falling as bounce: y' = -y', "
                       "n = n + 1, record\nwhen x[i] = x[j] as contact: x[i]' = 0 for i = 1..N, j = 1..N\n"
                       "when y >= 0 and t < 1: stop after 3\nwhen bounce accumulates: stop\nwhen every 1/2: "
                       "record\nc = at(bounce, 2, y)");
    const char *const lines =
        "bounce happens when y = 0, falling; it assigns y', n; it keeps 2 numbers; it is recorded\n"
        "contact happens when x[i] = x[j]; it is a family of events; it assigns x[i]'\n"
        "event3 happens when y >= 0 and t < 1 becomes true; the run stops at number 3\n"
        "event4 happens where the events of bounce accumulate; the run stops there\n"
        "event5 happens every 0.5, from the start on; it is recorded\n"
        "the state decides where an event that assigns ends a step: by a symplectic method that step is not "
        "symplectic, while those between are\n"
        "n is a mode: events assign this parameter; at the start it is 0. Neither the force nor an event depends on "
        "it\n"
        "at the start both sides of bounce are equal, which is no event\n"
        "at the start both sides of contact[1,1] are equal, which is no event\n"
        "at the start both sides of contact[2,2] are equal, which is no event\n"
        "at the start both sides of contact[3,3] are equal, which is no event\n"
        "at the start both sides of contact[4,4] are equal, which is no event\n"
        "at the start the condition of event3 holds, which is no event\n";
    assert_string_equal(motus_explain_events(s), lines);
    const double y = -1;
    motus_error err = motus_default_error();
    must(motus_system_set(s, "y(0)", &y, 1, &err), &err, "y(0)");
    assert_null(strstr(motus_explain_events(s), "bounce are equal"));
    assert_null(strstr(motus_explain_events(s), "the condition of"));
    motus_system_destroy(s);
    const double period = 3;
    s = given_text("T = 2\ny'' = 0\ny(0) = 0\ny'(0) = 1\nwhen every T as tick: record");
    assert_non_null(strstr(motus_explain_events(s), "tick happens every 2, from"));
    must(motus_system_set(s, "T", &period, 1, &err), &err, "T");
    assert_non_null(strstr(motus_explain_events(s), "tick happens every 3, from"));
    motus_system_destroy(s);
    s = given_text(BALL);
    assert_string_equal(motus_explain_events(s), "");
    motus_system_destroy(s);
    assert_string_equal(motus_explain_events(NULL), "");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_event),
        cmocka_unit_test(all_kinds),
        cmocka_unit_test(least_on_boxes),
        cmocka_unit_test(conditions),
        cmocka_unit_test(families),
        cmocka_unit_test(vectors),
        cmocka_unit_test(over_indices),
        cmocka_unit_test(not_finite),
        cmocka_unit_test(modes_are_positions),
        cmocka_unit_test(modes_are_assigned),
        cmocka_unit_test(modes_in_public),
        cmocka_unit_test(modes_elsewhere),
        cmocka_unit_test(kept_numbers),
        cmocka_unit_test(kept_for_observers),
        cmocka_unit_test(kept_of_families),
        cmocka_unit_test(own_words),
        cmocka_unit_test(along_a_run),
        cmocka_unit_test(in_words),
        cmocka_unit_test(set),
        cmocka_unit_test(ensembles),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
