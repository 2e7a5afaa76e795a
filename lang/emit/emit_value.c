/* Values: their names, and the C text that computes them. */
#include "lang/emit/emit_parts.h"

#include <stdio.h>
/* Writes the name of a value where it is needed, as wide as `user`; what was bound with the parameters is in u. */
void emit_operand(writer *w, node n, node user, char out[48])
{
    uint32_t home = plan_home(&w->plan, w->plan.g->nodes[n].deps, w->region);
    uint32_t item = plan_find(&w->plan, n, home);
    bool spread = emit_wide(w, user) && !emit_wide(w, n);
    const char *open = spread ? "MANY(" : "", *close = spread ? ")" : "";
    /* it is computed in this function */
    bool mine = w->part == BINDING || (w->part == BINDING_LANES && emit_wide(w, n));
    if (home != AT_BIND || mine || w->plan.g->nodes[n].op == OP_CONST)
        snprintf(out, 48, "%sr%u%s", open, item, close);
    else if (emit_wide(w, n))
        snprintf(out, 48, "AT(w, %u)", w->fixed[item]);
    else
        snprintf(out, 48, "%su[%u]%s", open, w->fixed[item], close);
}

/* Writes the store of an acceleration by the window, as PUT. A cell with an equation of its own may be outside the
 * window. */
static void write_put(writer *w, const output *o, const char *value)
{
    char index[PLACE_MAX], place[PLACE_MAX];
    emit_element(w, &o->to, o->to.dims, place);
    if (o->loops == 0) {
        emit_bound(w, &o->to.at[0], index);
        emit_line(w, "if (%s >= from && %s < to)", index, index);
    }
    emit_line(w, "%s%s(%s, %s);", o->loops ? "" : "    ", w->along < 0 ? "PUT" : "PUTS", place, value);
}

/* Divides stores. A compiler compares every store with those before it, in quadratic time and memory: 4000 variables
 * took 14 s and 480 MB. It does not look past a place where memory may have changed. */
static void divide_stores(writer *w)
{
    enum { STORES_TOGETHER = 64 };
    if (w->plan.regions.at[w->region].level < 0 && ++w->stores % STORES_TOGETHER == 0)
        emit_line(w, "__asm__ volatile(\"\" ::: \"memory\");");
}

void emit_outputs(writer *w, uint32_t first)
{
    char name[48], value[64], where[PLACE_MAX];
    for (uint32_t k = first; k != NONE && w->part == RUNNING; k = w->plan.next_output[k]) {
        const output *o = &w->plan.program->outputs[k];
        const bool spread = (w->e->lanes || w->along >= 0) && !emit_wide(w, o->value);
        emit_operand(w, o->value, o->value, name);
        snprintf(value, sizeof value, spread ? "MANY(%s)" : "%s", name);
        emit_address(w, &o->to, o->to.dims, where);
        if (w->e->windowed)
            write_put(w, o, value);
        else if (w->along >= 0)
            emit_line(w, "index_store(&%s, %s);", where, value);
        else
            emit_line(w, "%s = %s;", where, value);
        divide_stores(w);
    }
}

static void write_load(writer *w, uint32_t k, const reference *r, bool wide)
{
    char text[3 * PLACE_MAX];
    if (w->along < 0 || !wide) {
        emit_address(w, r, r->dims, text);
        emit_line(w, "const %s r%u = %s;", wide ? "reals" : "double", k, text);
        return;
    }
    switch (emit_spread(w, r)) {
    case TOGETHER:
        emit_address(w, r, r->dims, text);
        emit_line(w, "const reals r%u = index_load(&%s);", k, text);
        break;
    case AROUND:
        emit_around(w, r, text);
        emit_line(w, "const reals r%u = %s;", k, text);
        break;
    case ANYWHERE:
        w->one_by_one = true;
        emit_address(w, r, r->dims, text);
        w->one_by_one = false;
        emit_line(w, "reals r%u;", k);
        emit_line(w, "for (int l = 0; l < WIDTH; l++) LANE_OF(r%u, l) = %s;", k, text);
    }
}

static void write_table(writer *w, uint32_t k, const graph_node *n)
{
    const reference first = {
        .array = (uint16_t)n->a, .dims = 1, .at = {{.level = -1, .slot = -1, .modulus = -1, .literal = 0}}};
    char place[PLACE_MAX];
    emit_element(w, &first, first.dims, place);
    emit_line(w, "const double r%u = motus_table_of(&pool[%s]);", k, place);
}

void emit_item(writer *w, uint32_t k)
{
    const plan_item *item = &w->plan.items.at[k];
    const graph_node *n = &w->plan.g->nodes[item->n];
    const char *type = emit_type(w, item->n);
    char o[3][48], text[EMIT_NUMBER];
    bool term = w->part == RUNNING && w->nature[item->n] & PLAIN_TIME;
    if (term && w->term[item->n] == NONE) return; /* only other terms use it */
    if (term)
        emit_line(w, "const double r%u = T[%u];", k, w->term[item->n]);
    else
        switch (n->op) {
        case OP_CONST:
            emit_number(n->value, text);
            emit_line(w, "const double r%u = %s;", k, text);
            break;
        case OP_TIME: emit_line(w, "const %s r%u = t;", type, k); break;
        case OP_PARAM:
            emit_line(w, emit_wide(w, item->n) ? "const reals r%u = AT(own, %u);" : "const double r%u = pool[%u];", k,
                      n->a);
            break;
        case OP_TABLE: write_table(w, k, n); break;
        case OP_INDEX:
            emit_line(w,
                      n->level == w->along ? "const reals r%u = index_count(j%d);" : "const double r%u = (double)j%d;",
                      k, n->level);
            break;
        case OP_LOAD: write_load(w, k, &w->plan.g->references[n->a], emit_wide(w, item->n)); break;
        case OP_SUM: break; /* its loop has written it */
        default: {
            unsigned op = n->op;
            int arity = operation_at(op)->arity;
            emit_operand(w, n->a, item->n, o[0]);
            if (arity > 1) emit_operand(w, n->b, item->n, o[1]);
            if (arity > 2) emit_operand(w, n->c, item->n, o[2]);
            emit_exact(w, item->n, &op, o);
            arity = operation_at(op)->arity;
            emit_line(w, "const %s r%u = %s_%d(%s%s%s%s%s);", type, k, emit_operation(w, item->n, op), op, o[0],
                      arity > 1 ? ", " : "", arity > 1 ? o[1] : "", arity > 2 ? ", " : "", arity > 2 ? o[2] : "");
        }
        }
    if (w->region == AT_BIND && w->part == (emit_wide(w, item->n) ? BINDING_LANES : BINDING))
        emit_line(w, emit_wide(w, item->n) ? "AT(w, %u) = r%u;" : "u[%u] = r%u;", w->fixed[k], k);
    if (w->part == TERMS && w->term[item->n] != NONE) emit_line(w, "T[%u] = r%u;", w->term[item->n], k);
    emit_outputs(w, item->outputs);
}
