/* The symbol table, a hash table with open addressing. See symbols.h. */
#include "lang/model/symbols.h"

#include "base/near.h"
#include "lang/text/words.h"

#include <stdio.h>
#include <string.h>

static uint32_t hash(const char *name)
{
    uint32_t h = 2166136261u;
    for (; *name; name++) h = (h ^ (unsigned char)*name) * 16777619u;
    return h;
}

static const char *name_of(const model *m, uint32_t entry)
{
    return entry & 1 ? m->states[entry / 2].name : m->definitions[entry / 2].name;
}

/* The entry's place in the table; entries are 2 k + is_state + 1, 0 is empty. */
static uint32_t *place(const model *m, const char *name)
{
    uint32_t i = hash(name) & (m->symbol_size - 1);
    while (m->symbols[i] && strcmp(name_of(m, m->symbols[i] - 1), name)) i = (i + 1) & (m->symbol_size - 1);
    return &m->symbols[i];
}

symbol symbols_find(const model *m, const char *name)
{
    uint32_t entry = *place(m, name);
    if (!entry) return (symbol){0};
    entry--;
    return entry & 1 ? (symbol){.state = &m->states[entry / 2]} : (symbol){.definition = &m->definitions[entry / 2]};
}

void symbols_enter(model *m, const char *name, symbol s)
{
    size_t k = s.state ? (size_t)(s.state - m->states) : (size_t)(s.definition - m->definitions);
    *place(m, name) = (uint32_t)(2 * k) + (s.state != NULL) + 1;
}

static bool known(const model *m, const char *name, const char *const *more, uint32_t more_count)
{
    for (uint32_t i = 0; i < more_count; i++)
        if (!strcmp(name, more[i])) return true;
    symbol s = symbols_find(m, name);
    return s.state || s.definition || !strcmp(name, "t") || !strcmp(name, "pi");
}

/* mg where m and g are names: the product needs a blank [1]. */
static bool product_of_two(model *m, const char *name, const char *const *more, uint32_t more_count)
{
    char left[MOTUS_NAME_MAX];
    for (size_t n = 1; name[n]; n++) {
        if (((unsigned char)name[n] & 0xC0) == 0x80) continue; /* within a character */
        snprintf(left, sizeof left, "%.*s", (int)n, name);
        if (known(m, left, more, more_count) && known(m, name + n, more, more_count)) {
            source_hint(&m->source, "%s is one name; for the product write %s %s", name, left, name + n);
            return true;
        }
    }
    return false;
}

void symbols_suggest(model *m, const char *name, const char *const *more, uint32_t more_count)
{
    const char *best = NULL;
    int least = 7;
    for (uint32_t i = 0; i < more_count + m->state_count + m->definition_count; i++) {
        const char *other = i < more_count                    ? more[i]
                            : i - more_count < m->state_count ? m->states[i - more_count].name
                                                              : m->definitions[i - more_count - m->state_count].name;
        if (near_nearer(name, other, &least)) best = other;
    }
    char codes[64];
    if (best && near_look_alike(name, best, codes, sizeof codes))
        source_hint(&m->source, "it looks like %s, which is defined, but is another character (%s)", best, codes);
    else if (product_of_two(m, name, more, more_count))
        return;
    else if (best)
        source_hint(&m->source, "did you mean %s?", best);
    else if (!strcmp(name, "v") && symbols_find(m, "x").state)
        source_hint(&m->source, "the velocity is x'");
    else if (words_function(name) >= 0)
        source_hint(&m->source, "write %s(…)", name);
    else
        source_hint(&m->source, "define it: %s = …", name);
}

void symbols_suggest_call(model *m, const char *name)
{
    static const char *const known_functions[] = {
        "sin",  "cos",   "tan", "asin", "acos", "atan",  "atan2", "sinh", "cosh", "tanh", "exp",   "log", "sqrt",
        "cbrt", "hypot", "abs", "min",  "max",  "floor", "mod",   "sign", "erf",  "dot",  "cross", "if",  "sum"};
    symbols_suggest(m, name, known_functions, sizeof known_functions / sizeof *known_functions);
}
