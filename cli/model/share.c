/* The fragment of a link to the lab.
 *
 * Invariant: the fragment has only the characters # A-Z a-z 0-9 - . _ ~ ( ) , * % = &, and decoding a value gives its
 * bytes, which are UTF-8.
 */
#include "cli/model/share.h"

#include "base/decimal.h"
#include "base/utf8.h"
#include "cli/files/file.h"
#include "cli/model/load.h"
#include "cli/model/settle.h"
#include "cli/words/complain.h"
#include "cli/words/text.h"
#include "cli/words/words.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct item {
    char key;
    const char *value;
} item;
typedef struct items {
    item *list;
    size_t count;
} items;

/* Encodes `s`; `out` has room for 3 bytes for each of its bytes. Returns the end. */
static char *encode(char *out, const char *s, const char *plain)
{
    static const char hex[] = "0123456789ABCDEF";
    for (; *s; s++) {
        unsigned char c = (unsigned char)*s;
        bool letter = (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
        if (letter || strchr(plain, c)) {
            *out++ = *s;
        } else {
            *out++ = '%';
            *out++ = hex[c >> 4];
            *out++ = hex[c & 15];
        }
    }
    return out;
}

char *share_file_url(const char *path)
{
    static const char scheme[] = "file://";
    char *url = malloc(sizeof scheme + 3 * strlen(path));
    if (url) {
        memcpy(url, scheme, sizeof scheme);
        *encode(url + sizeof scheme - 1, path, "/-._~(),*") = 0;
    }
    return url;
}

/* Returns the first byte that is not UTF-8, or NULL. */
static const char *foreign(const char *s)
{
    uint32_t c;
    for (size_t length; *s; s += length) {
        length = utf8_read(s, SIZE_MAX, &c);
        if (length == 0) return s;
    }
    return NULL;
}

static motus_status check_item(const item *i, const options *o, size_t *total, motus_error *err)
{
    const char *bad = foreign(i->value);
    if (bad && i->key == 'm')
        return load_complain(i->value, bad, o->operand, "this byte is not UTF-8, so it cannot be in a link", err);
    if (bad) return fail(err, MOTUS_ARGUMENT, "%s: this is not UTF-8, so it cannot be in a link", i->value);
    *total += strlen(i->value);
    if (*total > SHARE_TEXT_MAX)
        return complain(err, MOTUS_LIMIT, "share the file itself, or remove comments and tables",
                        "the model and its settings are longer than %zu bytes: too long for a link", SHARE_TEXT_MAX);
    return MOTUS_OK;
}

static motus_status write_items(const items *all, const options *o, char **fragment, motus_error *err)
{
    size_t total = 0;
    for (size_t k = 0; k < all->count; k++) {
        motus_status status = check_item(&all->list[k], o, &total, err);
        if (status) return status;
    }
    char *out = *fragment = malloc(3 * total + 3 * all->count + 1);
    if (!out) return complain_memory(err);
    for (size_t k = 0; k < all->count; k++) {
        *out++ = k > 0 ? '&' : '#';
        *out++ = all->list[k].key;
        *out++ = '=';
        out = encode(out, all->list[k].value, "-._~(),*");
    }
    *out = 0;
    return MOTUS_OK;
}

/* Returns the methods of the options, with commas between them, the main one first. NULL: out of memory. */
static char *methods_of(const options *o)
{
    const char *const main[] = {o->method ? o->method : ""};
    const struct {
        const char *const *items;
        size_t count;
    } lists[] = {{main, o->method ? 1 : 0}, {o->methods.items, o->methods.count}};
    size_t room = strlen(main[0]) + 2;
    for (size_t k = 0; k < o->methods.count; k++) room += strlen(o->methods.items[k]) + 1;
    char *out = malloc(room);
    size_t used = 0;
    for (size_t l = 0; out && l < 2; l++)
        for (size_t k = 0; k < lists[l].count; k++) {
            if (l == 1 && strcmp(lists[l].items[k], main[0]) == 0) continue;
            memcpy(out + used, lists[l].items[k], strlen(lists[l].items[k]));
            used += strlen(lists[l].items[k]);
            out[used++] = ',';
        }
    if (out) out[used > 0 ? used - 1 : 0] = 0;
    return out;
}

enum { NUMBER_ROOM = 256 };
/* Writes a number of the command line for the language: as it was typed, or, for .5 and 1., its digits. */
static void number_of(double value, const char *typed, char out[NUMBER_ROOM])
{
    double read;
    char digits[DECIMAL_MAX];
    const size_t length = strlen(typed);
    const bool foreign = length == 0 || length >= NUMBER_ROOM || typed[strspn(typed, "+-")] == '.' ||
                         (typed[length - 1] == '.' && typed_decimal(typed, &read));
    snprintf(out, NUMBER_ROOM, "%s", foreign ? decimal(value, digits) : typed);
}

/* Gathers the items of a link in their order. `numbers` is memory for their texts. */
static void gather(items *all, const load *m, const options *o, const char *methods, char numbers[][NUMBER_ROOM])
{
    all->list[all->count++] = (item){'v', "1"};
    all->list[all->count++] = (item){'m', m->text};
    for (size_t k = 0, used = 0; k < OPTION_COUNT; k++) {
        const option *row = options_row(k);
        const double *const number = (const double *)((const char *)o + row->place);
        if (k == OPTION_set)
            for (size_t i = 0; i < o->set.count; i++) all->list[all->count++] = (item){row->link, o->set.items[i]};
        else if (k == OPTION_method && *methods)
            all->list[all->count++] = (item){row->link, methods};
        else if (row->link && row->kind >= NUMBER && row->kind <= TOLERANCE && o->given[k]) {
            number_of(*number, row->kind == TOLERANCE ? "" : o->given[k], numbers[used]);
            all->list[all->count++] = (item){row->link, numbers[used++]};
        }
    }
}

motus_status share_fragment(const load *m, const options *o, char **fragment, motus_error *err)
{
    enum { OTHERS = 3 }; /* the items v, m, a */
    char numbers[OPTION_COUNT][NUMBER_ROOM];
    if (o->absolute) {
        const bool accuracy = !isnan(o->accuracy);
        fail(err, MOTUS_ARGUMENT, "a link has a relative %s, but this one is absolute",
             accuracy ? "accuracy" : "tolerance");
        hint(err, "write `%s … absolute` into the model, or give --%s as a number alone",
             accuracy ? "accuracy" : "tolerance", accuracy ? "accuracy" : "tolerance");
        return MOTUS_ARGUMENT;
    }
    char *methods = methods_of(o);
    for (size_t k = 0; k < o->set.count; k++)
        if (components_are(o->set.items[k])) {
            free(methods);
            return complain(err, MOTUS_ARGUMENT, "set all components: \"r(0) = (1, 0)\"",
                            "--set %s: a link has only whole vectors", o->set.items[k]);
        }
    items all = {malloc((o->set.count + OTHERS + OPTION_COUNT) * sizeof *all.list), 0};
    motus_status status = methods && all.list ? MOTUS_OK : complain_memory(err);
    if (!status) gather(&all, m, o, methods, numbers);
    if (!status) status = write_items(&all, o, fragment, err);
    free(all.list);
    free(methods);
    return status;
}

/* Checks that the methods exist, and finds one that admits the model, for check_run(). */
static motus_status check_methods(const load *m, const options *o, const char **fits, motus_error *err)
{
    const motus_method *found;
    motus_status status = MOTUS_OK;
    for (size_t k = 0; !status && k < o->methods.count; k++)
        status = motus_method_find(o->methods.items[k], &found, err);
    for (size_t k = 0; !status && k < motus_method_count() && !*fits; k++)
        if (motus_method_admits(m->system, motus_method_at(k)->name, NULL) == MOTUS_OK)
            *fits = motus_method_at(k)->name;
    return status;
}

static motus_status check_run(load *m, const options *o, motus_error *err)
{
    motus_run_def def = motus_default_run();
    SETTLE_ASK(&def, o);
    motus_status status = o->verb == VERB_COMPARE ? check_methods(m, o, &def.method, err) : MOTUS_OK;
    return status ? status : motus_run_settings(m->system, &def, &m->set, err);
}

motus_status share_verb(const options *o, motus_error *err)
{
    load m = {0};
    char *fragment = NULL;
    motus_status status = load_model(&m, o, err);
    if (!status) status = check_run(&m, o, err);
    if (!status) status = share_fragment(&m, o, &fragment, err);
    if (!status && o->json) {
        json j = text_json(stdout);
        json_string(&j, "share", fragment);
        json_end(&j);
    } else if (!status) {
        puts(fragment);
    }
    if (!status) status = file_flush_output(err);
    free(fragment);
    load_free(&m);
    return status;
}
