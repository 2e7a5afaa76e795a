/* Functions of one's own [16]: a call is the function's expression with the arguments in place of their names.
 *
 * A body uses its arguments, which hide all other names, and the names of the model, but no index of its caller.
 * Functions do not call themselves (classify.c), so the expansion ends.
 */
#include "lang/lower/lower_parts.h"

#include <string.h>

argument *lower_find_argument(const lowering *l, const char *name)
{
    for (uint32_t i = 0; i < l->argument_count; i++)
        if (!strcmp(l->arguments[i].name, name)) return &l->arguments[i];
    return NULL;
}

value lower_argument(lowering *l, argument *a)
{
    value *known = &a->known[a->tree ? l->levels : 0];
    if (known->item || failed(l)) return known->item ? *known : wrong(l);
    lowering inner = *a->caller;
    inner.levels = l->levels;
    inner.terms = l->terms;
    for (int k = a->caller->levels; k < l->levels; k++) {
        inner.low[k] = l->low[k];
        inner.high[k] = l->high[k];
    }
    value v = lower_expression(&inner, a->tree);
    if (!failed(l)) *known = v;
    return v;
}

value lower_function(lowering *l, const tree *call, const model_function *f)
{
    const statement *s = f->statement;
    argument arguments[MODEL_ARGUMENTS_MAX];
    lowering inner = *l;
    if (++inner.chain > MODEL_CHAIN_MAX) {
        source_complain(&l->model->source, MOTUS_LIMIT, call->at, "functions use one another more than %d deep",
                        MODEL_CHAIN_MAX);
        return wrong(l);
    }
    inner.name_count = 0;
    inner.arguments = arguments;
    inner.argument_count = s->applied->count - 1;
    for (uint32_t i = 0; i < inner.argument_count; i++) {
        arguments[i] = (argument){.name = s->applied->item[i + 1]->name, .tree = call->item[i + 1], .caller = l};
        lower_argument(l, &arguments[i]); /* what is wrong with it is wrong whether the function uses it or not */
    }
    if (failed(l)) return wrong(l);
    value v = lower_expression(&inner, s->value);
    if (source_failed(&l->model->source)) {
        char text[80];
        source_hint(&l->model->source, "it is called as %s", quote(l, call->at, text));
    }
    return v;
}
