/* See columns.h. */
#include "cli/model/columns.h"

#include "base/decimal.h"
#include "cli/files/file.h"
#include "cli/words/complain.h"

#include <stdlib.h>
#include <string.h>

/* Returns where the file of a setting begins; NULL: it names none. */
static const char *file_of(const char *item)
{
    const char *s = strchr(item, '=');
    if (!s) return NULL;
    s += 1 + strspn(s + 1, " ");
    return *s == '@' ? s + 1 : NULL;
}

static motus_status write_list(columns_list *to, const char *item, motus_error *err)
{
    const size_t name = strcspn(item, "=");
    char *s = to->text = malloc(name + 8 + to->of.count * (DECIMAL_MAX + 2));
    if (!s) return complain_memory(err);
    memcpy(s, item, name);
    s += name;
    *s++ = '=';
    for (uint64_t k = 0; k < to->of.count; k++) {
        *s++ = k ? ',' : '[';
        if (k) *s++ = ' ';
        s += strlen(decimal(to->of.value[k], s));
    }
    memcpy(s, "]", 2);
    return MOTUS_OK;
}

motus_status columns_set(columns *c, options *o, motus_error *err)
{
    motus_status status = MOTUS_OK;
    const char *const out[] = {o->output, o->events, o->plot, o->save_state};
    *c = (columns){.list = calloc(o->set.count + 1, sizeof *c->list)};
    if (!c->list) return complain_memory(err);
    for (size_t k = 0; k < o->set.count && !status; k++) {
        const char *const file = file_of(o->set.items[k]);
        if (!file) continue;
        columns_list *const to = &c->list[c->count++];
        status = column_of(file, &to->path, &to->of, err);
        for (size_t i = 0; !status && i < sizeof out / sizeof *out; i++)
            if (out[i] && file_same(out[i], to->path))
                status = fail(err, MOTUS_ARGUMENT, "%s is read and would be overwritten", out[i]);
        if (!status) status = write_list(to, o->set.items[k], err);
        if (!status) o->set.items[k] = to->text;
    }
    return status;
}

void columns_tell(const columns *c, motus_error *err)
{
    for (size_t k = 0; k < c->count; k++) {
        const columns_list *const one = &c->list[k];
        const size_t name = one->text ? strcspn(one->text, " =") : 0;
        char *end;
        if (!name || strncmp(err->variable, one->text, name) != 0 || err->variable[name] != '[') continue;
        const unsigned long long number = strtoull(err->variable + name + 1, &end, 10);
        if (strcmp(end, "]") != 0 || number < 1 || number > one->of.count) continue;
        hint(err, "%s stands in line %lld of %s", err->variable, one->of.line[number - 1], one->path);
    }
}

void columns_free(columns *c)
{
    for (size_t k = 0; k < c->count; k++) {
        free(c->list[k].text);
        free(c->list[k].path);
        column_free(&c->list[k].of);
    }
    free(c->list);
    *c = (columns){0};
}
