/* The variables, quantities and invariants of a callback, in the form that a model has, without expressions.
 *
 * Invariant: names are copied, are names of the language and are all different, so that a name finds its column.
 */
#include "api/system/system.h"

#include "lang/text/lex.h"

#include <stdlib.h>
#include <string.h>

/* Checks a name with the lexer of the language: letters of any alphabet, digits, _; not t. */
static motus_status check_name(motus_system *s, const char *name, const char *of, size_t number, motus_error *err)
{
    if (!name) return fail(err, MOTUS_ARGUMENT, "name %zu of the %s is NULL", number + 1, of);
    const size_t length = strlen(name);
    struct source_text text = {name, (uint32_t)(length < SOURCE_BYTES_MAX ? length : SOURCE_BYTES_MAX), NULL, false};
    source src = {.arena = &s->arena, .texts = &text, .count = 1};
    lexer l;
    lex_start(&l, &src, 0);
    const token t = lex_next(&l);
    if (t.kind == TOKEN_NAME && t.at.from == 0 && t.at.to == length && strcmp(name, "t")) return MOTUS_OK;
    fail(err, MOTUS_NAME, "\"%s\" cannot be the name of one of the %s", name, of);
    if (!strcmp(name, "t"))
        hint(err, "t is the time: take another name");
    else
        hint(err, "a name is letters, digits and _, at most %d bytes, and begins with a letter", MOTUS_NAME_MAX - 1);
    return MOTUS_NAME;
}

static motus_status copy_names(motus_system *s, const char *const **names, size_t count, const char *of,
                               motus_error *err)
{
    if (!*names) return MOTUS_OK;
    const char **copies = arena_room(&s->arena, (count + 1) * sizeof *copies);
    for (size_t k = 0; copies && k < count; k++) {
        motus_status status = check_name(s, (*names)[k], of, k, err);
        if (status != MOTUS_OK) return status;
        const size_t bytes = strlen((*names)[k]) + 1;
        char *copy = arena_room(&s->arena, bytes);
        if (!copy) break;
        memcpy(copy, (*names)[k], bytes);
        copies[k] = copy;
    }
    *names = copies;
    return s->arena.failed ? fail(err, MOTUS_MEMORY, "no memory for the names") : MOTUS_OK;
}

/* Adds a variable; several numbers of one name become a family with indices from 1. */
static void add_state(motus_system *s, const char *name, int order, size_t count, size_t base)
{
    model_state *st = &s->states[s->state_count++];
    *st = (model_state){.name = name, .order = order, .dims = count > 1, .hull = count, .base = base};
    st->cells.count = count;
    st->first[0] = st->eq_first[0] = count > 1;
    st->last[0] = st->eq_last[0] = count > 1 ? (int64_t)count : 0;
}

static void add_definition(motus_system *s, const char *name, definition_kind kind, size_t count, size_t first)
{
    model_definition *d = &s->definitions[s->definition_count++];
    *d = (model_definition){.name = name, .kind = kind, .dims = count > 1, .numbers = count, .slot = (uint32_t)first};
    d->first = arena_take(&s->arena, 2 * MAX_DIMS * sizeof *d->first);
    d->last = d->first + MAX_DIMS;
    d->first[0] = count > 1;
    d->last[0] = count > 1 ? (int64_t)count : 0;
}

static void add_definitions(motus_system *s, definition_kind kind, size_t count, const char *const *names,
                            const char *plain)
{
    if (!names && count) add_definition(s, plain, kind, count, 0);
    for (size_t k = 0; names && k < count; k++) add_definition(s, names[k], kind, 1, k);
}

static int by_text(const void *a, const void *b) { return strcmp(*(const char *const *)a, *(const char *const *)b); }

static motus_status all_different(const motus_system *s, motus_error *err)
{
    const size_t count = (size_t)s->state_count + s->definition_count;
    const char **all = take(&s->allocator, count, sizeof *all), *twice = NULL;
    if (!all) return fail(err, MOTUS_MEMORY, "no memory for the names");
    for (size_t k = 0; k < count; k++)
        all[k] = k < s->state_count ? s->states[k].name : s->definitions[k - s->state_count].name;
    qsort(all, count, sizeof *all, by_text);
    for (size_t k = 1; k < count && !twice; k++)
        if (!strcmp(all[k - 1], all[k])) twice = all[k];
    give(&s->allocator, all);
    if (!twice) return MOTUS_OK;
    fail(err, MOTUS_NAME, "two things are called %s", twice);
    hint(err, "positions, first-order variables, quantities and invariants need different names");
    return MOTUS_NAME;
}

static motus_status check_counts(motus_callback_def *def, motus_error *err)
{
    if (!def->quantity) def->quantities = 0;
    if (!def->invariant) def->invariants = 0;
    if (def->quantities > MODEL_LIST_MAX || def->invariants > MODEL_LIST_MAX)
        return fail(err, MOTUS_LIMIT, "a callback has at most %d quantities and %d invariants", MODEL_LIST_MAX,
                    MODEL_LIST_MAX);
    return MOTUS_OK;
}

motus_status stand_in_make(motus_system *s, motus_error *err)
{
    motus_callback_def *def = &s->callback;
    const size_t nx = def->positions, ns = def->first_order;
    motus_status status = check_counts(def, err);
    if (status == MOTUS_OK) status = copy_names(s, &def->names, nx + ns, "positions and first-order variables", err);
    if (status == MOTUS_OK) status = copy_names(s, &def->quantity_names, def->quantities, "quantities", err);
    if (status == MOTUS_OK) status = copy_names(s, &def->invariant_names, def->invariants, "invariants", err);
    if (status != MOTUS_OK) return status;
    s->states = arena_room(&s->arena, ((def->names ? nx + ns : 2) + 1) * sizeof *s->states);
    s->definitions = arena_room(
        &s->arena, ((def->quantity_names ? def->quantities : 1) + (def->invariant_names ? def->invariants : 1) + 1) *
                       sizeof *s->definitions);
    if (!s->states || !s->definitions) return fail(err, MOTUS_MEMORY, "no memory for the system");
    for (size_t k = 0; def->names && k < nx + ns; k++) add_state(s, def->names[k], k < nx ? 2 : 1, 1, k);
    if (!def->names && nx) add_state(s, "x", 2, nx, 0);
    if (!def->names && ns) add_state(s, "s", 1, ns, nx);
    add_definitions(s, DEFINED_QUANTITY, def->quantities, def->quantity_names, "quantity");
    add_definitions(s, DEFINED_INVARIANT, def->invariants, def->invariant_names, "invariant");
    return all_different(s, err);
}
