/* The structure of a linear system: its pattern, an order of the unknowns with a narrow band, and colours of its
 * columns.
 *
 * Invariant: the cost is linear in the number of entries (times the degree, for colours), without recursion; indices
 * of a problem's pattern are checked before use.
 */
#include "core/solver.h"

#include <stdlib.h>
#include <string.h>

void solver_release(sparse *m, const motus_allocator *allocator)
{
    give(allocator, m->start);
    give(allocator, m->row);
    give(allocator, m->value);
    give(allocator, m->colour_column);
    give(allocator, m->colour_start);
    *m = (sparse){0};
}

/* Pattern ---------------------------------------------------------------------------------------------------------- */

typedef struct gather {
    sparse *to;
    size_t rows, room;
    bool filling, broken, inconsistent;
} gather;

/* Counts the entries of each column in start[c + 1]; when `filling`, writes them and moves start[c] on. A problem that
 * runs out of memory may report fewer entries the first time than the second: then the pattern is inconsistent. */
static void gather_entry(void *arg, size_t row, size_t column)
{
    gather *g = arg;
    if (row >= g->rows || column >= g->to->columns)
        g->broken = true;
    else if (g->filling && g->to->start[column] >= g->room)
        g->inconsistent = true;
    else if (g->filling)
        g->to->row[g->to->start[column]++] = (uint32_t)row;
    else
        g->to->start[column + 1]++;
}

static void gather_all(const problem *p, bool in_v, gather *g)
{
    if (p->pattern) {
        p->pattern(p->ctx, in_v, gather_entry, g);
        return;
    }
    for (size_t column = 0; column < g->to->columns; column++)
        for (size_t row = 0; row < g->rows; row++) gather_entry(g, row, column);
}

static int ascending(const void *a, const void *b)
{
    uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
    return (x > y) - (x < y);
}

bool solver_pattern(const problem *p, bool in_v, sparse *m, const motus_allocator *allocator, bool *broken)
{
    m->columns = in_v ? p->nv : p->nx;
    m->start = take(allocator, m->columns + 2, sizeof *m->start);
    if (!m->start) return false;
    gather g = {.to = m, .rows = p->nv};
    gather_all(p, in_v, &g);
    if ((*broken = g.broken)) return false;
    for (size_t c = 0; c < m->columns; c++) m->start[c + 1] += m->start[c];
    const size_t entries = m->start[m->columns];
    m->row = take(allocator, entries, sizeof *m->row);
    if (!m->row) return false;
    g.filling = true;
    g.room = entries;
    gather_all(p, in_v, &g);
    size_t kept = 0, first = 0;
    /* start[c] now is the end of column c: sort, drop duplicates, close the gaps */
    for (size_t c = 0; c < m->columns; c++) {
        const size_t end = m->start[c];
        if (g.inconsistent || end < first) return false;
        qsort(m->row + first, end - first, sizeof *m->row, ascending);
        m->start[c] = kept;
        for (size_t i = first; i < end; i++)
            if (i == first || m->row[i] != m->row[i - 1]) m->row[kept++] = m->row[i];
        first = end;
    }
    m->start[m->columns] = kept;
    m->value = take(allocator, kept, sizeof *m->value);
    return m->value != NULL;
}

/* Order ------------------------------------------------------------------------------------------------------------ */

typedef struct net {
    size_t n, *start;
    uint32_t *to;
} net; /* neighbours of each unknown, in either direction */

static void net_entries(net *g, const sparse *m, bool fill)
{
    for (size_t c = 0; m && c < m->columns; c++)
        for (size_t i = m->start[c]; i < m->start[c + 1]; i++) {
            const size_t r = m->row[i];
            if (r == c) continue;
            if (fill) {
                g->to[g->start[r]++] = (uint32_t)c;
                g->to[g->start[c]++] = (uint32_t)r;
            } else {
                g->start[r + 1]++;
                g->start[c + 1]++;
            }
        }
}

static bool net_build(net *g, size_t n, const sparse *x, const sparse *v, const motus_allocator *allocator)
{
    *g = (net){.n = n, .start = take(allocator, n + 2, sizeof *g->start)};
    if (!g->start) return false;
    net_entries(g, x, false);
    net_entries(g, v, false);
    for (size_t k = 0; k < n; k++) g->start[k + 1] += g->start[k];
    g->to = take(allocator, g->start[n], sizeof *g->to);
    if (!g->to) return false;
    net_entries(g, x, true);
    net_entries(g, v, true);
    /* filling moved each start to its end, the next one's start */
    memmove(g->start + 1, g->start, n * sizeof *g->start);
    g->start[0] = 0;
    return true;
}

static size_t degree(const net *g, size_t k) { return g->start[k + 1] - g->start[k]; }

/* Walks breadth-first from `root` over the unknowns that have the mark `unmarked`, neighbours of low degree first, and
 * gives them `mark`. Returns how many there are. */
static size_t sweep(const net *g, uint32_t root, uint32_t *queue, uint32_t *marks, uint32_t mark, uint32_t unmarked)
{
    size_t head = 0, tail = 0;
    queue[tail++] = root;
    marks[root] = mark;
    while (head < tail) {
        const uint32_t k = queue[head++];
        const size_t from = tail;
        for (size_t i = g->start[k]; i < g->start[k + 1]; i++) {
            const uint32_t other = g->to[i];
            if (marks[other] != unmarked) continue;
            marks[other] = mark;
            size_t at = tail++;
            /* sorted by insertion, which is slow for many: those beyond 64 neighbours stay in their order */
            if (tail - from <= 64)
                for (; at > from && degree(g, queue[at - 1]) > degree(g, other); at--) queue[at] = queue[at - 1];
            queue[at] = other;
        }
    }
    return tail;
}

/* Orders the unknowns by reverse Cuthill-McKee. Each component begins at the far end of a sweep from its first
 * member. */
static bool cuthill_mckee(const net *g, uint32_t *place, const motus_allocator *allocator)
{
    uint32_t *queue = take(allocator, g->n, sizeof *queue), *marks = take(allocator, g->n, sizeof *marks);
    if (queue && marks) {
        size_t done = 0;
        for (uint32_t k = 0; k < g->n; k++) {
            if (marks[k]) continue;
            size_t count = sweep(g, k, queue, marks, 1, 0);
            count = sweep(g, queue[count - 1], queue, marks, 2, 1);
            for (size_t i = 0; i < count; i++) place[queue[i]] = (uint32_t)(g->n - 1 - (done + i));
            done += count;
        }
    }
    bool ok = queue && marks;
    give(allocator, queue);
    give(allocator, marks);
    return ok;
}

static void measure(const sparse *m, const uint32_t *place, size_t *lower, size_t *upper)
{
    for (size_t c = 0; m && c < m->columns; c++)
        for (size_t i = m->start[c]; i < m->start[c + 1]; i++) {
            const size_t r = place ? place[m->row[i]] : m->row[i], at = place ? place[c] : c;
            if (r > at && r - at > *lower) *lower = r - at;
            if (at > r && at - r > *upper) *upper = at - r;
        }
}

bool solver_order(size_t n, const sparse *x, const sparse *v, uint32_t *place, size_t *lower, size_t *upper,
                  const motus_allocator *allocator)
{
    *lower = *upper = 0;
    measure(x, NULL, lower, upper);
    measure(v, NULL, lower, upper);
    if (*lower + *upper > 0) {
        net g;
        bool ok = net_build(&g, n, x, v, allocator) && cuthill_mckee(&g, place, allocator);
        give(allocator, g.start);
        give(allocator, g.to);
        if (!ok) return false;
        size_t low = 0, up = 0;
        measure(x, place, &low, &up);
        measure(v, place, &low, &up);
        if (2 * low + up < 2 * *lower + *upper) {
            *lower = low;
            *upper = up;
            return true;
        }
    }
    for (size_t k = 0; k < n; k++) place[k] = (uint32_t)k;
    return true;
}

/* Colours ---------------------------------------------------------------------------------------------------------- */

/* Gives one colour to columns that share no row, greedily, so that one directional derivative serves them all
 * [CPR74]. */
static void paint(size_t rows, sparse *m, size_t *by_row, uint32_t *columns, uint32_t *colour, uint32_t *taken)
{
    for (size_t i = 0; i < m->start[m->columns]; i++) by_row[m->row[i] + 1]++;
    for (size_t r = 0; r < rows; r++) by_row[r + 1] += by_row[r];
    for (size_t c = 0; c < m->columns; c++)
        for (size_t i = m->start[c]; i < m->start[c + 1]; i++) columns[by_row[m->row[i]]++] = (uint32_t)c;
    memmove(by_row + 1, by_row, rows * sizeof *by_row);
    by_row[0] = 0;
    m->colours = 0;
    for (size_t c = 0; c < m->columns; c++) {
        if (m->start[c] == m->start[c + 1]) continue; /* nothing depends on it: no colour */
        for (size_t i = m->start[c]; i < m->start[c + 1]; i++)
            for (size_t j = by_row[m->row[i]]; j < by_row[m->row[i] + 1]; j++)
                if (colour[columns[j]]) taken[colour[columns[j]]] = (uint32_t)c + 1;
        uint32_t pick = 1;
        while (taken[pick] == (uint32_t)c + 1) pick++;
        colour[c] = pick;
        if (pick > m->colours) m->colours = pick;
    }
}

bool solver_colour(size_t rows, sparse *m, const motus_allocator *allocator)
{
    size_t *by_row = take(allocator, rows + 2, sizeof *by_row);
    uint32_t *columns = take(allocator, m->start[m->columns], sizeof *columns);
    uint32_t *colour = take(allocator, m->columns, sizeof *colour),
             *taken = take(allocator, m->columns + 2, sizeof *taken);
    bool ok = by_row && columns && colour && taken;
    if (ok) {
        paint(rows, m, by_row, columns, colour, taken);
        m->colour_start = take(allocator, m->colours + 2, sizeof *m->colour_start);
        m->colour_column = take(allocator, m->columns, sizeof *m->colour_column);
        ok = m->colour_start && m->colour_column;
    }
    if (ok) {
        for (size_t c = 0; c < m->columns; c++)
            if (colour[c]) m->colour_start[colour[c]]++;
        for (size_t k = 0; k < m->colours; k++) m->colour_start[k + 1] += m->colour_start[k];
        for (size_t c = 0; c < m->columns; c++) /* colour k + 1 starts where colour k ends */
            if (colour[c]) m->colour_column[m->colour_start[colour[c] - 1]++] = (uint32_t)c;
        memmove(m->colour_start + 1, m->colour_start, m->colours * sizeof *m->colour_start);
        m->colour_start[0] = 0;
    }
    give(allocator, by_row);
    give(allocator, columns);
    give(allocator, colour);
    give(allocator, taken);
    return ok;
}
