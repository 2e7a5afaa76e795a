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

enum { DEFINITION, STATE, FUNCTION, KINDS };

static const char *name_of(const model *m, uint32_t entry)
{
    const uint32_t k = entry / KINDS;
    return entry % KINDS == STATE        ? m->states[k].name
           : entry % KINDS == DEFINITION ? m->definitions[k].name
                                         : m->functions[k].name;
}

/* Returns the place of a name in the table; entries are KINDS k + kind + 1, and 0 is empty. */
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
    const uint32_t k = entry / KINDS;
    return entry % KINDS == STATE        ? (symbol){.state = &m->states[k]}
           : entry % KINDS == DEFINITION ? (symbol){.definition = &m->definitions[k]}
                                         : (symbol){.function = &m->functions[k]};
}

void symbols_enter(model *m, const char *name, symbol s)
{
    size_t k = s.state        ? (size_t)(s.state - m->states)
               : s.definition ? (size_t)(s.definition - m->definitions)
                              : (size_t)(s.function - m->functions);
    *place(m, name) = (uint32_t)(KINDS * k) + (s.state ? STATE : s.definition ? DEFINITION : FUNCTION) + 1;
}

static bool known(const model *m, const char *name, const char *const *more, uint32_t more_count)
{
    for (uint32_t i = 0; i < more_count; i++)
        if (!strcmp(name, more[i])) return true;
    symbol s = symbols_find(m, name);
    return s.state || s.definition || s.function || !strcmp(name, m->time) || !strcmp(name, "pi") || !strcmp(name, "π");
}

/* Hints that mg, where m and g are names, is no product without a blank [1]. */
static bool product_of_two(model *m, const char *name, const char *const *more, uint32_t more_count)
{
    char left[MOTUS_NAME_MAX];
    for (size_t n = 1; name[n]; n++) {
        if (((unsigned char)name[n] & 0xC0) == 0x80) continue; /* within a character */
        snprintf(left, sizeof left, "%.*s", (int)n, name);
        if (known(m, left, more, more_count) && known(m, name + n, more, more_count)) {
            source_hint(&m->source, "%s is one name; for the product write %s %s", name, left, name + n);
            source_repair(&m->source, name, "%s %s", left, name + n);
            return true;
        }
    }
    return false;
}

static void suggest(model *m, const char *name, const char *const *more, uint32_t more_count, const char *bracket)
{
    const char *best = NULL;
    int least = 7;
    for (uint32_t i = 0; i < more_count; i++)
        if (near_nearer(name, more[i], &least)) best = more[i];
    for (uint32_t i = 0; i < m->state_count; i++)
        if (near_nearer(name, m->states[i].name, &least)) best = m->states[i].name;
    for (uint32_t i = 0; i < m->definition_count; i++)
        if (near_nearer(name, m->definitions[i].name, &least)) best = m->definitions[i].name;
    for (uint32_t i = 0; i < m->function_count; i++)
        if (near_nearer(name, m->functions[i].name, &least)) best = m->functions[i].name;
    char codes[64];
    const bool velocity = !best && !strcmp(name, "v") && symbols_find(m, "x").state;
    if (best && near_look_alike(name, best, codes, sizeof codes))
        source_hint(&m->source, "it looks like %s, which is defined, but is another character (%s)", best, codes);
    else if (product_of_two(m, name, more, more_count))
        return;
    else if (best)
        source_hint(&m->source, "did you mean %s?", best);
    else if (velocity)
        source_hint(&m->source, "the velocity is x'");
    else if (words_function(name) >= 0)
        source_hint(&m->source, "write %s(…)", name);
    else
        source_hint(&m->source, "define it: %s%s = …", name, bracket);
    source_repair(&m->source, name, "%s", best ? best : velocity ? "x'" : "");
}

void symbols_suggest(model *m, const char *name, const char *const *more, uint32_t more_count)
{
    suggest(m, name, more, more_count, "");
}

void symbols_suggest_call(model *m, const char *name)
{
    const char *known[OPERATIONS + 8] = {"sum"};
    uint32_t count = 1;
    for (const char *word; (word = words_called(count - 1));) known[count++] = word;
    suggest(m, name, known, count, "(…)");
}
