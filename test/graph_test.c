/* The graph: the values of operations, constant folding, derivatives against difference quotients, the analysis, the
 * normal form, and how nodes are printed.
 */
#include <float.h>
#include "graph_world.h"

/* Operations ------------------------------------------------------------------------------------------------------- */

/* An argument inside the domain of each operation, away from kinks and poles. */
static void argument(operation op, double *a, double *b, double *c)
{
    *a = number(), *b = number(), *c = number();
    switch (op) {
    case OP_DIV:
    case OP_MOD: *b += *b < 0 ? -0.5 : 0.5; break;
    case OP_POW: *a = fabs(*a) + 0.1; break;
    case OP_ASIN:
    case OP_ACOS: *a *= 0.4; break;
    case OP_LOG:
    case OP_SQRT: *a = fabs(*a) + 0.1; break;
    case OP_CBRT: *a += *a < 0 ? -0.5 : 0.5; break;
    case OP_ATAN2:
    case OP_HYPOT: *b += 3; break;
    case OP_TAN: *a *= 0.5; break;
    default: break;
    }
}

static long double exact_value(operation op, long double a, long double b, long double c)
{
    switch (op) {
    case OP_NEG: return -a;
    case OP_ADD: return a + b;
    case OP_SUB: return a - b;
    case OP_MUL: return a * b;
    case OP_DIV: return a / b;
    case OP_FMA: return a * b + c;
    case OP_FMS: return a * b - c;
    case OP_FNMA: return c - a * b;
    case OP_LT: return a < b;
    case OP_LE: return a <= b;
    case OP_GT: return a > b;
    case OP_GE: return a >= b;
    case OP_EQ: return a == b;
    case OP_NE: return a != b;
    case OP_AND: return a != 0 && b != 0;
    case OP_OR: return a != 0 || b != 0;
    case OP_NOT: return a == 0;
    case OP_SELECT: return a != 0 ? b : c;
    case OP_POW: return powl(a, b);
    case OP_SIN: return sinl(a);
    case OP_COS: return cosl(a);
    case OP_TAN: return tanl(a);
    case OP_ASIN: return asinl(a);
    case OP_ACOS: return acosl(a);
    case OP_ATAN: return atanl(a);
    case OP_ATAN2: return atan2l(a, b);
    case OP_SINH: return sinhl(a);
    case OP_COSH: return coshl(a);
    case OP_TANH: return tanhl(a);
    case OP_EXP: return expl(a);
    case OP_LOG: return logl(a);
    case OP_SQRT: return sqrtl(a);
    case OP_CBRT: return cbrtl(a);
    case OP_HYPOT: return hypotl(a, b);
    case OP_ABS: return fabsl(a);
    case OP_MIN: return a < b || isnan(a) ? a : b;
    case OP_MAX: return a > b || isnan(a) ? a : b;
    case OP_FLOOR: return floorl(a);
    case OP_MOD: return a - b * floorl(a / b);
    case OP_SIGN: return (a > 0) - (a < 0);
    case OP_ERF: return erfl(a);
    default: fail_msg("operation %d has no value here", op); return 0;
    }
}

/* Returns whether any numbers are its operands: a table has a test of its own (table_test.c). */
static bool is_operation(operation op) { return operation_at(op)->arity > 0 && op != OP_FIND && op != OP_ENTRY; }

static void values_are_what_they_say(void **state)
{
    (void)state;
    for (int op = 0; op < OPERATIONS; op++)
        for (int k = 0; is_operation(op) && k < 200; k++) {
            double a, b, c;
            argument(op, &a, &b, &c);
            long double wanted = exact_value(op, a, b, c);
            double got = operation_value(op, a, b, c);
            if (!(fabsl(got - wanted) <= 4 * DBL_EPSILON * (fabsl(wanted) + 1)))
                fail_msg("%s(%g, %g, %g) = %.17g, not %.17Lg", operation_at(op)->spelling, a, b, c, got, wanted);
        }
    assert_true(isnan(operation_value(OP_MIN, NAN, 1, 0)) && isnan(operation_value(OP_MAX, 1, NAN, 0)));
    assert_true(operation_value(OP_SELECT, 0, NAN, 2) == 2 && operation_value(OP_SELECT, 1, 2, NAN) == 2);
    assert_true(operation_value(OP_MOD, -1, 3, 0) == 2 && operation_value(OP_SIGN, 0, 0, 0) == 0);
}

static void folding_is_running(void **state)
{
    (void)state;
    static world w;
    world_make(&w, 3, 1, 1, 1);
    static const double special[] = {0, -0.0, 1, -1, 0.5, 1e308, -1e308, 5e-324, INFINITY, -INFINITY, NAN};
    enum { SPECIAL = sizeof special / sizeof *special };
    for (int op = 0; op < OPERATIONS; op++)
        for (int k = 0; is_operation(op) && k < 60; k++) {
            fixture f = begin(&w);
            graph *g = start(&f);
            argument(op, &w.pool[0], &w.pool[1], &w.pool[2]);
            for (int j = 0; k >= 20 && j < 3; j++)
                if (draw(2)) w.pool[j] = special[draw(SPECIAL)];
            node constant =
                graph_op(g, op, graph_const(g, w.pool[0]), graph_const(g, w.pool[1]), graph_const(g, w.pool[2]));
            node running = graph_op(g, op, graph_param(g, 0), graph_param(g, 1), graph_param(g, 2));
            assert_int_equal(graph_at(g, constant)->op, OP_CONST);
            assert_int_equal(graph_at(g, running)->op, op);
            double got = run_one(&f, running, 0);
            if (!same_bits(graph_at(g, constant)->value, got))
                fail_msg("%s(%a, %a, %a): folded %a, run %a", operation_at(op)->spelling, w.pool[0], w.pool[1],
                         w.pool[2], graph_at(g, constant)->value, got);
            arena_release(&f.arena);
        }
}

/* Derivatives ------------------------------------------------------------------------------------------------------ */

static long double exact_at(const graph *g, const world *w, node n, long double x)
{
    const graph_node *m = &g->nodes[n];
    switch (m->op) {
    case OP_CONST: return m->value;
    case OP_PARAM: return w->pool[m->a];
    case OP_LOAD: return x;
    default: {
        int arity = operation_at(m->op)->arity;
        return exact_value(m->op, exact_at(g, w, m->a, x), arity > 1 ? exact_at(g, w, m->b, x) : 0,
                           arity > 2 ? exact_at(g, w, m->c, x) : 0);
    }
    }
}

/* The derivative along x against Richardson's extrapolation of the central difference. False if the difference has
 * not converged: a kink, a pole or a cliff is near. */
static bool derivative_holds(fixture *f, node n)
{
    graph *g = f->g;
    long double x = f->w->x[0], h = 1e-3L, q[4];
    for (int k = 0; k < 4; k++, h /= 4) q[k] = (exact_at(g, f->w, n, x + h) - exact_at(g, f->w, n, x - h)) / (2 * h);
    long double first = (16 * q[2] - q[1]) / 15, second = (16 * q[3] - q[2]) / 15,
                wanted = (256 * second - first) / 255;
    if (!isfinite((double)wanted) || fabsl(wanted) > 1e6 || fabsl(second - first) > 1e-7L * (fabsl(wanted) + 1))
        return false;
    double got = run_one(f, graph_derivative(g, n, seed_one, NULL), 0);
    if (!(fabsl(got - wanted) < 1e-7L * (fabsl(wanted) + 1))) {
        char text[2000];
        graph_print(g, n, NULL, NULL, text, sizeof text);
        fail_msg("derivative at %.17g is %.12g, not %.12Lg, of %s", f->w->x[0], got, wanted, text);
    }
    return true;
}

static void every_operation_has_its_derivative(void **state)
{
    (void)state;
    static world w;
    world_make(&w, 3, 1, 1, 1);
    for (int op = 0; op < OPERATIONS; op++) {
        int held = 0;
        for (int k = 0; is_operation(op) && k < 60; k++) {
            int arity = operation_at(op)->arity;
            fixture f = begin(&w);
            graph *g = start(&f);
            double argument_of[3];
            argument(op, &argument_of[0], &argument_of[1], &argument_of[2]);
            node operand[3];
            /* x is in one operand, or in all, scaled and shifted so that each has its own argument and slope. */
            for (int j = 0; j < 3; j++) {
                double slope = k % 2 || k / 2 % arity == j ? 0.5 + 0.25 * j : 0;
                node linear = bin(g, OP_MUL, graph_const(g, slope), load(g, ref0(SCALAR)));
                operand[j] = slope == 0 ? graph_const(g, argument_of[j])
                                        : bin(g, OP_ADD, linear, graph_const(g, argument_of[j] - slope * w.x[0]));
            }
            held += derivative_holds(&f, graph_op(g, op, operand[0], operand[1], operand[2]));
            arena_release(&f.arena);
        }
        if (is_operation(op) && held < 30)
            fail_msg("%s: only %d quotients could be formed", operation_at(op)->spelling, held);
    }
}

static node random_smooth(fixture *f, int depth)
{
    static const operation ops[] = {OP_ADD, OP_SUB,  OP_MUL,  OP_MUL,  OP_DIV,   OP_NEG, OP_SIN,    OP_COS,
                                    OP_EXP, OP_TANH, OP_SQRT, OP_ATAN, OP_HYPOT, OP_ERF, OP_SELECT, OP_ABS,
                                    OP_MAX, OP_POW,  OP_FMA,  OP_FMS,  OP_FNMA,  OP_LOG, OP_CBRT};
    graph *g = f->g;
    if (!depth || !draw(6))
        return draw(3) ? load(g, ref0(SCALAR)) : draw(2) ? graph_const(g, number()) : graph_param(g, draw(PARAMS));
    operation op = ops[draw(sizeof ops / sizeof *ops)];
    node a = random_smooth(f, depth - 1), b = random_smooth(f, depth - 1), c = random_smooth(f, depth - 1);
    if (op == OP_SELECT) a = bin(g, OP_LT, a, c);
    if (op == OP_POW) return draw(2) ? graph_power(g, a, (int)draw(9) - 4) : bin(g, OP_POW, a, b);
    return graph_op(g, op, a, b, c);
}

static void composites_have_their_derivatives(void **state)
{
    (void)state;
    static world w;
    world_make(&w, 3, 1, 1, 1);
    int held = 0;
    for (int k = 0; k < 3000; k++) {
        fixture f = begin(&w);
        start(&f);
        w.x[0] = number();
        held += derivative_holds(&f, random_smooth(&f, 2 + k % 4));
        arena_release(&f.arena);
    }
    assert_true(held > 1500);
}

static void a_derivative_is_not_poisoned(void **state)
{
    (void)state;
    static world w;
    world_make(&w, 3, 1, 1, 1);
    fixture f = begin(&w);
    graph *g = start(&f);
    node x = load(g, ref0(SCALAR)), root = un(g, OP_SQRT, x);
    node guarded = graph_op(g, OP_SELECT, bin(g, OP_GT, x, 0), root, x);
    node speed = bin(g, OP_MUL, un(g, OP_SQRT, graph_power(g, x, 2)), x); /* |x| x */
    node power = bin(g, OP_POW, x, graph_param(g, 0));
    w.x[0] = 0;
    assert_true(run_one(&f, graph_derivative(g, guarded, seed_one, NULL), 0) == 1);
    assert_true(run_one(&f, graph_derivative(g, speed, seed_one, NULL), 0) == 0);
    assert_true(run_one(&f, graph_derivative(g, un(g, OP_ABS, x), seed_one, NULL), 0) == 0);
    w.x[0] = -2; /* (-2)^3: the slope in the exponent, log(-2), must not enter */
    w.pool[0] = 3;
    assert_true(run_one(&f, graph_derivative(g, power, seed_one, NULL), 0) == 12);
    arena_release(&f.arena);
}

static void seeds_shift_arrays(void **state)
{
    (void)state;
    static world w;
    world_make(&w, 3, 1, 1, 1);
    fixture f = begin(&w);
    graph *g = start(&f);
    graph_shift shift = {DIRECTION_CHAIN - CHAIN, 0};
    range r = {literal(1), slot(INT_N, 0)};
    node squares = sum_over(g, 0, r, 0, graph_power(g, load(g, ref1(CHAIN, level(0, 0))), 2));
    double wanted = 0;
    for (int k = 1; k <= 3; k++) wanted += 2 * w.x[1 + k] * w.dx[1 + k];
    double got =
        run_one(&f, graph_derivative(g, bin(g, OP_MUL, squares, graph_time(g)), graph_seed_direction, &shift), 2);
    assert_true(fabs(got - 2 * wanted) < 1e-12);
    /* The derivative of a masked sum is masked: 1/(k - 2) does not enter at k = 2. */
    node k = graph_index(g, 0), two = graph_const(g, 2);
    node masked = sum_over(g, 0, r, bin(g, OP_NE, k, two),
                           bin(g, OP_DIV, load(g, ref1(CHAIN, level(0, 0))), bin(g, OP_SUB, k, two)));
    got = run_one(&f, graph_derivative(g, masked, graph_seed_direction, &shift), 0);
    assert_true(fabs(got - (w.dx[4] - w.dx[2])) < 1e-12);
    arena_release(&f.arena);
}

/* Analysis --------------------------------------------------------------------------------------------------------- */

static void nodes_are_shared_and_plain(void **state)
{
    (void)state;
    static world w;
    world_make(&w, 3, 1, 1, 1);
    fixture f = begin(&w);
    graph *g = start(&f);
    node x = load(g, ref0(SCALAR)), t = graph_time(g), p = graph_param(g, 1);
    assert_int_equal(graph_const(g, 0), 0);
    assert_int_not_equal(graph_const(g, -0.0), 0);
    assert_int_equal(bin(g, OP_ADD, x, t), bin(g, OP_ADD, x, t));
    assert_int_not_equal(bin(g, OP_ADD, x, t), bin(g, OP_ADD, t, x));
    assert_int_equal(load(g, ref1(CHAIN, level(0, 1))), load(g, ref1(CHAIN, level(0, 1))));
    assert_int_not_equal(load(g, ref1(CHAIN, level(0, 1))), load(g, ref1(CHAIN, level(0, 2))));
    range r = {literal(1), slot(INT_N, 0)}, s = {literal(1), slot(INT_N, 1)};
    assert_int_equal(sum_over(g, 0, r, 0, p), sum_over(g, 0, r, 0, p));
    assert_int_not_equal(sum_over(g, 0, r, 0, p), sum_over(g, 0, s, 0, p));
    assert_int_not_equal(sum_over(g, 0, r, 0, p), sum_over(g, 1, r, 0, p));
    /* Equations are not simplified; derivatives are. */
    assert_int_not_equal(bin(g, OP_ADD, x, 0), x);
    assert_int_not_equal(bin(g, OP_MUL, 0, x), 0);
    g->simplify = true;
    assert_int_equal(bin(g, OP_ADD, x, 0), x);
    assert_int_equal(bin(g, OP_MUL, 0, x), 0);
    assert_int_equal(bin(g, OP_DIV, x, x), graph_const(g, 1));
    assert_int_equal(bin(g, OP_SUB, x, x), 0);
    g->simplify = false;
    /* The chain of a power: even, the square of the half; odd, one more factor. */
    node x2 = bin(g, OP_MUL, x, x), x4 = bin(g, OP_MUL, x2, x2), x5 = bin(g, OP_MUL, x4, x),
         x10 = bin(g, OP_MUL, x5, x5);
    assert_int_equal(graph_power(g, x, 10), x10);
    assert_int_equal(graph_power(g, x, -5), bin(g, OP_DIV, graph_const(g, 1), x5));
    assert_int_equal(graph_power(g, x, 0), graph_const(g, 1));
    assert_int_equal(
        graph_deps(g, bin(g, OP_MUL, sum_over(g, 1, r, 0, load(g, ref2(GRID, level(0, 0), level(1, 0)))), t)),
        DEP_X | DEP_TIME | DEP_PARAM | 1);
    arena_release(&f.arena);
}

static void degrees_and_kinks(void **state)
{
    (void)state;
    static world w;
    world_make(&w, 3, 1, 1, 1);
    fixture f = begin(&w);
    graph *g = start(&f);
    node x = load(g, ref0(SCALAR)), v = load(g, ref1(CHAIN_V, literal(1))), p = graph_param(g, 0), t = graph_time(g);
    node i = graph_index(g, 0);
    range r = {literal(1), slot(INT_N, 0)};
    struct {
        node n;
        unsigned deps;
        int degree;
    } rows[] = {
        {bin(g, OP_MUL, x, v), DEP_V, 1},
        {bin(g, OP_MUL, x, v), DEP_V | DEP_X, 2},
        {bin(g, OP_MUL, x, x), DEP_V, 0},
        {bin(g, OP_DIV, v, un(g, OP_SIN, x)), DEP_V, 1},
        {bin(g, OP_DIV, x, v), DEP_V, 2},
        {un(g, OP_SIN, v), DEP_V, 2},
        {graph_op(g, OP_SELECT, bin(g, OP_LT, x, t), v, p), DEP_V, 1},
        {graph_op(g, OP_SELECT, bin(g, OP_LT, v, t), v, p), DEP_V, 2},
        {graph_op(g, OP_FMA, x, v, v), DEP_V, 1},
        {graph_op(g, OP_FMA, v, v, x), DEP_V, 2},
        {un(g, OP_NEG, v), DEP_V, 1},
        {sum_over(g, 0, r, bin(g, OP_NE, i, p), bin(g, OP_MUL, i, v)), DEP_V, 1},
        {sum_over(g, 0, r, v, v), DEP_V, 2},
        {sum_over(g, 0, r, 0, graph_power(g, v, 2)), DEP_V, 2},
        {bin(g, OP_ADD, p, t), DEP_V | DEP_X, 0},
        {t, DEP_TIME, 1},
    };
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++)
        if (graph_degree(g, rows[k].n, rows[k].deps) != rows[k].degree)
            fail_msg("row %zu: degree %d, not %d", k, graph_degree(g, rows[k].n, rows[k].deps), rows[k].degree);
    node corner = un(g, OP_ABS, v);
    assert_int_equal(graph_kink(g, bin(g, OP_ADD, x, bin(g, OP_MUL, corner, v))), corner);
    assert_int_equal(graph_kink(g, bin(g, OP_ADD, un(g, OP_SIN, x), un(g, OP_ABS, p))), 0);
    assert_int_equal(graph_kink(g, sum_over(g, 0, r, bin(g, OP_NE, i, p), x)), 0);
    assert_int_equal(graph_kink(g, graph_op(g, OP_SELECT, bin(g, OP_LT, p, i), x, v)), 0);
    assert_int_not_equal(graph_kink(g, graph_op(g, OP_SELECT, bin(g, OP_LT, t, i), x, v)), 0);
    arena_release(&f.arena);
}

static void loads_are_found_with_their_sums(void **state)
{
    (void)state;
    static world w;
    world_make(&w, 3, 1, 1, 1);
    fixture f = begin(&w);
    graph *g = start(&f);
    range r = {literal(1), slot(INT_N, 0)}, s = {level(1, 1), slot(INT_N, 0)};
    node here = load(g, ref1(CHAIN, level(0, 1)));
    node inner = sum_over(g, 2, s, 0, bin(g, OP_MUL, load(g, ref1(CHAIN, level(2, 0))), here));
    node outer = sum_over(g, 1, r, 0, bin(g, OP_MUL, inner, load(g, ref1(CHAIN_V, level(1, 0)))));
    seen found = {0};
    graph_loads(g, bin(g, OP_ADD, here, bin(g, OP_ADD, outer, here)), SPACE_X, see, &found);
    assert_int_equal(found.count, 3); /* here: outside, and in the inner sum; x[k] in the inner sum */
    int outside = 0, deep = 0;
    for (int k = 0; k < 3; k++) {
        outside += found.inside[k] == 0 && found.ref[k].at[0].level == 0;
        deep += found.inside[k] == 2 && found.first[k] == 1 && found.range[k].first.level == 1;
    }
    assert_int_equal(outside, 1);
    assert_int_equal(deep, 2);
    arena_release(&f.arena);
}

/* The normal form -------------------------------------------------------------------------------------------------- */

static operation formed(fixture *f, node n)
{
    output o = {.value = n, .to = ref0(TO_SCALAR)};
    program *p = program_create(f->g, &o, 1);
    assert_non_null(p);
    return graph_at(p->graph, p->outputs[0].value)->op;
}

static void products_are_fused_by_rule(void **state)
{
    (void)state;
    static world w;
    world_make(&w, 3, 1, 1, 1);
    fixture f = begin(&w);
    graph *g = start(&f);
    node x = load(g, ref0(SCALAR)), t = graph_time(g), p = graph_param(g, 0), q = graph_param(g, 1);
    node pq = bin(g, OP_MUL, p, q), xt = bin(g, OP_MUL, x, t);
    assert_int_equal(formed(&f, bin(g, OP_ADD, x, pq)), OP_FMA);
    assert_int_equal(formed(&f, bin(g, OP_ADD, pq, x)), OP_FMA);
    assert_int_equal(formed(&f, bin(g, OP_SUB, x, pq)), OP_FNMA);
    assert_int_equal(formed(&f, bin(g, OP_SUB, pq, x)), OP_FMS);
    assert_int_equal(formed(&f, bin(g, OP_ADD, x, un(g, OP_NEG, pq))), OP_FNMA);
    assert_int_equal(formed(&f, bin(g, OP_SUB, x, un(g, OP_NEG, pq))), OP_FMA);
    assert_int_equal(formed(&f, bin(g, OP_ADD, un(g, OP_NEG, pq), x)), OP_FNMA);
    assert_int_equal(formed(&f, bin(g, OP_SUB, un(g, OP_NEG, pq), x)), OP_FMS);
    assert_int_equal(formed(&f, bin(g, OP_ADD, bin(g, OP_DIV, x, p), q)), OP_ADD);
    /* A product that is used twice is not fused. */
    assert_int_equal(formed(&f, bin(g, OP_ADD, pq, pq)), OP_ADD);
    assert_int_equal(formed(&f, bin(g, OP_ADD, bin(g, OP_DIV, pq, x), pq)), OP_ADD);
    output two[] = {{.value = bin(g, OP_ADD, x, pq), .to = ref0(TO_SCALAR)},
                    {.value = pq, .to = ref1(TO_CHAIN, literal(1))}};
    program *both = program_create(g, two, 2);
    assert_int_equal(graph_at(both->graph, both->outputs[0].value)->op, OP_ADD);
    /* Of two products the right one is fused, and the left one is rounded. */
    program *pair = program_create(g, &(output){.value = bin(g, OP_SUB, xt, pq), .to = ref0(TO_SCALAR)}, 1);
    const graph_node *n = graph_at(pair->graph, pair->outputs[0].value);
    assert_int_equal(n->op, OP_FNMA);
    assert_int_equal(graph_at(pair->graph, n->a)->op, OP_PARAM);
    assert_int_equal(graph_at(pair->graph, n->c)->op, OP_MUL);
    /* x^3 - x: the last factor of the chain. */
    n = graph_at(g, graph_power(g, x, 3));
    program *cube =
        program_create(g, &(output){.value = bin(g, OP_SUB, graph_power(g, x, 3), x), .to = ref0(TO_SCALAR)}, 1);
    n = graph_at(cube->graph, cube->outputs[0].value);
    assert_int_equal(n->op, OP_FMS);
    assert_int_equal(graph_at(cube->graph, n->a)->op, OP_MUL);
    arena_release(&f.arena);
}

/* Printing --------------------------------------------------------------------------------------------------------- */

static void named(void *ctx, const graph_node *n, char *out, size_t size)
{
    const graph *g = ctx;
    static const char *const parameters[] = {"F", "beta", "c"};
    if (n->op == OP_PARAM)
        snprintf(out, size, "%s", parameters[n->a]);
    else if (n->op == OP_LOAD && g->references[n->a].dims)
        snprintf(out, size, "x[i%+d]", (int)g->references[n->a].at[0].literal);
    else if (n->op == OP_LOAD)
        snprintf(out, size, "x");
    else if (n->op == OP_INDEX && n->level == MAX_LEVELS)
        snprintf(out, size, "N");
}

static void nodes_are_written_in_the_language(void **state)
{
    (void)state;
    static world w;
    world_make(&w, 3, 1, 1, 1);
    fixture f = begin(&w);
    graph *g = start(&f);
    node x = load(g, ref0(SCALAR)), F = graph_param(g, 0), beta = graph_param(g, 1), t = graph_time(g);
    node two = graph_const(g, 2), minus = graph_const(g, -2), s = bin(g, OP_ADD, F, beta), xs = bin(g, OP_ADD, x, t);
    range r = {literal(1), slot(INT_N, -1)};
    node i = graph_index(g, 0), next = load(g, ref1(CHAIN, level(0, 1)));
    struct {
        node n;
        const char *text;
    } rows[] = {
        {bin(g, OP_ADD, bin(g, OP_ADD, un(g, OP_NEG, x), graph_power(g, x, 3)), bin(g, OP_MUL, F, un(g, OP_COS, t))),
         "-x + x^3 + F cos(t)"},
        {bin(g, OP_SUB, x, bin(g, OP_SUB, F, t)), "x - (F - t)"},
        {bin(g, OP_SUB, bin(g, OP_SUB, x, F), t), "x - F - t"},
        {bin(g, OP_ADD, x, bin(g, OP_ADD, F, t)), "x + (F + t)"},
        {bin(g, OP_MUL, two, x), "2 x"},
        {bin(g, OP_MUL, x, two), "x*2"},
        {bin(g, OP_MUL, bin(g, OP_MUL, x, two), t), "x*2*t"},
        {bin(g, OP_MUL, F, s), "F (F + beta)"},
        {bin(g, OP_MUL, x, s), "x*(F + beta)"},
        {bin(g, OP_MUL, s, xs), "(F + beta) (x + t)"},
        {bin(g, OP_MUL, x, bin(g, OP_MUL, F, t)), "x*(F t)"},
        {bin(g, OP_DIV, bin(g, OP_MUL, F, x), bin(g, OP_MUL, two, t)), "F x/(2 t)"},
        {bin(g, OP_MUL, bin(g, OP_DIV, F, two), x), "(F/2) x"},
        {bin(g, OP_DIV, bin(g, OP_DIV, F, x), t), "F/x/t"},
        {bin(g, OP_DIV, F, bin(g, OP_DIV, x, t)), "F/(x/t)"},
        {bin(g, OP_ADD, x, bin(g, OP_MUL, minus, t)), "x - 2 t"},
        {bin(g, OP_SUB, x, un(g, OP_NEG, t)), "x + t"},
        {minus, "-2"},
        {bin(g, OP_MUL, x, minus), "x*(-2)"},
        {un(g, OP_NEG, bin(g, OP_MUL, F, x)), "-F x"},
        {bin(g, OP_MUL, un(g, OP_NEG, F), x), "(-F) x"},
        {un(g, OP_NEG, un(g, OP_NEG, x)), "-(-x)"},
        {un(g, OP_NEG, xs), "-(x + t)"},
        {graph_power(g, xs, 6), "(x + t)^6"},
        {graph_power(g, x, -3), "1/x^3"},
        {bin(g, OP_MUL, F, graph_power(g, x, 2)), "F x^2"},
        {graph_power(g, un(g, OP_SIN, t), 2), "sin(t)^2"},
        {bin(g, OP_MUL, graph_power(g, x, 3), x), "x^3 x"},
        {bin(g, OP_MUL, bin(g, OP_MUL, x, x), x), "x^3"},
        {bin(g, OP_POW, x, F), "x^F"},
        {bin(g, OP_POW, bin(g, OP_POW, x, F), t), "(x^F)^t"},
        {bin(g, OP_POW, x, bin(g, OP_POW, F, t)), "x^F^t"},
        {bin(g, OP_POW, un(g, OP_NEG, x), graph_const(g, 1.5)), "(-x)^1.5"},
        {bin(g, OP_ATAN2, x, t), "atan2(x, t)"},
        {graph_op(g, OP_SELECT,
                  bin(g, OP_AND, bin(g, OP_LT, x, t), bin(g, OP_OR, un(g, OP_NOT, F), bin(g, OP_NE, x, two))), x, t),
         "if(x < t and (not F or x != 2), x, t)"},
        {sum_over(g, 0, r, bin(g, OP_GE, i, two), bin(g, OP_MUL, beta, bin(g, OP_SUB, next, x))),
         "sum(i = 1..N - 1, i >= 2: beta (x[i+1] - x))"},
        {graph_const(g, 0.1), "0.1"},
        {graph_const(g, 1e-300), "1e-300"},
        {graph_const(g, INFINITY), "1/0"},
    };
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
        char text[200], cut[8];
        size_t length = graph_print(g, rows[k].n, named, g, text, sizeof text);
        assert_string_equal(text, rows[k].text);
        assert_int_equal(length, strlen(text));
        assert_int_equal(graph_print(g, rows[k].n, named, g, cut, sizeof cut), length);
        assert_int_equal(strncmp(cut, text, sizeof cut - 1), 0);
        assert_int_equal(strlen(cut), length < sizeof cut ? length : sizeof cut - 1);
    }
    /* The normal form too: fused operations are sums of products again. */
    node lap = bin(g, OP_ADD, bin(g, OP_SUB, next, bin(g, OP_MUL, two, x)), F);
    program *p =
        program_create(g, &(output){.value = bin(g, OP_SUB, bin(g, OP_MUL, beta, lap), x), .to = ref0(TO_SCALAR)}, 1);
    char text[200];
    graph_print(p->graph, p->outputs[0].value, named, p->graph, text, sizeof text);
    assert_string_equal(text, "beta (x[i+1] - 2 x + F) - x");
    p = program_create(g, &(output){.value = rows[sizeof rows / sizeof *rows - 4].n, .to = ref0(TO_SCALAR)}, 1);
    graph_print(p->graph, p->outputs[0].value, named, p->graph, text, sizeof text);
    assert_string_equal(text, "sum(i = 1..N - 1, i >= 2: beta (x[i+1] - x))");
    arena_release(&f.arena);
}

/* Bounds ----------------------------------------------------------------------------------------------------------- */

static void a_graph_has_a_largest_size(void **state)
{
    (void)state;
    static world w;
    world_make(&w, 3, 1, 1, 1);
    fixture f = begin(&w);
    graph *g = start(&f);
    node n = graph_time(g);
    for (int k = 0; k < GRAPH_NODES_MAX + 10; k++) n = bin(g, OP_ADD, n, graph_time(g));
    assert_true(g->too_large);
    assert_false(f.arena.failed);
    assert_int_equal(n, 0);
    assert_null(program_create(g, &(output){.value = n, .to = ref0(TO_SCALAR)}, 1));
    arena_release(&f.arena);
}

static void the_arena_keeps_its_promises(void **state)
{
    (void)state;
    meter m = {.left = 3};
    arena a;
    arena_init(&a, &(motus_allocator){metered_take, metered_give, &m});
    for (size_t bytes = 1; bytes < 5000; bytes = bytes * 3 + 1) {
        unsigned char *p = arena_take(&a, bytes);
        assert_non_null(p);
        assert_int_equal((uintptr_t)p % (bytes >= 512      ? 64
                                         : bytes % 16 == 0 ? 16
                                         : bytes % 8 == 0  ? 8
                                         : bytes % 4 == 0  ? 4
                                                           : 1),
                         0);
        for (size_t k = 0; k < bytes; k++) assert_int_equal(p[k], 0);
        memset(p, 0xA5, bytes);
    }
    char *text = arena_text(&a, "momentum", 3);
    assert_string_equal(text, "mom");
    char *longer = arena_grow(&a, text, 4, 100000);
    assert_string_equal(longer, "mom");
    assert_int_equal(longer[99999], 0);
    const int before = m.live;
    m.left++;
    longer = arena_replace(&a, longer, 100000, 200000); /* the old block goes back to the hooks */
    assert_string_equal(longer, "mom");
    assert_int_equal(longer[199999], 0);
    assert_int_equal(m.live, before);
    m.left = 0;
    while (!a.failed) /* a small expression can always be printed, a large one is refused */
        memset(arena_take(&a, ARENA_SPARE), 1, ARENA_SPARE);
    assert_ptr_equal(arena_take(&a, ARENA_SPARE), a.spare);
    assert_int_equal(a.spare[ARENA_SPARE - 1], 0);
    assert_null(arena_take(&a, ARENA_SPARE + 1));
    assert_null(arena_take(&a, SIZE_MAX - 8));
    assert_null(arena_room(&a, 4096));
    arena_release(&a);
    assert_int_equal(m.live, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values_are_what_they_say),           cmocka_unit_test(folding_is_running),
        cmocka_unit_test(every_operation_has_its_derivative), cmocka_unit_test(composites_have_their_derivatives),
        cmocka_unit_test(a_derivative_is_not_poisoned),       cmocka_unit_test(seeds_shift_arrays),
        cmocka_unit_test(nodes_are_shared_and_plain),         cmocka_unit_test(degrees_and_kinks),
        cmocka_unit_test(loads_are_found_with_their_sums),    cmocka_unit_test(products_are_fused_by_rule),
        cmocka_unit_test(nodes_are_written_in_the_language),  cmocka_unit_test(a_graph_has_a_largest_size),
        cmocka_unit_test(the_arena_keeps_its_promises),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
