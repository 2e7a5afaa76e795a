/* The tape: every way of running a program against a simple evaluator, bit for bit; binding; and out of memory. */
#include "graph_world.h"

/* A simple evaluator of a normal form ------------------------------------------------------------------------------ */

typedef struct plain {
    const graph *g;
    world *w;
    double t;
    int64_t index[MAX_LEVELS];
    double total[MAX_LEVELS];
} plain;

static double *cell(plain *p, const reference *r)
{
    const array *a = &p->w->arrays[r->array];
    int64_t at = (int64_t)a->base;
    for (int d = 0; d < r->dims; d++)
        at += (graph_subscript(&r->at[d], p->index, p->w->ints) - a->over->first[d]) * a->over->stride[d];
    return (a->space == SPACE_POOL ? p->w->pool : p->w->base[a->space]) + at;
}

static double plain_value(plain *p, node n)
{
    const graph_node *m = &p->g->nodes[n];
    switch (m->op) {
    case OP_CONST: return m->value;
    case OP_TIME: return p->t;
    case OP_PARAM: return p->w->pool[m->a];
    case OP_INDEX: return (double)p->index[m->level];
    case OP_LOAD: return *cell(p, &p->g->references[m->a]);
    case OP_TOTAL: return p->total[m->level];
    case OP_SUM: {
        int64_t first = graph_subscript(&p->g->ranges[m->c].first, p->index, p->w->ints);
        int64_t last = graph_subscript(&p->g->ranges[m->c].last, p->index, p->w->ints), kept = p->index[m->level];
        double part[8] = {0}, total = p->total[m->level];
        int parts = last - first + 1 <= 16 ? 1 : 8;
        for (int64_t k = first; k <= last; k++) {
            double *at = &part[(k - first) % parts];
            p->index[m->level] = k;
            p->total[m->level] = *at;
            double next = plain_value(p, m->a);
            p->index[m->level] = k;
            if (!m->b || plain_value(p, m->b) != 0) *at = next;
        }
        p->index[m->level] = kept;
        p->total[m->level] = total;
        return parts == 1 ? part[0]
                          : ((part[0] + part[1]) + (part[2] + part[3])) + ((part[4] + part[5]) + (part[6] + part[7]));
    }
    default: {
        int arity = operation_at(m->op)->arity;
        double a = plain_value(p, m->a), b = arity > 1 ? plain_value(p, m->b) : 0,
               c = arity > 2 ? plain_value(p, m->c) : 0;
        return operation_value(m->op, a, b, c);
    }
    }
}

static void plain_output(plain *p, const output *o, int d)
{
    if (d == o->loops) {
        *cell(p, &o->to) = plain_value(p, o->value);
        return;
    }
    int64_t last = graph_subscript(&o->loop[d].last, p->index, p->w->ints);
    for (int64_t k = graph_subscript(&o->loop[d].first, p->index, p->w->ints); k <= last; k++) {
        p->index[d] = k;
        plain_output(p, o, d + 1);
    }
}

static void plain_run(const program *p, world *w, double t)
{
    plain e = {.g = p->graph, .w = w, .t = t};
    for (size_t k = 0; k < p->count; k++) plain_output(&e, &p->outputs[k], 0);
}

static void wipe(world *w)
{
    for (size_t k = 0; k < 4096; k++) w->a[k] = w->out[k] = -77;
}

/* Every choice of machine, width and code gives the evaluator's bits. */
static void check_all_ways(fixture *f, const program *p, double t)
{
    static const size_t widths[] = {0, 8, 16, 64, 1024};
    static double wanted[4096], wanted_out[4096];
    world *w = f->w;
    wipe(w);
    plain_run(p, w, t);
    memcpy(wanted, w->a, sizeof wanted);
    memcpy(wanted_out, w->out, sizeof wanted_out);
    const tape_machine *m;
    for (int k = 0; (m = tape_machine_at(k)); k++)
        for (int blocks = -1; blocks <= 1; blocks++)
            for (size_t j = 0; j < (blocks ? sizeof widths / sizeof *widths : 1); j++) {
                tape *tp = tape_create_as(&f->arena, p, &(tape_choice){widths[j], m->name, blocks});
                assert_non_null(tp);
                assert_true(tape_bind(tp, &w->binding));
                wipe(w);
                tape_run(tp, t, w->base);
                tape_run(tp, t, w->base); /* a run leaves no state behind */
                for (size_t i = 0; i < 4096; i++)
                    if (!same_bits(w->a[i], wanted[i]) || !same_bits(w->out[i], wanted_out[i]))
                        fail_msg("%s, width %zu, blocks %d: cell %zu is %a and %a, not %a and %a", m->name, widths[j],
                                 blocks, i, w->a[i], w->out[i], wanted[i], wanted_out[i]);
            }
}

/* The values, not only the form: fma and the order of sums written out by hand. */
static void sums_have_their_bits(void **state)
{
    (void)state;
    static world w;
    for (int64_t n = 0; n <= 40; n++) {
        world_make(&w, 40, 1, 1, 1);
        w.ints[INT_N] = n;
        fixture f = begin(&w);
        graph *g = start(&f);
        range r = {literal(1), slot(INT_N, 0)};
        node x = load(g, ref1(CHAIN, level(0, 0))), v = load(g, ref1(CHAIN_V, level(0, 0)));
        node odd = bin(g, OP_NE, bin(g, OP_MOD, graph_index(g, 0), graph_const(g, 3)), graph_const(g, 1));
        double part[8] = {0}, masked[8] = {0};
        for (int64_t k = 1; k <= n; k++) {
            int m = n <= 16 ? 0 : (int)((k - 1) % 8);
            part[m] = fma(w.x[1 + k], w.v[1 + k], part[m]);
            if (k % 3 != 1) masked[m] += w.x[1 + k];
        }
        double total = ((part[0] + part[1]) + (part[2] + part[3])) + ((part[4] + part[5]) + (part[6] + part[7]));
        double others =
            ((masked[0] + masked[1]) + (masked[2] + masked[3])) + ((masked[4] + masked[5]) + (masked[6] + masked[7]));
        double got = run_one(&f, sum_over(g, 0, r, 0, bin(g, OP_MUL, x, v)), 0);
        if (!same_bits(got, total)) fail_msg("%d products: %a, not %a", (int)n, got, total);
        got = run_one(&f, sum_over(g, 0, r, odd, x), 0);
        if (!same_bits(got, others)) fail_msg("%d masked terms: %a, not %a", (int)n, got, others);
        node terms[40];
        for (int k = 0; k < n; k++)
            terms[k] = bin(g, OP_MUL, load(g, ref1(CHAIN, literal(k + 1))), load(g, ref1(CHAIN_V, literal(k + 1))));
        got = run_one(&f, graph_total(g, terms, (size_t)n), 0);
        if (!same_bits(got, total)) fail_msg("%d explicit products: %a, not %a", (int)n, got, total);
        arena_release(&f.arena);
    }
}

/* Random programs -------------------------------------------------------------------------------------------------- */

/* The range of an index decides where it may be used as a subscript. */
typedef enum walk { OVER_N, OVER_ROWS, OVER_COLUMNS, OVER_LIST } walk;
typedef struct scope {
    int levels;
    walk over[MAX_LEVELS];
    int sums;
} scope;

static node random_leaf(fixture *f, const scope *s)
{
    graph *g = f->g;
    if (s->levels && draw(4)) {
        int l = (int)draw((uint32_t)s->levels), m = (int)draw((uint32_t)s->levels);
        int32_t shift = (int32_t)draw(3) - 1;
        if (!draw(8)) return graph_index(g, l);
        switch (s->over[l]) {
        case OVER_N:
            if (!draw(5)) return load(g, ref1(CHAIN, folded(l, (int32_t)draw(7) - 3, INT_N)));
            return load(g, ref1(draw(3) ? CHAIN : CHAIN_V, level(l, shift)));
        case OVER_ROWS:
            if (!draw(5)) return load(g, ref2(GRID, level(l, shift), folded(l, 0, INT_COLUMNS)));
            if (s->over[m] == OVER_COLUMNS)
                return load(g, ref2(GRID, draw(4) ? level(l, shift) : folded(l, shift, INT_ROWS),
                                    level(m, (int32_t)draw(3) - 1)));
            return load(g, ref2(GRID, level(l, shift), draw(2) ? literal(1) : slot(INT_COLUMNS, 0)));
        case OVER_COLUMNS:
            if (s->over[m] == OVER_ROWS)
                return load(g, ref2(GRID, level(m, shift), draw(3) ? level(l, shift) : folded(l, shift, INT_COLUMNS)));
            return load(g, ref2(GRID, slot(INT_ROWS, 1), level(l, shift)));
        case OVER_LIST: return load(g, ref1(LIST_M, level(l, 0)));
        }
    }
    switch (draw(5)) {
    case 0: return graph_const(g, number());
    case 1: return graph_time(g);
    case 2: return graph_param(g, draw(PARAMS));
    case 3: return load(g, ref1(CHAIN, draw(2) ? literal(1) : slot(INT_N, 0)));
    default: return load(g, ref0(SCALAR));
    }
}

static node random_value(fixture *f, scope s, int depth);

static node random_sum(fixture *f, scope s, int depth)
{
    graph *g = f->g;
    int l = s.levels;
    range r = {literal(1), slot(INT_N, 0)};
    walk over = (walk)draw(4);
    if (over == OVER_ROWS) r.last = slot(INT_ROWS, 0);
    if (over == OVER_COLUMNS) r.last = slot(INT_COLUMNS, 0);
    if (over == OVER_LIST) r.last = slot(INT_LIST, 0);
    int outer = l ? (int)draw((uint32_t)l) : 0;
    if (l && s.over[outer] == over && draw(2)) { /* bounds that depend on an outer index */
        if (draw(2))
            r.first = level(outer, 1);
        else
            r.last = level(outer, draw(2) ? 0 : -1);
    }
    s.over[s.levels++] = over;
    s.sums++;
    node condition = 0;
    if (draw(2))
        condition = l && draw(2) ? bin(g, OP_NE, graph_index(g, l), graph_index(g, outer))
                                 : bin(g, OP_LT, random_value(f, s, 1), random_value(f, s, 1));
    if (condition && graph_at(g, condition)->op == OP_CONST) condition = 0;
    node body = random_value(f, s, depth);
    /* A masked term may be infinite or NaN. */
    if (condition && l && graph_at(g, condition)->op == OP_NE && draw(2))
        body = bin(g, OP_DIV, body, bin(g, OP_SUB, graph_index(g, l), graph_index(g, outer)));
    return graph_sum(g, l, &r, condition, body);
}

static node random_value(fixture *f, scope s, int depth)
{
    static const operation ops[] = {OP_ADD, OP_ADD,    OP_SUB,    OP_SUB,   OP_MUL, OP_MUL, OP_MUL, OP_NEG,  OP_DIV,
                                    OP_LT,  OP_SELECT, OP_SELECT, OP_FLOOR, OP_ABS, OP_MIN, OP_MAX, OP_SIGN, OP_SQRT,
                                    OP_SIN, OP_MOD,    OP_AND,    OP_NOT,   OP_GE,  OP_EQ,  OP_OR};
    graph *g = f->g;
    if (!depth || !draw(7)) return random_leaf(f, &s);
    if (s.sums < 2 && !draw(6)) return random_sum(f, s, depth - 1);
    operation op = ops[draw(sizeof ops / sizeof *ops)];
    node a = random_value(f, s, depth - 1), b = operation_at(op)->arity > 1 ? random_value(f, s, depth - 1) : 0;
    node c = operation_at(op)->arity > 2 ? random_value(f, s, depth - 1) : 0;
    node n = graph_op(g, op, a, b, c);
    return draw(6) ? n : bin(g, OP_ADD, bin(g, OP_MUL, n, n), n); /* shared */
}

static void every_way_of_running_gives_the_same_bits(void **state)
{
    (void)state;
    static world w;
    static const int64_t sizes[][4] = {{1, 1, 1, 1},    {5, 3, 4, 2},    {13, 2, 19, 17},
                                       {40, 21, 3, 16}, {100, 5, 37, 9}, {0, 0, 3, 1}};
    for (int k = 0; k < 500; k++) {
        const int64_t *size = sizes[k % 6];
        world_make(&w, size[0], size[1], size[2], size[3]);
        fixture f = begin(&w);
        start(&f);
        output o[6];
        size_t count = 1 + draw(6);
        range rn = {literal(1), slot(INT_N, 0)}, rr = {literal(1), slot(INT_ROWS, 0)},
              rc = {literal(1), slot(INT_COLUMNS, 0)};
        /* Six outputs: the same loops twice, the second time to other places: wrapped by a modulus, transposed. */
        const output shapes[] = {
            {.to = ref1(TO_CHAIN, level(0, 0)), .loops = 1, .loop = {rn}},
            {.to = ref2(TO_GRID, level(0, 0), level(1, 0)), .loops = 2, .loop = {rr, rc}},
            {.to = ref0(TO_SCALAR)},
            {.to = ref1(OUT_CHAIN, folded(0, 3, INT_N)), .loops = 1, .loop = {rn}},
            {.to = ref2(OUT_GRID, level(1, 0), level(0, 0)), .loops = 2, .loop = {rr, rc}},
            {.to = ref0(OUT_SCALAR)},
        };
        const scope scopes[] = {{1, {OVER_N}, 0}, {2, {OVER_ROWS, OVER_COLUMNS}, 0}, {0, {0}, 0}};
        for (size_t j = 0; j < count; j++) {
            o[j] = shapes[j];
            o[j].value = j && !draw(8) && j % 3 == 0 ? o[0].value : random_value(&f, scopes[j % 3], 2 + (int)draw(4));
        }
        program *p = program_create(f.g, o, count);
        assert_non_null(p);
        check_all_ways(&f, p, number());
        arena_release(&f.arena);
    }
}

/* Binding, length, memory ------------------------------------------------------------------------------------------ */

static void parameters_and_sizes_are_bound_again(void **state)
{
    (void)state;
    static world w;
    world_make(&w, 30, 1, 1, 1);
    fixture f = begin(&w);
    graph *g = start(&f);
    range r = {literal(1), slot(INT_N, 0)};
    node p = graph_param(g, 0);
    node mean = bin(g, OP_DIV, sum_over(g, 1, r, 0, load(g, ref1(CHAIN, level(1, 0)))), p);
    node weight = bin(g, OP_ADD, sum_over(g, 1, r, 0, bin(g, OP_MUL, graph_index(g, 1), p)), un(g, OP_SIN, p));
    output o = {.value = bin(g, OP_ADD, bin(g, OP_MUL, load(g, ref1(CHAIN, level(0, 0))), mean), weight),
                .to = ref1(TO_CHAIN, level(0, 0)),
                .loops = 1,
                .loop = {r}};
    program *form = program_create(g, &o, 1);
    tape *t = tape_create(&f.arena, form);
    static const int64_t sizes[] = {1, 30, 2, 0, 17, 30}; /* computed as scalars and as blocks */
    for (size_t k = 0; k < sizeof sizes / sizeof *sizes; k++) {
        static double wanted[4096];
        w.ints[INT_N] = sizes[k];
        w.pool[0] = 1.5 + (double)k;
        wipe(&w);
        plain_run(form, &w, 0);
        memcpy(wanted, w.a, sizeof wanted);
        wipe(&w);
        assert_true(tape_bind(t, &w.binding));
        tape_run(t, 0, w.base);
        assert_memory_equal(w.a, wanted, sizeof wanted);
    }
    arena_release(&f.arena);
}

/* No recursion over the length of an expression. */
static void long_expressions_need_no_stack(void **state)
{
    (void)state;
    static world w;
    world_make(&w, 3, 1, 1, 1);
    enum { LONG = 100000 };
    static char text[1 << 21];
    for (int right = 0; right < 2; right++) {
        fixture f = begin(&w);
        graph *g = start(&f);
        node x = load(g, ref0(SCALAR)), n = x;
        double wanted = w.x[0];
        for (int k = 0; k < LONG; k++) {
            n = right ? bin(g, OP_ADD, x, n) : bin(g, OP_ADD, n, x);
            wanted += w.x[0];
        }
        assert_true(same_bits(run_one(&f, n, 0), wanted));
        assert_true(run_one(&f, graph_derivative(g, n, seed_one, NULL), 0) == LONG + 1);
        assert_int_equal(graph_degree(g, n, DEP_X), 1);
        assert_int_equal(graph_kink(g, n), 0);
        size_t length = graph_print(g, n, NULL, NULL, text, sizeof text);
        assert_int_equal(length, strlen(text));
        arena_release(&f.arena);
    }
    /* As a tree, repeated squaring grows exponentially; as text it does not. */
    fixture f = begin(&w);
    graph *g = start(&f);
    node n = load(g, ref0(SCALAR));
    for (int k = 0; k < 60; k++) n = bin(g, OP_ADD, un(g, OP_SIN, n), n);
    assert_int_equal(graph_print(g, n, NULL, NULL, text, sizeof text), GRAPH_TEXT_MAX);
    assert_string_equal(text + GRAPH_TEXT_MAX - 3, "...");
    arena_release(&f.arena);
}

/* All of it, once; false if a call reported a failure. */
static bool all_of_it(arena *a, world *w)
{
    graph *g = graph_create(a);
    if (!g) return false;
    g->arrays = w->arrays;
    range r = {literal(1), slot(INT_N, 0)};
    node x = load(g, ref1(CHAIN, folded(0, 1, INT_N))), y = load(g, ref1(CHAIN, level(1, 0)));
    node body = bin(g, OP_MUL, bin(g, OP_SUB, x, y), graph_param(g, 0));
    node n = bin(g, OP_ADD, sum_over(g, 1, r, bin(g, OP_NE, graph_index(g, 0), graph_index(g, 1)), body),
                 un(g, OP_SIN, graph_time(g)));
    for (int k = 0; k < 400; k++) /* past the first tables */
        n = bin(g, OP_ADD, n, bin(g, OP_MUL, graph_const(g, k + 0.5), load(g, ref1(CHAIN, literal(k % 30)))));
    graph_shift shift = {DIRECTION_CHAIN - CHAIN, 0};
    output o[] = {{.value = n, .to = ref1(TO_CHAIN, level(0, 0)), .loops = 1, .loop = {r}},
                  {.value = graph_derivative(g, n, graph_seed_direction, &shift),
                   .to = ref1(OUT_CHAIN, level(0, 0)),
                   .loops = 1,
                   .loop = {r}}};
    char text[100];
    graph_print(g, n, NULL, NULL, text, sizeof text);
    bool known = graph_degree(g, n, DEP_X) == 1 && !graph_kink(g, n);
    seen found = {.count = -10000};
    graph_loads(g, body, SPACE_X, see, &found);
    program *p = program_create(g, o, 2);
    tape *t = p ? tape_create(a, p) : NULL;
    if (!t || !tape_bind(t, &w->binding)) return false;
    tape_run(t, 1, w->base);
    w->ints[INT_N] = 1; /* the other code */
    bool bound = tape_bind(t, &w->binding);
    w->ints[INT_N] = 29;
    return bound && known && !a->failed;
}

static void every_allocation_may_fail(void **state)
{
    (void)state;
    static world w, clean;
    world_make(&clean, 29, 1, 1, 1);
    long failures = 0;
    for (long k = 0;; k++, failures++) {
        meter m = {.left = k};
        arena a;
        w = clean;
        w.binding = (binding){w.arrays, w.ints, w.pool};
        w.base[SPACE_X] = w.x, w.base[SPACE_V] = w.v, w.base[SPACE_A] = w.a, w.base[SPACE_DX] = w.dx,
        w.base[SPACE_OUT] = w.out;
        arena_init(&a, &(motus_allocator){metered_take, metered_give, &m});
        bool done = all_of_it(&a, &w);
        if (m.taken > k) assert_true(!done && a.failed);
        arena_release(&a);
        assert_int_equal(m.live, 0);
        if (done) break;
    }
    assert_true(failures > 30);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sums_have_their_bits),
        cmocka_unit_test(parameters_and_sizes_are_bound_again),
        cmocka_unit_test(long_expressions_need_no_stack),
        cmocka_unit_test(every_allocation_may_fail),
        cmocka_unit_test(every_way_of_running_gives_the_same_bits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
