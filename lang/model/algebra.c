/* Sums, products and the normal form of polynomials in atoms. */
#include "lang/model/algebra.h"

#include <math.h>
#include <string.h>

enum { EXPONENT_MAX = 64 };

bool algebra_begin(algebra *A, const model *m, long work)
{
    *A = (algebra){.model = m, .work = work, .atom_count = 1, .monomial_count = 1};
    arena_init(&A->arena, &m->arena->allocator);
    A->monomials = arena_take(&A->arena, sizeof *A->monomials);
    A->polys = arena_take(&A->arena, sizeof *A->polys);
    A->monomial_room = A->poly_count = A->poly_room = 1;
    return !A->arena.failed;
}

void algebra_end(algebra *A) { arena_release(&A->arena); }

poly algebra_lose(algebra *A)
{
    A->lost = true;
    return 0;
}

/* Makes room for one more element of a list, which doubles. False: no memory, or no work is left. */
static bool grow(algebra *A, void *list, uint32_t count, uint32_t *room, size_t size)
{
    if (A->lost || --A->work < 0 || !arena_more(&A->arena, list, count, room, size)) A->lost = true;
    return !A->lost;
}

static uint32_t mixed(uint32_t h, uint32_t x)
{
    h = (h ^ x) * 0x9E3779B1u;
    return h ^ h >> 15;
}

/* Monomials -------------------------------------------------------------------------------------------------------- */

static bool same_powers(const algebra_power *p, const algebra_power *q, uint32_t count)
{
    for (uint32_t k = 0; k < count; k++)
        if (p[k].atom != q[k].atom || p[k].exponent != q[k].exponent) return false;
    return true;
}

/* Returns the monomial of the powers in the list from `first` on, which leave the list if the monomial exists. */
static uint32_t share(algebra *A, uint32_t first)
{
    const uint32_t count = A->power_count - first;
    uint32_t h = count;
    if (count == 0) return 0;
    for (uint32_t k = first; k < A->power_count; k++)
        h = mixed(mixed(h, A->powers[k].atom), (uint32_t)(int32_t)(4096 * A->powers[k].exponent));
    h %= ALGEBRA_HEADS;
    for (uint32_t k = A->monomial_heads[h]; k; k = A->monomials[k].next)
        if (A->monomials[k].count == count &&
            same_powers(A->powers + A->monomials[k].first, A->powers + first, count)) {
            A->power_count = first;
            return k;
        }
    if (!grow(A, &A->monomials, A->monomial_count, &A->monomial_room, sizeof *A->monomials)) return 0;
    A->monomials[A->monomial_count] = (algebra_monomial){first, count, A->monomial_heads[h]};
    return A->monomial_heads[h] = A->monomial_count++;
}

static void push(algebra *A, uint32_t atom, double exponent)
{
    if (fabs(exponent) < 1e-12) return;
    if (!(fabs(exponent) <= 1e4)) {
        A->lost = true;
        return;
    }
    if (A->atoms[atom].op == OP_GT && exponent > 0) exponent = 1; /* step² is step */
    if (!grow(A, &A->powers, A->power_count, &A->power_room, sizeof *A->powers)) return;
    A->powers[A->power_count++] = (algebra_power){atom, exponent};
}

static uint32_t product(algebra *A, uint32_t p, uint32_t q)
{
    if (!p || !q) return p + q;
    const uint32_t first = A->power_count;
    const algebra_monomial m = A->monomials[p], n = A->monomials[q];
    for (uint32_t i = 0, k = 0; (i < m.count || k < n.count) && !A->lost;) {
        const algebra_power a = i < m.count ? A->powers[m.first + i] : (algebra_power){UINT32_MAX, 0},
                            b = k < n.count ? A->powers[n.first + k] : (algebra_power){UINT32_MAX, 0};
        push(A, a.atom < b.atom ? a.atom : b.atom,
             (a.atom <= b.atom ? a.exponent : 0) + (b.atom <= a.atom ? b.exponent : 0));
        i += a.atom <= b.atom;
        k += b.atom <= a.atom;
    }
    return share(A, first);
}

uint32_t algebra_with_exponent(algebra *A, uint32_t of, uint32_t atom, double exponent)
{
    const uint32_t first = A->power_count;
    const algebra_monomial m = A->monomials[of];
    for (uint32_t k = 0; k < m.count && !A->lost; k++) {
        const algebra_power p = A->powers[m.first + k];
        push(A, p.atom, p.atom == atom ? exponent : p.exponent);
    }
    return share(A, first);
}

static double exponent_of(const algebra *A, uint32_t of, uint32_t atom)
{
    const algebra_monomial *m = &A->monomials[of];
    for (uint32_t k = 0; k < m->count; k++)
        if (A->powers[m->first + k].atom == atom) return A->powers[m->first + k].exponent;
    return 0;
}

/* Lists of terms --------------------------------------------------------------------------------------------------- */

static void note(algebra *A, uint32_t of, double factor, double size)
{
    if (!grow(A, &A->line, A->line_count, &A->line_room, sizeof *A->line)) return;
    if (!isfinite(size)) A->lost = true;
    A->line[A->line_count++] = (poly_term){of, factor, size};
}

static void sort(poly_term *t, uint32_t count) /* Shell's sort, with Ciura's gaps */
{
    static const uint32_t gaps[] = {8929, 3905, 1750, 701, 301, 132, 57, 23, 10, 4, 1};
    for (size_t g = 0; g < sizeof gaps / sizeof *gaps; g++)
        for (uint32_t i = gaps[g]; i < count; i++) {
            const poly_term moved = t[i];
            uint32_t k = i;
            for (; k >= gaps[g] && t[k - gaps[g]].of > moved.of; k -= gaps[g]) t[k] = t[k - gaps[g]];
            t[k] = moved;
        }
}

poly algebra_gather(algebra *A, uint32_t first, double low)
{
    if (A->lost) return algebra_lose(A);
    if (A->line_count == first) return 0;
    uint32_t count = 0;
    poly_term *t = A->line + first;
    sort(t, A->line_count - first);
    for (uint32_t k = 0; k < A->line_count - first;) {
        poly_term sum = t[k];
        for (k++; k < A->line_count - first && t[k].of == sum.of; k++) {
            sum.factor += t[k].factor;
            sum.size += t[k].size;
        }
        if (fabs(sum.factor) > ALGEBRA_ROUNDING * sum.size) t[count++] = sum;
    }
    A->line_count = first;
    if (count == 0) return 0;
    poly_term *kept = arena_room(&A->arena, count * sizeof *kept);
    if (!kept || !grow(A, &A->polys, A->poly_count, &A->poly_room, sizeof *A->polys)) return algebra_lose(A);
    memcpy(kept, t, count * sizeof *kept);
    A->polys[A->poly_count] = (algebra_poly){kept, count, count == 1 && kept->of == 0 ? kept->factor : low};
    return A->poly_count++;
}

poly algebra_number(algebra *A, double value)
{
    const uint32_t first = A->line_count;
    if (value != 0) note(A, 0, value, fabs(value));
    return algebra_gather(A, first, value);
}

poly algebra_of_atom(algebra *A, uint32_t atom, double exponent, double factor, double low)
{
    const uint32_t first = A->line_count, powers = A->power_count;
    if (A->lost) return algebra_lose(A);
    push(A, atom, exponent);
    note(A, share(A, powers), factor, fabs(factor));
    return algebra_gather(A, first, low);
}

poly algebra_add(algebra *A, poly p, double factor, poly q)
{
    const uint32_t first = A->line_count;
    const algebra_poly a = A->polys[p], b = A->polys[q];
    for (uint32_t k = 0; k < a.count; k++) note(A, a.terms[k].of, a.terms[k].factor, a.terms[k].size);
    for (uint32_t k = 0; k < b.count; k++)
        note(A, b.terms[k].of, factor * b.terms[k].factor, fabs(factor) * b.terms[k].size);
    return algebra_gather(A, first, factor > 0 ? a.low + factor * b.low : -INFINITY);
}

void algebra_note_product(algebra *A, const poly_term *t, poly p)
{
    const algebra_poly a = A->polys[p];
    for (uint32_t k = 0; k < a.count && !A->lost; k++)
        note(A, product(A, t->of, a.terms[k].of), t->factor * a.terms[k].factor, t->size * a.terms[k].size);
}

poly algebra_times(algebra *A, poly p, poly q)
{
    const uint32_t first = A->line_count;
    const algebra_poly a = A->polys[p], b = A->polys[q];
    for (uint32_t k = 0; k < a.count; k++) algebra_note_product(A, &a.terms[k], q);
    return algebra_gather(A, first, a.low >= 0 && b.low >= 0 ? a.low * b.low : p == q ? 0 : -INFINITY);
}

poly algebra_without(algebra *A, poly p, poly_term t)
{
    const uint32_t first = A->line_count;
    note(A, t.of, t.factor, t.size);
    return algebra_add(A, p, -1, algebra_gather(A, first, -INFINITY));
}

/* Atoms ------------------------------------------------------------------------------------------------------------ */

static bool same_poly(const algebra *A, poly p, poly q)
{
    const algebra_poly a = A->polys[p], b = A->polys[q];
    if (a.count != b.count) return false;
    for (uint32_t k = 0; k < a.count; k++)
        if (a.terms[k].of != b.terms[k].of ||
            !(fabs(a.terms[k].factor - b.terms[k].factor) <= ALGEBRA_ROUNDING * fabs(a.terms[k].factor)))
            return false;
    return true;
}

static uint32_t hashed(const algebra *A, uint32_t h, poly p)
{
    for (uint32_t k = 0; k < A->polys[p].count; k++) h = mixed(h, A->polys[p].terms[k].of);
    return h;
}

static uint32_t intern(algebra *A, algebra_atom atom)
{
    uint32_t h = mixed(mixed(atom.op, atom.space), (uint32_t)atom.at);
    h = hashed(A, hashed(A, h, atom.a), atom.b) % ALGEBRA_HEADS;
    for (uint32_t k = A->atom_heads[h]; k; k = A->atoms[k].next) {
        algebra_atom *other = &A->atoms[k];
        if (other->op != atom.op || other->space != atom.space || other->at != atom.at) continue;
        if (!same_poly(A, other->a, atom.a) || !same_poly(A, other->b, atom.b)) continue;
        A->polys[other->a].low = fmax(A->polys[other->a].low, A->polys[atom.a].low);
        return k;
    }
    if (A->atom_room == 0 && !grow(A, &A->atoms, 0, &A->atom_room, sizeof *A->atoms)) return 0;
    if (!grow(A, &A->atoms, A->atom_count, &A->atom_room, sizeof *A->atoms)) return 0;
    atom.next = A->atom_heads[h];
    A->atoms[A->atom_count] = atom;
    return A->atom_heads[h] = A->atom_count++;
}

uint32_t algebra_place(algebra *A, space s, size_t at)
{
    return intern(A, (algebra_atom){.op = s == SPACE_OUT ? OP_TIME : OP_LOAD, .space = (uint8_t)s, .at = at});
}

uint32_t algebra_atom_of(algebra *A, operation op, poly a, poly b)
{
    return A->lost ? 0 : intern(A, (algebra_atom){.op = (uint8_t)op, .a = a, .b = b});
}

/* Powers ----------------------------------------------------------------------------------------------------------- */

static double powered(double a, double e) { return operation_value(OP_POW, a, e, 0); }

static bool whole(double e) { return e == floor(e); }

/* Raises a single term: a power of a product is the product of powers, for whole exponents and for positive factors.
 * False: neither holds. */
static bool raise_single(algebra *A, poly_term t, double e, poly *out)
{
    const algebra_monomial m = A->monomials[t.of];
    if (!whole(e) && t.factor < 0) return false;
    for (uint32_t k = 0; k < m.count; k++) {
        const algebra_power p = A->powers[m.first + k];
        const uint8_t op = A->atoms[p.atom].op;
        if (op == OP_GT || op == OP_EQ || op == OP_NE) return false;
        if (!whole(e) && op != OP_EXP && (op != OP_POW || whole(p.exponent))) return false;
    }
    const uint32_t first = A->line_count, powers = A->power_count;
    for (uint32_t k = 0; k < m.count && !A->lost; k++)
        push(A, A->powers[m.first + k].atom, e * A->powers[m.first + k].exponent);
    const double factor = powered(t.factor, e);
    note(A, share(A, powers), factor, fabs(factor) * t.size / fabs(t.factor));
    *out = algebra_gather(A, first, whole(e / 2) || !whole(e) ? 0 : -INFINITY);
    return true;
}

poly algebra_raise(algebra *A, poly base, double e)
{
    poly out;
    const algebra_poly b = A->polys[base];
    if (A->lost || !isfinite(e)) return algebra_lose(A);
    if (e == 0) return algebra_number(A, 1);
    if (b.count == 0) return e > 0 ? base : algebra_lose(A);
    if (e == 1) return base;
    if (b.count == 1 && raise_single(A, b.terms[0], e, &out)) return out;
    if (whole(e) && e > 0 && e <= EXPONENT_MAX) {
        const poly half = algebra_raise(A, base, floor(e / 2));
        out = algebra_times(A, half, half);
        return whole(e / 2) ? out : algebra_times(A, out, base);
    }
    const double c = whole(e) ? b.terms[0].factor : fabs(b.terms[0].factor);
    const poly one = algebra_add(A, 0, 1 / c, base);
    const double low = !whole(e) || whole(e / 2) || b.low > 0 ? 0 : -INFINITY;
    return algebra_of_atom(A, algebra_atom_of(A, OP_POW, one, 0), e, powered(c, e), low);
}

/* Writes out the powers of one base, divided by the smallest of them: only the zero of the polynomial matters. */
static poly write_out(algebra *A, poly given, uint32_t atom)
{
    const algebra_poly p = A->polys[given];
    double least = INFINITY, most = -INFINITY;
    for (uint32_t k = 0; k < p.count; k++) {
        const double e = exponent_of(A, p.terms[k].of, atom);
        least = fmin(least, e);
        most = fmax(most, e);
    }
    if (most - least < 1) return given;
    const uint32_t first = A->line_count;
    for (uint32_t k = 0; k < p.count && !A->lost; k++) {
        const poly_term t = p.terms[k];
        const double e = exponent_of(A, t.of, atom) - least, n = floor(e + 1e-9);
        const poly_term rest = {algebra_with_exponent(A, t.of, atom, fabs(e - n) > 1e-9 ? e - n : 0), t.factor, t.size};
        algebra_note_product(A, &rest, n > 0 ? algebra_raise(A, A->atoms[atom].a, n) : algebra_number(A, 1));
    }
    return algebra_gather(A, first, -INFINITY);
}

bool algebra_zero(algebra *A, poly *given)
{
    poly p = *given;
    /* a base contains only atoms with smaller numbers */
    for (uint32_t atom = A->atom_count; p && !A->lost;) {
        uint32_t next = 0;
        for (uint32_t k = 0; k < A->polys[p].count; k++) {
            const algebra_monomial *m = &A->monomials[A->polys[p].terms[k].of];
            for (uint32_t i = 0; i < m->count; i++) {
                const uint32_t other = A->powers[m->first + i].atom;
                if (other < atom && other > next && A->atoms[other].op == OP_POW) next = other;
            }
        }
        if (!next) break;
        p = write_out(A, p, atom = next);
    }
    *given = p;
    return !A->lost && p == 0;
}

static bool plain(const algebra *A, uint32_t atom)
{
    return A->atoms[atom].op == OP_LOAD || A->atoms[atom].op == OP_TIME;
}

static bool reads_places_alone(const algebra *A, poly p)
{
    for (uint32_t k = 0; k < A->polys[p].count; k++) {
        const algebra_monomial m = A->monomials[A->polys[p].terms[k].of];
        for (uint32_t i = 0; i < m.count; i++)
            if (!plain(A, A->powers[m.first + i].atom)) return false;
    }
    return true;
}

bool algebra_differs(const algebra *A, poly p)
{
    uint32_t function = 0;
    for (uint32_t k = 0; k < A->polys[p].count; k++) {
        const algebra_monomial m = A->monomials[A->polys[p].terms[k].of];
        for (uint32_t i = 0; i < m.count; i++) {
            const uint32_t atom = A->powers[m.first + i].atom;
            const algebra_atom *a = &A->atoms[atom];
            if (plain(A, atom) || atom == function) continue;
            if (function || a->op == OP_GT || a->op == OP_EQ || a->op == OP_NE || a->op == OP_FLOOR) return false;
            if (!reads_places_alone(A, a->a) || !reads_places_alone(A, a->b)) return false;
            function = atom;
        }
    }
    return !A->lost && p != 0;
}

/* Derivatives ------------------------------------------------------------------------------------------------------ */
