/* Roots on a step: the points and the transform, cells, polynomials with known roots, other functions, what comes of
 * bad input.
 *
 * A polynomial is given by its roots and evaluated as a product in long double, so its sign and size are known next to
 * a multiple root too. What roots_find tells is then judged by what core/roots.h promises: every root lies in exactly
 * one place, an odd number in a crossing and an even one in a touch; where g exceeds the noise between two roots they
 * are two places; outside of places the sign of g is the one told.
 *
 *   roots_test            a million polynomials; 300 000 under sanitizers, 30 000 by qemu; of these one in SHARE
 *   roots_test 1000       so many
 */
#include "core/roots.h"
#include "core/roots_cell.h"
#include "test/share.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <cmocka.h>

enum { FACTORS = 20, ROOM = 300 };
#define ROUNDING 0x1p-53

#if !defined __x86_64__
static long polynomials = 30000;
#elif defined SANITIZED
static long polynomials = 300000;
#else
static long polynomials = 1000000;
#endif

/* --- random numbers -------------------------------------------------------------------------------------- */
static uint64_t seed = 1;

static uint64_t bits(void)
{
    uint64_t z = seed += 0x9e3779b97f4a7c15;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9;
    z = (z ^ z >> 27) * 0x94d049bb133111eb;
    return z ^ z >> 31;
}

static double uniform(void) { return (double)(bits() >> 11) * 0x1p-53; }
static int below(int n) { return (int)(bits() % (uint64_t)n); }

/* --- a function on a step and what is found -------------------------------------------------------------- */
typedef long double (*function)(const void *, double tau);

typedef struct answer {
    roots_fit_status fit;
    roots_status status;
    int degree; /* of the fit */
    double c[ROOTS_DEGREE_MOST + 1], largest;
    roots_fitted fitted;
    roots_found found;
    roots_root root[ROOM];
} answer;

/* The values are those of g rounded to double, and nothing else is wrong with them. */
static void find(function g, const void *ctx, int before, double slack, answer *a)
{
    double v[ROOTS_DEGREE_MOST + 1];
    for (a->degree = ROOTS_DEGREE_LEAST;; a->degree *= 2) {
        a->largest = 0;
        for (int k = 0; k <= a->degree; k++) {
            v[k] = (double)g(ctx, roots_point(k, a->degree));
            if (fabs(v[k]) > a->largest) a->largest = fabs(v[k]);
        }
        a->fit = roots_fit(v, 1, a->degree, ROUNDING * a->largest, a->c, &a->fitted);
        if (a->fit != ROOTS_FIT_ROUGH || a->degree == ROOTS_DEGREE_MOST) break;
    }
    a->found = (roots_found){0};
    if (a->fit == ROOTS_FIT_NOT_FINITE) return;
    a->status = roots_find(a->c, a->fitted.degree, before, a->fitted.noise, slack, a->root, ROOM, &a->found);
}

/* p by its coefficients */
static long double sum_of(const answer *a, double tau)
{
    const long double x = 2 * (long double)tau - 1;
    long double b1 = 0, b2 = 0;
    for (int k = a->fitted.degree; k > 0; k--) {
        const long double b = a->c[k] + 2 * x * b1 - b2;
        b2 = b1, b1 = b;
    }
    return a->c[0] + x * b1 - b2;
}

/* --- polynomials with known roots ------------------------------------------------------------------------ */
typedef struct polynomial {
    double scale;
    int roots, pairs;
    double root[FACTORS + 1];                 /* ascending, multiple ones repeated */
    double real[FACTORS], imaginary[FACTORS]; /* complex pairs */
} polynomial;

static long double product(const void *ctx, double tau)
{
    const polynomial *p = ctx;
    long double value = p->scale;
    for (int i = 0; i < p->roots; i++) value *= (long double)tau - p->root[i];
    for (int i = 0; i < p->pairs; i++) {
        const long double d = (long double)tau - p->real[i];
        value *= d * d + (long double)p->imaginary[i] * p->imaginary[i];
    }
    return value;
}

static void sort(polynomial *p)
{
    for (int i = 1; i < p->roots; i++)
        for (int j = i; j > 0 && p->root[j] < p->root[j - 1]; j--) {
            const double keep = p->root[j];
            p->root[j] = p->root[j - 1];
            p->root[j - 1] = keep;
        }
}

static void add_root(polynomial *p, double root)
{
    if (p->roots + 2 * p->pairs < FACTORS) p->root[p->roots++] = root;
}

static double place(void)
{
    switch (below(8)) {
    case 0: return below(17) / 16.0 + (below(2) ? 0 : 0x1p-5);
    case 1: return 1 - ldexp(1 + uniform(), -below(50) - 2);
    case 2: return ldexp(1 + uniform(), -below(40) - 2);
    case 3: return 3 * uniform() - 1;
    default: return uniform();
    }
}

/* Clusters: simple and multiple roots, neighbours at 2^-1 … 2^-40, and pairs that just miss the axis. */
static polynomial random_polynomial(void)
{
    polynomial p = {.scale = ldexp(below(2) ? 1 + uniform() : -1 - uniform(), below(40) - 20)};
    for (int clusters = 1 + below(below(4) ? 6 : 16); clusters > 0; clusters--) {
        const double at = place(), gap = ldexp(1 + uniform(), -1 - below(40));
        const int many = below(3) ? 1 : 1 + below(4);
        switch (below(6)) {
        case 0:
            for (int i = 0; i < many; i++) add_root(&p, at + i * gap);
            break;
        case 1:
            if (p.roots + 2 * p.pairs + 2 > FACTORS) break;
            p.real[p.pairs] = at;
            p.imaginary[p.pairs++] = gap;
            break;
        default:
            for (int i = 0; i < many; i++) add_root(&p, at);
        }
    }
    sort(&p);
    return p;
}

/* --- the judge ------------------------------------------------------------------------------------------- */
static const char *complaint;
#define JUDGE(condition)                                        \
    do {                                                        \
        if (!(condition) && !complaint) complaint = #condition; \
    } while (0)

static int sign_of(long double p) { return (p > 0) - (p < 0); }

/* What core/roots.h promises of |p - g|. */
static double noise_at(const answer *a, int before, double tau)
{
    const double steep = 2.0 * a->fitted.degree * a->fitted.degree + 1;
    if (before) return a->found.noise;
    return a->found.noise * (steep * tau < 2 ? steep * tau : 2);
}

static bool covers(const roots_root *r, double tau)
{
    return r->kind != ROOTS_NEAR && tau >= r->from - 0x1p-52 && tau <= r->to + 0x1p-52;
}

/* No |P| between a and b exceeds what a place may hide: p is below 9/8 of the noise there, or, next to a root that is
 * stood on, below twice the noise. */
static bool hidden(const polynomial *p, const answer *a, int before, double from, double to)
{
    for (int i = 1; i < 16; i++) {
        const double tau = from + (to - from) * (i / 16.0);
        if (fabsl(product(p, tau)) > (before ? 1 + 9 / 8.0 : 3) * noise_at(a, before, tau)) return false;
    }
    return true;
}

static void judge_root(const polynomial *p, const answer *a, int before, const roots_root *r, int *side)
{
    const double noise = noise_at(a, before, r->tau);
    JUDGE(r->tau >= 0 && r->tau <= 1 && r->from <= r->tau && r->tau <= r->to);
    if (r->kind == ROOTS_NEAR) {
        JUDGE(fabsl(product(p, r->tau) - r->value) <= noise);
        JUDGE(fabs(r->value) > noise && sign_of(r->value) == *side);
        return;
    }
    JUDGE(r->side == *side);
    JUDGE(fabsl(product(p, r->tau)) <= 2 * noise);
    if (r->kind != ROOTS_TOUCH) {
        JUDGE(r->kind == -*side);
        *side = -*side;
    }
    int inside = 0;
    for (int i = 0; i < p->roots; i++) {
        if (!covers(r, p->root[i])) continue;
        inside++;
        if (i > 0 && covers(r, p->root[i - 1])) JUDGE(hidden(p, a, before, p->root[i - 1], p->root[i]));
    }
    if (r->to < 1 && r->from > 0) JUDGE(inside % 2 == (r->kind != ROOTS_TOUCH));
    if (r->single) JUDGE(inside == 1);
}

/* before = 0: P(0) is 0. */
static void judge_polynomial(const polynomial *p, const answer *a, int before)
{
    int side = before ? before : a->found.after;
    const double start = before ? 0 : a->found.leaves;
    JUDGE(a->fit == ROOTS_FIT_SMOOTH && a->status == ROOTS_COMPLETE);
    JUDGE(a->found.noise <= (100 + 10.0 * a->degree * a->degree) * ROUNDING * a->largest);
    JUDGE(start == 0 || hidden(p, a, before, 0, start));
    for (size_t i = 0; i < a->found.count; i++) {
        judge_root(p, a, before, &a->root[i], &side);
        JUDGE(a->root[i].tau > (i > 0 ? a->root[i - 1].tau : before ? -1 : 0));
    }
    for (int i = 0; i < p->roots; i++) {
        int places = 0;
        for (size_t j = 0; j < a->found.count; j++) places += covers(&a->root[j], p->root[i]);
        if (p->root[i] > start && p->root[i] <= 1) JUDGE(places == 1);
    }
    for (int i = 0; i < 8; i++) {
        const double tau = start + (1 - start) * (i % 2 ? uniform() : ldexp(1, -below(52)));
        int here = before ? before : a->found.after;
        bool in = tau <= start;
        for (size_t j = 0; j < a->found.count; j++) {
            in = in || covers(&a->root[j], tau);
            if (abs(a->root[j].kind) == 1 && a->root[j].tau < tau) here = a->root[j].kind;
        }
        if (!in) JUDGE(sign_of(product(p, tau)) == here);
        JUDGE(fabsl(product(p, tau)) <= 1e3 * noise_at(a, before, tau) || here);
    }
    const bool ends = a->found.count > 0 && a->root[a->found.count - 1].to == 1;
    JUDGE(ends || start == 1 || (a->found.last == side && side == sign_of(product(p, 1))));
}

/* Extrema within the slack are told: every one that |p| > N and the roots beside it make certain. */
static void judge_near(const polynomial *p, const answer *a, double slack)
{
    for (int i = 0; i + 1 < p->roots; i++) {
        const double from = p->root[i], to = p->root[i + 1];
        if (from < 0 || to > 1 || to - from < 0x1p-30) continue;
        long double most = 0;
        for (int k = 1; k < 64; k++) most = fmaxl(most, fabsl(product(p, from + (to - from) * (k / 64.0))));
        if (most > slack / 2 || most < 4 * a->found.noise) continue;
        bool told = false;
        for (size_t j = 0; j < a->found.count; j++)
            told = told || (a->root[j].kind == ROOTS_NEAR && a->root[j].tau > from && a->root[j].tau < to);
        JUDGE(told);
    }
}

static void fail_with(const polynomial *p, const answer *a, long number)
{
    fprintf(stderr, "polynomial %ld: %s\n  scale %a, noise %g (N %g), degree %d, after %d from %g, last %d\n", number,
            complaint, p->scale, a->fitted.noise, a->found.noise, a->fitted.degree, a->found.after, a->found.leaves,
            a->found.last);
    for (int i = 0; i < p->roots; i++) fprintf(stderr, "  root %.17g\n", p->root[i]);
    for (int i = 0; i < p->pairs; i++) fprintf(stderr, "  pair %.17g +- %.17g i\n", p->real[i], p->imaginary[i]);
    for (size_t i = 0; i < a->found.count; i++) {
        const roots_root *r = &a->root[i];
        fprintf(stderr, "  told %d at %.17g in [%.17g, %.17g] value %g%s\n", r->kind, r->tau, r->from, r->to, r->value,
                r->open ? ", open" : "");
    }
    fail_msg("polynomial %ld: %s", number, complaint);
}

static void test_polynomials(void **state)
{
    (void)state;
    static answer a;
    long places = 0, roots = 0;
    double worst = 0, noise = 0;
    for (long n = 0; n < polynomials; n++) {
        seed = (uint64_t)n * 0x1234567;
        const polynomial p = random_polynomial();
        const int before = sign_of(product(&p, 0));
        if (before == 0) continue;
        const double slack = below(2) ? 0 : fabs((double)product(&p, uniform())) * ldexp(1, -below(40));
        find(product, &p, before, slack, &a);
        complaint = NULL;
        judge_polynomial(&p, &a, before);
        judge_near(&p, &a, slack);
        if (complaint) fail_with(&p, &a, n);
        for (int i = 0; i < 4; i++) {
            const double tau = uniform(), ratio = (double)fabsl(product(&p, tau) - sum_of(&a, tau)) / a.fitted.noise;
            if (ratio > worst) worst = ratio;
        }
        noise += a.found.noise / (ROUNDING * a.largest) / (double)polynomials;
        places += (long)a.found.count;
        for (int i = 0; i < p.roots; i++) roots += p.root[i] > 0 && p.root[i] <= 1;
    }
    print_message(
        "%ld polynomials, %ld roots, %ld places; N is %.0f roundings of the largest value on average, |p - g| at "
        "most %.2f of the noise of roots_fit\n",
        polynomials, roots, places, noise, worst);
    assert_true(places > polynomials / 2 && roots > places / 2 && worst < 1);
}

/* A root at 0 is stood on, a simple or a multiple one, and the next may be as near as 2^-40. */
static void test_standing(void **state)
{
    (void)state;
    static answer a;
    long left = 0;
    for (long n = 0; n < polynomials / 2; n++) {
        seed = (uint64_t)n * 0x7654321 + 99;
        polynomial p = random_polynomial();
        for (int i = below(4) ? 1 : 1 + below(3); i > 0; i--) add_root(&p, 0);
        sort(&p);
        if (product(&p, 0) != 0) continue;
        find(product, &p, 0, 0, &a);
        complaint = NULL;
        judge_polynomial(&p, &a, 0);
        if (complaint) fail_with(&p, &a, n);
        left += a.found.leaves == 0;
    }
    assert_true(left > polynomials / 10);

    for (int k = 1; k <= 40; k++) {
        const polynomial p = {.scale = 1, .roots = 2, .root = {0, ldexp(1, -k)}};
        find(product, &p, 0, 0, &a);
        assert_int_equal(a.found.count, 1);
        assert_int_equal(a.found.after, -1);
        assert_true(a.found.leaves == 0 && a.root[0].kind == ROOTS_RISING);
        assert_true(fabs(a.root[0].tau - p.root[1]) <= a.root[0].error && a.root[0].error <= 0x1p-43);
    }
}

/* --- consecutive steps ----------------------------------------------------------------------------------- */
enum { STEPS = 8, EVENTS = 64 };

typedef struct walk {
    polynomial p;
    int steps;
    double start[STEPS + 1], noise[STEPS + 1];
    roots_root event[EVENTS]; /* places in t */
    int events;
    bool held;
} walk;

typedef struct piece {
    const polynomial *p;
    double a, b;
} piece;

static long double on_piece(const void *ctx, double tau)
{
    const piece *s = ctx;
    long double value = s->p->scale;
    const long double width = (long double)s->b - s->a;
    for (int i = 0; i < s->p->roots; i++) value *= ((long double)s->a - s->p->root[i]) + width * tau;
    for (int i = 0; i < s->p->pairs; i++) {
        const long double d = ((long double)s->a - s->p->real[i]) + width * tau;
        value *= d * d + (long double)s->p->imaginary[i] * s->p->imaginary[i];
    }
    return value;
}

static void cut_into_steps(walk *w)
{
    w->steps = 1 + below(STEPS);
    w->start[0] = 0;
    for (int i = 1; i < w->steps; i++) {
        const double root = w->p.roots ? w->p.root[below(w->p.roots)] : 0.5;
        const double near = below(2) ? root : root + (uniform() - 0.5) * ldexp(1, -below(50));
        double at = below(3) && near > 0 && near < 1 ? near : (1 + below(63)) / 64.0;
        int k = i;
        for (; k > 1 && w->start[k - 1] > at; k--) w->start[k] = w->start[k - 1];
        w->start[k] = at;
    }
    w->start[w->steps] = 1;
    int kept = 0;
    for (int i = 1; i <= w->steps; i++)
        if (w->start[i] - w->start[kept] > 0x1p-40) w->start[++kept] = w->start[i];
    w->start[kept] = 1;
    w->steps = kept;
}

static void add_event(walk *w, const roots_root *r, double t0, double h)
{
    if (w->events == EVENTS) return;
    roots_root *event = &w->event[w->events++];
    *event = *r;
    event->tau = t0 + h * r->tau;
    event->from = t0 + h * r->from;
    event->to = t0 + h * r->to;
}

/* The only root of a place, or NaN. */
static double only_root(const walk *w, const roots_root *event)
{
    double root = NAN;
    for (int i = 0; i < w->p.roots; i++)
        if (covers(event, w->p.root[i])) root = isnan(root) ? w->p.root[i] : INFINITY;
    return root;
}

/* What an engine does with the places of one step. Returns where it starts anew: the end of the step, or a root that it
 * acts on. */
static double take(walk *w, double t0, double t1, bool acts, int *before, const answer *a)
{
    size_t first = 0;
    if (*before == 0) {
        roots_root *last = &w->event[w->events - 1];
        JUDGE(a->found.leaves > 0 || a->found.after == (int)last->kind);
        last->to = t0 + (t1 - t0) * a->found.leaves;
        if (a->found.after == 0) return t1;
        if (a->found.after != (int)last->kind) last->kind = ROOTS_TOUCH;
    } else if (w->held && a->found.count > 0 && a->root[0].from == 0) {
        roots_root *last = &w->event[--w->events];
        const double from = last->from;
        JUDGE(a->root[0].side == last->side);
        add_event(w, &a->root[0], t0, t1 - t0);
        last->from = from;
        w->held = a->root[0].open;
        first = 1;
    } else if (w->held) {
        w->event[w->events - 1].kind = ROOTS_TOUCH;
        w->held = false;
    }
    *before = a->found.last;
    for (size_t i = first; i < a->found.count && w->events < EVENTS; i++) {
        add_event(w, &a->root[i], t0, t1 - t0);
        const roots_root *event = &w->event[w->events - 1];
        const double root = only_root(w, event);
        if (acts && event->kind != ROOTS_TOUCH && !event->open && root > t0 && t1 - root > 0x1p-40) {
            *before = 0;
            return root;
        }
        w->held = event->open;
    }
    return t1;
}

static void judge_walk(const walk *w, int before)
{
    const polynomial *p = &w->p;
    int side = before;
    for (int i = 0; i < w->events; i++) {
        JUDGE(w->event[i].side == side);
        if (w->event[i].kind != ROOTS_TOUCH) side = -side;
    }
    for (int i = 0; i < p->roots; i++) {
        const double root = p->root[i];
        int places = 0, strictly = 0, step = 0;
        if (root <= 0 || root > 1) continue;
        for (int j = 0; j < w->events; j++) {
            places += covers(&w->event[j], root);
            strictly += root > w->event[j].from && root < w->event[j].to;
        }
        JUDGE(strictly <= 1);
        while (w->start[step + 1] < root) step++;
        /* behind a touch at the end of a step */
        const long double least = 3 * (long double)w->noise[step];
        if (!places) JUDGE(step > 0 && fabsl(product(p, w->start[step])) <= least);
    }
    for (int i = 0; i < 16; i++) {
        const double t = uniform();
        int here = before, step = 0;
        while (w->start[step + 1] < t) step++;
        if (fabsl(product(p, t)) <= 3 * w->noise[step]) continue;
        for (int j = 0; j < w->events; j++)
            if (w->event[j].kind != ROOTS_TOUCH && w->event[j].tau < t) here = w->event[j].kind;
        JUDGE(sign_of(product(p, t)) == here);
    }
}

/* Returns how many steps stood on a root. */
static int walk_along(walk *w, int before, answer *a)
{
    int standing = 0, step = 0;
    const bool acts = below(2);
    for (double t = 0; step < w->steps && w->events < EVENTS && !complaint;) {
        const piece s = {&w->p, t, w->start[step + 1]};
        find(on_piece, &s, before, 0, a);
        JUDGE(a->status == ROOTS_COMPLETE);
        standing += before == 0;
        if (a->found.noise > w->noise[step]) w->noise[step] = a->found.noise;
        t = take(w, t, w->start[step + 1], acts, &before, a);
        if (t == w->start[step + 1]) step++;
    }
    if (w->held) w->event[w->events - 1].kind = ROOTS_TOUCH;
    return standing;
}

static void test_steps(void **state)
{
    (void)state;
    static answer a;
    long standing = 0, ends = 0;
    for (long n = 0; n < polynomials / 2; n++) {
        seed = (uint64_t)n * 0xabcdef1 + 7;
        walk w = {.p = random_polynomial()};
        cut_into_steps(&w);
        const int before = sign_of(product(&w.p, 0));
        if (before == 0) continue;
        complaint = NULL;
        standing += walk_along(&w, before, &a);
        judge_walk(&w, before);
        for (int i = 0; i < w.events; i++)
            for (int j = 1; j < w.steps; j++) ends += w.event[i].from < w.start[j] && w.event[i].to > w.start[j];
        if (!complaint) continue;
        for (int i = 0; i <= w.steps; i++) fprintf(stderr, "  start %.17g noise %g\n", w.start[i], w.noise[i]);
        for (int i = 0; i < w.events; i++)
            fprintf(stderr, "  event %d at %.17g in [%.17g, %.17g]\n", w.event[i].kind, w.event[i].tau, w.event[i].from,
                    w.event[i].to);
        fail_with(&w.p, &a, n);
    }
    print_message("%ld steps from a root, %ld places across ends of steps\n", standing, ends);
    assert_true(standing > polynomials / 100 && ends > polynomials / 100);
}

/* --- points, coefficients, cells ------------------------------------------------------------------------- */
static const long double pi = 3.14159265358979323846264338327950288L;

static void test_points(void **state)
{
    (void)state;
    for (int n = ROOTS_DEGREE_LEAST; n <= ROOTS_DEGREE_MOST; n *= 2) {
        assert_true(roots_point(0, n) == 0 && roots_point(n, n) == 1 && roots_point(n / 2, n) == 0.5);
        for (int k = 0; k <= n; k++) {
            const long double sine = sinl(pi * k / (2 * n)), exact = sine * sine;
            assert_true(fabsl(roots_point(k, n) - exact) <= 0x1.8p-52L * exact);
            if (k > 0) assert_true(roots_point(k, n) > roots_point(k - 1, n));
            if (n < ROOTS_DEGREE_MOST) assert_true(roots_point(k, n) == roots_point(2 * k, 2 * n));
        }
    }
}

/* The coefficients of T_j are one 1. */
static void test_coefficients(void **state)
{
    (void)state;
    static double v[3 * (ROOTS_DEGREE_MOST + 1)], c[ROOTS_DEGREE_MOST + 1];
    for (int n = ROOTS_DEGREE_LEAST; n <= ROOTS_DEGREE_MOST; n *= 2)
        for (int j = 0; j <= n; j++) {
            roots_fitted fitted;
            for (int k = 0; k <= n; k++) v[3 * k] = (double)cosl(pi * (((long)(n - k) * j) % (2 * n)) / n);
            assert_int_not_equal(roots_fit(v, 3, n, 0, c, &fitted), ROOTS_FIT_NOT_FINITE);
            assert_true(fitted.degree >= j);
            for (int k = 0; k <= n; k++) assert_true(fabs(c[k] - (k == j)) <= 0x1p-50);
        }
}

/* p on cells that are halved at random is p there, within the rounding that N counts, as long
 * as cells may hold a root. */
static void test_cells(void **state)
{
    (void)state;
    static roots_halving h;
    for (int n = 0; n < 2000; n++) {
        static answer a;
        roots_cell cell = {.half = 0.5, .degree = 1 + below(ROOTS_CELL_DEGREE)}, left;
        const int degree = a.fitted.degree = cell.degree;
        const double fall = uniform();
        for (int k = 0; k <= cell.degree; k++) a.c[k] = cell.c[k] = (2 * uniform() - 1) * pow(fall, k);
        roots_found found;
        roots_root root[ROOM];
        roots_find(a.c, cell.degree, 1, 0, 0, root, ROOM, &found);
        roots_cell_halving(cell.degree, &h);
        for (int level = 0; level < 40; level++) {
            roots_cell_halve(&h, &cell, &left);
            if (below(2)) cell = left;
            if (fabs(cell.c[0]) > roots_cell_rest(&cell)) break;
            double ends[2] = {0, 0};
            for (int k = cell.degree; k >= 0; k--) {
                ends[0] += k % 2 ? -cell.c[k] : cell.c[k];
                ends[1] += cell.c[k];
            }
            for (int end = 0; end < 2; end++) {
                const long double wrong = fabsl(sum_of(&a, cell.at + end * 2 * cell.half) - ends[end]);
                if (wrong > found.noise)
                    fail_msg("degree %d, level %d: %Lg above %g", degree, level, wrong, found.noise);
            }
        }
    }
}

/* --- functions ------------------------------------------------------------------------------------------- */
typedef struct known {
    const char *name;
    long double (*g)(const void *, double);
    int before, after;
    double slack;
    int count;
    struct {
        roots_kind kind;
        double tau;
    } root[3]; /* the first of them */
} known;

static long double sine50(const void *c, double t) { return (void)c, sinl(50 * (long double)t); }
static long double exponential(const void *c, double t) { return (void)c, expl(t) - 2; }
static long double bell(const void *c, double t) { return (void)c, 1 / ((long double)t * t + 0.01L) - 50; }
static long double sine300(const void *c, double t) { return (void)c, sinl(300 * (long double)t); }
static long double shallow(const void *c, double t) { return (void)c, cosl(40 * (long double)t) - 1; }
static long double triple(const void *c, double t) { return (void)c, powl(t - 0.3L, 3) * expl(t); }
static long double fourth(const void *c, double t) { return (void)c, powl(t - 0.3L, 4); }
static long double arriving(const void *c, double t) { return (void)c, 1 - (long double)t; }
static long double touching(const void *c, double t) { return (void)c, (1 - (long double)t) * (1 - (long double)t); }
static long double square(const void *c, double t) { return (void)c, (long double)t * t; }
static long double down(const void *c, double t) { return (void)c, -powl(t, 3); }
static long double near_by(const void *c, double t) { return (void)c, t * ((long double)t - 1e-9L) * (t + 1); }
static long double grazing(const void *c, double t)
{
    const long double d = 2 * (long double)t - 1;
    return d * d - *(const double *)c;
}
static long double nothing(const void *c, double t) { return (void)c, (void)t, 0; }
static long double later(const void *c, double t)
{
    (void)c;
    const long double d = (long double)t - 0.5L;
    return d > 0 ? -d * d * d * d * d * d * d * d * 0x1p8L : 0;
}

static long double skew(const void *c, double t) { return (void)c, powl(t - 0.3L, 2) * expl(3 * (long double)t); }
static long double chebyshev(const void *c, double t) { return (void)c, cosl(128 * acosl(2 * (long double)t - 1)); }

static long double pole(const void *c, double t) { return (void)c, 1 / ((long double)t + 0.001L); }
static long double spike(const void *c, double t) { return (void)c, 1 / (powl(t - 0.3L, 2) + 1e-6L); }

static const known functions[] = {
    {"sin 50 t", sine50, 0, 1, 0, 15, {{ROOTS_FALLING, 0.062831853071795865}, {ROOTS_RISING, 0.12566370614359173}}},
    {"exp t - 2", exponential, -1, 0, 0, 1, {{ROOTS_RISING, 0.69314718055994531}}},
    {"1/(t^2 + 0.01) - 50", bell, 1, 0, 0, 1, {{ROOTS_FALLING, 0.1}}},
    {"sin 300 t", sine300, 0, 1, 0, 95, {{ROOTS_FALLING, 0.010471975511965977}}},
    {"cos 40 t - 1", shallow, 0, -1, 0, 6, {{ROOTS_TOUCH, 0.15707963267948966}, {ROOTS_TOUCH, 0.31415926535897931}}},
    {"t - 0.3 cubed", triple, -1, 0, 0, 1, {{ROOTS_RISING, 0.3}}},
    {"(t - 0.3)^4", fourth, 1, 0, 0, 1, {{ROOTS_TOUCH, 0.3}}},
    {"1 - t", arriving, 1, 0, 0, 1, {{ROOTS_FALLING, 1}}},
    {"(1 - t)^2", touching, 1, 0, 0, 1, {{ROOTS_TOUCH, 1}}},
    {"t^2", square, 0, 1, 0, 0, {{0, 0}}},
    {"-t^3", down, 0, -1, 0, 0, {{0, 0}}},
    {"t (t - 1e-9) (t + 1)", near_by, 0, -1, 0, 1, {{ROOTS_RISING, 1e-9}}},
    {"t (t - 1e-9) (t + 1), slack", near_by, 0, -1, 1e-3, 2, {{ROOTS_NEAR, 5e-10}, {ROOTS_RISING, 1e-9}}},
    {"0", nothing, 0, 0, 0, 0, {{0, 0}}},
};

static void test_functions(void **state)
{
    (void)state;
    static answer a;
    for (size_t i = 0; i < sizeof functions / sizeof *functions; i++) {
        const known *f = &functions[i];
        find(f->g, NULL, f->before, f->slack, &a);
        if (a.fit != ROOTS_FIT_SMOOTH || a.status != ROOTS_COMPLETE || (int)a.found.count != f->count ||
            a.found.after != f->after)
            fail_msg("%s: fit %d, status %d, %zu roots, after %d", f->name, a.fit, a.status, a.found.count,
                     a.found.after);
        for (int k = 0; k < 3 && k < f->count && f->root[k].tau > 0; k++) {
            const roots_root *r = &a.root[k];
            if (r->kind != f->root[k].kind ||
                !(fabs(r->tau - f->root[k].tau) <= r->error + (r->kind == ROOTS_NEAR ? 0x1p-20 : 0x1p-40) * r->tau))
                fail_msg("%s: %d at %.17g +- %g", f->name, r->kind, r->tau, r->error);
        }
        for (size_t k = 0; k < a.found.count; k++) assert_true(a.root[k].open == (a.root[k].to == 1));
    }
}

/* (2 t - 1)^2 - d: a touch at d = 0, two roots at 2^-30, none at -2^-30 but for a near one; around the noise a touch or
 * two crossings, and crossings where the dip exceeds the noise for certain. */
static void test_grazing(void **state)
{
    (void)state;
    static answer a;
    for (int k = 20; k < 60; k++)
        for (int sign = -1; sign <= 1; sign += 2) {
            const double d = sign * ldexp(1, -k);
            find(grazing, &d, 1, 0, &a);
            const bool two = a.found.count == 2 && a.root[0].kind == ROOTS_FALLING && a.root[1].kind == ROOTS_RISING;
            const bool touch =
                a.found.count == 1 && a.root[0].kind == ROOTS_TOUCH && fabs(a.root[0].tau - 0.5) < 0x1p-52;
            if (fabs(d) > 2.2 * a.found.noise)
                assert_true(sign > 0 ? two : a.found.count == 0);
            else
                assert_true(touch || (sign > 0 ? two : a.found.count == 0));
            assert_true(a.found.noise < 0x1p-46);
            if (two) assert_true(fabs(a.root[0].tau - (0.5 - sqrt(d) / 2)) <= a.root[0].error);
            find(grazing, &d, 1, 2 * fabs(d), &a);
            if (!touch) assert_true(a.found.count == (sign > 0 ? 3 : 1) && a.root[sign > 0].kind == ROOTS_NEAR);
            if (!touch) assert_true(fabs(a.root[sign > 0].value + d) <= a.found.noise);
        }
    /* stays 0 up to the middle of the step, then falls */
    find(later, NULL, 0, 0, &a);
    assert_true(a.found.after == -1 && a.found.leaves > 0.4 && a.found.leaves < 1 && a.found.count == 0);
}

/* Coefficients that do not yet fall off bound what is unseen of a smooth function, whose coefficients go on falling. */
static void test_unresolved(void **state)
{
    (void)state;
    static double v[ROOTS_DEGREE_MOST + 1];
    static answer a;
    const function g[] = {sine50, exponential, bell, triple, sine300, pole, spike, chebyshev};
    for (size_t i = 0; i < sizeof g / sizeof *g; i++)
        for (int n = g[i] == chebyshev ? ROOTS_DEGREE_MOST : ROOTS_DEGREE_LEAST; n <= ROOTS_DEGREE_MOST; n *= 2) {
            for (int k = 0; k <= n; k++) v[k] = (double)g[i](NULL, roots_point(k, n));
            roots_fit(v, 1, n, 0, a.c, &a.fitted);
            for (int k = 0; k <= 1000; k++) {
                const double tau = k < 500 ? uniform() : k < 750 ? ldexp(uniform(), -16) : 1 - ldexp(uniform(), -16);
                const long double wrong = fabsl(sum_of(&a, tau) - g[i](NULL, tau));
                const double bound = a.fitted.noise + a.fitted.unseen;
                if (!(wrong <= bound)) fail_msg("function %zu, degree %d: %Lg above %g", i, n, wrong, bound);
            }
        }
}

/* What a step says of its ends and of what it stands on. */
static void test_ends(void **state)
{
    (void)state;
    static answer a;
    roots_found *found = &a.found;
    const roots_root *r = a.root;
    /* 1e-11 + t, wrong by 1e-10 */
    const double rising[2] = {0.5 + 1e-11, 0.5};
    assert_int_equal(roots_find(rising, 1, 1, 1e-10, 0, a.root, ROOM, found), ROOTS_COMPLETE);
    assert_true(found->count == 0 && found->last == 1);
    assert_int_equal(roots_find(rising, 1, -1, 1e-10, 0, a.root, ROOM, found), ROOTS_COMPLETE);
    assert_true(found->count == 1 && found->last == 1);
    assert_true(r->kind == ROOTS_RISING && r->from == 0 && r->tau == 0 && r->to > 0.9e-10 && r->to < 1e-10);
    assert_int_equal(roots_find(rising, 1, -1, 1e-12, 0, a.root, ROOM, found), ROOTS_COMPLETE);
    assert_true(found->count == 1 && r->kind == ROOTS_RISING && r->from == 0 && r->to == 0);
    assert_int_equal(roots_find(rising, 1, 0, 1e-12, 0, a.root, ROOM, found), ROOTS_COMPLETE);
    assert_true(found->count == 0 && found->after == 1 && found->leaves == 0 && found->noise > 1e-11);

    /* the sign is certain at both ends, the slope is, and is not */
    const double line[2] = {0, 1e-3};
    assert_int_equal(roots_find(line, 1, -1, 1e-4, 0, a.root, ROOM, found), ROOTS_COMPLETE);
    assert_true(found->count == 1 && r->kind == ROOTS_RISING && r->single && r->tau == 0.5);
    assert_int_equal(roots_find(line, 1, -1, 9e-4, 0, a.root, ROOM, found), ROOTS_COMPLETE);
    assert_true(found->count == 1 && r->kind == ROOTS_RISING && !r->single && r->tau == 0.5);

    /* where p turns within the noise there is no extremum */
    double wavy[ROOTS_CELL_DEGREE + 1] = {0};
    for (int k = 1; k <= ROOTS_CELL_DEGREE; k++) wavy[k] = (2 * uniform() - 1) * 1e-13;
    wavy[0] = 1e-9;
    assert_int_equal(roots_find(wavy, ROOTS_CELL_DEGREE, 1, 1e-11, 1, a.root, ROOM, found), ROOTS_COMPLETE);
    assert_int_equal(found->count, 0);

    /* a touch is where the extremum is, though its interval lies askew */
    find(skew, NULL, 1, 0, &a);
    roots_find(a.c, a.fitted.degree, 1, 1e-6, 0, a.root, ROOM, found);
    assert_true(found->count == 1 && r->kind == ROOTS_TOUCH && fabs(r->tau - 0.3) < 1e-12);
    assert_true(fabs((r->from + r->to) / 2 - 0.3) > 1e-8 && r->error > 1e-4);
}

/* --- bad input, full tables ------------------------------------------------------------------------------ */
static void test_limits(void **state)
{
    (void)state;
    static answer a;
    static const double bad[] = {NAN, INFINITY, -INFINITY, 1e308};
    roots_fitted fitted;
    for (int i = 0; i < 4; i++) {
        double v[ROOTS_DEGREE_LEAST + 1] = {1, 2, 3};
        v[5] = bad[i];
        assert_int_equal(roots_fit(v, 1, ROOTS_DEGREE_LEAST, 0, a.c, &fitted), ROOTS_FIT_NOT_FINITE);
        double c[3] = {0, bad[i], 1e-5};
        assert_int_equal(roots_find(c, 2, -1, 0, 0, a.root, ROOM, &a.found), i < 3 ? ROOTS_NOT_FINITE : ROOTS_COMPLETE);
        assert_int_equal(a.found.count, i == 3);
    }
    for (int n = -1; n < 600; n++) {
        const bool good = n >= 8 && n <= 256 && (n & (n - 1)) == 0;
        static double v[600];
        assert_int_equal(roots_fit(v, 1, n, 0, a.c, &fitted), good ? ROOTS_FIT_SMOOTH : ROOTS_FIT_NOT_FINITE);
    }
    const double line[2] = {0.25, 1}, tiny[3] = {0, -0x1p-1070, 0x1p-1073};
    assert_int_equal(roots_find(line, 1, -1, NAN, 0, a.root, ROOM, &a.found), ROOTS_NOT_FINITE);
    assert_int_equal(roots_find(line, 1, -1, 0, NAN, a.root, ROOM, &a.found), ROOTS_NOT_FINITE);
    assert_int_equal(roots_find(line, 1, -1, -1, 0, a.root, ROOM, &a.found), ROOTS_NOT_FINITE);
    assert_int_equal(roots_find(line, ROOTS_DEGREE_MOST + 1, -1, 0, 0, a.root, ROOM, &a.found), ROOTS_NOT_FINITE);
    assert_int_equal(roots_find(line, 1, -1, 0, INFINITY, a.root, ROOM, &a.found), ROOTS_COMPLETE);
    assert_int_equal(a.found.count, 1);
    assert_int_equal(roots_find(tiny, 2, 1, 0, 0, a.root, ROOM, &a.found), ROOTS_COMPLETE);
    assert_int_equal(a.found.count, 1);
    /* nothing but noise: from either side, or at rest */
    for (int before = -1; before <= 1; before++) {
        assert_int_equal(roots_find(line, 1, before, before ? 10 : INFINITY, 0, a.root, ROOM, &a.found),
                         ROOTS_COMPLETE);
        assert_true(a.found.after == 0 && a.found.last == before && (int)a.found.count == abs(before));
        if (before) assert_true(a.root[0].open && a.root[0].kind == ROOTS_TOUCH && a.root[0].from == 0);
    }

    /* with room for few, the first are told and where they end */
    find(sine50, NULL, 0, 0, &a);
    const answer all = a;
    for (size_t most = 0; most < all.found.count; most++) {
        const roots_status status = roots_find(a.c, a.fitted.degree, 0, a.fitted.noise, 0, a.root, most, &a.found);
        assert_int_equal(status, ROOTS_CUT);
        assert_int_equal(a.found.count, most);
        assert_true(a.found.reach == all.root[most].from);
        for (size_t k = 0; k < most; k++) assert_true(a.root[k].tau == all.root[k].tau);
    }

    /* random coefficients of the highest degree, without any smoothness: it ends, in order */
    for (int n = 0; n < 20; n++) {
        for (int k = 0; k <= ROOTS_DEGREE_MOST; k++) a.c[k] = 2 * uniform() - 1;
        a.fitted.degree = ROOTS_DEGREE_MOST;
        const int before = sign_of(sum_of(&a, 0));
        assert_int_equal(roots_find(a.c, ROOTS_DEGREE_MOST, before, 0, 0, a.root, ROOM, &a.found), ROOTS_COMPLETE);
        for (size_t k = 0; k < a.found.count; k++) {
            if (k == 0) continue;
            assert_true(a.root[k].from > a.root[k - 1].to);
            assert_true(sign_of(sum_of(&a, (a.root[k - 1].to + a.root[k].from) / 2)) == a.root[k].side);
        }
        assert_true(a.found.count > 50);
    }
}

static void test_none(void **state)
{
    (void)state;
    const double c[3] = {1, 0.5, 0.25};
    assert_true(roots_none(c, 2, 0.2) && !roots_none(c, 2, 0.25));
    assert_false(roots_none((double[]){NAN, 0}, 1, 0));
    assert_false(roots_none((double[]){1, NAN}, 1, 0));
    assert_false(roots_none((double[]){1, 0}, 1, NAN));
}

int main(int count, char **argument)
{
    polynomials = count > 1 ? atol(argument[1]) : polynomials / share_one_in();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_points),      cmocka_unit_test(test_coefficients), cmocka_unit_test(test_cells),
        cmocka_unit_test(test_functions),   cmocka_unit_test(test_grazing),      cmocka_unit_test(test_limits),
        cmocka_unit_test(test_none),        cmocka_unit_test(test_unresolved),   cmocka_unit_test(test_ends),
        cmocka_unit_test(test_polynomials), cmocka_unit_test(test_standing),     cmocka_unit_test(test_steps),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
