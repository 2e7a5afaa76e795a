/* The words of the language. See words.h. */
#include "lang/text/words.h"

#include "base/near.h"
#include "lang/base/operation.h"

#include <stdio.h>
#include <string.h>

static const struct {
    const char *name;
    int operation;
} calls[] = {{"dot", CALL_DOT},   {"cross", CALL_CROSS},   {"if", CALL_IF},
             {"diff", CALL_DIFF}, {"interp", CALL_INTERP}, {"spline", CALL_SPLINE}};

enum { STATEMENTS, OTHERS, OF_EVENTS, KEPT, LISTS, MOST = 11 };
static const char *const lists[LISTS][MOST] = {
    [STATEMENTS] = {"method", "step", "tolerance", "accuracy", "from", "until", "every", "exact", "invariant", "when"},
    [OTHERS] = {"t", "pi", "and", "or", "not", "for", "sum", "steps"},
    [OF_EVENTS] = {"rising", "falling", "as", "accumulates", "record", "stop", "after"},
    [KEPT] = {"count", "time", "at"}};

static bool has(int list, const char *name)
{
    size_t i = 0;
    while (lists[list][i] && strcmp(lists[list][i], name)) i++;
    return lists[list][i] != NULL;
}

const char *words_called(size_t k)
{
    for (int op = 0; op < OPERATIONS; op++)
        if (operation_is(op, IS_WORD) && k-- == 0) return operation_at(op)->spelling;
    return k < sizeof calls / sizeof *calls ? calls[k].name : NULL;
}

int words_function(const char *name)
{
    for (int op = 0; op < OPERATIONS; op++)
        if (operation_is(op, IS_WORD) && !strcmp(operation_at(op)->spelling, name)) return op;
    for (size_t i = 0; i < sizeof calls / sizeof *calls; i++)
        if (!strcmp(calls[i].name, name)) return calls[i].operation;
    return -1;
}

bool words_reserved(const char *name) { return has(STATEMENTS, name) || has(OTHERS, name); }

bool words_nearest_statement(const char *name, char *out, size_t size)
{
    int best = 5;
    for (const char *const *word = lists[STATEMENTS]; *word; word++) {
        const int d = near_distance(name, *word, 4);
        if (d < best) snprintf(out, size, "%s", *word), best = d;
    }
    return best < 5;
}

motus_word_kind words_event_kind(const char *name)
{
    return has(OF_EVENTS, name) ? MOTUS_WORD_OPERATOR : has(KEPT, name) ? MOTUS_WORD_FUNCTION : MOTUS_WORD_UNKNOWN;
}

const char *words_at(size_t k)
{
    for (size_t i = 0; words_called(i); i++)
        if (k-- == 0) return words_called(i);
    for (int list = 0; list < LISTS; list++)
        for (const char *const *word = lists[list]; *word; word++)
            if (k-- == 0) return *word;
    return NULL;
}

motus_word_kind words_kind(const char *name)
{
    if (words_function(name) >= 0 || !strcmp(name, "sum")) return MOTUS_WORD_FUNCTION;
    if (has(STATEMENTS, name)) return MOTUS_WORD_SETTING;
    if (!strcmp(name, "t") || !strcmp(name, "pi")) return MOTUS_WORD_KNOWN;
    return words_reserved(name) ? MOTUS_WORD_OPERATOR : MOTUS_WORD_UNKNOWN;
}
