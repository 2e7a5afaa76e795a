/* Names: what is defined, by which statement, and what was probably meant. */
#include "lang/lower.h"
#include "base/near.h"

#include <stdio.h>
#include <string.h>

static uint32_t hash(const char *name)
{
    uint32_t h = 2166136261u;
    for (; *name; name++)
        h = (h ^ (unsigned char)*name) * 16777619u;
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
    while (m->symbols[i] && strcmp(name_of(m, m->symbols[i] - 1), name))
        i = (i + 1) & (m->symbol_size - 1);
    return &m->symbols[i];
}

symbol symbols_find(const model *m, const char *name)
{
    uint32_t entry = *place(m, name);
    if (!entry)
        return (symbol){0};
    entry--;
    return entry & 1 ? (symbol){.state = &m->states[entry / 2]} : (symbol){.definition = &m->definitions[entry / 2]};
}

static void twice(model *m, const statement *s, span earlier)
{
    source_complain(&m->source, MOTUS_NAME, s->name_at, "%s is defined twice; the first time in line %d", s->name,
                    source_line(&m->source, earlier));
    source_hint(&m->source, "remove one of them, or give it another name");
}

static bool add_state(model *m, const statement *s)
{
    uint32_t *at = place(m, s->name);
    if (!*at) {
        model_state *state = &m->states[m->state_count];
        *state = (model_state){.name = s->name, .at = s->name_at, .order = s->primes, .dims = (int)s->index_count};
        *at = 2 * m->state_count++ + 1 + 1;
        return true;
    }
    model_state *state = &m->states[(*at - 1) / 2];
    if (state->order != s->primes) {
        source_complain(&m->source, MOTUS_NAME, s->name_at, "%s has an equation for %s%s and another for %s%s", s->name, s->name,
                        state->order == 2 ? "''" : "'", s->name, s->primes == 2 ? "''" : "'");
        source_hint(&m->source, "one of them follows from the other: remove it");
    } else if (state->dims == 0) {
        twice(m, s, state->at);
    } else if (state->dims != (int)s->index_count) {
        source_complain(&m->source, MOTUS_SHAPE, s->name_at, "%s has %d ind%s in line %d, but %u here", s->name, state->dims,
                        state->dims == 1 ? "ex" : "ices", source_line(&m->source, state->at), s->index_count);
    }
    return !source_failed(&m->source);
}

static bool add_definition(model *m, const statement *s)
{
    uint32_t *at = place(m, s->name);
    if (*at && (*at - 1) & 1) {
        if (s->index_count > 0 && s->kind == STATEMENT_DEFINITION)
            return true;             /* a boundary line */
        source_complain(&m->source, MOTUS_NAME, s->name_at, "%s has an equation of motion in line %d and cannot be defined besides",
                        s->name, source_line(&m->source, m->states[(*at - 1) / 2].at));
        return false;
    }
    if (*at) {
        twice(m, s, m->definitions[(*at - 1) / 2].statement->name_at);
        return false;
    }
    model_definition *d = &m->definitions[m->definition_count];
    *d = (model_definition){.name = s->name, .statement = s, .dims = (int)s->index_count,
                            .kind = s->kind == STATEMENT_INVARIANT ? DEFINED_INVARIANT : DEFINED_UNKNOWN};
    *at = 2 * m->definition_count++ + 0 + 1;
    return true;
}

/* --set name=expression: a statement of its own text that takes the place of the model's. */
static bool replace(model *m, uint32_t text)
{
    statements set = {0};
    source *s = &m->source;
    span all = {text, 0, s->texts[text].length};
    if (!parse_text(s, text, &set))
        return false;
    if (set.count != 1) {
        source_complain(s, MOTUS_SYNTAX, all, "a setting is one definition");
        source_hint(s, "write --set F=0.2 or --set \"x(0)=1\"");
        return false;
    }
    statement *one = &set.item[0];
    if (one->kind != STATEMENT_DEFINITION && one->kind != STATEMENT_START) {
        source_complain(s, MOTUS_ARGUMENT, all, "only parameters and initial values can be set");
        source_hint(s, "write --set F=0.2 or --set \"x(0)=1\"; method, step and until have options of their own");
        return false;
    }
    for (uint32_t i = 0; one->kind == STATEMENT_DEFINITION && i < m->statements.count; i++)
        if (m->statements.item[i].kind == STATEMENT_EQUATION && !strcmp(m->statements.item[i].name, one->name)) {
            source_complain(s, MOTUS_ARGUMENT, one->name_at, "%s has an equation of motion and cannot be set", one->name);
            source_hint(s, "its initial values can: %s%s(0) = …", one->name, one->index_count ? "[…]" : "");
            return false;
        }
    uint32_t found = 0, kept = 0;
    for (uint32_t i = 0; i < m->statements.count; i++) {
        statement *old = &m->statements.item[i];
        bool same = old->kind == one->kind && !strcmp(old->name, one->name);
        if (one->kind == STATEMENT_START)
            same = same && old->primes == one->primes && one->index_count == 0;     /* x[3](0) is an additional line, before the model's */
        else
            same = same && old->index_count == one->index_count;
        if (same && found++)
            continue;                /* the first has taken the place of all */
        if (same) {
            tree *replaced = old->replaced ? old->replaced : old->value;
            span stood = old->replaced ? old->stood : old->at;
            *old = *one;
            old->replaced = replaced;
            old->stood = stood;
        }
        m->statements.item[kept++] = *old;
    }
    m->statements.count = kept;
    if (found)
        return true;
    if (one->kind == STATEMENT_START) {
        statement *item = arena_grow(m->arena, m->statements.item, m->statements.count * sizeof *item,
                                     (m->statements.count + 1) * sizeof *item);
        if (!item)
            return false;
        item[m->statements.count] = *one;
        m->statements.item = item;
        m->statements.capacity = ++m->statements.count;
        return true;
    }
    for (uint32_t i = 0; i < m->statements.count; i++) {
        const statement *old = &m->statements.item[i];
        if (old->kind != STATEMENT_DEFINITION || strcmp(old->name, one->name))
            continue;
        source_complain(s, MOTUS_ARGUMENT, one->name_at, "%s can only be set as a whole", one->name);
        if (old->value->kind == TREE_LIST)
            source_hint(s, "write %s = [1, 2, …]", one->name);
        else
            source_hint(s, "write it as the model does, in line %d", source_line(s, old->at));
        return false;
    }
    source_complain(s, MOTUS_NAME, one->name_at, "the model has no parameter %s", one->name);
    for (uint32_t i = 0; i < m->statements.count; i++) {
        const statement *old = &m->statements.item[i];
        if (old->kind == STATEMENT_DEFINITION && near_likely(one->name, old->name)) {
            source_hint(s, "did you mean %s?", old->name);
            break;
        }
    }
    return false;
}

bool symbols_collect(model *m, const motus_text_def *def)
{
    if (!parse_text(&m->source, 0, &m->statements))
        return false;
    for (uint32_t i = 0; i < def->set_count; i++)
        if (!replace(m, i + 1))
            return false;
    uint32_t n = m->statements.count;
    m->symbol_size = 16;
    while (m->symbol_size < 4 * n)
        m->symbol_size *= 2;
    m->symbols = arena_room(m->arena, m->symbol_size * sizeof *m->symbols);
    m->states = arena_room(m->arena, (n + 1) * sizeof *m->states);
    m->definitions = arena_room(m->arena, (n + 1) * sizeof *m->definitions);
    if (!m->symbols || !m->states || !m->definitions)
        return false;
    memset(m->symbols, 0, m->symbol_size * sizeof *m->symbols);
    for (uint32_t i = 0; i < n; i++)
        if (m->statements.item[i].kind == STATEMENT_EQUATION && !add_state(m, &m->statements.item[i]))
            return false;
    for (uint32_t i = 0; i < n; i++) {
        const statement *s = &m->statements.item[i];
        if ((s->kind == STATEMENT_DEFINITION || s->kind == STATEMENT_INVARIANT) && !add_definition(m, s))
            return false;
    }
    for (uint32_t i = 0; i < n; i++) {
        statement *s = &m->statements.item[i];
        bool about = s->kind == STATEMENT_EQUATION || s->kind == STATEMENT_START || s->kind == STATEMENT_EXACT ||
                     (s->kind == STATEMENT_DEFINITION && s->index_count > 0);
        model_state *state = about ? symbols_find(m, s->name).state : NULL;
        if (!state)
            continue;
        if (state->last_line)
            m->statements.item[state->last_line - 1].next = i + 1;
        else
            state->line = i + 1;
        state->last_line = i + 1;
    }
    if (m->state_count == 0) {
        source_complain(&m->source, MOTUS_SYNTAX, (span){0, 0, 0}, "there is no equation of motion");
        source_hint(&m->source, "write one: x'' = -x");
        return false;
    }
    return true;
}

static bool known(const model *m, const char *name, const char *const *more, uint32_t more_count)
{
    for (uint32_t i = 0; i < more_count; i++)
        if (!strcmp(name, more[i]))
            return true;
    symbol s = symbols_find(m, name);
    return s.state || s.definition || !strcmp(name, "t") || !strcmp(name, "pi");
}

/* mg where m and g are names: a product wants a blank [1]. */
static bool product_of_two(model *m, const char *name, const char *const *more, uint32_t more_count)
{
    char left[MOTUS_NAME_MAX];
    for (size_t n = 1; name[n]; n++) {
        if (((unsigned char)name[n] & 0xC0) == 0x80)
            continue;                /* within a character */
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
        const char *other = i < more_count ? more[i]
                            : i - more_count < m->state_count ? m->states[i - more_count].name
                                                              : m->definitions[i - more_count - m->state_count].name;
        if (near_nearer(name, other, &least))
            best = other;
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
    else if (parse_function(name) >= 0)
        source_hint(&m->source, "write %s(…)", name);
    else
        source_hint(&m->source, "define it: %s = …", name);
}

/* ---- parameter or quantity? [10] ---- */

static bool moves(model *m, const tree *t, int chain, bool *yes);

static bool definition_moves(model *m, model_definition *d, span at, int chain, bool *yes)
{
    if (d->kind == DEFINED_QUANTITY || d->kind == DEFINED_INVARIANT) {
        *yes = true;
        if (d->kind == DEFINED_QUANTITY || d->progress)
            return true;
    }
    if (d->kind == DEFINED_PARAMETER)
        return true;
    if (d->progress == 1) {
        source_complain(&m->source, MOTUS_NAME, at, "%s is defined by itself, in a circle", d->name);
        source_hint(&m->source, "follow the names on the right side until %s comes back, and cut there", d->name);
        return false;
    }
    if (chain > MODEL_CHAIN_MAX) {
        source_complain(&m->source, MOTUS_LIMIT, at, "definitions use one another more than %d deep", MODEL_CHAIN_MAX);
        return false;
    }
    d->progress = 1;
    bool own = false;
    if (!moves(m, d->statement->value, chain + 1, &own))
        return false;
    d->progress = 0;
    if (d->kind == DEFINED_UNKNOWN)
        d->kind = own ? DEFINED_QUANTITY : DEFINED_PARAMETER;
    else
        d->progress = 2;
    *yes |= own || d->kind == DEFINED_INVARIANT;
    return true;
}

/* The left side of a long chain of operators is followed in the loop: trees lean left. */
static bool moves_inside(model *m, const tree *t, int chain, bool *yes)
{
    for (;;) {
        if (t->kind == TREE_NAME) {
            symbol s = symbols_find(m, t->name);
            if (!strcmp(t->name, "t") || s.state)
                *yes = true;
            else if (s.definition && !definition_moves(m, s.definition, t->at, chain, yes))
                return false;
        }
        if (t->kind == TREE_START || t->count == 0)
            return true;
        for (uint32_t i = 1; i < t->count; i++)
            if (!moves(m, t->item[i], chain, yes))
                return false;
        t = t->item[0];
    }
}

static bool moves(model *m, const tree *t, int chain, bool *yes)
{
    if (m->depth == MODEL_DEPTH_MAX) {
        source_complain(&m->source, MOTUS_LIMIT, t->at, "brackets and definitions within one another are more than %d deep", MODEL_DEPTH_MAX);
        source_hint(&m->source, "use fewer brackets, or fewer definitions within definitions");
        return false;
    }
    m->depth++;
    bool ok = moves_inside(m, t, chain, yes);
    m->depth--;
    return ok;
}

bool symbols_classify(model *m)
{
    bool yes = false;
    for (uint32_t i = 0; i < m->definition_count; i++)
        if (!definition_moves(m, &m->definitions[i], m->definitions[i].statement->name_at, 0, &yes))
            return false;
    for (uint32_t i = 0; i < m->definition_count; i++) {
        model_definition *d = &m->definitions[i];
        d->progress = 0;
        yes = false;
        if (!d->statement->replaced)
            continue;
        if (!moves(m, d->statement->replaced, 0, &yes))
            return false;
        if (yes) {
            source_complain(&m->source, MOTUS_ARGUMENT, d->statement->name_at, "%s is a quantity and follows from the motion", d->name);
            source_hint(&m->source, "parameters and initial values can be set");
            return false;
        }
        if (d->kind != DEFINED_PARAMETER) {
            source_complain(&m->source, MOTUS_ARGUMENT, d->statement->value->at, "%s is a parameter: what it is set to cannot depend on a state or on time", d->name);
            source_hint(&m->source, "a force that moves is written in the model");
            return false;
        }
    }
    return true;
}
