/* The stack of tasks. */
#include "lang/typeset/typeset_parts.h"

static void push(typesetter *p, task t)
{
    if (p->failed) return;
    if (p->count == p->capacity) {
        uint32_t capacity = p->capacity ? 2 * p->capacity : 128;
        task *more = take_more(p->allocator, p->tasks, p->count, capacity, sizeof *more);
        if (!more) {
            p->failed = true;
            return;
        }
        p->tasks = more;
        p->capacity = capacity;
    }
    p->tasks[p->count++] = t;
}

void typeset_tag(typesetter *p, const char *text) { push(p, (task){.kind = TASK_TAG, .text = text}); }
void typeset_sign(typesetter *p, const char *text) { push(p, (task){.kind = TASK_SIGN, .text = text}); }
void typeset_then(typesetter *p, const tree *t, place at)
{
    push(p, (task){.kind = TASK_TREE, .tree = t, .place = at});
}
void typeset_word(typesetter *p, task_kind kind, const char *name) { push(p, (task){.kind = kind, .text = name}); }
