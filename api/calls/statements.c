/* The statements of a model: their kinds, their lines, and their MathML. */
#include "api/system/system.h"
#include "lang/model/symbols.h"
#include "lang/typeset/typeset.h"

size_t motus_statement_count(const motus_system *s) { return s && s->model ? s->model->statements.count : 0; }

static motus_statement_kind kind_of(const model *m, const statement *s)
{
    symbol named = {0};
    switch (s->kind) {
    case STATEMENT_EQUATION: return s->primes == 2 ? MOTUS_STATEMENT_MOTION : MOTUS_STATEMENT_FIRST_ORDER;
    case STATEMENT_START: return MOTUS_STATEMENT_START;
    case STATEMENT_FUNCTION: return MOTUS_STATEMENT_FUNCTION;
    case STATEMENT_EXACT: return MOTUS_STATEMENT_EXACT;
    case STATEMENT_INVARIANT: return MOTUS_STATEMENT_INVARIANT;
    case STATEMENT_WHEN: return MOTUS_STATEMENT_EVENT;
    case STATEMENT_DEFINITION:
        named = symbols_find(m, s->name);
        return named.state                                   ? MOTUS_STATEMENT_BOUNDARY
               : named.definition->kind == DEFINED_PARAMETER ? MOTUS_STATEMENT_PARAMETER
                                                             : MOTUS_STATEMENT_QUANTITY;
    default: return MOTUS_STATEMENT_SETTING;
    }
}

motus_status motus_statement_at(const motus_system *s, size_t k, motus_statement *out)
{
    if (!out || k >= motus_statement_count(s) || motus_struct_check(MOTUS_DEF_STATEMENT, out, NULL) != MOTUS_OK)
        return MOTUS_ARGUMENT;
    model *m = s->model;
    const statement *one = &m->statements.item[k];
    bool set = one->at.text != 0;
    motus_statement ours = {.kind = kind_of(m, one), .name = one->name, .is_set = set};
    if (!set || one->replaced) ours.line = source_line(&m->source, set ? &one->replaced->at : &one->at);
    motus_struct_write(MOTUS_DEF_STATEMENT, &ours, out);
    return MOTUS_OK;
}

const char *motus_statement_mathml(motus_system *s, size_t k)
{
    if (k >= motus_statement_count(s)) return NULL;
    give(&s->allocator, s->mathml);
    s->mathml = typeset_statement(s->model, &s->allocator, k);
    return s->mathml;
}
