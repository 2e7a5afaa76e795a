/* Statements, and the loop that carries out tasks. See typeset.h. */
#include "lang/typeset/typeset_parts.h"

/* Reverses new tasks: they are pushed in reading order, and taken from the end. */
static void reverse(task *tasks, uint32_t count)
{
    for (uint32_t i = 0; i < count / 2; i++) {
        task t = tasks[i];
        tasks[i] = tasks[count - 1 - i];
        tasks[count - 1 - i] = t;
    }
}

static void upright(typesetter *p, const char *name)
{
    if (p->full) return;
    typeset_put(p, "<mtext>");
    typeset_plain(p, name);
    typeset_put(p, "</mtext>");
}

static void do_all(typesetter *p)
{
    reverse(p->tasks, p->count);
    while (p->count && !p->failed) {
        task t = p->tasks[--p->count];
        uint32_t mark = p->count;
        switch (t.kind) {
        case TASK_TREE: typeset_tree(p, t.tree, t.place); break;
        case TASK_NAME: typeset_name(p, t.text); break;
        case TASK_TAIL: typeset_tail(p, t.text); break;
        case TASK_PLAIN: upright(p, t.text); break;
        case TASK_TAG: typeset_put(p, t.text); break;
        case TASK_SIGN: typeset_put(p, p->full ? "" : t.text); break;
        }
        reverse(p->tasks + mark, p->count - mark);
    }
}

/* Writes the ranges: for i = 1, …, N and j = 1, 2. */
static void ranges(typesetter *p, const statement *s)
{
    for (uint32_t i = 0; i < s->loop_count; i++) {
        const loop *l = &s->loops[i];
        double more =
            l->first->kind == TREE_NUMBER && l->last->kind == TREE_NUMBER ? l->last->number - l->first->number : 2;
        typeset_tag(p, i ? "<mtext>&#xA0;and&#xA0;</mtext>"
                         : "<mspace width=\"2em\"/><mrow class=\"for\"><mtext>for&#xA0;</mtext>");
        typeset_range(p, l, more == 0 ? NULL : more == 1 ? "<mo>,</mo>" : "<mo>,</mo><mi>…</mi><mo>,</mo>", 0);
    }
    if (s->loop_count) typeset_tag(p, "</mrow>");
}

static void setting(typesetter *p, const statement *s)
{
    typeset_put(p, "<mtext>");
    typeset_plain(p, s->name);
    typeset_put(p, "&#xA0;");
    if (s->kind == STATEMENT_METHOD) typeset_plain(p, s->text);
    typeset_put(p, "</mtext>");
    if (s->kind == STATEMENT_METHOD) return;
    typeset_then(p, s->value, 0);
    if (s->steps) typeset_sign(p, "<mtext>&#xA0;steps</mtext>");
}

static char *write_statement(typesetter *p, const statement *s)
{
    /* the left side is an expression, too: a name, its value at a time, which is t for an exact motion, or a function
     * of its arguments */
    tree name = {.kind = TREE_NAME,
                 .name = s->name,
                 .primes = s->primes,
                 .item = s->index,
                 .count = s->index_count,
                 .index_count = s->index_count};
    tree time = {.kind = TREE_NAME, .name = p->model->time};
    tree exact = {.kind = TREE_APPLY, .item = (tree *[]){&name, &time}, .count = 2};
    typeset_put(p, "<math xmlns=\"http://www.w3.org/1998/Math/MathML\" display=\"block\">");
    if (s->kind == STATEMENT_TIME) {
        typeset_put(p, "<mtext>time&#xA0;</mtext>");
        typeset_then(p, &name, 0);
    } else if (s->kind >= STATEMENT_METHOD) {
        setting(p, s);
    } else if (s->kind == STATEMENT_WHEN) {
        typeset_when(p, s);
        ranges(p, s);
    } else {
        typeset_then(p, s->kind == STATEMENT_EXACT ? &exact : s->applied ? s->applied : &name, 0);
        typeset_tag(p, "<mo>=</mo>");
        typeset_then(p, s->value, 0);
        ranges(p, s);
    }
    typeset_tag(p, "</math>");
    do_all(p);
    give(p->allocator, p->tasks);
    if (!p->failed) return p->text;
    give(p->allocator, p->text);
    return NULL;
}

char *typeset_statement(const model *m, const motus_allocator *a, size_t k)
{
    typesetter p = {.model = m, .allocator = a};
    const statement *s = &m->statements.item[k];
    if (s->kind == STATEMENT_METHOD) return write_statement(&p, s);
    arena trees;
    arena_init(&trees, a);
    statement again;
    char *text = parse_again(&m->source, s, &trees, &again) ? write_statement(&p, &again) : NULL;
    arena_release(&trees);
    return text;
}
