/* Events: when y = 0 falling as bounce: y′ = −e y′, record. */
#include "lang/typeset/typeset_parts.h"

static void occasion(typesetter *p, const when *w)
{
    typeset_tag(p, w->kind == WHEN_EVERY ? "<mtext>when&#xA0;every&#xA0;</mtext>" : "<mtext>when&#xA0;</mtext>");
    if (w->kind == WHEN_ACCUMULATES) {
        typeset_word(p, TASK_PLAIN, w->of);
        typeset_sign(p, "<mtext>&#xA0;accumulates</mtext>");
        return;
    }
    typeset_then(p, w->left, 0);
    if (w->kind != WHEN_EQUAL) return;
    typeset_sign(p, "<mo>=</mo>");
    typeset_then(p, w->right, 0);
    if (w->direction)
        typeset_sign(p, w->direction > 0 ? "<mtext>&#xA0;rising</mtext>" : "<mtext>&#xA0;falling</mtext>");
}

static void happening(typesetter *p, const action *a)
{
    switch (a->kind) {
    case ACTION_RECORD: typeset_sign(p, "<mtext>record</mtext>"); break;
    case ACTION_STOP:
        typeset_sign(p, a->value ? "<mtext>stop&#xA0;after&#xA0;</mtext>" : "<mtext>stop</mtext>");
        if (a->value) typeset_then(p, a->value, 0);
        break;
    default:
        typeset_then(p, a->target, 0);
        typeset_sign(p, "<mo>=</mo>");
        typeset_then(p, a->value, 0);
    }
}

void typeset_when(typesetter *p, const statement *s)
{
    occasion(p, s->when);
    if (s->name) {
        typeset_sign(p, "<mtext>&#xA0;as&#xA0;</mtext>");
        typeset_word(p, TASK_PLAIN, s->name);
    }
    for (const action *a = s->when->actions; a; a = a->next) {
        typeset_sign(p, a == s->when->actions ? "<mtext>:&#xA0;&#xA0;</mtext>" : "<mo>,</mo><mtext>&#xA0;</mtext>");
        happening(p, a);
    }
}
