/* Helpers that the files of this folder share. */
#ifndef LANG_LOWER_LOWER_PARTS_H
#define LANG_LOWER_LOWER_PARTS_H

#include "lang/lower/lower.h"

#include <stdio.h>

#define COMPLAIN(l, at, ...) (source_complain(&(l)->model->source, MOTUS_SHAPE, (at), __VA_ARGS__))
#define HINT(l, ...) (source_hint(&(l)->model->source, __VA_ARGS__))

/* Returns whether lowering has failed, or must be done again in parts (lower_ghost.c). */
static inline bool failed(const lowering *l)
{
    const model *m = l->model;
    return source_failed(&m->source) || m->graph->too_large || m->cut.wanted;
}

static inline const char *quote(const lowering *l, const span *at, char out[80])
{
    return source_excerpt(&l->model->source, at, out, 80);
}

static inline value scalar(lowering *l, node n)
{
    value v = {.item = arena_take(l->model->arena, sizeof(node))};
    v.item[0] = n;
    return v;
}

static inline value condition(lowering *l, node n)
{
    value v = scalar(l, n);
    v.boolean = true;
    return v;
}

static inline value vector(lowering *l, int count)
{
    value v = {.count = count};
    size_t bytes = sizeof(node) * (size_t)(count ? count : 1);
    v.item = arena_take(l->model->arena, bytes);
    if (!v.item) {
        v.item = arena_take(l->model->arena, ARENA_SPARE);
        v.count = 0;
    }
    return v;
}

static inline value wrong(lowering *l) { return scalar(l, 0); }

/* Switches on or off the simplification that derivatives need. */
static inline void lower_tidy(lowering *l, bool on) { l->model->graph->simplify = l->model->graph->tidy = on; }

static inline node binary(lowering *l, operation op, node a, node b) { return graph_op(l->model->graph, op, a, b, 0); }

/* lower.c. lower_factor lowers what may be a matrix; lower_no_matrix complains if a value is one. */
value lower_factor(lowering *, const tree *);
bool lower_no_matrix(lowering *, const value *, const tree *);

/* lower_direction.c: return sign(u), and a/b, which may be a direction u/|u|. */
node lower_sign(lowering *, node u);
node lower_ratio(lowering *, node a, node b);

/* lower_number.c */
value lower_number(lowering *, const tree *);
value lower_pi(lowering *);

static inline const char *shape_name(const value *v, char out[40])
{
    if (v->boolean) return "a condition";
    if (v->count == 0) return "a number";
    snprintf(out, 40, "a vector of length %d", v->count);
    return out;
}

/* lower_index.c */
const index_name *lower_find_index(const lowering *, const char *name);
bool lower_add_index(lowering *, const loop *, int level, int64_t first, int64_t last);
bool lower_range(lowering *, const loop *, range *, int64_t *low, int64_t *high);
/* Begins to lower, in a copy of a lowering, the right side of another line, which the tree t refers to: its indices are
 * the subscripts of the reference, which are in [low, high]. lines: what such lines are called. Returns false, with a
 * message, if too many use one another. */
bool lower_enter_line(lowering *inner, const tree *t, const statement *line, const reference *, const int64_t low[],
                      const int64_t high[], const char *lines);

/* Returns the value of a subscript as a node. */
node lower_subscript_number(lowering *, const subscript *);

/* lower_function.c: functions of the model, expanded where they are called */
argument *lower_find_argument(const lowering *, const char *name);
value lower_argument(lowering *, argument *);
value lower_function(lowering *, const tree *call, model_function *);

/* lower_table.c: lower interp(…) and spline(…), and an entry of a list whose number moves. lower_moves tells whether an
 * expression uses a state, t, or what follows from them. */
value lower_table(lowering *, const tree *call);
bool lower_moves(const lowering *, const tree *);
value lower_entry(lowering *, const tree *, const model_definition *list);

/* lower_kept.c */
value lower_kept(lowering *, const tree *call);

/* lower_rate.c: returns the highest derivative of a state, where an equation or an event reads it */
value lower_rate(lowering *, const tree *, const model_state *, const reference *, const int64_t low[],
                 const int64_t high[]);

/* lower_diff.c */
value lower_diff(lowering *, const tree *call);

/* lower_name.c: names, and initial values x(0) */
value lower_name(lowering *, const tree *);
value lower_initial(lowering *, const tree *);
value lower_component(lowering *, value, const tree *number, const tree *whole);

#endif
