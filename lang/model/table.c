/* See table.h. */
#include "lang/model/table.h"

#include "lang/model/vary_record.h"

#include <math.h>
#include <string.h>

/* The columns of TABLE_POINTS: u has the position base + d width/(1 + d bend), d = u - point. */
enum { BASE, POINT, WIDTH, BEND, POINT_COLUMNS };

int table_columns(table_kind kind)
{
    return kind == TABLE_LIST ? 1 : kind == TABLE_POINTS ? POINT_COLUMNS : kind == TABLE_LINEAR ? 3 : 5;
}

static size_t length_of(const model *m, uint16_t list)
{
    const extent *over = m->arrays[list].over;
    return (size_t)(over->last[0] - over->first[0] + 1);
}

/* Numbers ---------------------------------------------------------------------------------------------------------- */

/* Returns what follows from an interval, or NaN where the points do not rise. */
static double within(double width, double value) { return width > 0 ? value : NAN; }

/* Tells whether a row is computed from its right end, where it is then exactly 0. A motion may rest there, and what
 * rounding left from the other end would move it. */
static bool ends_at_zero(const double *y) { return y[1] == 0 && y[0] != 0; }

static void fill_list(double *to, const double *list, size_t n)
{
    to[0] = NAN;
    memcpy(to + 1, list, n * sizeof *to);
}

/* Returns how far a table reaches beyond an end. The last point of a uniform grid is rounded as the first one is. */
static double reach(double end, double other)
{
    const double size = fmax(fabs(end), fabs(other));
    return TABLE_BEYOND * (nextafter(size, INFINITY) - size);
}

static void fill_points(double *to, const table *t, const double *x, size_t n)
{
    const double first = t->hold ? x[0] : x[0] - reach(x[0], 0);
    const double last = t->hold ? x[n - 1] : x[n - 1] + reach(x[n - 1], t->uniform ? x[0] : 0);
    for (size_t k = 0; k <= n; k++, to += POINT_COLUMNS) {
        const size_t from = k == 0 ? 0 : k == n ? n - 2 : k - 1;
        const double begins = from == 0 ? first : x[from], ends = from == n - 2 ? last : x[from + 1];
        const double width = ends - begins, slope = within(x[from + 1] - x[from], 1 / width);
        to[BASE] = k ? (double)k : 1;
        to[POINT] = k == n ? last : begins;
        to[WIDTH] = slope;
        to[BEND] = k == 0 ? -slope : k == n ? slope : 0;
    }
}

/* Computes the second derivatives at all points into `second`, by Gauss's elimination in a tridiagonal matrix [de Boor,
 * A Practical Guide to Splines, chapter IV]. The second numbers of rows 1 … n - 1 of `to` are scratch. */
static void bend_spline(double *second, size_t stride, const double *x, const double *y, size_t n, double *scratch)
{
    for (size_t k = 0; k < n; k++) second[k * stride] = scratch[k * stride] = 0;
    for (size_t k = 1; k + 1 < n; k++) {
        const double before = x[k] - x[k - 1], after = x[k + 1] - x[k];
        const double bend = 6 * ((y[k + 1] - y[k]) / after - (y[k] - y[k - 1]) / before);
        const double pivot = 2 * (before + after) - before * scratch[(k - 1) * stride];
        scratch[k * stride] = after / pivot;
        second[k * stride] = (bend - before * second[(k - 1) * stride]) / pivot;
    }
    for (size_t k = n; k-- > 1;) second[(k - 1) * stride] -= scratch[(k - 1) * stride] * second[k * stride];
}

static void fill_spline(double *to, const double *x, const double *y, size_t n)
{
    enum { COLUMNS = 5 };
    double *const row = to + COLUMNS;
    bend_spline(row + 3, COLUMNS, x, y, n, row + 4);
    for (size_t k = 0; k + 1 < n; k++) {
        double *r = row + k * COLUMNS;
        const double width = x[k + 1] - x[k], m = r[3], next = r[COLUMNS + 3];
        r[0] = x[k], r[1] = within(width, y[k]);
        r[2] = (y[k + 1] - y[k]) / width - width * (2 * m + next) / 6;
        r[3] = m / 2;
        r[4] = (next - m) / (6 * width);
        if (!ends_at_zero(y + k)) continue;
        r[0] = x[k + 1], r[1] = within(width, 0), r[2] += width * (m + next) / 2, r[3] = next / 2;
    }
}

static void fill_linear(double *to, const double *x, const double *y, size_t n)
{
    enum { COLUMNS = 3 };
    for (size_t k = 0; k + 1 < n; k++) {
        double *r = to + (k + 1) * COLUMNS;
        const double width = x[k + 1] - x[k];
        r[0] = x[k], r[1] = within(width, y[k]), r[2] = (y[k + 1] - y[k]) / width;
        if (ends_at_zero(y + k)) r[0] = x[k + 1], r[1] = within(width, 0);
    }
}

/* Fills the rows before and beyond the points. */
static void fill_ends(double *to, const table *t, const double *x, const double *y, size_t n)
{
    const size_t columns = (size_t)table_columns(t->kind);
    for (int end = 0; end < 2; end++) {
        double *r = to + (end ? n * columns : 0);
        for (size_t c = 0; c < columns; c++) r[c] = t->hold ? 0 : NAN;
        if (t->hold) r[0] = x[end ? n - 1 : 0], r[1] = y[end ? n - 1 : 0];
    }
}

void table_fill(const model *m, const table *t)
{
    const size_t n = length_of(m, t->points);
    const double *const x = m->pool + m->arrays[t->points].base, *const y = m->pool + m->arrays[t->list].base;
    double *const to = m->pool + m->arrays[t->array].base + 1;
    switch (t->kind) {
    case TABLE_LIST: fill_list(to, y, n); return;
    case TABLE_POINTS: fill_points(to, t, x, n); return;
    case TABLE_LINEAR: fill_linear(to, x, y, n); break;
    case TABLE_SPLINE: fill_spline(to, x, y, n); break;
    }
    fill_ends(to, t, x, y, n);
}

double table_point(const double *at, size_t k) { return at[1 + k * POINT_COLUMNS + POINT]; }

/* Tables ----------------------------------------------------------------------------------------------------------- */

static bool same_table(const table *a, const table *b)
{
    return a->kind == b->kind && a->hold == b->hold && a->uniform == b->uniform && a->list == b->list &&
           a->points == b->points;
}

bool table_make(model *m, const table *want, uint16_t *array)
{
    for (uint32_t k = 0; k < m->table_count; k++)
        if (same_table(m->tables[k], want)) return *array = m->tables[k]->array, true;
    const size_t numbers = (length_of(m, want->points) + 1) * (size_t)table_columns(want->kind);
    const int64_t first = 0, last = (int64_t)numbers;
    size_t base;
    table *t = arena_room(m->arena, sizeof *t);
    if (!t || !arena_more(m->arena, &m->tables, m->table_count, &m->table_room, sizeof(table *))) return false;
    *t = *want;
    if (!model_take_numbers(m, numbers + 1, &base) || !model_take_arrays(m, 1, &t->array)) return false;
    graph_shape(m->arena, &m->arrays[t->array], SPACE_POOL, base, 1, &first, &last);
    if (m->arena->failed) return false;
    m->pool[base] = (double)numbers;
    table_fill(m, t);
    m->tables[m->table_count++] = t;
    *array = t->array;
    return vary_record_table(m, t);
}

/* Nodes ------------------------------------------------------------------------------------------------------------ */

static node op(graph *g, operation o, node a, node b) { return graph_op(g, o, a, b, 0); }

node table_entry(graph *g, node row, table_kind kind, int column, node of)
{
    const int columns = table_columns(kind);
    if (columns > 1) row = op(g, OP_MUL, graph_const(g, columns), row);
    if (column) row = op(g, OP_ADD, row, graph_const(g, column));
    return op(g, OP_ENTRY, row, of);
}

node table_value(graph *g, node u, node row, table_kind kind, node of)
{
    const node d = op(g, OP_SUB, u, table_entry(g, row, kind, 0, of));
    node value = table_entry(g, row, kind, table_columns(kind) - 1, of);
    for (int c = table_columns(kind) - 1; c-- > 1;) {
        const node product = op(g, OP_MUL, d, value);
        value = op(g, OP_ADD, table_entry(g, row, kind, c, of), product);
    }
    return value;
}

node table_position(graph *g, node u, node row, node points)
{
    const node d = op(g, OP_SUB, u, table_entry(g, row, TABLE_POINTS, POINT, points));
    const node bend = op(g, OP_MUL, d, table_entry(g, row, TABLE_POINTS, BEND, points));
    const node width = op(g, OP_MUL, d, table_entry(g, row, TABLE_POINTS, WIDTH, points));
    const node share = op(g, OP_DIV, width, op(g, OP_ADD, graph_const(g, 1), bend));
    return op(g, OP_ADD, table_entry(g, row, TABLE_POINTS, BASE, points), share);
}
