/* Any bytes as a model: read, explained, printed, looked at, run for a few steps with methods of every family. Bytes
 * after a line "--set" are settings, one a line.
 *
 * Invariant: whatever comes, every call returns; an error has a message that a terminal can show; nothing is left of
 * the memory. Under libFuzzer the sanitizers judge; with -DREPLAY it is a plain program that replays the files named
 * as arguments.
 */
#include "motus.h"
#include "test/mathml.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { HEADER = 32, NUMBERS = 1000, SETTINGS = 4, TYPESET_MAX = 1 << 17 };

#define CHECK(condition)                                                    \
    do {                                                                    \
        if (!(condition)) {                                                 \
            fprintf(stderr, "%s:%d: %s\n", __FILE__, __LINE__, #condition); \
            abort();                                                        \
        }                                                                   \
    } while (0)

/* An allocator with the memory of a small machine, which refuses larger requests. */
typedef struct ledger {
    size_t bytes, blocks;
} ledger;

static void *take_counted(void *context, size_t bytes)
{
    ledger *l = context;
    if (bytes > ((size_t)256 << 20) - l->bytes) return NULL;
    char *p = malloc(bytes + HEADER);
    if (!p) return NULL;
    memcpy(p, &bytes, sizeof bytes);
    l->bytes += bytes;
    l->blocks++;
    return p + HEADER;
}

static void release_counted(void *context, void *block)
{
    ledger *l = context;
    size_t bytes;
    if (!block) return;
    memcpy(&bytes, (char *)block - HEADER, sizeof bytes);
    l->bytes -= bytes;
    l->blocks--;
    free((char *)block - HEADER);
}

/* UTF-8 without control characters. */
static void check_text(const char *text, size_t room)
{
    size_t n = strnlen(text, room);
    CHECK(n < room);
    const unsigned char *p = (const unsigned char *)text;
    while (*p) {
        CHECK(*p >= 0x20 && *p != 0x7F);
        int more = *p < 0x80 ? 0 : *p >> 5 == 6 ? 1 : *p >> 4 == 14 ? 2 : *p >> 3 == 30 ? 3 : -1;
        CHECK(more >= 0);
        for (p++; more > 0; more--, p++) CHECK((*p & 0xC0) == 0x80);
    }
}

static void check_error(const motus_error *err, motus_status status)
{
    CHECK(status > MOTUS_OK && status < MOTUS_STATUS_COUNT && err->status == status && err->message[0]);
    check_text(err->message, sizeof err->message);
    check_text(err->hint, sizeof err->hint);
    check_text(err->caret, sizeof err->caret);
    check_text(err->variable, sizeof err->variable);
    /* the model's bytes, which need not be UTF-8 */
    CHECK(strnlen(err->source, sizeof err->source) < sizeof err->source);
    for (const char *p = err->source; *p; p++) CHECK((unsigned char)*p >= 0x20 && *p != 0x7F);
    CHECK((err->line > 0) == (err->column > 0));
}

/* Every statement as MathML is well-formed XML. */
static void check_statements(motus_system *s)
{
    for (size_t k = 0; k < motus_statement_count(s) && k < NUMBERS; k++) {
        motus_statement statement = motus_default_statement();
        const char *text = motus_statement_mathml(s, k), *wrong;
        CHECK(motus_statement_at(s, k, &statement) == MOTUS_OK && statement.name &&
              (statement.line > 0 || statement.is_set));
        if (!text) continue; /* out of memory */
        CHECK(strlen(text) < TYPESET_MAX);
        wrong = mathml_read(text, NULL, 0, NULL);
        if (wrong) fprintf(stderr, "%s: %s\n", wrong, text);
        CHECK(!wrong);
    }
}

static void look(motus_system *s, motus_run *r)
{
    for (size_t k = 0; k < motus_column_count(s) && k < NUMBERS; k++) {
        motus_column column = motus_default_column();
        size_t first, count;
        double value;
        motus_error err = motus_default_error();
        CHECK(motus_column_at(s, k, &column) == MOTUS_OK);
        check_text(column.name, sizeof column.name);
        if (motus_column_find(s, column.name, &first, &count, &err) == MOTUS_OK)
            CHECK(count >= 1 && first <= k && k < first + count);
        if (r) {
            motus_status status = motus_run_values(r, &k, 1, &value, &err);
            if (status != MOTUS_OK) check_error(&err, status);
        }
    }
}

static void run(motus_system *s, const char *method)
{
    motus_error err = motus_default_error();
    motus_run_def def = motus_default_run();
    motus_settings settings = motus_default_settings();
    motus_run *r = NULL;
    motus_settings_of(s, &settings);
    def.method = method;
    def.step = 1e-3;
    def.machine = "interpreter";
    def.until = settings.from + 1;
    motus_status status = motus_run_create(s, &def, &r, &err);
    if (status == MOTUS_OK) status = motus_run_step(r, 3, &err);
    const motus_trace_entry *const *entries;
    size_t count = 0;
    if (status == MOTUS_OK) status = motus_run_trace(r, &entries, &count, &err);
    if (status != MOTUS_OK) check_error(&err, status);
    if (r) look(s, r);
    motus_run_destroy(r);
}

/* A model whose evaluation takes very many operations is read, not run. */
static int cheap(const uint8_t *bytes, size_t length)
{
    int digits = 0, sums = 0;
    for (size_t i = 0; i < length; i++) {
        digits = bytes[i] >= '0' && bytes[i] <= '9' ? digits + 1 : 0;
        if (digits > 3 || (digits > 0 && i + 1 < length && (bytes[i + 1] | 0x20) == 'e')) return 0;
        sums += i + 2 < length && bytes[i] == '.' && bytes[i + 1] == '.';
    }
    return sums < 8;
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t length);
int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t length)
{
    ledger l = {0};
    motus_text_def def = motus_default_text();
    motus_error err = motus_default_error();
    motus_system *s = NULL;
    const char *set[SETTINGS];
    char *text = malloc(length + 1);
    if (!text) return 0;
    memcpy(text, bytes, length);
    text[length] = 0;
    def.text = text;
    def.length = length;
    def.allocator = (motus_allocator){take_counted, release_counted, &l};
    char *tail = strstr(text, "\n--set\n");
    if (tail) {
        def.length = (size_t)(tail - text);
        def.set = set;
        for (char *line = strtok(tail + strlen("\n--set\n"), "\n"); line && def.set_count < SETTINGS;
             line = strtok(NULL, "\n"))
            set[def.set_count++] = line;
    }
    motus_status status = motus_system_from_text(&def, &s, &err);
    if (status != MOTUS_OK) {
        CHECK(!s);
        check_error(&err, status);
    } else if (motus_positions(s) + motus_velocities(s) <= NUMBERS) {
        check_statements(s);
        for (size_t k = 0; k < 20 && motus_equation_text(s, k); k++)
            check_text(motus_equation_text(s, k), SIZE_MAX / 2);
        look(s, NULL);
        const char *emitted = motus_compiled_text(s, "rk4", &err);
        for (const char *p = emitted; p && *p; p++) CHECK(*p == '\n' || ((unsigned char)*p >= 0x20 && *p != 0x7F));
        if (cheap(bytes, length)) {
            const char *explained = motus_explain(s); /* evaluates the force at some places */
            if (explained) CHECK(strlen(explained) > 0);
            static const char *const methods[] = {"rk4",     "verlet", "velocity-verlet", "gauss4",
                                                  "newmark", "boris",  "exact",           "yoshida4"};
            for (size_t i = 0; i < sizeof methods / sizeof *methods; i++) run(s, methods[i]);
        }
    }
    motus_system_destroy(s);
    CHECK(l.blocks == 0 && l.bytes == 0);
    free(text);
    return 0;
}

#ifdef REPLAY
int main(int count, char **files)
{
    for (int i = 1; i < count; i++) {
        FILE *file = fopen(files[i], "rb");
        static uint8_t bytes[1 << 24];
        if (!file) {
            fprintf(stderr, "%s cannot be read\n", files[i]);
            return 1;
        }
        size_t length = fread(bytes, 1, sizeof bytes, file);
        fclose(file);
        printf("%s\n", files[i]);
        LLVMFuzzerTestOneInput(bytes, length);
    }
    return 0;
}
#endif
