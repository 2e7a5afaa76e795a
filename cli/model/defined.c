/* Quantities that --record adds to a model. See load.h. */
#include "cli/model/load.h"

#include "cli/words/complain.h"
#include "cli/words/options.h"
#include "cli/words/words.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const words[] = {"count", "time", "at"};
enum { WORDS = sizeof words / sizeof *words, NAME = 32 };
#define IS " = "

static bool keeps(const char *item)
{
    for (size_t k = 0; k < WORDS; k++) {
        const size_t length = strlen(words[k]);
        if (strncmp(item, words[k], length) == 0 && item[length] == '(') return item[strlen(item) - 1] == ')';
    }
    return false;
}

static motus_status add(defined *d, const char *item, const char *text, motus_error *err)
{
    char name[NAME];
    size_t number = d->count;
    char **lines = realloc(d->line, (d->count + 1) * sizeof *lines);
    if (!lines) return complain_memory(err);
    d->line = lines;
    do snprintf(name, sizeof name, "recorded%zu", ++number);
    while (strstr(text, name));
    const size_t room = strlen(name) + strlen(IS) + strlen(item) + 1;
    if (!(lines[d->count] = malloc(room))) return complain_memory(err);
    snprintf(lines[d->count++], room, "%s" IS "%s", name, item);
    return MOTUS_OK;
}

motus_status defined_find(defined *d, const char *list, const char *text, motus_error *err)
{
    options_list items;
    *d = (defined){0};
    if (!list) return MOTUS_OK;
    motus_status status = words_part(list, "--record", &items, err);
    if (status) return status;
    size_t length;
    for (size_t k = 0; k < items.count && !status; k++)
        if (keeps(items.items[k]) && !defined_name(d, items.items[k], &length))
            status = add(d, items.items[k], text, err);
    words_free(&items);
    return status;
}

void defined_free(defined *d)
{
    for (size_t k = 0; k < d->count; k++) free(d->line[k]);
    free(d->line);
    *d = (defined){0};
}

const char *defined_name(const defined *d, const char *item, size_t *length)
{
    for (size_t k = 0; k < d->count; k++) {
        const char *const is = strstr(d->line[k], IS);
        if (strcmp(is + strlen(IS), item) != 0) continue;
        *length = (size_t)(is - d->line[k]);
        return d->line[k];
    }
    return NULL;
}

const char *defined_label(const defined *d, const char *column, const char **rest)
{
    for (size_t k = 0; k < d->count; k++) {
        const char *const is = strstr(d->line[k], IS);
        const size_t length = (size_t)(is - d->line[k]);
        if (strncmp(column, d->line[k], length) != 0 || (column[length] >= '0' && column[length] <= '9')) continue;
        *rest = column + length;
        return is + strlen(IS);
    }
    return NULL;
}
