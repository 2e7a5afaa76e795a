/* Collects the statements of the text and of --set, and enters states, definitions and functions in the symbol
 * table. */
#include "lang/read/read_steps.h"

#include "base/near.h"
#include "lang/model/symbols.h"

#include <math.h>
#include <string.h>

static void twice(model *m, const statement *s, span earlier)
{
    source_complain(&m->source, MOTUS_NAME, &s->name_at, "%s is defined twice; the first time in line %d", s->name,
                    source_line(&m->source, &earlier));
    if (!strcmp(s->name, "F")) source_hint(&m->source, "remove one of them; Newton's law is written m x'' = F");
    source_hint(&m->source, "remove one of them, or give it another name");
}

/* Makes room for twice as many states, as is due where their number is a power of two. */
static bool more_states(model *m)
{
    const size_t count = m->state_count, room = count ? 2 * count : 1;
    model_state *more = arena_replace(m->arena, m->states, count * sizeof *more, room * sizeof *more);
    if (more) m->states = more;
    return more != NULL;
}

static bool add_state(model *m, const statement *s)
{
    model_state *state = symbols_find(m, s->name).state;
    if (!state) {
        if (!(m->state_count & (m->state_count - 1)) && !more_states(m)) return false;
        state = &m->states[m->state_count++];
        *state = (model_state){.name = s->name, .at = s->name_at, .order = s->primes, .dims = (int)s->index_count};
        symbols_enter(m, s->name, (symbol){.state = state});
        return true;
    }
    if (state->order != s->primes) {
        source_complain(&m->source, MOTUS_NAME, &s->name_at, "%s has an equation for %s%s and another for %s%s",
                        s->name, s->name, state->order == 2 ? "''" : "'", s->name, s->primes == 2 ? "''" : "'");
        if (s->value->kind == TREE_NUMBER)
            source_hint(&m->source, "an initial value is written %s%s(0) = %g", s->name, s->primes == 2 ? "''" : "'",
                        s->value->number);
        source_hint(&m->source, "one of them follows from the other: remove it");
    } else if (state->dims == 0) {
        twice(m, s, state->at);
    } else if (state->dims != (int)s->index_count) {
        source_complain(&m->source, MOTUS_SHAPE, &s->name_at, "%s has %d ind%s in line %d, but %u here", s->name,
                        state->dims, state->dims == 1 ? "ex" : "ices", source_line(&m->source, &state->at),
                        s->index_count);
    }
    return !source_failed(&m->source);
}

static bool add_definition(model *m, const statement *s)
{
    const uint32_t number = 1 + (uint32_t)(s - m->statements.item);
    symbol known = symbols_find(m, s->name);
    if (known.state) {
        if (s->index_count > 0 && s->kind == STATEMENT_DEFINITION) return true; /* a boundary line */
        source_complain(&m->source, MOTUS_NAME, &s->name_at,
                        "%s has an equation of motion in line %d and cannot be defined too", s->name,
                        source_line(&m->source, &known.state->at));
        if (s->value->kind == TREE_NUMBER)
            source_hint(&m->source, "its initial value is written %s(0) = %g", s->name, s->value->number);
        if (s->value->kind == TREE_VECTOR)
            source_hint(&m->source, "remove this line: %s is a vector if its initial value is one, %s(0) = (…, …)",
                        s->name, s->name);
        if (s->value->kind == TREE_NAME && s->value->primes)
            source_hint(&m->source, "its equation makes %s a state: write %s' = %s here, and %s(0) in place of %s'(0)",
                        s->name, s->value->name, s->name, s->name, s->value->name);
        return false;
    }
    if (known.definition) {
        const statement *first = known.definition->statement;
        const bool families = s->kind == STATEMENT_DEFINITION && first->kind == STATEMENT_DEFINITION;
        if (families && s->index_count > 0 && s->index_count == first->index_count) { /* k[3] = 2 beside k[i] = 1 */
            m->statements.item[known.definition->last_line - 1].next = number;
            known.definition->last_line = number;
            return true;
        }
        twice(m, s, first->name_at);
        return false;
    }
    model_definition *d = &m->definitions[m->definition_count++];
    *d = (model_definition){.name = s->name,
                            .statement = s,
                            .last_line = number,
                            .dims = (uint8_t)s->index_count,
                            .first = m->no_extent,
                            .last = m->no_extent,
                            .kind = s->kind == STATEMENT_INVARIANT ? DEFINED_INVARIANT : DEFINED_UNKNOWN};
    symbols_enter(m, s->name, (symbol){.definition = d});
    return true;
}

/* Returns whether a bracket contains only plain names, as in V(q), F(t). */
static bool names_arguments(const tree *applied)
{
    const tree *name = applied->item[0];
    if (name->primes || name->index_count) return false;
    for (uint32_t i = 1; i < applied->count; i++) {
        const tree *t = applied->item[i];
        if (t->kind != TREE_NAME || t->primes || t->index_count || t->bracketed) return false;
        if (words_reserved(t->name) && strcmp(t->name, "t")) return false;
    }
    return true;
}

static bool check_arguments(model *m, const statement *s)
{
    const tree *applied = s->applied;
    if (applied->count - 1 > MODEL_ARGUMENTS_MAX) {
        source_complain(&m->source, MOTUS_LIMIT, &applied->at, "a function has at most %d arguments",
                        MODEL_ARGUMENTS_MAX);
        return false;
    }
    for (uint32_t i = 1; i < applied->count; i++)
        for (uint32_t k = 1; k < i; k++)
            if (!strcmp(applied->item[i]->name, applied->item[k]->name)) {
                source_complain(&m->source, MOTUS_NAME, &applied->item[i]->at, "the argument %s stands twice",
                                applied->item[i]->name);
                return false;
            }
    if (s->loop_count == 0) return true;
    source_complain(&m->source, MOTUS_SHAPE, &s->loops[0].at, "a function cannot be a family");
    source_hint(&m->source, "an index may be an argument: %s(i, …)", s->name);
    return false;
}

/* Enters a function: what looks like an initial value of something that is no state. */
static bool add_function(model *m, statement *s)
{
    symbol known = symbols_find(m, s->name);
    if (known.state && s->applied->count > 2) {
        source_complain(&m->source, MOTUS_SYNTAX, &s->applied->at,
                        "%s has an equation of motion: its bracket holds the start", s->name);
        source_hint(&m->source, "write %s(0) = …, or give the function another name", s->name);
        return false;
    }
    if (known.state || !names_arguments(s->applied)) return true;
    if (known.definition || known.function) {
        const statement *other = known.definition ? known.definition->statement : known.function->statement;
        const bool before = other->at.text == s->at.text && other->at.from > s->at.from;
        twice(m, before ? other : s, before ? s->name_at : other->name_at);
        return false;
    }
    if (s->at.text > 0 && !s->replaced) {
        source_complain(&m->source, MOTUS_NAME, &s->name_at, "the model has no function %s", s->name);
        return false;
    }
    s->kind = STATEMENT_FUNCTION;
    model_function *f = &m->functions[m->function_count++];
    *f = (model_function){.name = s->name, .statement = s};
    symbols_enter(m, s->name, (symbol){.function = f});
    return check_arguments(m, s);
}

/* Refuses method, step and until, which are no parameters. Returns whether it did. */
static bool refuse_setting(model *m, uint32_t text)
{
    static const char *const words[] = {"method", "step", "until"};
    const struct source_text *t = &m->source.texts[text];
    const char *at = t->bytes, *end = at + t->length;
    while (at < end && *at == ' ') at++;
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        const size_t n = strlen(words[i]);
        if ((size_t)(end - at) <= n || memcmp(at, words[i], n) || !strchr(" =", at[n])) continue;
        const uint32_t from = (uint32_t)(at - t->bytes);
        const span word = {text, from, from + (uint32_t)n};
        for (at += n; at < end && strchr(" =", *at);) at++;
        source_complain(&m->source, MOTUS_ARGUMENT, &word,
                        "%s is a setting, and only parameters and initial values can be set", words[i]);
        source_hint(&m->source, "give `%s = %.*s` of the definition", words[i], (int)(end - at > 40 ? 40 : end - at),
                    at);
        return true;
    }
    return false;
}

/* Copies a list, and replaces the entry with the indices of a setting from number `d` on. NULL: there is none, or no
 * memory. */
static tree *with_entry(model *m, const statement *one, const tree *list, uint16_t d)
{
    const tree *const index = one->index[d];
    const bool whole = index->kind == TREE_NUMBER && index->number >= 1 && floor(index->number) == index->number;
    if (list->kind != TREE_LIST || !whole || index->number > list->count) {
        source_complain(&m->source, MOTUS_ARGUMENT, &index->at, "%s has no such entry", one->name);
        source_hint(&m->source, list->kind == TREE_LIST ? "entries have the numbers 1 to %u" : "it has fewer indices",
                    list->count);
        return NULL;
    }
    tree *const copy = arena_room(m->arena, sizeof *copy);
    tree **const item = arena_room(m->arena, list->count * sizeof *item);
    if (!copy || !item) return NULL;
    memcpy(item, list->item, list->count * sizeof *item);
    *copy = *list;
    copy->item = item;
    tree **const at = &item[(size_t)index->number - 1];
    if (d + 1 == one->index_count && (*at)->kind == TREE_LIST) {
        source_complain(&m->source, MOTUS_ARGUMENT, &one->name_at, "an entry of %s has more indices", one->name);
        return NULL;
    }
    *at = d + 1 < one->index_count ? with_entry(m, one, *at, (uint16_t)(d + 1)) : one->value;
    return *at ? copy : NULL;
}

/* Keeps the value of a statement that a setting is to replace. */
static void keep_replaced(model *m, statement *old)
{
    replaced *own = arena_take(m->arena, sizeof *own);
    *own = old->replaced ? *old->replaced : (replaced){old->value, old->at};
    old->replaced = own;
}

/* Replaces statements of the model by name=expression of `set`, a statement in a text of its own. */
static bool replace(model *m, uint32_t text)
{
    statements set = {0};
    source *s = &m->source;
    span all = {text, 0, s->texts[text].length};
    if (refuse_setting(m, text)) return false;
    if (!parse_text(s, text, &set)) return false;
    if (set.count != 1) {
        source_complain(s, MOTUS_SYNTAX, &all, "a setting is one definition");
        source_hint(s, "write F=0.2 or x(0)=1");
        return false;
    }
    statement *one = &set.item[0];
    if (one->kind != STATEMENT_DEFINITION && one->kind != STATEMENT_START) {
        source_complain(s, MOTUS_ARGUMENT, &all, "only parameters and initial values can be set");
        source_hint(s, "write F=0.2 or x(0)=1");
        return false;
    }
    for (uint32_t i = 0; one->kind == STATEMENT_DEFINITION && i < m->statements.count; i++)
        if (m->statements.item[i].kind == STATEMENT_EQUATION && !strcmp(m->statements.item[i].name, one->name)) {
            source_complain(s, MOTUS_ARGUMENT, &one->name_at, "%s has an equation of motion and cannot be set",
                            one->name);
            source_hint(s, "its initial values can: %s%s(0) = …", one->name, one->index_count ? "[…]" : "");
            return false;
        }
    /* x[3](0) = … and k[3] = … are additional lines */
    const bool cell = one->kind == STATEMENT_DEFINITION && one->index_count > 0 && one->loop_count == 0;
    uint32_t found = 0, kept = 0, families = 0;
    for (uint32_t i = 0; i < m->statements.count; i++) {
        statement *old = &m->statements.item[i];
        bool same = old->kind == one->kind && !strcmp(old->name, one->name);
        if (one->kind == STATEMENT_START)
            same = same && old->primes == one->primes && one->index_count == 0;
        else
            same = same && old->index_count == one->index_count;
        families += same && cell;
        same = same && !cell;
        if (same && found++) continue; /* the first is replaced, the others are removed */
        if (same) {
            keep_replaced(m, old);
            replaced *const own = old->replaced;
            *old = *one;
            old->replaced = own;
        }
        m->statements.item[kept++] = *old;
    }
    m->statements.count = kept;
    if (found) return true;
    if (one->kind == STATEMENT_START || families) {
        statement *item = arena_replace(m->arena, m->statements.item, m->statements.count * sizeof *item,
                                        (m->statements.count + 1) * sizeof *item);
        if (!item) return false;
        item[m->statements.count] = *one;
        m->statements.item = item;
        m->statements.capacity = ++m->statements.count;
        return true;
    }
    for (uint32_t i = 0; i < m->statements.count; i++) {
        statement *old = &m->statements.item[i];
        if (old->kind != STATEMENT_DEFINITION || strcmp(old->name, one->name)) continue;
        if (cell && old->value->kind == TREE_LIST) {
            tree *const list = with_entry(m, one, old->value, 0);
            if (!list) return false;
            keep_replaced(m, old);
            old->value = list;
            return true;
        }
        source_complain(s, MOTUS_ARGUMENT, &one->name_at, "%s can only be set as a whole", one->name);
        source_hint(s, "write it as the model does, in line %d", source_line(s, &old->at));
        return false;
    }
    source_complain(s, MOTUS_NAME, &one->name_at, "the model has no parameter %s", one->name);
    for (uint32_t i = 0; i < m->statements.count; i++) {
        const statement *old = &m->statements.item[i];
        if (old->kind == STATEMENT_DEFINITION && near_likely(one->name, old->name)) {
            source_hint(s, "did you mean %s?", old->name);
            break;
        }
    }
    return false;
}

/* Reads a statement that is added to the text: an event or a quantity. */
static bool add_line(model *m, uint32_t text, bool event)
{
    const uint32_t before = m->statements.count;
    if (!parse_text(&m->source, text, &m->statements)) return false;
    const uint32_t lines = m->statements.count - before;
    if (lines == 1 && (event || m->statements.item[before].kind == STATEMENT_DEFINITION)) return true;
    source_complain(&m->source, MOTUS_SYNTAX, &(span){text, 0, m->source.texts[text].length}, "this is %s%s",
                    lines > 1 ? "more than one " : "no ", event ? "event" : "quantity");
    source_hint(&m->source, event ? "write x = 0 rising: record" : "write speed = |x'|");
    return false;
}

static bool defines(const statement *s, const char *name)
{
    return s->kind <= STATEMENT_INVARIANT && !strcmp(s->name, name);
}

/* Finds a name for the time of a model with an equation for t; NULL: all of them are defined. */
static const char *other_time(const model *m)
{
    static const char *const names[] = {"tau", "s", "time"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        bool taken = false;
        for (uint32_t k = 0; k < m->statements.count; k++) taken |= defines(&m->statements.item[k], names[i]);
        if (!taken) return names[i];
    }
    return NULL;
}

/* Names the time: as the model does, or t; if t has an equation, it is a coordinate, and the time is tau. */
static bool name_time(model *m)
{
    source *s = &m->source;
    const statement *named = NULL, *moves = NULL;
    for (uint32_t i = 0; i < m->statements.count; i++) {
        const statement *one = &m->statements.item[i];
        if (one->kind == STATEMENT_EQUATION && !moves && !strcmp(one->name, "t")) moves = one;
        if (one->kind != STATEMENT_TIME) continue;
        if (named)
            source_complain(s, MOTUS_NAME, &one->at, "the time has two names: the first one in line %d",
                            source_line(s, &named->at));
        named = one;
    }
    m->time = named ? named->name : moves ? other_time(m) : "t";
    if (!m->time) {
        source_complain(s, MOTUS_NAME, &moves->name_at, "t has an equation of motion, so the time needs another name");
        source_hint(s, "write it: time lambda");
        m->time = "t";
    }
    for (uint32_t i = 0; i < m->statements.count; i++) {
        const statement *one = &m->statements.item[i];
        if (!defines(one, m->time)) continue;
        source_complain(s, MOTUS_SYNTAX, &one->name_at, "%s is the time and cannot be defined", m->time);
        const bool start = one->kind == STATEMENT_DEFINITION && one->value->kind == TREE_NUMBER;
        if (start) source_hint(s, "write `from %g` for the start of the run, or take another name", one->value->number);
        source_hint(s, "take another name, or name the time: time %s", named ? "lambda" : "tau");
    }
    return !source_failed(s);
}

static bool derives(const tree *t)
{
    for (; t; t = t->count ? t->item[0] : NULL) {
        if (t->kind == TREE_NAME && t->primes) return true;
        for (uint32_t i = 1; i < t->count; i++)
            if (derives(t->item[i])) return true;
    }
    return false;
}

/* Complains that there is no equation of motion; F = m x'' may be meant as one. */
static bool no_equation(model *m)
{
    source *s = &m->source;
    const statement *meant = NULL;
    for (uint32_t i = 0; i < m->statements.count && !meant; i++)
        if (m->statements.item[i].kind == STATEMENT_DEFINITION && derives(m->statements.item[i].value))
            meant = &m->statements.item[i];
    source_complain(s, MOTUS_SYNTAX, meant ? &meant->at : &(span){0, 0, 0}, "there is no equation of motion");
    char text[80], right[80];
    const tree *value = meant ? meant->value : NULL;
    if (value && value->kind == TREE_COMPARE && value->operation == OP_EQ) /* eq = x'' + x == 0 */
        source_hint(s, "write the equation alone, with one =: %s = %s",
                    source_excerpt(s, &value->item[0]->at, text, sizeof text),
                    source_excerpt(s, &value->item[1]->at, right, sizeof right));
    else if (meant)
        source_hint(s, "this line defines %s; an equation has its derivative on the left: %s = %s", meant->name,
                    source_excerpt(s, &meant->value_at, text, sizeof text), meant->name);
    for (uint32_t i = 0; i < m->statements.count; i++)
        if (m->statements.item[i].kind == STATEMENT_START) {
            const char *name = m->statements.item[i].name;
            source_hint(s, "%s has an initial value: write %s'' = … for its acceleration, or %s' = … for its rate",
                        name, name, name);
        }
    source_hint(s, "write one: x'' = -x");
    return false;
}

bool collect_all(model *m, const motus_text_def *def)
{
    if (!parse_text(&m->source, 0, &m->statements)) return false;
    for (uint32_t i = 0; i < def->when_count; i++)
        if (!add_line(m, (uint32_t)def->set_count + i + 1, true)) return false;
    for (uint32_t i = 0; i < def->define_count; i++)
        if (!add_line(m, (uint32_t)(def->set_count + def->when_count) + i + 1, false)) return false;
    for (uint32_t i = 0; i < def->set_count; i++)
        if (!replace(m, i + 1)) return false;
    if (!name_time(m)) return false;
    uint32_t n = m->statements.count;
    uint32_t brackets = 0, definitions = 0;
    for (uint32_t i = 0; i < n; i++) {
        const int kind = m->statements.item[i].kind;
        brackets += kind == STATEMENT_START;
        definitions += kind == STATEMENT_DEFINITION || kind == STATEMENT_INVARIANT;
    }
    m->symbol_size = 16;
    while (m->symbol_size < n + n / 4) m->symbol_size *= 2;
    m->symbols = arena_room(m->arena, m->symbol_size * sizeof *m->symbols);
    m->definitions = arena_room(m->arena, (definitions + 1) * sizeof *m->definitions);
    m->functions = arena_room(m->arena, (brackets + 1) * sizeof *m->functions);
    if (!m->symbols || !m->definitions || !m->functions) return false;
    for (uint32_t i = 0; i < n; i++)
        if (m->statements.item[i].kind == STATEMENT_EQUATION && !add_state(m, &m->statements.item[i])) return false;
    for (uint32_t i = 0; i < n; i++) {
        const statement *s = &m->statements.item[i];
        if ((s->kind == STATEMENT_DEFINITION || s->kind == STATEMENT_INVARIANT) && !add_definition(m, s)) return false;
    }
    for (uint32_t i = 0; i < n; i++)
        if (m->statements.item[i].kind == STATEMENT_START && !add_function(m, &m->statements.item[i])) return false;
    for (uint32_t i = 0; i < n; i++) {
        statement *s = &m->statements.item[i];
        bool about = s->kind == STATEMENT_EQUATION || s->kind == STATEMENT_START || s->kind == STATEMENT_EXACT ||
                     (s->kind == STATEMENT_DEFINITION && s->index_count > 0);
        model_state *state = about ? symbols_find(m, s->name).state : NULL;
        if (!state) continue;
        if (state->last_line)
            m->statements.item[state->last_line - 1].next = i + 1;
        else
            state->line = i + 1;
        state->last_line = i + 1;
    }
    return m->state_count || no_equation(m);
}
