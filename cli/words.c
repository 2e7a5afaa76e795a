/* See words.h. */
#include "cli/words.h"

#include "cli/complain.h"

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
