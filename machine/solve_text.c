/* See solve_text.h.
 *
 * Invariant: the order of the unknowns, the bandwidths, the colours of columns and the order of all operations are
 * those of core/solver.c, and so are the bits.
 */
#include "machine/solve_text.h"

#include "core/solver.h"
#include "core/stepper_body.h"
#include "machine/machine.h"

typedef struct structure {
    sparse x, v;
    uint32_t *place;
    size_t lower, upper, stages, n;
    bool use_x, use_v;
} structure;

bool solve_text_admits(const model *m, const problem *p, const chosen *chosen)
{
    const size_t stages = (size_t)stepper_plan(p, chosen, NULL).solves;
    return !stages ||
           (!model_has_families(m) && stages * m->nv <= SOLVE_TEXT_MAX && m->graph->count <= SOLVE_OPERATIONS_MAX);
}

size_t solve_text_programs(model *m, const problem *p, const chosen *chosen, composed_program programs[2])
{
    const work plan = stepper_plan(p, chosen, NULL);
    size_t count = 0;
    if (!plan.solves) return 0;
    if (plan.solves_x)
        programs[count++] =
            (composed_program){.program = interpreter_derivative(m, false), .name = "compiled_along_x", .along = true};
    if (p->traits.velocity)
        programs[count++] =
            (composed_program){.program = interpreter_derivative(m, true), .name = "compiled_along_v", .along = true};
    return count;
}

static void release(structure *s, const motus_allocator *a)
{
    solver_release(&s->x, a);
    solver_release(&s->v, a);
    give(a, s->place);
}

/* Finds the structure as solver_create does. */
static bool find(structure *s, const problem *p, const work *plan, const motus_allocator *a)
{
    bool broken = false;
    *s = (structure){.stages = (size_t)plan->solves,
                     .n = (size_t)plan->solves * p->nv,
                     .use_x = plan->solves_x,
                     .use_v = p->traits.velocity};
    s->place = take(a, p->nv, sizeof *s->place);
    bool ok = s->place && (!s->use_x || solver_pattern(p, false, &s->x, a, &broken)) &&
              (!s->use_v || solver_pattern(p, true, &s->v, a, &broken));
    ok = ok && solver_order(p->nv, s->use_x ? &s->x : NULL, s->use_v ? &s->v : NULL, s->place, &s->lower, &s->upper, a);
    ok = ok && (!s->use_x || solver_colour(p->nv, &s->x, a)) && (!s->use_v || solver_colour(p->nv, &s->v, a));
    s->lower = s->lower * s->stages + s->stages - 1;
    s->upper = s->upper * s->stages + s->stages - 1;
    return ok;
}

/* ---- the text ---- */

/* Writes what computes the entries of one derivative, by one evaluation for the columns of a colour. */
static void write_derivative(emit_text *t, const sparse *m, const char *name)
{
    for (size_t colour = 0; colour < m->colours; colour++) {
        const size_t first = m->colour_start[colour], end = m->colour_start[colour + 1];
        for (size_t i = first; i < end; i++) emit_add(t, "    d[%u] = MANY(1.0);\n", m->colour_column[i]);
        emit_add(t,
                 "    compiled_along_%s(host->pool, host->q, host->u, host->bound, host->own, t, (const clock *)0, x, "
                 "v, image, (real *)0, d, d);\n",
                 name);
        for (size_t i = first; i < end; i++) {
            const size_t c = m->colour_column[i];
            emit_add(t, "    d[%zu] = MANY(0.0);\n", c);
            for (size_t e = m->start[c]; e < m->start[c + 1]; e++)
                emit_add(t, "    z->%s[%zu] = image[%u];\n", name, e, m->row[e]);
        }
    }
}

/* Writes matrix -= a ⊗ derivative, column after column. */
static void write_entries(emit_text *t, const structure *s, const sparse *m, const char *name)
{
    const bool diagonal = s->lower + s->upper == 0;
    for (size_t c = 0; c < m->columns; c++)
        for (size_t e = m->start[c]; e < m->start[c + 1]; e++)
            for (size_t i = 0; i < s->stages; i++)
                for (size_t j = 0; j < s->stages; j++) {
                    const size_t row = s->place[m->row[e]] * s->stages + i, column = s->place[c] * s->stages + j;
                    emit_add(t, "    m[%zu] -= a%s[%zu] * z->%s[%zu];\n", diagonal ? row : column * s->n + row, name,
                             i * s->stages + j, name, e);
                }
}

static void write_matrix(emit_text *t, const structure *s)
{
    const bool diagonal = s->lower + s->upper == 0;
    emit_add(t, "static inline void solve_fill(const solving *z, const clock *ax, const clock *av, real *restrict "
                "m)\n{\n    (void)z, (void)ax, (void)av;\n");
    for (size_t k = 0; k < (diagonal ? s->n : s->n * s->n); k++)
        emit_add(t, "    m[%zu] = MANY(%s);\n", k, diagonal || k % (s->n + 1) == 0 ? "1.0" : "0.0");
    if (s->use_x) write_entries(t, s, &s->x, "x");
    if (s->use_v) write_entries(t, s, &s->v, "v");
    emit_add(t, "}\n\n");
}

/* Writes what moves numbers between the arrays of the stages and the order of the unknowns. */
static void write_moves(emit_text *t, const structure *s, size_t nv)
{
    emit_add(t, "static inline void solve_take(const real *restrict r, size_t stride, real *restrict b)\n{\n    "
                "(void)stride;\n");
    for (size_t k = 0; k < nv; k++)
        for (size_t i = 0; i < s->stages; i++)
            emit_add(t, "    b[%zu] = r[%zu * stride + %zu];\n", s->place[k] * s->stages + i, i, k);
    emit_add(t, "}\n\nstatic inline void solve_give(real *restrict r, size_t stride, const real *restrict b)\n{\n    "
                "(void)stride;\n");
    for (size_t k = 0; k < nv; k++)
        for (size_t i = 0; i < s->stages; i++)
            emit_add(t, "    r[%zu * stride + %zu] = b[%zu];\n", i, k, s->place[k] * s->stages + i);
    emit_add(t, "}\n\n");
}

/* Writes what solver_apply does: the diagonal first. */
static void write_apply(emit_text *t, const structure *s, size_t nv)
{
    emit_add(t, "static inline void solve_multiply(const solving *z, clock c, const real *restrict y, real *restrict "
                "out)\n{\n    (void)z, (void)c;\n");
    for (size_t k = 0; k < nv; k++) emit_add(t, "    out[%zu] = y[%zu];\n", k, k);
    for (int off = 0; off < 2; off++)
        for (size_t k = 0; s->use_v && k < s->v.columns; k++)
            for (size_t e = s->v.start[k]; e < s->v.start[k + 1]; e++)
                if (!off && s->v.row[e] == k)
                    emit_add(t, "    out[%zu] = (1.0 + c * z->v[%zu]) * y[%zu];\n", k, e, k);
                else if (off && s->v.row[e] != k)
                    emit_add(t, "    out[%u] += c * z->v[%zu] * y[%zu];\n", s->v.row[e], e, k);
    emit_add(t, "}\n\n");
}

/* Writes what tells whether da/dv does no work, as a gyroscopic row needs: it is antisymmetric to the bit. */
static void write_turns(emit_text *t, const structure *s, bool gyroscopic)
{
    emit_add(t, "static inline mask solve_turns(const solving *z)\n{\n    mask turns = ALWAYS;\n    (void)z;\n");
    for (size_t c = 0; gyroscopic && c < s->v.columns; c++)
        for (size_t e = s->v.start[c]; e < s->v.start[c + 1]; e++) {
            const size_t row = s->v.row[e];
            size_t other = s->v.start[row];
            while (other < s->v.start[row + 1] && s->v.row[other] != c) other++;
            if (row == c || other == s->v.start[row + 1])
                emit_add(t, "    turns = turns & (z->v[%zu] == 0);\n", e);
            else
                emit_add(t, "    turns = turns & (z->v[%zu] == -z->v[%zu]);\n", e, other);
        }
    emit_add(t, "    return turns;\n}\n\n");
}

bool solve_text_single(const work *plan) { return plan->stages <= plan->solves + 1; }

bool solve_text_write(emit_text *t, const composition *c)
{
    const problem *p = c->problem;
    const work plan = stepper_plan(p, c->chosen, NULL);
    structure s;
    const bool ok = find(&s, p, &plan, &c->model->arena->allocator);
    if (ok) {
        const size_t diagonal = s.lower + s.upper == 0;
        emit_add(t,
                 "#define SOLVE_N %zu\n#define SOLVE_LOWER %zu\n#define SOLVE_UPPER %zu\n#define SOLVE_STAGES "
                 "%zu\n#define SOLVE_CONSTANT %d\n",
                 s.n, s.lower, s.upper, s.stages, stepper_fixed(p, &plan) && solve_text_single(&plan));
        emit_add(t,
                 "typedef struct solving { real x[%zu], v[%zu], matrix[%zu], pivot[%zu]; clock a[2 * SOLVE_STAGES * "
                 "SOLVE_STAGES]; bool lossy; } solving;\n\n",
                 s.use_x ? s.x.start[s.x.columns] + 1 : 1, s.use_v ? s.v.start[s.v.columns] + 1 : 1,
                 diagonal ? s.n : s.n * s.n, s.n);
        emit_add(
            t,
            "static inline void solve_derive(const compiled_host *host, clock t, real *x, real *v, solving *z)\n{\n"
            "    real d[%zu], image[%zu];\n    (void)host, (void)t, (void)x, (void)v, (void)z, (void)image;\n",
            p->nv, p->nv);
        for (size_t k = 0; k < p->nv; k++) emit_add(t, "    d[%zu] = MANY(0.0);\n", k);
        if (s.use_x) write_derivative(t, &s.x, "x");
        if (s.use_v) write_derivative(t, &s.v, "v");
        emit_add(t, "}\n\n");
        write_matrix(t, &s);
        write_moves(t, &s, p->nv);
        write_apply(t, &s, p->nv);
        write_turns(t, &s, c->chosen->row->gyroscopic);
    }
    release(&s, &c->model->arena->allocator);
    return ok && !t->arena->failed;
}
