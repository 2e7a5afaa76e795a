/* The typesetter's state, shared by typeset.c (statements), typeset_tree.c, typeset_script.c and typeset_fence.c
 * (expressions), typeset_text.c (characters) and typeset_task.c (tasks).
 *
 * Text still to be written waits as tasks on a stack, so that deep expressions do not exhaust the C stack. A task
 * writes, or replaces itself by other tasks, which typeset_then and the like push in reading order.
 */
#ifndef LANG_TYPESET_TYPESET_PARTS_H
#define LANG_TYPESET_TYPESET_PARTS_H

#include "lang/typeset/typeset.h"

#include <string.h>

/* From loosest to tightest. A quotient is a fraction, which needs no brackets in a product; in small print it is a/b,
 * which does. */
typedef enum tight {
    TIGHT_OR,
    TIGHT_AND,
    TIGHT_NOT,
    TIGHT_COMPARE,
    TIGHT_MOD,
    TIGHT_SUM,
    TIGHT_MINUS,
    TIGHT_DOT,
    TIGHT_SLASH,
    TIGHT_PRODUCT,
    TIGHT_POWER,
    TIGHT_ATOM
} tight;

/* The place of an expression, in one word (a struct would be passed through memory in WebAssembly):
 *
 *     tight    looser expressions get brackets
 *     follow   what stands to the right, outside its brackets: a sum sign would include a factor, a choice anything
 *     element  one element is expected, not a row of elements
 *     small    in a superscript, a subscript or a limit
 *     chain    the left side of the same operator: its terms are counted already
 *     level    the number of expressions around it, in the bits from PLACE_LEVEL on
 */
typedef uint32_t place;
enum {
    PLACE_TIGHT = 0xF,
    FOLLOW_NOTHING = 0,
    FOLLOW_TERM = 0x10,
    FOLLOW_FACTOR = 0x20,
    PLACE_FOLLOW = 0x30,
    PLACE_ELEMENT = 0x40,
    PLACE_SMALL = 0x80,
    PLACE_CHAIN = 0x100,
    PLACE_LEVEL = 0x10000
};

/* A row of its own: in brackets, under a root … */
static inline place place_inside(place at) { return ((at & PLACE_SMALL) | (at & ~0xFFFFu)) + PLACE_LEVEL; }
/* One element of its own: a numerator, a base … */
static inline place place_element(place at) { return place_inside(at) | PLACE_ELEMENT; }
static inline place place_script(place at) { return place_inside(at) | PLACE_ELEMENT | PLACE_SMALL; }
/* In the present row: place_left with something to the right; place_last with what follows the row. */
static inline place place_left(place at, tight t, uint32_t follow) { return place_inside(at) | t | follow; }
static inline place place_last(place at, tight t) { return place_inside(at) | t | (at & PLACE_FOLLOW); }

typedef enum task_kind {
    TASK_TREE,
    TASK_NAME, /* a name without its subscript; TASK_TAIL: its subscript, without the name */
    TASK_TAIL,
    TASK_PLAIN, /* a name as it is typed, upright */
    TASK_TAG,   /* text that opens and closes elements, written whatever has been cut */
    TASK_SIGN   /* text that is left out together with the expressions around it */
} task_kind;

typedef struct task {
    task_kind kind;
    place place;
    union {
        const tree *tree;
        const char *text;
    };
} task;

typedef struct typesetter {
    const model *model;
    const motus_allocator *allocator;
    char *text;
    size_t length, room;
    task *tasks;
    uint32_t count, capacity;
    bool full, failed;
} typesetter;

/* typeset_text.c writes at once */
void typeset_put(typesetter *, const char *text);
void typeset_name(typesetter *, const char *name);
void typeset_tail(typesetter *, const char *name);
bool typeset_has_tail(const char *name);
bool typeset_is_word(const char *name); /* it is set upright, so it needs space in a product */
void typeset_number(typesetter *, const tree *);
bool typeset_has_exponent(const source *, const tree *);
void typeset_plain(typesetter *, const char *text); /* text of the model, which is escaped */

/* typeset_task.c pushes a task */
void typeset_tag(typesetter *, const char *);
void typeset_sign(typesetter *, const char *);
void typeset_then(typesetter *, const tree *, place);
void typeset_word(typesetter *, task_kind, const char *name);
/* typeset_tree.c */
void typeset_tree(typesetter *, const tree *, place);
/* typeset_fence.c writes brackets, as high as necessary, around the items of a tree, with commas, or around a tree
 * itself */
typedef enum fence { FENCE_ROUND, FENCE_SQUARE, FENCE_BARS, FENCE_FLOOR } fence;
void typeset_items(typesetter *, fence, const tree *, place);
void typeset_arguments(typesetter *, const tree *applied, place);
void typeset_itself(typesetter *, fence, const tree *, place);
void typeset_cases(typesetter *, const tree *, place);
/* typeset_when.c writes an event, without the ranges of its indices */
void typeset_when(typesetter *, const statement *);
/* typeset_script.c writes a name with signs about it: x, x_i, x_max″, r_y, x(0), V(a, b) */
typedef struct head {
    const tree *name, *component, *applied;
} head;
bool typeset_head(const tree *, head *);
void typeset_scripted(typesetter *, const head *, const tree *power, place);
void typeset_component(typesetter *, const tree *, place);
void typeset_range(typesetter *, const loop *, const char *between, place); /* between NULL: without the last value */

#define TYPESET_APPLY "<mo>&#x2061;</mo>"

static inline bool typeset_calls(const tree *t, int operation)
{
    return t->kind == TREE_CALL && t->operation == operation;
}

#endif
