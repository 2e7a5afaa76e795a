/* Words and numbers that a user types. See words.h. */
#include "cli/words/words.h"

#include "base/decimal.h"
#include "cli/words/complain.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Copies a word and a byte 0, and moves *at behind the word. Returns the end of the copy. */
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
    list->items = calloc(length / 2 + 2, sizeof *list->items);
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

/* ---- numbers: the language reads an expression, as the initial value of a small model ---- */

bool typed_decimal(const char *s, double *value)
{
    const bool negative = *s == '-';
    s += negative || *s == '+';
    const size_t length = decimal_read(s, SIZE_MAX, value);
    *value = negative ? -*value : *value;
    return length > 0 && !s[length];
}

bool typed_count(const char *s, int64_t *count, const char **rest)
{
    uint64_t n;
    size_t length = decimal_read_whole(s, SIZE_MAX, &n);
    if (length == 0) return false;
    if (s[length] == 'e' || s[length] == 'E' || s[length] == '.') {
        double d;
        length = decimal_read(s, SIZE_MAX, &d);
        if (!(d >= 1 && d < TYPED_COUNT_MAX) || d != trunc(d)) return false;
        n = (uint64_t)d;
    }
    *count = (int64_t)n;
    *rest = s + length;
    return n >= 1 && n <= INT64_MAX;
}

bool typed_seed(const char *s, uint64_t *seed)
{
    const size_t length = decimal_read_whole(s, SIZE_MAX, seed);
    return length > 0 && !s[length];
}

motus_status typed_constant(const char *expression, const char *where, double *value, motus_error *err)
{
    motus_status status = MOTUS_OK;
    motus_error inner = motus_default_error();
    if (!typed_decimal(expression, value)) { /* a decimal, the usual case, needs no model */
        static const char name[] = "x(0)=";
        size_t length = strlen(expression);
        char *set = malloc(sizeof name + length);
        if (!set) return complain_memory(err);
        memcpy(set, name, sizeof name - 1);
        memcpy(set + sizeof name - 1, expression, length + 1);
        const char *items[] = {set};
        motus_text_def text = motus_default_text();
        text.text = "x' = 0\nx(0) = 0\nstep 1\nuntil 1";
        text.set = items;
        text.set_count = 1;
        motus_system *system = NULL;
        motus_run *run = NULL;
        status = motus_system_from_text(&text, &system, &inner);
        if (!status && motus_velocities(system) != 1) {
            fail(&inner, MOTUS_SHAPE, "%s is not a single number", expression);
            status = MOTUS_SHAPE;
        }
        if (!status) status = motus_run_create(system, NULL, &run, &inner);
        if (!status) status = motus_run_state(run, NULL, value, &inner);
        motus_run_destroy(run);
        motus_system_destroy(system);
        free(set);
        if (status == MOTUS_MEMORY) return complain_memory(err);
    }
    if (!status && isfinite(*value)) return MOTUS_OK;
    fail(err, MOTUS_ARGUMENT, "%s: %s is not a constant", where, *expression ? expression : "nothing");
    if (strchr(expression, ','))
        hint(err, "numbers are written with a point: 0.5");
    else if (status && inner.message[0])
        hint(err, "%s", inner.message);
    else if (!status)
        hint(err, "its value is not finite");
    return MOTUS_ARGUMENT;
}
