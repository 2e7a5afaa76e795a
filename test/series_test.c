/* The recurrences of step/series.h, one for each row of lang/base/operations.def, in 113 bits and in double precision.
 *
 * In 113 bits by what defines the operation: its differential equation, or its inverse, multiplied out by plain
 * products of polynomials, which together with the value at 0 determines every coefficient. In double
 * precision by Cauchy's integral of the function over a circle, which knows no recurrence at all.
 */
#include "test/given.h"
#include "test/series_quad.h"

#include <complex.h>
#include <math.h>
#include <string.h>

enum { ORDERS = 48, LENGTH = ORDERS + 1, TRIALS = 40 }; /* as long as the longest series */

/* Polynomials that know how large the terms were that they are made of ---------------------------------------------*/

typedef struct poly {
    quad c[ORDERS], size[ORDERS];
} poly;

static quad magnitude(quad x) { return x < 0 ? -x : x; }

static poly times(poly a, poly b)
{
    poly r = {0};
    for (int n = 0; n < ORDERS; n++)
        for (int j = 0; j <= n; j++) {
            r.c[n] += a.c[j] * b.c[n - j];
            r.size[n] += a.size[j] * b.size[n - j];
        }
    return r;
}

static poly plus(poly a, poly b, int sign)
{
    for (int n = 0; n < ORDERS; n++) a.c[n] += sign * b.c[n], a.size[n] += b.size[n];
    return a;
}

static poly number(quad x) { return (poly){.c = {x}, .size = {magnitude(x)}}; }

/* t a' */
static poly rate(poly a)
{
    for (int n = 0; n < ORDERS; n++) a.c[n] *= n, a.size[n] *= n;
    return a;
}

static poly poly_of(const quad *at, int last)
{
    poly r = {0};
    for (int n = 0; n < ORDERS && n <= last; n++) r.c[n] = at[n], r.size[n] = magnitude(at[n]);
    return r;
}

/* The two sides of an equation that defines an operation. */
typedef struct sides {
    poly left, right;
} sides;
enum { EQUATIONS = 2 }; /* the second is that of a helper; elsewhere nothing is nothing */

/* r: the result and its helpers. */
static sides equation(operation op, int which, poly a, poly b, poly c, const poly *r)
{
    const quad from = a.c[0], to = b.c[0];
    const poly one = number(1), none = number(0), minus = number(-1), da = rate(a), dr = rate(*r), helper = r[1],
               dh = rate(helper);
    if (which == 1) switch (op) {
        case OP_SIN: return (sides){dh, times(minus, times(*r, da))};
        case OP_COS:
        case OP_SINH:
        case OP_COSH: return (sides){dh, times(*r, da)};
        case OP_TAN: return (sides){helper, plus(one, times(*r, *r), 1)};
        case OP_TANH: return (sides){helper, plus(one, times(*r, *r), -1)};
        case OP_ASIN:
        case OP_ACOS: return (sides){times(helper, helper), plus(one, times(a, a), -1)};
        case OP_ATAN: return (sides){helper, plus(one, times(a, a), 1)};
        case OP_ATAN2: return (sides){helper, plus(times(a, a), times(b, b), 1)};
        case OP_ERF: return (sides){dh, times(number(-2), times(helper, times(a, da)))};
        default: return (sides){none, none};
        }
    switch (op) {
    case OP_NEG: return (sides){plus(*r, a, 1), none};
    case OP_ADD: return (sides){*r, plus(a, b, 1)};
    case OP_SUB: return (sides){*r, plus(a, b, -1)};
    case OP_MUL: return (sides){*r, times(a, b)};
    case OP_DIV: return (sides){times(*r, b), a};
    case OP_FMA: return (sides){*r, plus(times(a, b), c, 1)};
    case OP_FMS: return (sides){*r, plus(times(a, b), c, -1)};
    case OP_FNMA: return (sides){*r, plus(c, times(a, b), -1)};
    case OP_SELECT: return (sides){*r, from != 0 ? b : c};
    case OP_POW: return (sides){times(a, dr), times(number(to), times(*r, da))};
    case OP_SIN: return (sides){dr, times(helper, da)};
    case OP_COS: return (sides){dr, times(minus, times(helper, da))};
    case OP_SINH:
    case OP_COSH: return (sides){dr, times(helper, da)};
    case OP_TAN: return (sides){dr, times(plus(one, times(*r, *r), 1), da)};
    case OP_TANH: return (sides){dr, times(plus(one, times(*r, *r), -1), da)};
    case OP_ASIN: return (sides){times(helper, dr), da};
    case OP_ACOS: return (sides){times(helper, dr), times(minus, da)};
    case OP_ATAN: return (sides){times(dr, plus(one, times(a, a), 1)), da};
    case OP_ATAN2:
        return (sides){times(dr, plus(times(a, a), times(b, b), 1)), plus(times(da, b), times(rate(b), a), -1)};
    case OP_EXP: return (sides){dr, times(*r, da)};
    case OP_LOG: return (sides){times(a, dr), da};
    case OP_SQRT: return (sides){times(*r, *r), a};
    case OP_CBRT: return (sides){times(number(3), times(a, dr)), times(*r, da)};
    case OP_HYPOT: return (sides){times(*r, *r), plus(times(a, a), times(b, b), 1)};
    case OP_ABS: return (sides){*r, times(number(from < 0 ? -1 : 1), a)};
    case OP_MIN: return (sides){*r, from <= to ? a : b};
    case OP_MAX: return (sides){*r, from >= to ? a : b};
    case OP_MOD: return (sides){*r, plus(a, times(number((quad)floor((double)(from / to))), b), -1)};
    case OP_ERF: return (sides){dr, times(number(1.1283791670955126), times(helper, da))};
    default: return (sides){*r, number(series_quad_value(op, from, to, c.c[0]))};
    }
}

/* How far the two sides of coefficient n may be apart, in half units of their terms. A sum of n + 1 products rounds
 * each of them at most n + 2 times. A recurrence has at most two, one within the other, and six operations around each;
 * an equation three. The sums of a power are larger than the terms of its equation by 1 + 2 |c|. */
static quad roundings(operation op, int n, quad power)
{
    const quad count = 5 * (n + 8);
    return op == OP_POW ? (1 + 2 * magnitude(power)) * count : op == OP_CBRT ? 2 * count : count;
}

/* Operands ----------------------------------------------------------------------------------------------------------*/

static uint64_t state = 20261123;
static double uniform(double from, double to)
{
    state = state * 6364136223846793005u + 1442695040888963407u;
    return from + (to - from) * (double)(state >> 11) * 0x1p-53;
}

typedef struct operand {
    quad at[ORDERS];
    int last;
} operand;

static operand operand_from(double first, double second, int last)
{
    operand o = {.last = last};
    double size = 1;
    for (int n = 0; n < ORDERS && n <= last; n++, size /= 2)
        o.at[n] = n == 0 ? (quad)uniform(first, second) : (quad)(uniform(-1, 1) * size);
    return o;
}

/* Where the operation is defined, and a step away from where it is not. */
static operand first_operand(operation op, int last)
{
    switch (op) {
    case OP_POW:
    case OP_LOG:
    case OP_SQRT: return operand_from(0.5, 2, last);
    case OP_ASIN:
    case OP_ACOS: return operand_from(-0.4, 0.4, last);
    case OP_SELECT: return operand_from(uniform(0, 1) < 0.5 ? 0 : 1, uniform(0, 1) < 0.5 ? 0 : 1, 0);
    case OP_CBRT:
    case OP_ABS: return uniform(0, 1) < 0.5 ? operand_from(-2, -0.5, last) : operand_from(0.5, 2, last);
    default: return operand_from(-1.4, 1.4, last);
    }
}

static series_quad of(const operand *o) { return (series_quad){o->at, o->last < ORDERS ? o->last : SERIES_QUAD_ALL}; }

static void expand(operation op, series_quad a, series_quad b, series_quad c, quad r[SERIES_QUAD_HELPERS][LENGTH])
{
    memset(r, 0, SERIES_QUAD_HELPERS * LENGTH * sizeof(quad));
    for (int n = 0; n < ORDERS; n++) r[0][n] = series_quad_next(op, r[0], LENGTH, a, b, c, n);
}

static const int lasts[] = {ORDERS, 1, 0, 2};
enum { LASTS = 4 };

static void every_recurrence_solves_its_equation(void **unused)
{
    (void)unused;
    int seen = 0;
    for (operation op = 0; op < OPERATIONS; op++) {
        if (!series_quad_moves(op)) continue;
        seen++;
        for (int trial = 0; trial < TRIALS; trial++) {
            const int last = lasts[trial % LASTS], other = op == OP_POW ? 0 : lasts[trial / LASTS % LASTS];
            operand a = first_operand(op, last), b = operand_from(0.5, 1.5, other), c = operand_from(-1, 1, ORDERS);
            quad r[SERIES_QUAD_HELPERS][LENGTH];
            poly all[SERIES_QUAD_HELPERS];
            if (op == OP_POW && trial % 5 == 0) b.at[0] = -1.5;
            if (trial % 7 == 6 && op != OP_POW && last == other) b = a; /* a square has terms of its own */
            const bool square = b.at[0] == a.at[0] && b.last == a.last;
            expand(op, of(&a), square ? of(&a) : of(&b), of(&c), r);
            for (int k = 0; k < SERIES_QUAD_HELPERS; k++) all[k] = poly_of(r[k], ORDERS);
            for (int which = 0; which < EQUATIONS; which++) {
                const sides e =
                    equation(op, which, poly_of(a.at, a.last), poly_of(b.at, b.last), poly_of(c.at, c.last), all);
                for (int n = 0; n < ORDERS; n++) {
                    const quad bound =
                        roundings(op, n, b.at[0]) * QUAD_EPSILON / 2 * (e.left.size[n] + e.right.size[n]);
                    if (!(magnitude(e.left.c[n] - e.right.c[n]) <= bound))
                        fail_msg("%s: coefficient %d: %.17g is not %.17g, trial %d", series_quad_text(op), n,
                                 (double)e.left.c[n], (double)e.right.c[n], trial);
                }
            }
        }
    }
    assert_int_equal(seen, OPERATIONS - 8 - 13); /* all but the leaves and what is constant between kinks */
}

/* Cauchy's integral -------------------------------------------------------------------------------------------------*/

typedef double complex point;

static point complex_erf(point z)
{
    point term = z, sum = 0;
    for (int k = 0; k < 60; k++) {
        sum += term / (2 * k + 1);
        term *= -z * z / (k + 1);
    }
    return 1.1283791670955126 * sum;
}

/* The function that continues the operation from the real operands a0, b0 on; false: it is tested above alone. */
static bool continued(operation op, point a, point b, point *r)
{
    switch (op) {
    case OP_MUL: *r = a * b; break;
    case OP_DIV: *r = a / b; break;
    case OP_POW: *r = cpow(a, b); break;
    case OP_SIN: *r = csin(a); break;
    case OP_COS: *r = ccos(a); break;
    case OP_TAN: *r = ctan(a); break;
    case OP_ASIN: *r = casin(a); break;
    case OP_ACOS: *r = cacos(a); break;
    case OP_ATAN: *r = catan(a); break;
    case OP_ATAN2: *r = catan(a / b); break;
    case OP_SINH: *r = csinh(a); break;
    case OP_COSH: *r = ccosh(a); break;
    case OP_TANH: *r = ctanh(a); break;
    case OP_EXP: *r = cexp(a); break;
    case OP_LOG: *r = clog(a); break;
    case OP_SQRT: *r = csqrt(a); break;
    case OP_CBRT: *r = creal(a) < 0 ? -cpow(-a, 1.0 / 3.0) : cpow(a, 1.0 / 3.0); break;
    case OP_HYPOT: *r = csqrt(a * a + b * b); break;
    case OP_ERF: *r = complex_erf(a); break;
    default: return false;
    }
    return true;
}

static point at_point(const operand *o, point z)
{
    point sum = 0;
    for (int n = ORDERS; n-- > 0;) sum = sum * z + (double)o->at[n];
    return sum;
}

static void every_recurrence_is_the_function_itself(void **unused)
{
    (void)unused;
    enum { POINTS = 128 };
    const double radius = 0.25;
    for (operation op = 0; op < OPERATIONS; op++) {
        point probe;
        if (!series_quad_moves(op) || !continued(op, 1, 1, &probe)) continue;
        for (int trial = 0; trial < TRIALS; trial++) {
            operand a = first_operand(op, ORDERS), b = operand_from(0.9, 1.5, op == OP_POW ? 0 : ORDERS),
                    c = operand_from(-1, 1, 0);
            quad r[SERIES_QUAD_HELPERS][LENGTH];
            point f[POINTS];
            double largest = 0;
            if (op == OP_POW && trial % 2) b.at[0] = -1.5;
            expand(op, of(&a), of(&b), of(&c), r);
            for (int k = 0; k < POINTS; k++) {
                const point z = radius * cexp(2 * M_PI * I * k / POINTS);
                continued(op, at_point(&a, z), at_point(&b, z), &f[k]);
                largest = fmax(largest, cabs(f[k]));
            }
            for (int n = 0; n < ORDERS; n++) {
                point sum = 0;
                for (int k = 0; k < POINTS; k++) sum += f[k] * cexp(-2 * M_PI * I * k * n / POINTS);
                const double due = creal(sum) / POINTS, is = (double)r[0][n] * pow(radius, n);
                /* the C library's complex functions are a few roundings off, and operands beyond order 25 are not 0 */
                if (!(fabs(is - due) <= 64 * ROUNDING * largest + pow(radius / 2, ORDERS)))
                    fail_msg("%s: coefficient %d is %g, not %g, in units of the circle's radius", series_quad_text(op),
                             n, is, due);
            }
        }
    }
}

/* Where an operand is 0 throughout, as the velocity of a body at rest under drag, the result is 0 throughout. */
static void a_root_of_nothing_is_nothing(void **unused)
{
    (void)unused;
    const operand none = {.last = ORDERS}, power = {.at = {1.5}};
    for (operation op = 0; op < OPERATIONS; op++) {
        if (op != OP_SQRT && op != OP_CBRT && op != OP_HYPOT && op != OP_POW) continue;
        quad r[SERIES_QUAD_HELPERS][LENGTH];
        expand(op, of(&none), op == OP_POW ? of(&power) : of(&none), of(&none), r);
        for (int n = 0; n < ORDERS; n++) assert_true(r[0][n] == 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_recurrence_solves_its_equation),
        cmocka_unit_test(every_recurrence_is_the_function_itself),
        cmocka_unit_test(a_root_of_nothing_is_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
