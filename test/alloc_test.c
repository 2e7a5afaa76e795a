/* Out of memory at every allocation in turn: each call then succeeds or returns MOTUS_MEMORY, no memory is lost, and
 * every handle can still be destroyed. Memory runs out in two ways: only request k is refused, or request k and all
 * that follow.
 *
 * A call that succeeds in spite of a refusal must give the numbers of a run with enough memory.
 */
#include "test/ensemble_given.h"

#include <stdbool.h>

/* An allocator that counts its blocks; each is framed, so that a write beyond it is found when it is freed. */
typedef struct bank {
    int64_t requests, refuse, live;
    int forever;
    int64_t refused;
} bank;
enum { FRAME = 32 };

static void *lend(void *context, size_t bytes)
{
    bank *b = context;
    b->requests++;
    if (b->refuse && (b->forever ? b->requests >= b->refuse : b->requests == b->refuse)) {
        b->refused++;
        return NULL;
    }
    unsigned char *block = malloc(bytes + 2 * FRAME);
    if (!block) return NULL;
    memcpy(block, &bytes, sizeof bytes);
    memset(block + sizeof bytes, 0xC3, FRAME - sizeof bytes);
    memset(block + FRAME, 0x5A, bytes); /* new memory is not zero */
    memset(block + FRAME + bytes, 0xC3, FRAME);
    b->live++;
    return block + FRAME;
}

static void take_back(void *context, void *given)
{
    bank *b = context;
    if (!given) return;
    unsigned char *block = (unsigned char *)given - FRAME;
    size_t bytes;
    memcpy(&bytes, block, sizeof bytes);
    for (size_t i = sizeof bytes; i < FRAME; i++) assert_int_equal(block[i], 0xC3);
    for (size_t i = 0; i < FRAME; i++) assert_int_equal(block[FRAME + bytes + i], 0xC3);
    b->live--;
    free(block);
}

static motus_allocator hooks(bank *b) { return (motus_allocator){lend, take_back, b}; }

/* Restarts the count: request number `refuse` from now on is refused; 0: none. */
static void arm(bank *b, int64_t refuse, int forever)
{
    b->requests = 0;
    b->refuse = refuse;
    b->forever = forever;
}

static const char rich[] =
    "N = 3\ng = 9.81\nk = [1, 4, 9]\nA = [2, 1, 0.5]\nc[i] = k[i] + 0   for i = 1..N\n"
    "x[i]'' = -c[i] x[i] + x[0]   for i = 1..N\nx[0] = 0\n"
    "x[i](0) = A[i]   for i = 1..N\nx[i]'(0) = 0   for i = 1..N\nexact x[i] = A[i] cos(sqrt(k[i]) t)   for i = 1..N\n"
    "r'' = (0, -g)\nr(0) = (0, 0)\nr'(0) = (1, 4.5)\nexact r = r(0) + r'(0) t + (0, -g) t^2/2\n"
    "s' = -s\ns(0) = 1\nexact s = exp(-t)\n"
    "speed = |r'|\nmean = sum(i = 1..N: x[i])/N\npush = x[1]''\nfar[i] = x[i]^2 + x[i-1]^2   for i = 1..N\n"
    "invariant e = |r'|^2/2 + g r.y\ninvariant f = sum(i = 1..N: x[i]'^2/2 + k[i] x[i]^2/2)\n"
    "method verlet\nstep 0.05\nuntil 0.205\n";
static const char wide[] = "N = 1200\nw = 0.7\nx[i]'' = x[i+1] - 2 x[i] + x[i-1] - 0.1 x[i]' + w (x[i+1] - x[i])^3   "
                           "for i = 1..N\nx[0] = sin(t)\nx[N+1] = 0\n"
                           "x[i](0) = sin(pi i/N)   for i = 1..N\nx[i]'(0) = 0   for i = 1..N\ne = sum(i = 1..N: "
                           "x[i]'^2)\nstep 0.05\nuntil 0.205\n";
/* Ghost cells, places of families, matrices; neither step nor end. */
static const char cells[] =
    "N = 5\nk[i] = 1 for i = 1..N\nk[3] = 2\nK = [[2, -1], [-1, k[3]]]\n"
    "x[i]'' = k[i] (x[i+1] - 2 x[i] + x[i-1]) for i = 1..N\nx[0] = x[1]\nx[N+1] = cos(t) - x[N]\n"
    "x[i](0) = i for i = 1..N\nx[i]'(0) = 0 for i = 1..N\nstretch[i] = x[i+1] - x[i] for i = 0..N\n"
    "all = sum(i = 0..N: x[i+1]' - x[i]')\nr'' = -K r\nr(0) = (1, 0)\nr'(0) = (0, 0)\n";
static const char *const texts[] = {
    rich,
    wide,
    "r'' = -r/|r|^3 + 0.1 cross(r', (0, 0, 1))\nr(0) = (1, 0, 0.1)\nr'(0) = (0, 1, 0)\nstep 0.05\nuntil 0.205\n",
    "V(q, d) = q^2/2 + d q^4/4\nF(q) = -diff(V(q, k), q)\nk = 2\ny'' = F(y + sum(i = 1..2: i y)) - diff(k^2 y, k)\n"
    "y(0) = 1\ny'(0) = 0\nstep 0.05\nuntil 0.205\n",
    "y'' = -9.81 - 0.1 y' |y'|\ny(0) = 1\ny'(0) = 3\ns' = y'^2 - s\ns(0) = 0.5\nstep 0.05\nuntil 0.205\n",
    "r'' = -2 r + (sin(t), 0)\nr(0) = (1, 2)\nr'(0) = (0, 0)\nspin = r.x r'.y - r.y r'.x\nstep 0.05\nuntil 0.205\n",
    cells,
};
enum { TEXTS = sizeof texts / sizeof *texts, LARGE = 2 };

static motus_status read_text(bank *b, const char *text, motus_system **s, motus_error *err)
{
    motus_text_def def = motus_default_text();
    *err = motus_default_error();
    def.text = text;
    def.file = "given.motus";
    def.allocator = hooks(b);
    return motus_system_from_text(&def, s, err);
}

static int pull(void *context, double t, const double *x, const double *v, double *a)
{
    (void)context;
    a[0] = -x[0] - v[0] * fabs(v[0]) + cos(t);
    a[1] = -x[1] + x[0];
    a[2] = v[0] * v[1];
    return 0;
}

static int energy(void *context, double t, const double *x, const double *v, double *value)
{
    (void)context;
    (void)t;
    *value = x[0] + v[0];
    return 0;
}

static int side_by_side(void *context, size_t first, size_t count, double t, const double *x, const double *v,
                        double *a);
static bool in_blocks; /* the callback is one of blocks */

static motus_status from_callback(bank *b, motus_system **s, motus_error *err)
{
    static const double x[2] = {1, 2}, v[3] = {0, 1, 0};
    static const char *const names[] = {"a", "b", "c"};
    motus_callback_def def = motus_default_callback();
    *err = motus_default_error();
    def.positions = 2;
    def.first_order = 1;
    def.x = x;
    def.v = v;
    def.acceleration = pull;
    def.invariant = energy;
    def.names = in_blocks ? NULL : names;
    def.block = in_blocks ? side_by_side : NULL;
    def.allocator = hooks(b);
    return motus_system_from_callback(&def, s, err);
}

/* The law ---------------------------------------------------------------------------------------------------------- */

/* A test of a system; its result is a hash of all numbers that it computed. */
typedef motus_status (*attempt)(motus_system *s, const char *method, uint64_t *result, motus_error *err);

static uint64_t mix(uint64_t h, const void *bytes, size_t n)
{
    for (size_t i = 0; i < n; i++) h = (h ^ ((const unsigned char *)bytes)[i]) * 1099511628211u;
    return h;
}

static void allowed(motus_status status, const motus_error *err, const char *what, const char *method, int64_t k)
{
    if (status == MOTUS_OK) return;
    if (status != MOTUS_MEMORY)
        fail_msg("%s, %s, request %lld refused: %s: %s", what, method, (long long)k, motus_status_word(status),
                 err->message);
    assert_int_equal(err->status, MOTUS_MEMORY);
    assert_true(strlen(err->message) > 3);
}

/* Of very many requests, as in studies, which repeat themselves run after run, later ones are sampled at growing
 * distances; at larger ones under the sanitizers, which take several times as long. */
#ifdef SANITIZED
enum { CLOSE = 12 };
#else
enum { CLOSE = 64 };
#endif

/* Refuses every request of `try` in turn; each time the system is made anew with enough memory. */
static int64_t refuse_each(const char *text, const char *method, attempt try, const char *what)
{
    uint64_t whole = 0;
    int64_t requests = 0;
    for (int forever = 0; forever < 2; forever++) /* k = 0: nothing is refused; sets the expected result */
        for (int64_t k = 0;; k += 1 + k / CLOSE) {
            bank b = {0};
            motus_system *s = NULL;
            motus_error err;
            must(text ? read_text(&b, text, &s, &err) : from_callback(&b, &s, &err), &err, what);
            arm(&b, k, forever);
            err = motus_default_error();
            uint64_t result = 0;
            motus_status status = try(s, method, &result, &err);
            int64_t refused = b.refused;
            requests = b.requests;
            if (k == 0) {
                must(status, &err, what);
                whole = result;
            } else {
                allowed(status, &err, what, method, k);
                if (status == MOTUS_OK && result != whole)
                    fail_msg("%s, %s, request %lld refused: a success with other numbers", what, method, (long long)k);
            }
            arm(&b, 0, 0);
            motus_system_destroy(s);
            if (b.live)
                fail_msg("%s, %s, request %lld refused: %lld blocks lost", what, method, (long long)k,
                         (long long)b.live);
            if (k && !refused) break;
        }
    return requests;
}

/* Systems ---------------------------------------------------------------------------------------------------------- */

static void systems(void **state)
{
    (void)state;
    for (int i = 0; i <= TEXTS; i++)
        for (int forever = 0; forever < 2; forever++) {
            int64_t k = 0;
            for (int refused = 1; refused;) {
                bank b = {0};
                motus_system *s = NULL;
                motus_error err;
                arm(&b, ++k, forever);
                motus_status status = i < TEXTS ? read_text(&b, texts[i], &s, &err) : from_callback(&b, &s, &err);
                allowed(status, &err, "system", "", k);
                refused = b.refused > 0;
                if (status != MOTUS_OK)
                    assert_null(s);
                else
                    assert_int_equal(refused, 0); /* no allocation of a system may fail */
                motus_system_destroy(s);
                assert_int_equal(b.live, 0);
            }
            assert_true(k > (i < TEXTS ? 2 : 1)); /* the hooks were called */
        }
}

/* A wrong text leaks no memory either; it gives MOTUS_MEMORY or its own error. */
static void wrong_texts(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        motus_status status;
    } cases[] = {{"x'' = -y\nx(0) = 1\nx'(0) = 0", MOTUS_NAME},
                 {"x'' = (-x", MOTUS_SYNTAX},
                 {"x'' = (1, 2)\nx(0) = 1\nx'(0) = 0", MOTUS_SHAPE},
                 {"x'' = -x\nx(0) = 1\nx'(0) = 0\nexact x = sin(t)", 0}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        for (int64_t k = 1, refused = 1; refused; k++) {
            bank b = {0};
            motus_system *s = NULL;
            motus_error err;
            arm(&b, k, 1);
            motus_status status = read_text(&b, cases[i].text, &s, &err);
            refused = b.refused;
            if (status == MOTUS_OK || (status != MOTUS_MEMORY && cases[i].status && status != cases[i].status) ||
                (!refused && status == MOTUS_MEMORY))
                fail_msg("%s: %s, %s", cases[i].text, motus_status_word(status), err.message);
            assert_null(s);
            assert_int_equal(b.live, 0);
        }
}

/* Runs ------------------------------------------------------------------------------------------------------------- */

/* All operations of a run: stepping, reading every column, dense output, save, restore, and a shorter last step. */
static motus_status travel(motus_system *s, const char *method, uint64_t *result, motus_error *err)
{
    motus_run_def def = motus_default_run();
    motus_run *r = NULL;
    size_t count = motus_column_count(s), nx = motus_positions(s), nv = motus_velocities(s),
           *columns = malloc(count * sizeof *columns);
    double *out = malloc(count * sizeof *out), *y = malloc((nx + nv) * sizeof *y), times[2] = {0.033, 0.05};
    char *kept = NULL;
    size_t length = 0, length_traced = 0;
    const char *text = NULL;
    uint64_t h = 1;
    assert_true(columns && out && y);
    for (size_t k = 0; k < count; k++) columns[k] = k;
    def.method = method;
    given_step(&def, 0.025);
    def.until = strcmp(method, "verlet-literal") ? 0.205 : 0.2;
    def.switches = MOTUS_SWITCHES_STEP; /* a step that ends at a switch cannot be traced */
    motus_status status = motus_run_create(s, &def, &r, err);
    if (status != MOTUS_OK) assert_null(r);
    if (status == MOTUS_OK) status = motus_run_step(r, 1, err);
    for (int i = 0; i < 2 && status == MOTUS_OK; i++) {
        status = motus_run_sample(r, &times[i], 1, columns, count, out, err);
        h = mix(h, out, status == MOTUS_OK ? count * sizeof *out : 0);
    }
    if (status == MOTUS_OK) status = motus_run_save(r, &text, &length, err);
    if (status == MOTUS_OK) {
        h = mix(h, text, length);
        kept = malloc(length + 1);
        assert_non_null(kept);
        memcpy(kept, text, length + 1);
        const motus_trace_entry *const *e;
        status = motus_run_trace(r, &e, &length_traced, err);
        for (size_t k = 0; k < length_traced; k++) {
            h = mix(mix(mix(h, &e[k]->kind, sizeof e[k]->kind), e[k]->x, nx * sizeof(double)), e[k]->v,
                    nv * sizeof(double));
            h = mix(h, e[k]->a, e[k]->a ? nv * sizeof(double) : 0);
        }
    }
    if (status == MOTUS_OK) status = motus_run_restore(r, kept, length, err);
    if (status == MOTUS_OK) status = motus_run_finish(r, err);
    if (status == MOTUS_OK) status = motus_run_values(r, columns, count, out, err);
    if (status == MOTUS_OK) h = mix(h, out, count * sizeof *out);
    if (status == MOTUS_OK) status = motus_run_state(r, y, y + nx, err);
    if (status == MOTUS_OK) h = mix(h, y, (nx + nv) * sizeof *y);
    double *derivatives = malloc((nx + nv) * nv * sizeof *derivatives);
    assert_non_null(derivatives);
    if (status == MOTUS_OK && nv <= MOTUS_JACOBIAN_MAX) {
        status = motus_run_jacobian(r, derivatives, derivatives + nx * nv, err);
        h = mix(h, derivatives, status == MOTUS_OK ? (nx + nv) * nv * sizeof *derivatives : 0);
    }
    free(derivatives);
    *result = h;
    motus_run_destroy(r);
    free(kept);
    free(columns);
    free(out);
    free(y);
    return status;
}

/* A run with bars of error: sampled, finished, asked for them. */
static motus_status barred(motus_system *s, const char *method, uint64_t *result, motus_error *err)
{
    motus_run_def def = motus_default_run();
    motus_estimate estimate = motus_default_estimate();
    motus_run *r = NULL;
    const size_t count = motus_column_count(s);
    size_t *columns = malloc(count * sizeof *columns);
    double *values = malloc(2 * count * sizeof *values);
    const double time = 0.06;
    assert_true(columns && values);
    for (size_t k = 0; k < count; k++) columns[k] = k;
    def.method = method;
    def.step = 0.025;
    def.until = 0.2;
    def.error = MOTUS_BARS_FULL;
    motus_status status = motus_run_create(s, &def, &r, err);
    if (status == MOTUS_OK) status = motus_run_sample_errors(r, &time, 1, columns, count, values, values + count, err);
    if (status == MOTUS_OK) *result = mix(1, values, 2 * count * sizeof *values);
    if (status == MOTUS_OK) status = motus_run_finish(r, err);
    if (status == MOTUS_OK) status = motus_run_errors(r, columns, count, values, values + count, err);
    if (status == MOTUS_OK) *result = mix(*result, values, 2 * count * sizeof *values);
    if (status == MOTUS_OK) status = motus_run_estimate(r, &estimate, err);
    if (status == MOTUS_OK) assert_string_equal(estimate.reason, "");
    motus_run_destroy(r);
    free(columns);
    free(values);
    return status;
}

static void bars(void **state)
{
    (void)state;
    for (int i = 0; i <= TEXTS; i++) {
        const char *text = i < TEXTS ? texts[i] : NULL;
        assert_true(refuse_each(text, "verlet", barred, "bars") >= 8);
        if (!strcmp(text ? text : "", rich)) refuse_each(text, "exact", barred, "bars");
        if (i >= LARGE) refuse_each(text, "gauss6", barred, "bars");
    }
}

static void runs(void **state)
{
    (void)state;
    for (int i = 0; i <= TEXTS; i++) {
        const char *text = i < TEXTS ? texts[i] : NULL;
        bank b = {0};
        motus_system *s = NULL;
        motus_error err;
        must(text ? read_text(&b, text, &s, &err) : from_callback(&b, &s, &err), &err, "system");
        int admitted = 0;
        for (size_t k = 0; k < motus_method_count(); k++) {
            const char *method = motus_method_at(k)->name;
            if (motus_method_admits(s, method, NULL) != MOTUS_OK) continue;
            /* Large models, by a method of each family. */
            if (i < LARGE && strcmp(method, "verlet") && strcmp(method, "rk4") && strcmp(method, "gauss6") &&
                strcmp(method, "newmark") && strcmp(method, "exact"))
                continue;
            assert_true(refuse_each(text, method, travel, "run") >= 3);
            admitted++;
        }
        assert_true(admitted > (i < LARGE ? 3 : 8));
        motus_system_destroy(s);
        assert_int_equal(b.live, 0);
    }
}

/* A run whose steps end at switches, and resolve the force. */
static motus_status across(motus_system *s, const char *method, uint64_t *result, motus_error *err)
{
    motus_run_def def = motus_default_run();
    motus_run *r = NULL;
    def.method = method;
    def.switches = MOTUS_SWITCHES_RESOLVE;
    motus_status status = motus_run_create(s, &def, &r, err);
    if (status == MOTUS_OK) status = motus_run_finish(r, err);
    double x[3];
    if (status == MOTUS_OK) status = motus_run_state(r, x, NULL, err);
    if (status == MOTUS_OK) *result = mix(*result, x, sizeof *x);
    motus_run_destroy(r);
    return status;
}

static void runs_across_switches(void **state)
{
    (void)state;
    static const char *const kinked[] = {
        "x'' = -x - |x| x + if(t > 1.03, 1, 0) + exp(-x^2)\nx(0) = 1\nx'(0) = 0\nstep 0.2\nuntil 3\n",
        "x[i]'' = -x[i] - max(0, x[i] - x[i-1])   for i = 1..3\nx[0] = mod(t, 0.7)\nx[i](0) = i/3   for i = 1..3\n"
        "x[i]'(0) = 0   for i = 1..3\nstep 0.1\nuntil 2\n"};
    static const char *const methods[] = {"rk4", "gauss4", "verlet"};
    for (size_t i = 0; i < sizeof kinked / sizeof *kinked; i++)
        for (size_t k = 0; k < sizeof methods / sizeof *methods; k++)
            assert_true(refuse_each(kinked[i], methods[k], across, "run across switches") >= 3);
}

/* Whether a method is admitted may depend on sampled derivatives, which need memory; out of memory, the method must
 * not be refused. */
static motus_status admit(motus_system *s, const char *method, uint64_t *result, motus_error *err)
{
    *result = 1;
    return motus_method_admits(s, method, err);
}

/* Out of memory, what a parameter decides is "unknown"; all else about it needs no memory. */
static motus_status settings(motus_system *s, const char *method, uint64_t *result, motus_error *err)
{
    (void)method;
    *result = 1;
    for (size_t k = 0; k < motus_parameter_count(s); k++) {
        motus_parameter p = motus_default_parameter();
        assert_int_equal(motus_parameter_at(s, k, &p), MOTUS_OK);
        if (p.decides && !strcmp(p.decides, "unknown")) {
            *err = (motus_error){.status = MOTUS_MEMORY, .message = "unknown"};
            return MOTUS_MEMORY;
        }
        *result = mix(*result, p.decides ? p.decides : "", p.decides ? strlen(p.decides) : 0);
        double *values = malloc(p.count * sizeof *values);
        assert_non_null(values);
        assert_int_equal(motus_parameter_values(s, k, values), MOTUS_OK);
        *result = mix(*result, values, p.count * sizeof *values);
        free(values);
    }
    return MOTUS_OK;
}

static void what_may_be_set(void **state)
{
    (void)state;
    assert_true(refuse_each(rich, "", settings, "parameters") >= 4); /* one for each */
    refuse_each(wide, "", settings, "parameters");
}

/* Numbers set twice, and a clone that has them; out of memory the numbers stay unchanged. */
static motus_status set(motus_system *s, const char *method, uint64_t *result, motus_error *err)
{
    (void)method;
    static const double g[] = {1.5, 2.5}, k[][3] = {{1, 2, 3}, {4, 9, 16}};
    motus_system *clone = NULL;
    motus_status status = MOTUS_OK;
    for (int n = 0; n < 2 && status == MOTUS_OK; n++) {
        double before[3], now[3];
        assert_int_equal(motus_parameter_values(s, 2, before), MOTUS_OK);
        status = motus_system_set(s, "g", &g[n], 1, err);
        if (status == MOTUS_OK) status = motus_system_set(s, "k", k[n], 3, err);
        assert_int_equal(motus_parameter_values(s, 2, now), MOTUS_OK);
        assert_memory_equal(now, status == MOTUS_OK ? k[n] : before, sizeof now);
    }
    if (status == MOTUS_OK) status = motus_system_clone(s, &clone, err);
    *result = 1;
    for (size_t i = 0; status == MOTUS_OK && i < motus_parameter_count(s); i++) {
        double values[2][8];
        assert_int_equal(motus_parameter_values(s, i, values[0]), MOTUS_OK);
        assert_int_equal(motus_parameter_values(clone, i, values[1]), MOTUS_OK);
        *result = mix(*result, values[0], (i == 0 || i == 1 ? 1 : 3) * sizeof(double));
        assert_memory_equal(values[0], values[1], (i == 0 || i == 1 ? 1 : 3) * sizeof(double));
    }
    assert_true((status == MOTUS_OK) == (clone != NULL));
    motus_system_destroy(clone);
    return status;
}

static void setting(void **state)
{
    (void)state;
    assert_true(refuse_each(rich, "", set, "set") > 10);
}

static void admission(void **state)
{
    (void)state;
    assert_true(refuse_each(texts[2], "boris", admit, "admission") > 0);
}

/* Words and studies ------------------------------------------------------------------------------------------------ */

static motus_status explain(motus_system *s, const char *method, uint64_t *result, motus_error *err)
{
    (void)method;
    (void)err;
    const char *words = motus_explain(s), *equation = motus_equation_text(s, 0);
    assert_non_null(words);
    /* A text has no status: it is complete, or empty. */
    *result = mix(1, words, strlen(words));
    if (equation) *result = mix(*result, equation, strlen(equation));
    if (words[0] && equation) return MOTUS_OK;
    *err = (motus_error){.status = MOTUS_MEMORY, .message = "no words"};
    return MOTUS_MEMORY;
}

static void explanations(void **state)
{
    (void)state;
    for (int i = 0; i < TEXTS; i++) refuse_each(texts[i], "", explain, "explain");
}

/* All statements as MathML; one may succeed after another ran out of memory. */
static motus_status typeset(motus_system *s, const char *method, uint64_t *result, motus_error *err)
{
    (void)method;
    bool lost = false;
    *result = 1;
    for (size_t k = 0; k < motus_statement_count(s); k++) {
        const char *text = motus_statement_mathml(s, k);
        lost |= !text;
        *result = text ? mix(*result, text, strlen(text)) : *result;
    }
    if (!lost) return MOTUS_OK;
    *err = (motus_error){.status = MOTUS_MEMORY, .message = "not typeset"};
    return MOTUS_MEMORY;
}

static void statements(void **state)
{
    (void)state;
    for (int i = 0; i < TEXTS; i++) assert_true(refuse_each(texts[i], "", typeset, "typeset") > 8);
}

static motus_status suggested(motus_system *s, const char *method, uint64_t *result, motus_error *err)
{
    motus_run_def def = motus_default_run();
    motus_run *r = NULL;
    def.method = method;
    const motus_status status = motus_run_create(s, &def, &r, err);
    if (status != MOTUS_OK) assert_null(r);
    const double numbers[] = {motus_run_now(r).step, (double)motus_run_now(r).steps_total};
    *result = mix(1, numbers, status == MOTUS_OK ? sizeof numbers : 0);
    motus_run_destroy(r);
    return status;
}

static void suggestions(void **state)
{
    (void)state;
    assert_true(refuse_each(cells, "verlet", suggested, "suggest") > 10);
}

static motus_status compare(motus_system *s, const char *methods, uint64_t *result, motus_error *err)
{
    motus_comparison *c = NULL;
    motus_study_def def = motus_default_study();
    const char *names[] = {"verlet", "rk4", "gauss4"};
    (void)methods;
    def.methods = names;
    def.method_count = 3;
    def.step = 0.02;
    def.until = 0.2;
    motus_status status = motus_compare(s, &def, &c, err);
    if (status != MOTUS_OK) assert_null(c);
    *result = 1;
    for (size_t i = 0; status == MOTUS_OK && i < c->row_count; i++) {
        assert_int_equal(c->rows[i]->status, MOTUS_OK);
        *result = mix(*result, &c->rows[i]->error_final_x, sizeof(double));
        *result = mix(*result, &c->rows[i]->reversal, sizeof(double));
    }
    motus_comparison_destroy(c);
    return status;
}

static motus_status converge(motus_system *s, const char *methods, uint64_t *result, motus_error *err)
{
    motus_convergence *c = NULL;
    motus_study_def def = motus_default_study();
    const char *names[] = {"verlet", "rk4"};
    (void)methods;
    def.methods = names;
    def.method_count = 2;
    def.step = 0.05;
    def.until = 0.2;
    motus_status status = motus_converge(s, &def, &c, err);
    if (status != MOTUS_OK) assert_null(c);
    *result = 1;
    for (size_t i = 0; status == MOTUS_OK && i < c->row_count; i++)
        *result = mix(*result, &c->rows[i]->observed, sizeof(double));
    motus_convergence_destroy(c);
    return status;
}

static void studies(void **state)
{
    (void)state;
    assert_true(refuse_each(rich, "", compare, "compare") > 10);
    assert_true(refuse_each(texts[3], "", compare, "compare") > 10);
    assert_true(refuse_each(NULL, "", compare, "compare") > 10);
    assert_true(refuse_each(texts[3], "", converge, "converge") > 10);
}

/* Ensembles -------------------------------------------------------------------------------------------------------- */

static bool with_events; /* of the ensemble: their tables are kept */

/* By the method "machine method": creates, runs twice, hashes all records, or tables. */
static motus_status flock(motus_system *s, const char *how, uint64_t *result, motus_error *err)
{
    enum { COUNT = 5 };
    motus_ensemble_def def = motus_default_ensemble();
    motus_ensemble *e = NULL;
    motus_column c = motus_default_column();
    const size_t columns = motus_column_count(s);
    motus_record *records = malloc(columns * sizeof *records);
    double first[COUNT] = {1, 2, 3, INFINITY, 5}, second[COUNT] = {0.1, 0.2, 0.3, 0.4, 0.5}, stopped[COUNT],
           *room = malloc(columns * COUNT * sizeof *room);
    double **at = malloc(columns * sizeof *at);
    const double *values[] = {first, second};
    const char *names[2], *method = strchr(how, ' ') + 1;
    char machine[20], name[sizeof c.name + 4];
    assert_true(records && room && at);
    snprintf(machine, sizeof machine, "%.*s", (int)(method - how - 1), how);
    assert_int_equal(motus_column_at(s, 1, &c), MOTUS_OK);
    snprintf(name, sizeof name, "%s(0)", c.name);
    names[0] = name;
    names[1] = motus_invariant_count(s) > 1 ? "g" : "w";
    for (size_t k = 0; k < columns; k++) {
        records[def.record_count] = (motus_record){with_events ? MOTUS_REDUCE_FINAL : (motus_reduction)(k % 6), k};
        at[k] = room + k * COUNT;
        def.record_count += motus_column_at(s, k, &c) == MOTUS_OK && c.kind != MOTUS_COLUMN_EXACT;
    }
    def.vary = names;
    def.vary_count = strstr(machine, "callback") ? 1 : 2;
    def.records = records;
    def.method = method;
    if (!with_events) def.step = 0.05;
    def.until = 0.205;
    def.every = 2;
    def.threads = 2;
    def.machine = strstr(machine, "callback") ? NULL : machine;
    def.events = with_events;
    uint64_t h = 1;
    motus_status status = motus_ensemble_create(s, &def, &e, err);
    if (status != MOTUS_OK) assert_null(e);
    for (int round = 0; round < 2 && status == MOTUS_OK; round++) {
        status = motus_ensemble_run(e, COUNT, values, at, stopped, err);
        for (size_t k = 0; status == MOTUS_OK && k < def.record_count * COUNT; k++)
            h = isnan(room[k]) ? mix(h, "nan", 3) : mix(h, &room[k], sizeof(double));
        for (size_t k = 0; status == MOTUS_OK && k < COUNT; k++) {
            const int64_t rows = motus_ensemble_events(e, k);
            assert_true(!with_events || (rows > 0) == (k != 3)); /* one begins at infinity */
            h = mix(h, &rows, sizeof rows);
        }
    }
    *result = h;
    motus_ensemble_destroy(e);
    free(records);
    free(room);
    free(at);
    return status;
}

static int side_by_side(void *context, size_t first, size_t count, double t, const double *x, const double *v,
                        double *a)
{
    (void)context;
    (void)first;
    for (size_t j = 0; j < count; j++) {
        a[j] = -x[j] - v[j] * fabs(v[j]) + cos(t);
        a[count + j] = -x[count + j] + x[j];
        a[2 * count + j] = v[j] * v[count + j];
    }
    return 0;
}

static void ensembles(void **state)
{
    (void)state;
    static const char short_wide[] =
        "N = 12\nw = 0.7\nx[i]'' = x[i+1] - 2 x[i] + x[i-1] - 0.1 x[i]' + w (x[i+1] - x[i])^3   for i = 1..N\nx[0] = "
        "sin(t)\nx[N+1] = 0\n"
        "x[i](0) = sin(pi i/N)   for i = 1..N\nx[i]'(0) = 0   for i = 1..N\ne = sum(i = 1..N: x[i]'^2)\n";
    assert_true(refuse_each(short_wide, "interpreter rk4", flock, "ensemble") > 10);
    assert_true(refuse_each(rich, "interpreter gauss4", flock, "ensemble") > 10);
    assert_true(refuse_each(rich, "compiled rk4", flock, "ensemble in lanes") > 10);
    assert_true(refuse_each(short_wide, "compiled rk4", flock, "ensemble in lanes") > 10);
    assert_true(refuse_each(rich, "compiled gauss4", flock, "compiled ensemble") > 10);
    assert_true(refuse_each(NULL, "callback rk4", flock, "ensemble of a callback") > 5);
    in_blocks = true;
    assert_true(refuse_each(NULL, "callback rk4", flock, "ensemble of blocks") > 5);
    in_blocks = false;
    with_events = true;
    assert_true(refuse_each("w = 0.7\nx'' = -90000 w x\nx(0) = 1\nx'(0) = 0\nn = 0\nwhen x = 0: record\n"
                            "when x' = 0 rising as turn: n = n + 1, x' = 0.9 x', record\n",
                            "compiled dop853", flock, "events in lanes") > 10);
    with_events = false;
}

/* Without hooks the library uses malloc; with `allocate` alone it frees nothing. */
static void *from_pool(void *context, size_t bytes)
{
    static _Alignas(64) unsigned char pool[1 << 20];
    size_t *used = context, at = (*used + 63) / 64 * 64;
    if (bytes > sizeof pool - at) return NULL;
    *used = at + bytes;
    return pool + at;
}

static void a_pool_without_release(void **state)
{
    (void)state;
    size_t used = 0;
    motus_text_def def = motus_default_text();
    motus_error err = motus_default_error();
    motus_system *s = NULL;
    def.text = texts[3];
    def.allocator = (motus_allocator){from_pool, NULL, &used};
    must(motus_system_from_text(&def, &s, &err), &err, "pool");
    const motus_allocator *own = motus_system_allocator(s);
    assert_true(own && own->allocate == from_pool && !own->release && own->context == &used);
    assert_null(motus_system_allocator(NULL));
    uint64_t result;
    must(travel(s, "gauss6", &result, &err), &err, "pool");
    assert_true(used > 1000);
    motus_system_destroy(s);
}

/* A system is destroyed before its users: their numbers are the same, and its memory goes with the last one. */
static void systems_destroyed_first(void **state)
{
    (void)state;
    for (int first = 0; first < 2; first++) {
        static double due[3];
        bank b = {0};
        motus_error err;
        motus_system *s = NULL;
        must(read_text(&b, "c = 0.1\nx'' = -x - c sign(x')\nx(0) = 1\nx'(0) = 0\nuntil 4\n", &s, &err), &err, "text");
        motus_run_def def = motus_default_run();
        def.method = "dopri5", def.tolerance = 1e-6, def.error = MOTUS_BARS_CHEAP;
        motus_ensemble_def flock = motus_default_ensemble();
        static const char *const vary[] = {"c"};
        const motus_record record = {MOTUS_REDUCE_FINAL, 1};
        flock.vary = vary, flock.vary_count = 1, flock.records = &record, flock.record_count = 1;
        flock.method = "dopri5", flock.tolerance = 1e-6, flock.error = MOTUS_BARS_CHEAP, flock.machine = "interpreter";
        motus_run *r = NULL;
        motus_ensemble *e = NULL;
        motus_reference *known = NULL;
        must(motus_run_create(s, &def, &r, &err), &err, "run");
        must(motus_ensemble_create(s, &flock, &e, &err), &err, "ensemble");
        must(motus_reference_create(s, NULL, &known, &err), &err, "reference");
        if (first) {
            const int64_t live = b.live;
            motus_system_destroy(s);
            assert_int_equal(b.live, live);
        }
        const double c[] = {0.1, 0.2}, *values[] = {c}, end = 4;
        double x, bar, final[2], bars[2], *results[] = {final}, *errors[] = {bars};
        const size_t column = 1;
        must(motus_run_finish(r, &err), &err, "run");
        must(motus_run_errors(r, &column, 1, &x, &bar, &err), &err, "bars");
        must(motus_reference_at(known, &end, 1, &x, NULL, &err), &err, "reference");
        motus_run_destroy(r);
        must(motus_ensemble_run_errors(e, 2, values, results, errors, NULL, &err), &err, "ensemble");
        motus_ensemble_destroy(e);
        const double got[] = {x, bar, final[1]};
        if (first) assert_memory_equal(got, due, sizeof due);
        memcpy(due, got, sizeof due);
        motus_reference_destroy(known);
        if (!first) motus_system_destroy(s);
        assert_int_equal(b.live, 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(systems),
        cmocka_unit_test(wrong_texts),
        cmocka_unit_test(runs),
        cmocka_unit_test(bars),
        cmocka_unit_test(runs_across_switches),
        cmocka_unit_test(admission),
        cmocka_unit_test(what_may_be_set),
        cmocka_unit_test(setting),
        cmocka_unit_test(explanations),
        cmocka_unit_test(statements),
        cmocka_unit_test(suggestions),
        cmocka_unit_test(studies),
        cmocka_unit_test(a_pool_without_release),
        cmocka_unit_test(systems_destroyed_first),
        cmocka_unit_test(ensembles),
    };
    open_cache();
    int failed = cmocka_run_group_tests_name("memory that runs out", tests, NULL, NULL);
    close_cache();
    return failed;
}
