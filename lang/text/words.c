/* The words of the language. See words.h. */
#include "lang/text/words.h"

#include "base/near.h"
#include "lang/base/operation.h"

#include <stdio.h>
#include <string.h>

static const struct {
    const char *name;
    int operation;
} functions[] = {{"sin", OP_SIN},    {"cos", OP_COS},     {"tan", OP_TAN},   {"asin", OP_ASIN},     {"acos", OP_ACOS},
                 {"atan", OP_ATAN},  {"atan2", OP_ATAN2}, {"sinh", OP_SINH}, {"cosh", OP_COSH},     {"tanh", OP_TANH},
                 {"exp", OP_EXP},    {"log", OP_LOG},     {"sqrt", OP_SQRT}, {"cbrt", OP_CBRT},     {"hypot", OP_HYPOT},
                 {"abs", OP_ABS},    {"min", OP_MIN},     {"max", OP_MAX},   {"floor", OP_FLOOR},   {"mod", OP_MOD},
                 {"sign", OP_SIGN},  {"erf", OP_ERF},     {"dot", CALL_DOT}, {"cross", CALL_CROSS}, {"if", CALL_IF},
                 {"diff", CALL_DIFF}};

static const char *const statements_words[] = {"method", "step",  "tolerance", "accuracy",  "from",
                                               "until",  "every", "exact",     "invariant", "when"};
static const char *const other_words[] = {"t", "pi", "and", "or", "not", "for", "sum", "steps"};

int words_function(const char *name)
{
    for (size_t i = 0; i < sizeof functions / sizeof *functions; i++)
        if (!strcmp(functions[i].name, name)) return functions[i].operation;
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

const char *words_at(size_t k)
{
    enum { FUNCTIONS = sizeof functions / sizeof *functions };
    enum { STATEMENTS = sizeof statements_words / sizeof *statements_words };
    enum { OTHERS = sizeof other_words / sizeof *other_words };
    return k < FUNCTIONS                         ? functions[k].name
           : k < FUNCTIONS + STATEMENTS          ? statements_words[k - FUNCTIONS]
           : k < FUNCTIONS + STATEMENTS + OTHERS ? other_words[k - FUNCTIONS - STATEMENTS]
                                                 : NULL;
}

motus_word_kind words_kind(const char *name)
{
    if (words_function(name) >= 0 || !strcmp(name, "sum")) return MOTUS_WORD_FUNCTION;
    for (size_t i = 0; i < sizeof statements_words / sizeof *statements_words; i++)
        if (!strcmp(statements_words[i], name)) return MOTUS_WORD_SETTING;
    if (!strcmp(name, "t") || !strcmp(name, "pi")) return MOTUS_WORD_KNOWN;
    return words_reserved(name) ? MOTUS_WORD_OPERATOR : MOTUS_WORD_UNKNOWN;
}
