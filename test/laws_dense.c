/* LAWS OF DENSE OUTPUT: the local order of the state within a step, in positions and in velocities.
 *
 * Invariant: orders are those of the interpolant: Hermite's has local errors h⁶ and h⁵, where the step itself is
 * better; the polynomial of s > 4 collocated accelerations h^(s+2) and h^(s+1).
 */
#include "core/rows.h"
#include "test/laws.h"

#include <math.h>
#include <stdio.h>

typedef struct error {
    quad x, v;
} error;

static error at(method m, const quad_problem *p, quad h)
{
    const quad part = Q(0.3), start = Q(0.75);
    quad_state is = {0}, due;
    error e = {0, 0};
    for (size_t k = 0; k < p->nx; k++) is.x[k] = p->x[k];
    for (size_t k = 0; k < p->nv; k++) is.v[k] = p->v[k];
    due = is;
    quad_reference(p, start, start + part * h, &due);
    if (quad_dense(m, p, start, h, part, &is).bad) return (error){-1, -1};
    for (size_t k = 0; k < p->nx; k++) {
        if (quad_abs(is.x[k] - due.x[k]) > e.x) e.x = quad_abs(is.x[k] - due.x[k]);
        if (quad_abs(is.v[k] - due.v[k]) > e.v) e.v = quad_abs(is.v[k] - due.v[k]);
    }
    return e;
}

static void order(method m, const quad_problem *p, int x, int v)
{
    const quad h = Q(0.125);
    const error wide = at(m, p, h), narrow = at(m, p, h / 2);
    const double by_x = quad_log2(wide.x / narrow.x), by_v = quad_log2(wide.v / narrow.v);
    char law[64];
    snprintf(law, sizeof law, "dense output on %s", p->name);
    /* where time enters, a derivative may come near 0 within the step, and the error with it */
    const double above = p->time ? INFINITY : 0.5;
    judge(narrow.x > 0 && narrow.v > 0 && by_x > x - 0.5 && by_v > v - 0.5 && by_x < x + above && by_v < v + above,
          row_card(m)->name, law, "x falls by %.2f, v by %.2f orders; due %d and %d", by_x, by_v, x, v);
}

void laws_of_dense(void)
{
    static const int problems[] = {HENON_HEILES, DRIVEN, DAMPED, TANGLED};
    for (method m = 0; m < row_count(); m++) {
        const row *r = &methods_table[m];
        const bool own = (r->family == IMPLICIT || r->family == RADAU) && r->tableau.stages > 4;
        if (row_card(m)->order < 8 || r->adaptive) continue;
        for (size_t i = 0; i < sizeof problems / sizeof *problems; i++)
            if (quad_admits(m, &quad_problems[problems[i]]))
                order(m, &quad_problems[problems[i]], own ? r->tableau.stages + 2 : 6, own ? r->tableau.stages + 1 : 5);
    }
}
