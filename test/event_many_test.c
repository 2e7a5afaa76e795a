/* Many rules at once are followed as each alone: the same events, in the order of their times, though of many functions
 * only those are evaluated that may be 0 in an instant. */
#include "api/system/system.h"
#include "given.h"

enum { EVENTS = 60, PLACES = 24 }; /* more than 16 functions are evaluated one by one */

#define MOTION                                                                                                        \
    "x'' = -x - 0.3 x^3 + 0.1 cos(1.3 t)\ny'' = -1.7 y + 0.1 x\nx(0) = 1\nx'(0) = 0.1\ny(0) = 0.2\ny'(0) = 0.9\nk = " \
    "0\nuntil 12\n"

static const char *const methods[] = {"dop853", "taylor", "rk4"};

/* What rule number k waits for; every third one happens together with the one before it. */
static void rule_text(char *out, size_t size, int k)
{
    static const char *const of[] = {"x = %g", "x' y = %g rising", "sqrt(1 + (x - y)^2) > %g", "x > %g and y < 0.4",
                                     "%g = y"};
    const int twin = k % 3 == 2 ? k - 1 : k, place = twin % PLACES;
    char when[96];
    snprintf(when, sizeof when, of[twin % 5], twin % 5 == 2 ? 1.02 + 0.02 * place : -0.9 + 0.071 * place);
    snprintf(out, size, "when %s as e%d: %srecord\n", when, k, k % 7 == 3 ? "k = k + 1, " : "");
}

static motus_run *run_of(const char *text, const char *method, motus_system **s)
{
    motus_error err = motus_default_error();
    motus_run_def def = motus_default_run();
    motus_run *r = NULL;
    *s = given_text(text);
    def.method = method;
    if (!strcmp(method, "rk4")) def.step = 0.05;
    def.error = MOTUS_BARS_NONE;
    must(motus_run_create(*s, &def, &r, &err), &err, method);
    must(motus_run_finish(r, &err), &err, text);
    return r;
}

static motus_event_row row_of(motus_run *r, int64_t k)
{
    motus_event_row e = motus_default_event_row();
    assert_int_equal(motus_run_event(r, k, &e), MOTUS_OK);
    return e;
}

/* The events of the rule named so are those of the run in which it is alone. */
static int64_t same(motus_run *all, motus_run *one, const char *name)
{
    int64_t seen = 0;
    for (int64_t k = 0; k < motus_run_events(all); k++) {
        const motus_event_row e = row_of(all, k);
        if (strcmp(e.name, name)) continue;
        assert_true(seen < motus_run_events(one));
        if (!(fabs(row_of(one, seen).time - e.time) <= 1e-13)) /* other products are fused */
            fail_msg("%s: %.17g and alone %.17g", name, e.time, row_of(one, seen).time);
        seen++;
    }
    assert_int_equal(seen, motus_run_events(one));
    return seen;
}

static void as_each_alone(void **state)
{
    (void)state;
    static char all[EVENTS * 128 + sizeof MOTION];
    for (size_t m = 0; m < sizeof methods / sizeof *methods; m++) {
        motus_system *s, *own;
        int64_t count = 0;
        size_t at = (size_t)snprintf(all, sizeof all, "%s", MOTION);
        for (int k = 0; k < EVENTS; k++) {
            rule_text(all + at, sizeof all - at, k);
            at += strlen(all + at);
        }
        motus_run *r = run_of(all, methods[m], &s);
        for (int64_t k = 1; k < motus_run_events(r); k++) assert_true(row_of(r, k).time >= row_of(r, k - 1).time);
        for (int k = 0; k < EVENTS; k++) {
            char text[sizeof MOTION + 128], name[16];
            snprintf(name, sizeof name, "e%d", k);
            const int head = snprintf(text, sizeof text, "%s", MOTION);
            rule_text(text + head, sizeof text - (size_t)head, k);
            motus_run *one = run_of(text, methods[m], &own);
            count += same(r, one, name);
            motus_run_destroy(one);
            motus_system_destroy(own);
        }
        assert_int_equal(count, motus_run_events(r));
        assert_true(count > 2 * EVENTS);
        motus_run_destroy(r);
        motus_system_destroy(s);
    }
}

/* One function alone has the bits that it has among all, also where cells of a family have no rule. */
static void the_same_bits(void **state)
{
    (void)state;
    enum { N = 9, MOST = 256 };
    motus_error err = motus_default_error();
    motus_system *s =
        given_text("N = 9\nq = 0.7\nz[i]'' = -(1 + 0.1 i) z[i] for i = 1..N\nz[i](0) = 0.1 i for i = 1..N\n"
                   "z[i]'(0) = 1 for i = 1..N\nwhen z[i] z[i] + q z[i]^3 = exp(-z[i]') as a: record for i = 1..N\n"
                   "when every 0.5: record\n"
                   "when z[i] z[i] > z[j] + i t/7 and z[i]' < j as b: record for i = 1..N-1, j = i+1..N\n");
    const rules *r = NULL;
    double x[N], v[N], a[N] = {0}, all[RULE_NUMBERS][MOST];
    must(system_rules(s, &r, &err), &err, "rules");
    assert_true(r->alone && r->functions <= MOST);
    for (int k = 0; k < N; k++) x[k] = sin(k + 0.3), v[k] = cos(2 * k + 0.1), a[k] = sin(3 * k);
    r->values(r->ctx, 0.37, x, v, all[RULE_VALUE]);
    r->rates(r->ctx, 0.37, x, v, a, all[RULE_RATE]);
    r->rounding(r->ctx, 0.37, x, v, all[RULE_ROUNDING]);
    for (int what = 0; what < RULE_NUMBERS; what++)
        for (size_t f = 0; f < r->functions; f++) {
            const double one = r->alone(r->ctx, (rule_number)what, f, 0.37, x, v, a), other = all[what][f];
            if (isnan(one) && isnan(other)) continue;
            if (memcmp(&one, &other, sizeof one)) fail_msg("%d of %zu: %.17g, not %.17g", what, f, one, other);
        }
    motus_system_destroy(s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(the_same_bits), cmocka_unit_test(as_each_alone)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
