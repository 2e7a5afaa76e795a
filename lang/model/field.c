/* See field.h. The force is read cell by cell as polynomials, and their derivatives are compared (algebra.h). */
#include "lang/model/field.h"

#include "lang/graph/graph_place.h"
#include "lang/graph/graph_walk.h"
#include "lang/model/algebra.h"

#include <math.h>
#include <string.h>

enum { WORK = 1500000, WORK_CONSERVED = 200000, DEPTH_MAX = 100 };

typedef struct field {
    algebra algebra;
    space space;
    double sign;
    const double *masses;
    uint32_t cells, room;
    size_t *place;      /* by cell */
    poly *force, *part; /* by cell: the whole force, and a part of it */
    uint32_t *cell;     /* by place: 1 + number of its cell; 0: it has none */
    uint32_t *atom;     /* by cell */
    uint32_t *seen;     /* by atom of the force: 1 + the cell for which it was seen last */
    uint32_t atoms;
    bool refuted; /* the last two derivatives that were compared differ */
} field;

/* Reading ---------------------------------------------------------------------------------------------------------- */

static bool add_cell(field *f, const output *o, const int64_t *index)
{
    algebra *A = &f->algebra;
    uint32_t room = f->room; /* both lists have it */
    if (!arena_more(&A->arena, &f->place, f->cells, &room, sizeof *f->place) ||
        !arena_more(&A->arena, &f->force, f->cells, &f->room, sizeof *f->force))
        return false;
    f->place[f->cells] = graph_element(A->model->arrays, &o->to, index, A->model->ints);
    f->force[f->cells] = algebra_read(A, o->value, index);
    f->cells++;
    return !A->lost;
}

static bool add_cells(field *f, const output *o, int level, int64_t *index)
{
    if (level == o->loops) return add_cell(f, o, index);
    const int64_t *ints = f->algebra.model->ints;
    const int64_t first = graph_subscript(&o->loop[level].first, index, ints),
                  last = graph_subscript(&o->loop[level].last, index, ints);
    for (int64_t k = first; k <= last; k++) {
        index[level] = k;
        if (!add_cells(f, o, level + 1, index)) return false;
    }
    return true;
}

/* Reads the force of every cell. False: no memory, or the algebra is lost. */
static bool read_force(field *f, const model *m)
{
    algebra *A = &f->algebra;
    for (size_t i = 0; i < m->accel_count; i++) {
        int64_t index[MAX_LEVELS] = {0};
        if (!add_cells(f, &m->accel[i], 0, index)) return false;
    }
    f->cell = arena_room(&A->arena, (m->nv + 1) * sizeof *f->cell);
    f->atom = arena_room(&A->arena, (f->cells + 1) * sizeof *f->atom);
    f->part = arena_room(&A->arena, (f->cells + 1) * sizeof *f->part);
    if (!f->cell || !f->atom || !f->part) return false;
    for (uint32_t k = 0; k < f->cells && !A->lost; k++) {
        f->cell[f->place[k]] = k + 1;
        f->atom[k] = algebra_place(A, f->space, f->place[k]);
    }
    f->atoms = A->atom_count;
    f->seen = arena_room(&A->arena, (f->atoms + 1) * sizeof *f->seen);
    return f->seen && !A->lost;
}

/* The derivatives -------------------------------------------------------------------------------------------------- */

static double mass(const field *f, uint32_t cell) { return f->masses ? f->masses[f->place[cell]] : 1; }

/* Returns whether m[i] J[i][k] = sign m[k] J[k][i]. */
static bool same(field *f, const poly *force, uint32_t i, uint32_t k)
{
    algebra *A = &f->algebra;
    if (i == k && f->sign > 0) return true;
    const poly back = algebra_slope(A, force[k], f->atom[i]);
    if (k < i && back) return true; /* cell k has compared them */
    const poly there = algebra_slope(A, force[i], f->atom[k]);
    const poly weighed = algebra_add(A, 0, mass(f, i), there);
    poly apart = algebra_add(A, weighed, -f->sign * mass(f, k), back);
    if (algebra_zero(A, &apart)) return true;
    f->refuted = algebra_differs(A, apart);
    return false;
}

/* Compares the derivatives for all cells that cell i reads in a polynomial. */
static bool same_below(field *f, const poly *force, uint32_t i, poly p, int depth)
{
    algebra *A = &f->algebra;
    if (depth > DEPTH_MAX) return false;
    const algebra_poly of = A->polys[p];
    for (uint32_t k = 0; k < of.count; k++) {
        const algebra_monomial m = A->monomials[of.terms[k].of];
        for (uint32_t j = 0; j < m.count; j++) {
            const uint32_t number = A->powers[m.first + j].atom;
            if (number >= f->atoms || f->seen[number] == i + 1) continue;
            f->seen[number] = i + 1;
            const algebra_atom atom = A->atoms[number];
            const uint32_t other = atom.op == OP_LOAD && atom.space == f->space ? f->cell[atom.at] : 0;
            if (other && !same(f, force, i, other - 1)) return false;
            if (!same_below(f, force, i, atom.a, depth + 1) || !same_below(f, force, i, atom.b, depth + 1))
                return false;
        }
    }
    return !A->lost;
}

static bool symmetric(field *f, const poly *force)
{
    memset(f->seen, 0, f->atoms * sizeof *f->seen);
    for (uint32_t i = 0; i < f->cells; i++)
        if (!same_below(f, force, i, force[i], 0)) return false;
    return true;
}

/* The potential ---------------------------------------------------------------------------------------------------- */

/* How an expression scales under x → c x with c > 0: by c^degree, or by no power (NaN). pole: it may have no value
 * somewhere. */
typedef struct scaling {
    double degree;
    bool pole;
} scaling;

static scaling scaling_of(field *f, poly p, int depth);

static scaling scaling_of_power(field *f, algebra_power p, int depth)
{
    const algebra_atom a = f->algebra.atoms[p.atom];
    const bool root = p.exponent != floor(p.exponent);
    const double low = f->algebra.polys[a.a].low;
    if (a.op == OP_TIME) return (scaling){0, false};
    if (a.op == OP_LOAD) return (scaling){p.exponent, p.exponent < 0 || root};
    const scaling of_a = scaling_of(f, a.a, depth + 1), of_b = scaling_of(f, a.b, depth + 1);
    scaling s = {of_a.degree == 0 && of_b.degree == 0 ? 0 : NAN, of_a.pole || of_b.pole};
    switch ((operation)a.op) {
    case OP_POW:
        s.degree = of_a.degree * p.exponent;
        s.pole |= !(low > 0) && (p.exponent < 0 || (root && !(low >= 0)));
        return s;
    case OP_ABS: s.degree = of_a.degree * p.exponent; break;
    case OP_GT: s.degree = isnan(of_a.degree) ? NAN : 0; break;
    case OP_LOG: s.pole |= !(low > 0); break;
    case OP_ATAN2:
        if (of_a.degree == of_b.degree) s.degree = 0;
        s.pole |= !(f->algebra.polys[a.b].low > 0);
        break;
    case OP_TAN:
    case OP_ASIN: s.pole = true; break;
    default: break;
    }
    s.pole |= p.exponent < 0;
    return s;
}

static scaling scaling_of_term(field *f, uint32_t of, int depth)
{
    const algebra_monomial m = f->algebra.monomials[of];
    scaling s = {0, false};
    for (uint32_t k = 0; k < m.count; k++) {
        const scaling one = scaling_of_power(f, f->algebra.powers[m.first + k], depth);
        s.degree += one.degree;
        s.pole |= one.pole;
    }
    return s;
}

static scaling scaling_of(field *f, poly p, int depth)
{
    if (depth > DEPTH_MAX) return (scaling){NAN, true};
    scaling s = {0, false};
    const algebra_poly of = f->algebra.polys[p];
    for (uint32_t k = 0; k < of.count; k++) {
        const scaling one = scaling_of_term(f, of.terms[k].of, depth);
        if (k == 0) s.degree = one.degree;
        if (one.degree != s.degree) s.degree = NAN;
        s.pole |= one.pole;
    }
    return s;
}

/* Returns whether a term reads no place other than this one. */
static bool own(const field *f, uint32_t of, uint32_t atom, int depth)
{
    const algebra *A = &f->algebra;
    const algebra_monomial m = A->monomials[of];
    bool only = depth <= DEPTH_MAX;
    for (uint32_t k = 0; k < m.count && only; k++) {
        const algebra_atom a = A->atoms[A->powers[m.first + k].atom];
        only = a.op != OP_LOAD || A->powers[m.first + k].atom == atom;
        for (int j = 0; j < 2; j++) {
            const algebra_poly p = A->polys[j ? a.b : a.a];
            for (uint32_t i = 0; i < p.count && only; i++) only = own(f, p.terms[i].of, atom, depth + 1);
        }
    }
    return only;
}

/* Returns whether the potential has one value. Ways round a pole of the force may lead back with another energy, but
 * not if a part of the force has all the poles, is a gradient, and scales as |x|^n with n other than -1: its potential
 * is -x·F/(n + 1), and the rest is a gradient without poles. A force that depends on its own place alone has a
 * potential anyway. */
static bool single(field *f)
{
    algebra *A = &f->algebra;
    bool any = false, rest = false;
    for (uint32_t i = 0; i < f->cells; i++) {
        const algebra_poly force = A->polys[f->force[i]];
        f->part[i] = f->force[i];
        for (uint32_t k = 0; k < force.count; k++) {
            const scaling s = scaling_of_term(f, force.terms[k].of, 0);
            const bool counts = s.pole && !own(f, force.terms[k].of, f->atom[i], 0);
            if (counts && (isnan(s.degree) || fabs(s.degree + 1) < 1e-9)) return f->cells == 1;
            if (!counts) f->part[i] = algebra_without(A, f->part[i], force.terms[k]);
            any |= counts;
            rest |= !counts;
        }
    }
    return !any || !rest || symmetric(f, f->part);
}

/* Returns whether a part of the force that reads other places than its own may jump without a step in its formula,
 * which its derivatives do not show. */
static bool jumps(field *f)
{
    algebra *A = &f->algebra;
    for (uint32_t i = 0; i < f->cells; i++)
        for (uint32_t k = 0; k < A->polys[f->force[i]].count; k++) {
            const uint32_t of = A->polys[f->force[i]].terms[k].of;
            if (algebra_jump(A, of, f->space, f->cell) && !own(f, of, f->atom[i], 0)) return !A->lost;
        }
    return false;
}

bool field_prove(model *m, bool in_v, const double *masses, field_proof *out)
{
    field f = {.space = in_v ? SPACE_V : SPACE_X, .sign = in_v ? -1 : 1, .masses = masses};
    *out = (field_proof){0};
    const bool began = algebra_begin(&f.algebra, m, WORK);
    if (began && read_force(&f, m)) {
        out->jumps = !in_v && jumps(&f);
        out->holds = !out->jumps && symmetric(&f, f.force) && !f.algebra.lost;
        out->refuted = f.refuted;
        out->single = out->holds && !in_v && single(&f) && !f.algebra.lost;
    }
    const bool memory = !f.algebra.arena.failed && !m->arena->failed;
    algebra_end(&f.algebra);
    return memory;
}

/* What is conserved ------------------------------------------------------------------------------------------------ */

/* Returns whether dp/dt = ∂p/∂t + v ∂p/∂x + a ∂p/∂v is zero and p does not jump. */
static bool conserved(field *f, poly p)
{
    algebra *A = &f->algebra;
    for (uint32_t k = 0; k < A->polys[p].count; k++) {
        const uint32_t of = A->polys[p].terms[k].of;
        if (algebra_jump(A, of, SPACE_X, f->cell) || algebra_jump(A, of, SPACE_V, f->cell)) return false;
    }
    poly rate = algebra_slope(A, p, algebra_place(A, SPACE_OUT, 0));
    for (uint32_t k = 0; k < f->cells && !A->lost; k++) {
        rate = algebra_add(A, rate, 1, algebra_times(A, algebra_slope(A, p, f->atom[k]), f->force[k]));
        if (f->place[k] >= A->model->nx) continue;
        const poly by_x = algebra_slope(A, p, algebra_place(A, SPACE_X, f->place[k]));
        rate = algebra_add(A, rate, 1, algebra_times(A, by_x, algebra_of_atom(A, f->atom[k], 1, 1, -INFINITY)));
    }
    return algebra_zero(A, &rate);
}

static bool conserved_cells(field *f, const output *o, int level, int64_t *index)
{
    algebra *A = &f->algebra;
    if (level == o->loops) return conserved(f, algebra_read(A, o->value, index));
    const int64_t *ints = A->model->ints, last = graph_subscript(&o->loop[level].last, index, ints);
    for (int64_t k = graph_subscript(&o->loop[level].first, index, ints); k <= last; k++) {
        index[level] = k;
        if (!conserved_cells(f, o, level + 1, index)) return false;
    }
    return true;
}

bool field_conserves(model *m, const model_definition *d, bool *proved)
{
    field f = {.space = SPACE_V};
    const bool began = algebra_begin(&f.algebra, m, WORK_CONSERVED);
    *proved = began && !m->driven && read_force(&f, m);
    for (size_t k = 0; k < d->output_count && *proved; k++) {
        int64_t index[MAX_LEVELS] = {0};
        *proved = conserved_cells(&f, &d->outputs[k], 0, index) && !f.algebra.lost;
    }
    const bool memory = !f.algebra.arena.failed && !m->arena->failed;
    algebra_end(&f.algebra);
    return memory;
}

bool field_jumps(model *m)
{
    graph *g = m->graph;
    bool found = false;
    for (size_t i = 0; i < m->accel_count && !found; i++) {
        graph_walk w;
        if (!graph_order(g, &m->accel[i].value, 1, DEP_X, true, &w)) return true;
        for (uint32_t k = 0; k < w.count && !found; k++) {
            const graph_node *n = &g->nodes[w.nodes[k]];
            if (n->op == OP_SELECT) n = &g->nodes[n->a];
            if (operation_is((operation)n->op, BENDS | JUMPS)) found = (n->deps & DEP_X) != 0;
        }
        give(&g->arena->allocator, w.nodes);
    }
    return found;
}
