/* Lists of words. */
#include "cli/words/words.h"

#include "cli/words/complain.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Copies a word from *at, which then stands behind it. Returns the end of the copy, which is behind the byte 0. */
static char *copy(char *to, const char **at)
{
    const char *s = *at;
    for (bool quoted = false; *s && (quoted || *s != ' '); s++) {
        unsigned byte;
        int length = 0;
        if (!quoted && sscanf(s, "$'\\x%2x'%n", &byte, &length) == 1 && length > 0) {
            *to++ = (char)byte;
            s += length - 1;
        } else if (*s == '\'')
            quoted = !quoted;
        else if (*s == '\\' && !quoted && s[1])
            *to++ = *++s;
        else
            *to++ = *s;
    }
    *to++ = 0;
    *at = s;
    return to;
}

motus_status words_split(const char *text, char **memory, options_list *list, motus_error *err)
{
    const size_t length = strlen(text);
    *list = (options_list){0};
    *memory = malloc(length + 1);
    list->items = calloc(length / 2 + 4, sizeof *list->items);
    if (!*memory || !list->items) return complain_memory(err);
    char *to = *memory;
    for (const char *at = text; *(at += strspn(at, " "));) {
        list->items[list->count++] = to;
        to = copy(to, &at);
    }
    return MOTUS_OK;
}

void words_free(options_list *list)
{
    free(list->items);
    free(list->text);
    *list = (options_list){0};
}

motus_status words_part(const char *text, const char *option_name, options_list *list, motus_error *err)
{
    size_t most = 1;
    int depth = 0;
    for (const char *s = text; *s; s++) most += *s == ',';
    *list = (options_list){.items = malloc(most * sizeof *list->items), .text = strdup(text)};
    motus_status status = list->items && list->text ? MOTUS_OK : complain_memory(err);
    for (char *s = list->text, *part = s, last = 1; !status && last; s++) {
        depth += (*s == '(' || *s == '[') - (*s == ')' || *s == ']');
        if (*s && !(*s == ',' && depth <= 0)) continue;
        last = *s;
        *s = 0;
        part += strspn(part, " ");
        for (char *tail = s; tail > part && tail[-1] == ' ';) *--tail = 0;
        if (!*part) status = fail(err, MOTUS_ARGUMENT, "%s %s: a name is missing", option_name, text);
        list->items[list->count++] = part;
        part = s + 1;
    }
    if (status) words_free(list);
    return status;
}

motus_status words_add(options_list *list, const char *value, motus_error *err)
{
    const char **items = realloc(list->items, (list->count + 1) * sizeof *items);
    if (!items) return complain_memory(err);
    list->items = items;
    list->items[list->count++] = value;
    return MOTUS_OK;
}
