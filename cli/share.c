/* The fragment of a link to the lab.
 *
 * Invariant: the fragment consists of # A-Z a-z 0-9 - . _ ~ ( ) , * % = & alone, and decoding it gives the same bytes,
 * which are UTF-8.
 */
#include "cli/share.h"

#include "base/utf8.h"
#include "base/error.h"
#include "cli/components.h"
#include "cli/complain.h"
#include "cli/file.h"
#include "cli/text.h"

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

/* `out` has room for 3 bytes for each of `s`. */
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

/* The first byte that is not UTF-8, or NULL. */
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
    if (*total > SHARE_TEXT_MAX) {
        fail(err, MOTUS_LIMIT, "the model and its settings are longer than %zu bytes: too long for a link",
             SHARE_TEXT_MAX);
        hint(err, "share the file itself, or remove comments and tables");
        return MOTUS_LIMIT;
    }
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

/* The methods asked for, the main one first; "": none. NULL: out of memory. */
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

/* A number of the command line as the language reads it: as typed if the language reads the same value, else its
 * digits (for .5 and 1.). */
static void number_of(double value, const char *typed, char *out, size_t size)
{
    motus_text_def def = motus_default_text();
    motus_system *system = NULL;
    motus_settings settings = motus_default_settings();
    char model[256];
    int n = snprintf(model, sizeof model, "s' = 0\ns(0) = 0\nuntil %s\n", typed);
    def.text = model;
    if (n > 0 && (size_t)n < sizeof model && motus_system_from_text(&def, &system, NULL) == MOTUS_OK)
        motus_settings_of(system, &settings);
    bool same = system && settings.until == value;
    motus_system_destroy(system);
    char digits[DECIMAL_MAX];
    decimal(value, digits);
    snprintf(out, size, "%s", same ? typed : digits);
}

static motus_status gather(items *all, const load *m, const options *o, const char *methods, char **fragment,
                           motus_error *err)
{
    char step[256], until[256], tolerance[DECIMAL_MAX], accuracy[DECIMAL_MAX];
    all->list[all->count++] = (item){'v', "1"};
    all->list[all->count++] = (item){'m', m->text};
    for (size_t k = 0; k < o->set.count; k++) all->list[all->count++] = (item){'s', o->set.items[k]};
    if (*methods) all->list[all->count++] = (item){'a', methods};
    if (o->step_typed) {
        number_of(o->step, o->step_typed, step, sizeof step);
        all->list[all->count++] = (item){'h', step};
    }
    if (!isnan(o->tolerance)) {
        decimal(o->tolerance, tolerance);
        all->list[all->count++] = (item){'r', tolerance};
    }
    if (!isnan(o->accuracy)) {
        decimal(o->accuracy, accuracy);
        all->list[all->count++] = (item){'g', accuracy};
    }
    if (o->until_typed) {
        number_of(o->until, o->until_typed, until, sizeof until);
        all->list[all->count++] = (item){'T', until};
    }
    return write_items(all, o, fragment, err);
}

motus_status share_fragment(const load *m, const options *o, char **fragment, motus_error *err)
{
    enum { OTHERS = 7 }; /* v m a h r g T */
    if (o->absolute) {
        const bool accuracy = !isnan(o->accuracy);
        fail(err, MOTUS_ARGUMENT, "a link holds a relative %s, and this one is absolute",
             accuracy ? "accuracy" : "tolerance");
        hint(err, "write `%s … absolute` into the model, or give --%s as a number alone",
             accuracy ? "accuracy" : "tolerance", accuracy ? "accuracy" : "tolerance");
        return MOTUS_ARGUMENT;
    }
    char *methods = methods_of(o);
    for (size_t k = 0; k < o->set.count; k++)
        if (components_are(o->set.items[k])) {
            free(methods);
            fail(err, MOTUS_ARGUMENT, "--set %s: a link holds vectors as a whole", o->set.items[k]);
            hint(err, "set all components: \"r(0) = (1, 0)\"");
            return MOTUS_ARGUMENT;
        }
    items all = {malloc((o->set.count + OTHERS) * sizeof *all.list), 0};
    motus_status status;
    if (methods && all.list)
        status = gather(&all, m, o, methods, fragment, err);
    else
        status = complain_memory(err);
    free(all.list);
    free(methods);
    return status;
}

/* Checks that the methods exist, as compare would; *fits: one that admits the model, for check_run(). */
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

/* Checks the request by creating the run that it describes. */
static motus_status check_run(const load *m, const options *o, motus_error *err)
{
    motus_run_def def = motus_default_run();
    motus_run *run = NULL;
    def.method = o->method;
    def.step = o->step;
    def.until = o->until;
    def.machine = "interpreter"; /* compiles nothing */
    motus_status status = o->verb == VERB_COMPARE ? check_methods(m, o, &def.method, err) : MOTUS_OK;
    if (!status) status = motus_run_create(m->system, &def, &run, err);
    motus_run_destroy(run);
    return status;
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
