/* Writes a plan as C. The operations and their order are the interpreter's, and so are the bits.
 *
 * Invariant: a value is one `const` of the C block in which the plan computes it; sums follow lang/graph/program.c
 * exactly. A value is `wide`, one number for each lane, or a plain double that all lanes share; MANY spreads a plain
 * one for an operation with a wide one.
 */
#include "lang/emit/emit_parts.h"

/* Writes constants where they are used. */
static void write_constants(writer *w)
{
    const plan_region *bind = &w->plan.regions.at[AT_BIND];
    char number[EMIT_NUMBER];
    for (uint32_t k = 0; k < bind->item_count; k++) {
        uint32_t item = w->plan.order[bind->items + k];
        const graph_node *n = &w->plan.g->nodes[w->plan.items.at[item].n];
        if (n->op != OP_CONST) continue;
        emit_number(n->value, number);
        emit_line(w, "const double r%u = %s; (void)r%u;", item, number, item);
    }
}

static const char parameters[] = "const double *restrict pool, const int64_t *restrict q, ";
static const char silence[] = "    (void)pool, (void)q, (void)u";

static void write_functions(writer *w, const char *name, bool terms)
{
    SAY(w, "static inline void %s_bind(%sdouble *restrict u)\n{\n%s;\n", name, parameters, silence);
    w->part = BINDING;
    write_constants(w);
    emit_region(w, AT_BIND);
    SAY(w, "}\n\n");
    if (w->e->lanes) {
        SAY(w,
            "static inline void %s_bind_lanes(%sconst double *restrict u, const real *restrict own, real *restrict "
            "w)\n{\n%s, (void)own, (void)w;\n",
            name, parameters, silence);
        w->part = BINDING_LANES;
        write_constants(w);
        emit_region(w, AT_BIND);
        SAY(w, "}\n\n");
    }
    if (terms && w->e->terms) {
        SAY(w,
            "static inline void %s_terms(%sconst double *restrict u, const reals t, reals *restrict T)\n{\n%s, "
            "(void)t;\n",
            name, parameters, silence);
        w->part = TERMS;
        write_constants(w);
        emit_region(w, AT_RUN);
        SAY(w, "}\n\n");
    }
    w->part = RUNNING;
    if (w->e->series) {
        emit_series_pass(w, name);
        return;
    }
    SAY(w,
        "%s void %s(%sconst double *restrict u, const real *restrict w, real *restrict own, clock t, "
        "const clock *restrict T, real *restrict x, real *restrict v, real *restrict a, real *restrict "
        "out%s%s)\n{\n%s, "
        "(void)w, (void)own, "
        "(void)t, (void)T, (void)x, (void)v, (void)a, "
        "(void)out%s;\n",
        w->e->separate ? "__attribute__((noinline)) static" : "static inline", name, parameters,
        w->e->windowed ? ", const whole from, const whole to, const window_put *move" : "",
        w->e->along ? ", const real *dx, const real *dv" : "", silence, w->e->along ? ", (void)dx, (void)dv" : "");
    write_constants(w);
    emit_region(w, AT_RUN);
    SAY(w, "}\n\n");
}

bool emit_program(emit *e, const program *p, const char *name, bool terms)
{
    writer w = {.e = e, .region = AT_BIND, .depth = 1, .along = -1, .pairs = NONE};
    if (plan_create(&w.plan, e->text.arena, p, false)) {
        const plan_region *bind = &w.plan.regions.at[AT_BIND];
        w.fixed = arena_room(e->text.arena, (w.plan.items.count + 1) * sizeof *w.fixed);
        w.nature = arena_room(e->text.arena, (w.plan.g->count + 1) * sizeof *w.nature);
        w.term = arena_room(e->text.arena, (w.plan.g->count + 1) * sizeof *w.term);
        if (w.fixed && w.nature && w.term) {
            if (emit_natures(&w, false) && e->lanes) emit_natures(&w, true);
            for (uint32_t k = 0; k < w.plan.g->count; k++) {
                w.term[k] = NONE;
                if (!terms) w.nature[k] &= (uint8_t)~PLAIN_TIME;
            }
            if (terms) emit_terms(&w);
            w.part = RUNNING;
            for (uint32_t k = 0; k < bind->item_count; k++) {
                uint32_t item = w.plan.order[bind->items + k];
                w.fixed[item] = emit_wide(&w, w.plan.items.at[item].n) ? e->fixed_lanes++ : e->fixed++;
            }
            emit_values(&w);
            if (e->two) emit_two_order(&w);
            write_functions(&w, name, terms);
        }
    }
    plan_release(&w.plan);
    return !e->text.arena->failed;
}

/* OF, FUSE and WHEN stay: the C text defines them for doubles and for lanes. */
#define OF(f) OF(f)
#define FUSE(a, b, c) FUSE(a, b, c)
#define WHEN(condition, a, b) WHEN(condition, a, b)

bool emit_operations(emit *e, uint64_t set, const char *type, const char *prefix)
{
    emit_text *t = &e->text;
#define LEAF(...)
#define IN_SET(id) if (set & OPERATION_BIT(id))
#define UNARY(id, spelling, degree, nature, value, derivative, keeps, sums, recurrence) \
    IN_SET(id) emit_add(t, "static inline %s %s_%d(%s a) { return %s; }\n", type, prefix, OP_##id, type, #value);
#define BINARY(id, spelling, degree, nature, value, derivative, keeps, sums, recurrence) \
    IN_SET(id)                                                                           \
    emit_add(t, "static inline %s %s_%d(%s a, %s b) { return %s; }\n", type, prefix, OP_##id, type, type, #value);
#define TERNARY(id, spelling, degree, nature, value, derivative, keeps, sums, recurrence)                             \
    IN_SET(id)                                                                                                        \
    emit_add(t, "static inline %s %s_%d(%s a, %s b, %s c) { return %s; }\n", type, prefix, OP_##id, type, type, type, \
             #value);
#include "lang/base/operations.def"
#undef IN_SET
    return !e->text.arena->failed;
}
