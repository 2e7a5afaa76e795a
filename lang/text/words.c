/* The words of the language. See words.h. */
#include "lang/text/words.h"

#include "base/near.h"
#include "lang/base/operation.h"

#include <stdio.h>
#include <string.h>

static const struct {
    const char *name;
    int operation;
} calls[] = {{"dot", CALL_DOT}, {"cross", CALL_CROSS}, {"if", CALL_IF}, {"diff", CALL_DIFF}};

static const char *const statements_words[] = {"method", "step",  "tolerance", "accuracy",  "from",
                                               "until",  "every", "exact",     "invariant", "when"};
static const char *const other_words[] = {"t", "pi", "and", "or", "not", "for", "sum", "steps"};
static const char *const event_words[] = {"rising", "falling", "as", "accumulates", "record", "stop", "after"};
static const char *const kept_words[] = {"count", "time", "at"};

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

bool words_reserved(const char *name)
{
    for (size_t i = 0; i < sizeof statements_words / sizeof *statements_words; i++)
        if (!strcmp(statements_words[i], name)) return true;
    for (size_t i = 0; i < sizeof other_words / sizeof *other_words; i++)
        if (!strcmp(other_words[i], name)) return true;
    return false;
}

bool words_nearest_statement(const char *name, char *out, size_t size)
{
    int best = 5;
    for (size_t i = 0; i < sizeof statements_words / sizeof *statements_words; i++) {
        int d = near_distance(name, statements_words[i], 4);
        if (d < best) {
            best = d;
            snprintf(out, size, "%s", statements_words[i]);
        }
    }
    return best < 5;
}

motus_word_kind words_event_kind(const char *name)
{
    for (size_t i = 0; i < sizeof event_words / sizeof *event_words; i++)
        if (!strcmp(event_words[i], name)) return MOTUS_WORD_OPERATOR;
    for (size_t i = 0; i < sizeof kept_words / sizeof *kept_words; i++)
        if (!strcmp(kept_words[i], name)) return MOTUS_WORD_FUNCTION;
    return MOTUS_WORD_UNKNOWN;
}

const char *words_at(size_t k)
{
    for (size_t i = 0; words_called(i); i++)
        if (k-- == 0) return words_called(i);
    const struct {
        const char *const *word;
        size_t count;
    } lists[] = {{statements_words, sizeof statements_words / sizeof *statements_words},
                 {other_words, sizeof other_words / sizeof *other_words},
                 {event_words, sizeof event_words / sizeof *event_words},
                 {kept_words, sizeof kept_words / sizeof *kept_words}};
    for (size_t i = 0; i < sizeof lists / sizeof *lists; k -= lists[i++].count)
        if (k < lists[i].count) return lists[i].word[k];
    return NULL;
}

motus_word_kind words_kind(const char *name)
{
    if (words_function(name) >= 0 || !strcmp(name, "sum")) return MOTUS_WORD_FUNCTION;
    for (size_t i = 0; i < sizeof statements_words / sizeof *statements_words; i++)
        if (!strcmp(statements_words[i], name)) return MOTUS_WORD_SETTING;
    if (!strcmp(name, "t") || !strcmp(name, "pi")) return MOTUS_WORD_KNOWN;
    return words_reserved(name) ? MOTUS_WORD_OPERATOR : MOTUS_WORD_UNKNOWN;
}
