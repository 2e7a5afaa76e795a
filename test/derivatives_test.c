/* The first three derivatives of every operation, along curves u(t), w(t) through many points, against central
 * differences of 400 bits: also along curves whose own derivative is 0 at the point, where a chain rule with a case
 * distinction goes wrong. */
#include "test/graph_world.h"

#include <mpfr.h>

enum { BITS = 400, STEP = -40, ORDERS = 3, COEFFICIENTS = 4 };

static void power(mpfr_t r, const mpfr_t a, const mpfr_t b) { mpfr_pow(r, a, b, MPFR_RNDN); }

/* Values of 400 bits of the operations that functions of MPFR do not have. */
static bool value_of(operation op, mpfr_t r, mpfr_t a, mpfr_t b)
{
    switch (op) {
    case OP_NEG: mpfr_neg(r, a, MPFR_RNDN); return true;
    case OP_ADD: mpfr_add(r, a, b, MPFR_RNDN); return true;
    case OP_SUB: mpfr_sub(r, a, b, MPFR_RNDN); return true;
    case OP_MUL: mpfr_mul(r, a, b, MPFR_RNDN); return true;
    case OP_DIV: mpfr_div(r, a, b, MPFR_RNDN); return true;
    case OP_POW: power(r, a, b); return true;
    case OP_SIN: mpfr_sin(r, a, MPFR_RNDN); return true;
    case OP_COS: mpfr_cos(r, a, MPFR_RNDN); return true;
    case OP_TAN: mpfr_tan(r, a, MPFR_RNDN); return true;
    case OP_ASIN: mpfr_asin(r, a, MPFR_RNDN); return true;
    case OP_ACOS: mpfr_acos(r, a, MPFR_RNDN); return true;
    case OP_ATAN: mpfr_atan(r, a, MPFR_RNDN); return true;
    case OP_ATAN2: mpfr_atan2(r, a, b, MPFR_RNDN); return true;
    case OP_SINH: mpfr_sinh(r, a, MPFR_RNDN); return true;
    case OP_COSH: mpfr_cosh(r, a, MPFR_RNDN); return true;
    case OP_TANH: mpfr_tanh(r, a, MPFR_RNDN); return true;
    case OP_EXP: mpfr_exp(r, a, MPFR_RNDN); return true;
    case OP_LOG: mpfr_log(r, a, MPFR_RNDN); return true;
    case OP_SQRT: mpfr_sqrt(r, a, MPFR_RNDN); return true;
    case OP_CBRT: mpfr_cbrt(r, a, MPFR_RNDN); return true;
    case OP_HYPOT: mpfr_hypot(r, a, b, MPFR_RNDN); return true;
    case OP_ABS: mpfr_abs(r, a, MPFR_RNDN); return true;
    case OP_MIN: mpfr_min(r, a, b, MPFR_RNDN); return true;
    case OP_MAX: mpfr_max(r, a, b, MPFR_RNDN); return true;
    case OP_FLOOR: mpfr_floor(r, a); return true;
    case OP_SIGN: mpfr_set_si(r, mpfr_sgn(a), MPFR_RNDN); return true;
    case OP_ERF: mpfr_erf(r, a, MPFR_RNDN); return true;
    case OP_MOD:
        mpfr_div(r, a, b, MPFR_RNDN);
        mpfr_floor(r, r);
        mpfr_mul(r, r, b, MPFR_RNDN);
        mpfr_sub(r, a, r, MPFR_RNDN);
        return true;
    default: return false;
    }
}

/* The curve c[0] + c[1] t + c[2] t² + c[3] t³ at t = k 2^STEP. */
static void curve_at(mpfr_t r, const double *c, long k)
{
    mpfr_t t;
    mpfr_init2(t, BITS);
    mpfr_set_si_2exp(t, k, STEP, MPFR_RNDN);
    mpfr_set_d(r, c[COEFFICIENTS - 1], MPFR_RNDN);
    for (int i = COEFFICIENTS - 1; i-- > 0;) {
        mpfr_mul(r, r, t, MPFR_RNDN);
        mpfr_add_d(r, r, c[i], MPFR_RNDN);
    }
    mpfr_clear(t);
}

static node curve_node(graph *g, const double *c)
{
    node t = graph_time(g), r = graph_const(g, c[COEFFICIENTS - 1]);
    for (int i = COEFFICIENTS - 1; i-- > 0;) r = bin(g, OP_ADD, bin(g, OP_MUL, r, t), graph_const(g, c[i]));
    return r;
}

/* Derivatives 1 to 3 by central differences over t = -3 … 3 steps; their error goes with the square of the step,
 * 2^-80. */
static void differences(operation op, const double *u, const double *w, double out[ORDERS + 1])
{
    static const long weight[ORDERS + 1][7] = {
        {0, 0, 0, 1, 0, 0, 0}, {0, 0, -1, 0, 1, 0, 0}, {0, 0, 1, -2, 1, 0, 0}, {0, -1, 2, 0, -2, 1, 0}};
    static const long over[ORDERS + 1] = {0, 1, 0, 1}; /* divided by 2 */
    mpfr_t a, b, y[7], sum, term;
    mpfr_inits2(BITS, a, b, sum, term, (mpfr_ptr)0);
    for (int k = 0; k < 7; k++) {
        mpfr_init2(y[k], BITS);
        curve_at(a, u, k - 3);
        curve_at(b, w, k - 3);
        assert_true(value_of(op, y[k], a, b));
    }
    for (int order = 0; order <= ORDERS; order++) {
        mpfr_set_zero(sum, 1);
        for (int k = 0; k < 7; k++) {
            mpfr_mul_si(term, y[k], weight[order][k], MPFR_RNDN);
            if (weight[order][k]) mpfr_add(sum, sum, term, MPFR_RNDN);
        }
        mpfr_mul_2si(sum, sum, -STEP * order - over[order], MPFR_RNDN);
        out[order] = mpfr_get_d(sum, MPFR_RNDN);
    }
    for (int k = 0; k < 7; k++) mpfr_clear(y[k]);
    mpfr_clears(a, b, sum, term, (mpfr_ptr)0);
}

/* The sum of what is added up in a derivative bounds its rounding: the derivatives of the operation with every
 * coefficient of the curves taken at its size are a measure of it. */
static void check(operation op, const double *u, const double *w)
{
    static world world;
    world_make(&world, 4, 2, 2, 4);
    fixture f = begin(&world);
    graph *g = start(&f);
    node n = graph_op(g, op, curve_node(g, u), curve_node(g, w), 0);
    double due[ORDERS + 1], size = 1;
    differences(op, u, w, due);
    for (int order = 0; order <= ORDERS; order++) size = fmax(size, fabs(due[order]));
    for (int order = 0; order <= ORDERS; order++) {
        const double is = run_one(&f, n, 0);
        if (!(fabs(is - due[order]) <= 1e-12 * size))
            fail_msg("%s at %g, %g, %g, %g and %g, %g, %g, %g: derivative %d is %.17g, not %.17g",
                     operation_at(op)->spelling, u[0], u[1], u[2], u[3], w[0], w[1], w[2], w[3], order, is, due[order]);
        if (order < ORDERS) n = graph_derivative(g, n, graph_seed_time, NULL);
    }
    arena_release(&f.arena);
}

/* A point at which the operation is defined and smooth. */
static void point_of(operation op, double *u, double *w)
{
    u[0] = 0.3 + 0.05 * draw(10);
    w[0] = 0.9 + 0.05 * draw(10);
    if ((op == OP_SIN || op == OP_ABS || op == OP_SIGN || op == OP_ATAN2 || op == OP_HYPOT || op == OP_CBRT) && draw(2))
        u[0] = -u[0];
    if (op == OP_FLOOR || op == OP_MOD) u[0] += 2.11;
    if ((op == OP_MIN || op == OP_MAX) && draw(2)) u[0] += 1;
    for (int k = 1; k < COEFFICIENTS; k++) u[k] = number(), w[k] = number();
}

static void three_derivatives(void **state)
{
    (void)state;
    int tested = 0;
    for (operation op = OP_NEG; op < OPERATIONS; op++) {
        mpfr_t a;
        mpfr_init2(a, BITS);
        mpfr_set_d(a, 0.5, MPFR_RNDN);
        const bool known = value_of(op, a, a, a);
        mpfr_clear(a);
        if (!known) continue;
        tested++;
        for (int try = 0; try < 24; try++) {
            double u[COEFFICIENTS], w[COEFFICIENTS];
            point_of(op, u, w);
            if (try % 4 >= 1) u[1] = 0;
            if (try % 4 >= 2) w[1] = 0;
            if (try % 4 == 3) u[2] = 0;
            if (try % 8 >= 6) w[2] = 0;
            check(op, u, w);
        }
    }
    assert_int_equal(tested, 28);
}

/* hypot where the first derivative of what is under the root is 0 although neither operand rests; and |r| as the root
 * of a scalar product. */
static void lengths(void **state)
{
    (void)state;
    const double u[] = {3, 4, 0.5, -1}, w[] = {4, -3, 0.25, 2}, zero[] = {0, 0, 0, 0}, still[] = {1, 0, 1, 0};
    check(OP_HYPOT, u, w);
    check(OP_HYPOT, u, zero);
    check(OP_HYPOT, zero, w);
    check(OP_SQRT, still, zero);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(three_derivatives), cmocka_unit_test(lengths)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
