/* The highest derivative of a state on a right side, as y'' in s' = y''^2: the right side of its own equation stands in
 * its place, with the subscripts in place of its indices, so nothing else knows of it. A family whose cells have
 * several equations is divided as for ghost cells (lower_ghost.h).
 *
 * Invariant: no equation is lowered inside itself.
 */
#include "lang/lower/lower_ghost.h"
#include "lang/lower/lower_parts.h"

#include <string.h>

static const char *primes(int count) { return count == 2 ? "''" : "'"; }

/* Complains that an equation follows from itself: x'' → y'' → x''. */
static value circular(lowering *l, const tree *t, const statement *line)
{
    const statement *steps[8];
    char text[80], circle[10 * MOTUS_NAME_MAX];
    size_t count = 0, n = (size_t)snprintf(circle, sizeof circle, "%s%s", line->name, primes(line->primes));
    for (const lower_rates *r = l->rates; r && r->line != line; r = r->up)
        if (count < sizeof steps / sizeof *steps) steps[count++] = r->line;
    while (count-- > 0)
        n += (size_t)snprintf(circle + n, sizeof circle - n, " → %s%s", steps[count]->name,
                              primes(steps[count]->primes));
    snprintf(circle + n, sizeof circle - n, " → %s%s", line->name, primes(line->primes));
    COMPLAIN(l, &t->at, "%s follows from itself here: %s", quote(l, &t->at, text), circle);
    HINT(l, "solve these equations for the highest derivatives by hand, so that none follows from itself");
    return wrong(l);
}

static value expand(lowering *l, const tree *t, const model_state *s, const statement *line, const reference *r,
                    const int64_t low[], const int64_t high[])
{
    for (const lower_rates *up = l->rates; up; up = up->up)
        if (up->line == line) return circular(l, t, line);
    lowering inner = *l;
    const lower_rates here = {line, l->rates};
    inner.rates = &here;
    if (!lower_enter_line(&inner, t, line, r, low, high, "equations")) return wrong(l);
    const value v = lower_numbers(&inner, line->value);
    return failed(l) || !lower_fits(l->model, line, s, v, "the right side") ? wrong(l) : v;
}

value lower_rate(lowering *l, const tree *t, const model_state *s, const reference *r, const int64_t low[],
                 const int64_t high[])
{
    char text[80];
    if (l->by_variable) {
        COMPLAIN(l, &t->at, "%s follows from its equation, so nothing can be differentiated by it",
                 quote(l, &t->at, text));
        return wrong(l);
    }
    for (uint32_t i = s->line; i; i = l->model->statements.item[i - 1].next) {
        const statement *line = &l->model->statements.item[i - 1];
        int64_t first[MAX_DIMS], last[MAX_DIMS];
        if (line->kind != STATEMENT_EQUATION) continue;
        if (s->dims && !lower_places(l->model, line, first, last)) return wrong(l);
        bool apart = false, inside = true;
        for (int d = 0; d < s->dims; d++) {
            apart |= high[d] < first[d] || low[d] > last[d];
            inside &= low[d] >= first[d] && high[d] <= last[d];
        }
        if (apart) continue;
        if (!inside) lower_ask_cut(l, t, s->dims, first, last, r, low, high);
        return failed(l) ? wrong(l) : expand(l, t, s, line, r, low, high);
    }
    return wrong(l); /* lower_name.c has checked that every cell has an equation */
}
