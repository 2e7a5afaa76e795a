/* The names of events: from the text, or event1, event2 … */
#include "lang/read/read_steps.h"

#include "base/near.h"
#include "lang/model/symbols.h"

#include <stdio.h>
#include <string.h>

static const char *own_name(model *m, uint32_t number)
{
    char name[32];
    const int length = snprintf(name, sizeof name, "event%u", number);
    return arena_text(m->arena, name, (size_t)length);
}

/* Returns the rule of a name, or NULL. Names are few, or rarely sought. */
static const model_rule *find(const model *m, const char *name)
{
    for (uint32_t i = 0; i < m->rule_count; i++)
        if (!strcmp(m->rules[i].name, name)) return &m->rules[i];
    return NULL;
}

static const span *where(const statement *s) { return s->name ? &s->name_at : &s->at; }

static bool free_name(model *m, const statement *s, const char *name)
{
    const symbol known = symbols_find(m, name);
    const model_rule *other = find(m, name);
    if (other) {
        source_complain(&m->source, MOTUS_NAME, where(s), "two events are named %s; the first is in line %d", name,
                        source_line(&m->source, &other->statement->at));
        source_hint(&m->source,
                    s->name ? "take another name" : "this one is named %s, because it has no name of its own", name);
        return false;
    }
    if (!known.state && !known.definition && !known.function) return true;
    source_complain(&m->source, MOTUS_NAME, where(s), "%s is %s already and cannot name an event", name,
                    known.state        ? "a state"
                    : known.definition ? "defined"
                                       : "a function");
    source_hint(&m->source, "take another name behind `as`");
    return false;
}

bool rule_names_unknown(model *m, const span *at, const char *name)
{
    char text[80];
    source_complain(&m->source, MOTUS_NAME, at, "there is no event %s", quote(m, at, text));
    for (uint32_t i = 0; name && i < m->rule_count; i++)
        if (near_likely(name, m->rules[i].name)) {
            source_hint(&m->source, "did you mean %s?", m->rules[i].name);
            source_repair(&m->source, name, "%s", m->rules[i].name);
            break;
        }
    return false;
}

/* Finds the rule of `when NAME accumulates`. */
static bool find_accumulating(model *m, model_rule *r)
{
    const when *w = r->statement->when;
    const model_rule *of = find(m, w->of);
    if (!of) {
        rule_names_unknown(m, &w->of_at, w->of);
        source_hint(&m->source, "an event gets its name by `as`: when y = 0 as %s: …", w->of);
        return false;
    }
    const int kind = of->statement->when->kind;
    if (kind == WHEN_EVERY || kind == WHEN_ACCUMULATES) {
        source_complain(&m->source, MOTUS_ARGUMENT, &w->of_at, "%s cannot accumulate: %s", w->of,
                        kind == WHEN_EVERY ? "it happens at equal intervals" : "it is an accumulation itself");
        return false;
    }
    r->of = (size_t)(of - m->rules);
    return true;
}

bool rule_names_all(model *m)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < m->statements.count; i++) count += m->statements.item[i].kind == STATEMENT_WHEN;
    if (!count) return true;
    m->rules = arena_room(m->arena, count * sizeof *m->rules);
    if (!m->rules) return false;
    for (uint32_t i = 0; i < m->statements.count; i++) {
        statement *s = &m->statements.item[i];
        if (s->kind != STATEMENT_WHEN) continue;
        if (m->rule_count == RULES_MOST) {
            source_complain(&m->source, MOTUS_LIMIT, &s->at, "a model has at most %d events", RULES_MOST);
            source_hint(&m->source, "a family, when … for i = 1..N, is one event however large N is");
            return false;
        }
        const char *name = s->name ? s->name : own_name(m, m->rule_count + 1);
        if (m->arena->failed || !free_name(m, s, name)) return false;
        m->rules[m->rule_count++] = (model_rule){.name = s->name = name, .statement = s};
    }
    for (uint32_t i = 0; i < m->rule_count; i++)
        if (m->rules[i].statement->when->kind == WHEN_ACCUMULATES && !find_accumulating(m, &m->rules[i])) return false;
    return true;
}
