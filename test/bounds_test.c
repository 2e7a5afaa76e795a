/* A model is untrusted input: for any bytes the library answers with bounded work and memory; an allocation that fails
 * anywhere is an error, never a crash or a leak.
 *
 * Invariant: the allocation hooks count every block of the library; after destroy there are none.
 */
#include "test/given.h"
#include "test/share.h"

#include <stdbool.h>

/* ---- counted memory ---- */

typedef struct ledger {
    size_t blocks, bytes, peak, total;
    long calls, fail_at; /* fail_at: the call that fails, 0: none */
    bool fail_after;     /* and all after it */
    size_t limit;        /* bytes; 0: none */
} ledger;

enum { HEADER = 32 };

static void *take_counted(void *context, size_t bytes)
{
    ledger *l = context;
    l->calls++;
    if (l->fail_at && (l->fail_after ? l->calls >= l->fail_at : l->calls == l->fail_at)) return NULL;
    if (l->limit && l->bytes + bytes > l->limit) return NULL;
    char *p = bytes < SIZE_MAX - HEADER ? malloc(bytes + HEADER) : NULL;
    if (!p) return NULL;
    memcpy(p, &bytes, sizeof bytes);
    l->blocks++;
    l->bytes += bytes;
    l->total += bytes;
    l->peak = l->bytes > l->peak ? l->bytes : l->peak;
    return p + HEADER;
}

static void release_counted(void *context, void *block)
{
    ledger *l = context;
    size_t bytes;
    if (!block) return;
    memcpy(&bytes, (char *)block - HEADER, sizeof bytes);
    l->blocks--;
    l->bytes -= bytes;
    free((char *)block - HEADER);
}

#ifdef SANITIZED
enum { FEWER = 10 }; /* sanitized builds are slow, and smaller numbers test the same */
#else
enum { FEWER = 1 };
#endif

/* ---- generated texts ---- */

typedef struct text {
    char *bytes;
    size_t length, room;
} text;

static text make(size_t room)
{
    text t = {malloc(room + 1), 0, room};
    assert_non_null(t.bytes);
    return t;
}

__attribute__((format(printf, 2, 3))) static void say(text *t, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    int n = vsnprintf(t->bytes + t->length, t->room - t->length, format, list);
    va_end(list);
    assert_true(n >= 0 && t->length + (size_t)n < t->room);
    t->length += (size_t)n;
}

enum { CALLS_MAX = 20000000 }; /* the most that a limit of the language lets a text of 1 kB cause is 1.25e7 */

/* Reads, explains, runs three steps; checks the answer, the memory, and the work, as the bytes that are asked for in
 * all and how often. Frees the text. */
static void answer(text t, const char *what, motus_status expected, const char *named, size_t megabytes)
{
    ledger l = {.limit = (size_t)3 << 30};
    motus_text_def def = motus_default_text();
    motus_error err = motus_default_error();
    motus_system *s = NULL;
    def.text = t.bytes;
    def.length = t.length;
    def.allocator = (motus_allocator){take_counted, release_counted, &l};
    motus_status status = motus_system_from_text(&def, &s, &err);
    if (status == MOTUS_OK) {
        motus_run *r = NULL;
        motus_run_def run = motus_default_run();
        motus_settings settings = motus_default_settings();
        motus_settings_of(s, &settings);
        run.step = 1e-3;
        run.until = settings.from + 1;
        run.method = "rk4";
        run.machine = "interpreter";
        (void)motus_explain(s);
        (void)motus_equation_text(s, 0);
        status = motus_run_create(s, &run, &r, &err);
        if (status == MOTUS_OK) status = motus_run_step(r, 3, &err);
        motus_run_destroy(r);
    }
    motus_system_destroy(s);
    free(t.bytes);
    print_message("%s: %s, %zu MB, in all %zu MB by %ld calls%s%s\n", what, motus_status_word(status), l.peak >> 20,
                  l.total >> 20, l.calls, status ? ": " : "", status ? err.message : "");
    if (status != expected || (status != MOTUS_OK && !strstr(err.message, named)))
        fail_msg("%s: %s: %s", what, motus_status_word(status), err.message);
    if (l.total > 2 * megabytes << 20) fail_msg("%s asks for %zu MB in all", what, l.total >> 20);
    if (l.calls > CALLS_MAX) fail_msg("%s allocates %ld times", what, l.calls);
    if (l.peak > megabytes << 20) fail_msg("%s takes %zu MB, not %zu", what, l.peak >> 20, megabytes);
    assert_int_equal(l.blocks, 0);
}

static const char start[] = "\nx(0) = 1\nx'(0) = 0\n";

static uint32_t state = 12345;
static uint32_t chance(void) { return state = state * 1664525u + 1013904223u, state >> 8; }

static void random_bytes(void **unused)
{
    (void)unused;
    for (int kind = 0; kind < 3; kind++) {
        text t = make(10 << 20);
        static const char alphabet[] = "xyt'()[]|+-*/^=., \n0123456789:#<>ifsum";
        for (; t.length < t.room; t.length++)
            t.bytes[t.length] = kind == 0   ? (char)chance()
                                : kind == 1 ? alphabet[chance() % (sizeof alphabet - 1)]
                                            : (char)(0x20 + chance() % 0x5F);
        if (kind > 0) memcpy(t.bytes, "x = ", 4);
        answer(t, "10 MB of chance", MOTUS_SYNTAX, "", 200);
    }
}

static void long_remark(void **unused)
{
    (void)unused;
    text t = make(10 << 20);
    say(&t, "x'' = -x%s#", start);
    memset(t.bytes + t.length, 'a', t.room - t.length);
    t.length = t.room;
    answer(t, "10 MB of remark", MOTUS_OK, "", 50);
}

static void too_long(void **unused)
{
    (void)unused;
    text t = make(17 << 20);
    memset(t.bytes, '\n', t.room);
    t.length = t.room;
    answer(t, "17 MB of lines", MOTUS_LIMIT, "bytes", 50);
}

/* One expression of 10 MB; the graph shares its terms, or is bounded by its size. */
static void long_expressions(void **unused)
{
    (void)unused;
    text t = make((10 << 20) + 200);
    say(&t, "x'' = -x");
    while (t.length < 10 << 20) say(&t, " + x");
    say(&t, "%s", start);
    answer(t, "10 MB of + x", MOTUS_LIMIT, "large", 2500);

    t = make(1 << 20);
    say(&t, "x'' = -x");
    for (int i = 0; i < 100000; i++) say(&t, " + %d", i % 10);
    say(&t, "%s", start);
    answer(t, "100 000 additions", MOTUS_OK, "", 500);

    t = make(2 << 20);
    say(&t, "x'' = -x");
    for (int i = 0; i < 100000; i++) say(&t, " + x x'");
    say(&t, "%s", start);
    answer(t, "100 000 products", MOTUS_OK, "", 500);

    t = make(2 << 20);
    say(&t, "x'' = -x");
    for (int i = 0; i < 100000; i++) say(&t, " - sin(x + %d)", i);
    say(&t, "%s", start);
    answer(t, "100 000 functions", MOTUS_OK, "", 800);

    t = make(2 << 20);
    say(&t, "x'' = -x 1");
    t.length -= 2;
    for (int i = 0; i < 100000; i++) say(&t, "*x/2");
    say(&t, "%s", start);
    answer(t, "200 000 factors", MOTUS_OK, "", 500);

    t = make(2 << 20);
    say(&t, "x'' = if(x > 0");
    for (int i = 0; i < 50000; i++) say(&t, " and x > -%d", i);
    say(&t, ", -x, 0)%s", start);
    answer(t, "50 000 conditions", MOTUS_OK, "", 500);
}

/* 10 MB of sums that are valid. */
static void many_sums(void **unused)
{
    (void)unused;
    text t = make((10 << 20) + 200);
    say(&t, "N = 5\nx'' = -x%s", start);
    for (int i = 0; t.length < 10 << 20; i++) say(&t, "q%d = sum(i = 1..N, i != 2: i x + sum(j = 1..i: j))\n", i);
    answer(t, "10 MB of sums", MOTUS_LIMIT, "", 2500);
}

static void nested(const char *what, int depth, const char *open, const char *inside, const char *close,
                   motus_status expected, const char *named)
{
    text t = make((size_t)depth * (strlen(open) + strlen(close)) + 4096);
    say(&t, "x'' = -");
    for (int i = 0; i < depth; i++) say(&t, "%s", open);
    say(&t, "%s", inside);
    for (int i = 0; i < depth; i++) say(&t, "%s", close);
    say(&t, "%s", start);
    answer(t, what, expected, named, 200);
}

static void nesting(void **unused)
{
    (void)unused;
    nested("10 000 brackets", 10000, "(", "x", ")", MOTUS_LIMIT, "nested");
    nested("10 000 open brackets", 10000, "(", "x", "", MOTUS_LIMIT, "nested");
    nested("10 000 functions", 10000, "sin(", "x", ")", MOTUS_LIMIT, "nested");
    nested("10 000 bars", 10000, "|1 + ", "x", "|", MOTUS_LIMIT, "nested");
    nested("10 000 powers", 10000, "2^", "x", "", MOTUS_LIMIT, "nested");
    nested("10 000 denials", 10000, "", "if(not not not x > 1, 1, 2)", "", MOTUS_OK, "");
    nested("10 000 lists", 10000, "[", "x", "]", MOTUS_LIMIT, "nested");
    nested("10 000 indices", 10000, "x[", "1", "]", MOTUS_LIMIT, "nested");
    nested("10 000 sums", 10000, "sum(i = 1..2: ", "x", ")", MOTUS_LIMIT, "nested");
    nested("10 000 conditions", 10000, "if(x > 0, ", "x", ", 1)", MOTUS_LIMIT, "nested");
    nested("200 brackets", 200, "(", "x", ")", MOTUS_OK, "");
    nested("200 right sides", 200, "(x + ", "x", ")", MOTUS_OK, "");
    nested("200 functions", 200, "sin(", "x", ")", MOTUS_OK, "");
    nested("200 powers", 200, "1.01^", "x", "", MOTUS_OK, "");
    text t = make(100000);
    say(&t, "x'' = if(");
    for (int i = 0; i < 10000; i++) say(&t, "not ");
    say(&t, "x > 0, 1, 2)%s", start);
    answer(t, "10 000 times not", MOTUS_LIMIT, "nested", 100);
}

static void chains(void **unused)
{
    (void)unused;
    text t = make(1 << 20);
    say(&t, "q0 = x\n");
    for (int i = 1; i <= 60; i++) say(&t, "q%d = q%d + q%d\n", i, i - 1, i - 1);
    say(&t, "x'' = -q60%s", start);
    answer(t, "2^60 uses of x", MOTUS_OK, "", 100);

    t = make(1 << 20);
    say(&t, "q0[i] = x for i = 1..3\n");
    for (int i = 1; i <= 60; i++) say(&t, "q%d[i] = q%d[i] + q%d[i] for i = 1..3\n", i, i - 1, i - 1);
    say(&t, "x'' = -q60[1]%s", start);
    answer(t, "2^60 uses in families", MOTUS_LIMIT, "", 2500);

    t = make(1 << 20);
    say(&t, "q0[i] = x for i = 1..3\n");
    for (int i = 1; FEWER == 1 && i <= 31; i++) say(&t, "q%d[i] = q%d[i] + q%d[i] for i = 1..3\n", i, i - 1, i - 1);
    say(&t, "x'' = -q%d[1]%s", FEWER == 1 ? 31 : 0, start);
    answer(t, "2^31 uses in families", FEWER == 1 ? MOTUS_LIMIT : MOTUS_OK, "often", 2500);

    t = make(1 << 20);
    for (int i = 0; i < 300; i++) say(&t, "p%d = p%d + 1\n", i, i + 1);
    say(&t, "p300 = 1\nx'' = -p0 x%s", start);
    answer(t, "300 parameters in a chain", MOTUS_OK, "", 200);

    for (int quantity = 0; quantity < 2; quantity++) {
        t = make(4 << 20);
        for (int i = 0; i < 100000; i++) say(&t, "p%d = p%d + 1\n", i, i + 1);
        say(&t, "p100000 = %s\nx'' = -p0 x%s", quantity ? "x" : "1", start);
        answer(t, "100 000 definitions in a chain", MOTUS_LIMIT, "deep", 300);

        t = make(4 << 20); /* the order of the definitions does not matter */
        say(&t, "p0 = %s\n", quantity ? "x" : "1");
        for (int i = 1; i <= 300; i++) say(&t, "p%d = p%d + 1\n", i, i - 1);
        say(&t, "x'' = -p300 x%s", start);
        answer(t, "300 definitions forward", MOTUS_OK, "", 200);
    }
}

/* Chains of definitions, each deeply nested: both bounds hold together, where the stack could overflow. */
static void deep_chains(void **unused)
{
    (void)unused;
    for (int quantity = 0; quantity < 2; quantity++)
        for (int sines = 0; sines < 2; sines++) {
            text t = make(4 << 20);
            for (int i = 0; i < 390; i++) {
                say(&t, "p%d = ", i);
                for (int k = 0; k < 240; k++) say(&t, "%s", sines ? "sin(" : "(1 + ");
                say(&t, "p%d", i + 1);
                for (int k = 0; k < 240; k++) say(&t, ")");
                say(&t, "\n");
            }
            say(&t, "p390 = %s\nx'' = -p0 x%s", quantity ? "x" : "1", start);
            answer(t, "a chain of deep definitions", MOTUS_LIMIT, "deep", 1000);
        }
    for (int sines = 0; sines < 2; sines++) { /* parameters are known when they are used, so nothing is deep */
        text t = make(4 << 20);
        say(&t, "p0 = 1\n");
        for (int i = 1; i < 390; i++) {
            say(&t, "p%d = ", i);
            for (int k = 0; k < 240; k++) say(&t, "%s", sines ? "sin(" : "(1 + ");
            say(&t, "p%d", i - 1);
            for (int k = 0; k < 240; k++) say(&t, ")");
            say(&t, "\n");
        }
        say(&t, "x'' = -p389 x%s", start);
        answer(t, "deep definitions, one after the other", MOTUS_OK, "", 1000);
    }
    text t = make(4 << 20);
    say(&t, "x'' = -x%s", start);
    for (int i = 0; i < 390; i++) {
        say(&t, "y%d'' = 0\ny%d'(0) = 0\ny%d(0) = ", i, i, i);
        for (int k = 0; k < 240; k++) say(&t, "(1 + ");
        say(&t, i < 389 ? "y%d(0)" : "%d", i + 1);
        for (int k = 0; k < 240; k++) say(&t, ")");
        say(&t, "\n");
    }
    answer(t, "a chain of deep initial values", MOTUS_LIMIT, "deep", 1000);
}

static void many_names(void **unused)
{
    (void)unused;
    text t = make(8 << 20);
    say(&t, "x'' = -p99999 x%s", start);
    for (int i = 0; i < 100000; i++) say(&t, "p%d = %d\n", i, i);
    answer(t, "100 000 parameters", MOTUS_OK, "", 500);

    t = make(8 << 20);
    say(&t, "x'' = -p99999 x%s", start);
    for (int i = 0; i < 100000; i++) say(&t, "p%d = 2*%d + sqrt(%d)\n", i, i, i);
    answer(t, "100 000 computed parameters", MOTUS_OK, "", 500);

    t = make(8 << 20);
    say(&t, "x'' = -x%sa = 2\np0 = a\n", start);
    for (int i = 1; i < 20000; i++) say(&t, "p%d = a + p%d\n", i, i - 1);
    answer(t, "20 000 parameters of parameters", MOTUS_OK, "", 1000);

    t = make(8 << 20);
    say(&t, "x'' = -x%s", start);
    for (int i = 0; i < 20000; i++) say(&t, "q%d = x + %d\n", i, i);
    answer(t, "20 000 quantities", MOTUS_OK, "", 1000);

    t = make(16 << 20);
    for (int i = 1; i <= 7000; i++) say(&t, "x%d'' = -x%d\nx%d(0) = %d\nx%d'(0) = 0\n", i, i, i, i, i);
    answer(t, "7 000 states", MOTUS_OK, "", 1000);

    t = make(16 << 20);
    for (int i = 1; i <= 30000; i++) say(&t, "x%d'' = -x%d\nx%d(0) = %d\nx%d'(0) = 0\n", i, i, i, i, i);
    answer(t, "30 000 states", MOTUS_LIMIT, "", 1000);

    t = make(16 << 20);
    say(&t, "m = [");
    for (int i = 1; i < 1000000; i++) say(&t, "%d,", i);
    say(&t, "1]\nx'' = -m[1000000] x%s", start);
    answer(t, "a list of a million", MOTUS_OK, "", 1500);
}

static void many_lines(void **unused)
{
    (void)unused;
    text t = make(16 << 20);
    for (int i = 1; i <= 33000 / FEWER; i++) say(&t, "u[%d]'' = -u[%d]\nu[%d](0) = %d\nu[%d]'(0) = 0\n", i, i, i, i, i);
    answer(t, "100 000 lines of one family", MOTUS_OK, "", 1500);

    t = make(16 << 20);
    say(&t, "k = 2\n");
    for (int i = 1; i <= 20000 / FEWER; i++)
        say(&t, "u[%d]'' = -u[%d]\nu[%d](0) = k + %d\nu[%d]'(0) = k u[%d](0)\n", i, i, i, i, i, i);
    answer(t, "60 000 lines with parameters", MOTUS_OK, "", 2000);

    t = make(16 << 20);
    for (int i = 0; i < 1100000; i++) say(&t, "p=1\n");
    answer(t, "1 100 000 statements", MOTUS_LIMIT, "statements", 1000);

    t = make(16 << 20);
    for (int i = 0; i < 100000; i++) say(&t, "step 1\n");
    answer(t, "100 000 settings", MOTUS_SYNTAX, "equation", 300);
}

/* A million cells: parsed and started in under a second, and memory grows with the state only. */
static void large_family(void **unused)
{
    (void)unused;
    text t = make(4096);
    say(&t, "N = 1000000\nx[i]'' = x[i+1] - 2 x[i] + x[i-1] + 0.7 ((x[i+1] - x[i])^3 - (x[i] - x[i-1])^3) for i = "
            "1..N\nx[0] = 0\nx[N+1] = 0\n"
            "x[i](0) = sin(pi i/(N+1)) for i = 1..N\nx[i]'(0) = 0 for i = 1..N\ninvariant energy = sum(i = 1..N: "
            "x[i]'^2/2)\n");
    answer(t, "a chain of a million", MOTUS_OK, "", 300);

    t = make(4096);
    say(&t, "N = 1000\nu[i,j]'' = u[mod(i, N)+1, j] - u[i,j] + u[i,mod(j, N)+1] for i = 1..N, j = 1..N\nu[i,j](0) = i "
            "+ j for i = 1..N, j = 1..N\n"
            "u[i,j]'(0) = 0 for i = 1..N, j = 1..N\n");
    answer(t, "a lattice of a million", MOTUS_OK, "", 300);

    static const char *const huge[] = {"49999999", "1e9", "1e15", "1e300", "2^62"};
    for (size_t i = 1; i < sizeof huge / sizeof *huge; i++) {
        t = make(4096);
        say(&t, "N = %s\nx[i]'' = 0 for i = 1..N\nx[i](0) = 0 for i = 1..N\nx[i]'(0) = 0 for i = 1..N\n", huge[i]);
        answer(t, "a family far too large", MOTUS_LIMIT, "", 10);
    }
    t = make(4096);
    say(&t, "x'' = -x%sq = sum(i = 1..1000000000: x i)\n", start);
    answer(t, "a sum nobody looks at", MOTUS_OK, "", 10);
    t = make(4096);
    say(&t, "x'' = -x%sq = sum(i = 1..1000000, j = 1..1000000: i/j)\n", start);
    answer(t, "a constant of 1e12 terms", MOTUS_LIMIT, "terms", 10);
    t = make(65536);
    say(&t, "x'' = -f42(x)%sf0(u) = sin(u)\n", start);
    for (int i = 1; i <= 42; i++) say(&t, "f%d(u) = f%d(u) + f%d(u + %d)\n", i, i - 1, i - 1, i);
    answer(t, "functions that expand to 2^42 calls", MOTUS_LIMIT, "use one another too often", 200);
    t = make(65536);
    say(&t, "x'' = -x%s", start);
    for (int i = 0; i < 1000; i++) say(&t, "q%d = sum(i = 1..10000000: i)\n", i);
    answer(t, "constants of 1e10 terms together", MOTUS_LIMIT, "terms", 50);
}

/* ---- memory for the length of the text ---- */

typedef void shape(text *, int n);

static void chain_of_parameters(text *t, int n)
{
    say(t, "x'' = -x%sp1 = 1\n", start);
    for (int i = 2; i <= n; i++) say(t, "p%d = %d + p%d\n", i, i, i - 1);
}

static void parameters_alone(text *t, int n)
{
    say(t, "x'' = -x%s", start);
    for (int i = 1; i <= n; i++) say(t, "p%d = %d\n", i, i);
}

static void formulas(text *t, int n)
{
    say(t, "x'' = -x%s", start);
    for (int i = 1; i <= n; i++) say(t, "p%d = 2 sin(%d)\n", i, i);
}

static void functions(text *t, int n)
{
    say(t, "x'' = -x%s", start);
    for (int i = 1; i <= n; i++) say(t, "f%d(y) = %d y\n", i, i);
}

static void comments(text *t, int n)
{
    say(t, "x'' = -x%s", start);
    for (int i = 1; i <= n; i++) say(t, "# line %d\n", i);
}

static void list_of_numbers(text *t, int n)
{
    say(t, "x'' = -m[1] x%sm = [1", start);
    for (int i = 2; i <= n; i++) say(t, ", %d", i);
    say(t, "]\n");
}

static void terms(text *t, int n)
{
    say(t, "x'' = -x");
    for (int i = 1; i <= n; i++) say(t, " + %d x", i);
    say(t, "%s", start);
}

static void factors(text *t, int n)
{
    say(t, "x'' = -x");
    for (int i = 1; i <= n; i++) say(t, " (x + %d)", i);
    say(t, "%s", start);
}

static void calls(text *t, int n)
{
    say(t, "V(q) = q^2/2 + q^4\nx'' = -x");
    for (int i = 1; i <= n; i++) say(t, " + V(%d x)", i);
    say(t, "%s", start);
}

static void parameters_in_a_sum(text *t, int n)
{
    say(t, "x'' = -x");
    for (int i = 1; i <= n; i++) say(t, " + p%d x", i);
    say(t, "%s", start);
    for (int i = 1; i <= n; i++) say(t, "p%d = %d\n", i, i);
}

static void cells(text *t, int n)
{
    for (int i = 1; i <= n; i++) say(t, "u[%d]'' = -u[%d]\nu[%d](0) = %d\nu[%d]'(0) = 0\n", i, i, i, i, i);
}

static void quantities(text *t, int n)
{
    say(t, "x'' = -x%s", start);
    for (int i = 1; i <= n; i++) say(t, "q%d = %d x\n", i, i);
}

static void one_parameter_in_a_sum(text *t, int n)
{
    say(t, "x'' = -x");
    for (int i = 1; i <= n; i++) say(t, " + p");
    say(t, "%sp = 1\n", start);
}

static void variables(text *t, int n)
{
    for (int i = 1; i <= n; i++) say(t, "x%d'' = -x%d\nx%d(0) = 1\nx%d'(0) = 0\n", i, i, i, i);
}

/* Reads a model of n lines, terms or cells; the text's length and what reading it took. */
static size_t read_shape(shape *write, int n, ledger *l)
{
    text t = make((size_t)n * 100 + 1000);
    write(&t, n);
    motus_text_def def = motus_default_text();
    motus_error err = motus_default_error();
    motus_system *s = NULL;
    def.text = t.bytes;
    def.length = t.length;
    def.allocator = (motus_allocator){take_counted, release_counted, l};
    must(motus_system_from_text(&def, &s, &err), &err, "a long model");
    motus_system_destroy(s);
    free(t.bytes);
    assert_int_equal(l->blocks, 0);
    return t.length;
}

/* What a model takes while it is read, in bytes for each byte of its text, is bounded for each shape of text, and does
 * not grow with its length; nor does the number of allocations. The margin from n to 4 n is the last doubling of the
 * tables. */
static void memory_for_the_text(void **unused)
{
    (void)unused;
    static const struct {
        const char *name;
        shape *write;
        int n;
        size_t times;
    } shapes[] = {
        {"a chain of parameters", chain_of_parameters, 300000, 20},
        {"parameters", parameters_alone, 100000, 22},
        {"formulas", formulas, 100000, 28},
        {"functions", functions, 100000, 28},
        {"comments", comments, 100000, 3},
        {"a list", list_of_numbers, 100000, 28},
        {"a sum", terms, 300000, 33},
        {"one parameter in a sum", one_parameter_in_a_sum, 300000, 45},
        {"variables", variables, 8000, 56},
        {"a product", factors, 100000, 39},
        {"calls", calls, 50000, 74},
        {"parameters in a sum", parameters_in_a_sum, 100000, 27},
        {"cells", cells, 20000, 39},
        {"quantities", quantities, 20000, 50},
    };
    for (size_t i = 0; i < sizeof shapes / sizeof *shapes; i++) {
        const int n = shapes[i].n / FEWER;
        ledger small = {0}, large = {0};
        const double few = (double)read_shape(shapes[i].write, n / 4, &small),
                     many = (double)read_shape(shapes[i].write, n, &large);
        print_message("%s: %.1f bytes for a byte of %.1f MB, %.1f for a fourth; %.2f allocations for each of %d\n",
                      shapes[i].name, (double)large.peak / many, many / 1e6, (double)small.peak / few,
                      (double)large.calls / n, n);
        if ((double)large.peak > (double)shapes[i].times * many && FEWER == 1)
            fail_msg("%s take %.1f times their text, not %zu", shapes[i].name, (double)large.peak / many,
                     shapes[i].times);
        if ((double)large.peak / many > 1.5 * (double)small.peak / few)
            fail_msg("%s: memory for a byte of the text grows with it", shapes[i].name);
        if ((double)large.calls > 5.0 * (double)small.calls + 100)
            fail_msg("%s: %ld allocations, and %ld for a fourth of it", shapes[i].name, large.calls, small.calls);
    }
}

/* ---- out of memory ---- */

static const char rich[] =
    "G = 1\nN = 3\nm = [1, 2, 3]\nw[i] = 2 i for i = 1..N\nplaces = [(1, 0), (0, 1), (-1, 0)]\n"
    "r[i]'' = sum(j = 1..N, j != i: G m[j] (r[j] - r[i])/|r[j] - r[i]|^3) - 0.1 r[i]' + (0, sin(t)) for i = 1..N\n"
    "r[i](0) = places[i] for i = 1..N\nr[i]'(0) = (0, w[i]/10) for i = 1..N\n"
    "u[i]'' = u[i+1] - 2 u[i] + u[i-1] for i = 1..N\nu[0] = sin(t)\nu[N+1] = 0\nu[i](0) = i for i = 1..N\nu[2](0) = "
    "5\nu[i]'(0) = u[i](0) for i = 1..N\n"
    "s' = if(s > 0, -s, 1)\ns(0) = 1\nfar = |r[1] - r[2]|\ninvariant P = sum(i = 1..N: m[i] (r[i]' + "
    "0.1 r[i])) + (0, 6 cos(t))\nacc = u[2]''\nstep 0.01\nuntil 0.05\n";
static const char *const methods[] = {"rk4", "verlet", "gauss6", "implicit-midpoint", "newmark", "midpoint"};

/* The life of a system, from text to destroy, with the memory of `l`. */
static motus_status life(ledger *l, const char *method, motus_error *err)
{
    static const char *const set[] = {"G=2", "r[2](0) = (0, 1.5)"};
    motus_text_def def = motus_default_text();
    motus_run_def run = motus_default_run();
    motus_system *s = NULL;
    motus_run *r = NULL;
    def.text = rich;
    def.set = set;
    def.set_count = 2;
    def.allocator = (motus_allocator){take_counted, release_counted, l};
    run.method = method;
    run.machine = "interpreter";
    motus_status status = motus_system_from_text(&def, &s, err);
    if (status != MOTUS_OK) assert_null(s);
    if (status == MOTUS_OK) {
        (void)motus_explain(s);
        (void)motus_equation_text(s, 0);
        status = motus_run_create(s, &run, &r, err);
    }
    if (status == MOTUS_OK) status = motus_run_finish(r, err);
    for (size_t k = 0; status == MOTUS_OK && k < motus_column_count(s); k++) {
        double value;
        status = motus_run_values(r, &k, 1, &value, err);
        if (status == MOTUS_OK) assert_true(isfinite(value));
    }
    if (status == MOTUS_OK) {
        const char *saved;
        size_t length;
        status = motus_run_save(r, &saved, &length, err);
        if (status == MOTUS_OK) status = motus_run_restore(r, saved, length, err);
    }
    motus_run_destroy(r);
    motus_system_destroy(s);
    return status;
}

static void every_allocation_may_fail(void **unused)
{
    (void)unused;
    for (size_t i = 0; i < sizeof methods / sizeof *methods; i++) {
        if (FEWER > 1 && i != 2) continue;
        ledger whole = {0};
        motus_error err = motus_default_error();
        must(life(&whole, methods[i], &err), &err, methods[i]);
        assert_int_equal(whole.blocks, 0);
        assert_true(whole.calls > 5);
        for (int after = 0; after < 2; after++)
            for (long k = 1; k <= whole.calls; k++) {
                ledger l = {.fail_at = k, .fail_after = after};
                err = motus_default_error();
                motus_status status = life(&l, methods[i], &err);
                /* calls that only print (motus_explain, motus_equation_text) return NULL, and the others still work */
                if (status != MOTUS_MEMORY && status != MOTUS_OK)
                    fail_msg("%s: allocation %ld of %ld failed, and the answer is %s: %s", methods[i], k, whole.calls,
                             motus_status_word(status), err.message);
                if (status == MOTUS_MEMORY && (err.status != MOTUS_MEMORY || !err.message[0]))
                    fail_msg("%s: allocation %ld failed without a message", methods[i], k);
                if (l.blocks) fail_msg("%s: allocation %ld failed, and %zu blocks leaked", methods[i], k, l.blocks);
            }
        print_message("%s: %ld allocations, each failing\n", methods[i], whole.calls);
    }
}

/* An argument names the tests to run, * for any letters. */
int main(int count, char **arguments)
{
    if (count > 1) cmocka_set_test_filter(arguments[1]);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_bytes),
        cmocka_unit_test(long_remark),
        cmocka_unit_test(too_long),
        cmocka_unit_test(long_expressions),
        cmocka_unit_test(many_sums),
        cmocka_unit_test(nesting),
        cmocka_unit_test(chains),
        cmocka_unit_test(deep_chains),
        cmocka_unit_test(many_names),
        cmocka_unit_test(many_lines),
        cmocka_unit_test(large_family),
        cmocka_unit_test(memory_for_the_text),
        cmocka_unit_test(every_allocation_may_fail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
