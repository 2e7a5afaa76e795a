/* What the tests of the graph and of the tape share: a model with arrays, and short functions for making nodes. */
#ifndef TEST_GRAPH_WORLD_H
#define TEST_GRAPH_WORLD_H

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lang/base/operation.h"
#include "lang/tape/tape_code.h"

#include <cmocka.h> /* last: it defines a macro `fail` */

/* A scalar, a chain, a grid, a list; the places where results go; directions. */

enum {
    SCALAR,
    CHAIN,
    GRID,
    CHAIN_V,
    LIST_M,
    TO_SCALAR,
    TO_CHAIN,
    TO_GRID,
    OUT_SCALAR,
    OUT_CHAIN,
    OUT_GRID,
    DIRECTION_SCALAR,
    DIRECTION_CHAIN,
    ARRAYS
};
enum { INT_N, INT_ROWS, INT_COLUMNS, INT_LIST, INTS };
enum { PARAMS = 3 };

typedef struct world {
    array arrays[ARRAYS];
    extent over[ARRAYS];
    int64_t ints[INTS];
    double pool[PARAMS + 64], x[4096], v[4096], a[4096], dx[4096], out[4096];
    binding binding;
    double *base[SPACES];
} world;

static inline array line(extent *over, space s, size_t base, int64_t first, int64_t last)
{
    *over = (extent){.first = {first}, .last = {last}, .stride = {1}};
    return (array){.space = (uint8_t)s, .dims = 1, .base = base, .over = over};
}

static inline array plane(extent *over, space s, size_t base, int64_t rows, int64_t columns)
{
    *over = (extent){.last = {rows + 1, columns + 1}, .stride = {columns + 2, 1}};
    return (array){.space = (uint8_t)s, .dims = 2, .base = base, .over = over};
}

static uint64_t seed = 1; /* each test program has its own sequence */

static inline uint32_t draw(uint32_t below)
{
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    return (uint32_t)((seed >> 33) % below);
}

static inline double number(void) { return ((double)draw(2000001) - 1e6) / 5e5 + draw(1000) * 1e-9; }

static inline void world_make(world *w, int64_t n, int64_t rows, int64_t columns, int64_t list)
{
    memset(w, 0, sizeof *w);
    w->ints[INT_N] = n;
    w->ints[INT_ROWS] = rows;
    w->ints[INT_COLUMNS] = columns;
    w->ints[INT_LIST] = list;
    w->arrays[SCALAR] = (array){.space = SPACE_X};
    w->arrays[CHAIN] = line(&w->over[CHAIN], SPACE_X, 1, 0, n + 1);
    w->arrays[GRID] = plane(&w->over[GRID], SPACE_X, (size_t)n + 3, rows, columns);
    w->arrays[CHAIN_V] = line(&w->over[CHAIN_V], SPACE_V, 1, 0, n + 1);
    w->arrays[LIST_M] = line(&w->over[LIST_M], SPACE_POOL, PARAMS, 1, list);
    w->arrays[TO_SCALAR] = (array){.space = SPACE_A};
    w->arrays[TO_CHAIN] = line(&w->over[TO_CHAIN], SPACE_A, 1, 0, n + 1);
    w->arrays[TO_GRID] = plane(&w->over[TO_GRID], SPACE_A, (size_t)n + 3, rows, columns);
    w->arrays[OUT_SCALAR] = (array){.space = SPACE_OUT};
    w->arrays[OUT_CHAIN] = line(&w->over[OUT_CHAIN], SPACE_OUT, 1, 0, n + 1);
    w->arrays[OUT_GRID] = plane(&w->over[OUT_GRID], SPACE_OUT, (size_t)n + 3, columns, rows);
    w->arrays[DIRECTION_SCALAR] = (array){.space = SPACE_DX};
    w->arrays[DIRECTION_CHAIN] = line(&w->over[DIRECTION_CHAIN], SPACE_DX, 1, 0, n + 1);
    for (size_t k = 0; k < 4096; k++) w->x[k] = number(), w->v[k] = number(), w->dx[k] = number();
    for (size_t k = 0; k < PARAMS + 64; k++) w->pool[k] = number();
    w->binding = (binding){w->arrays, w->ints, w->pool};
    w->base[SPACE_X] = w->x;
    w->base[SPACE_V] = w->v;
    w->base[SPACE_A] = w->a;
    w->base[SPACE_DX] = w->dx;
    w->base[SPACE_OUT] = w->out;
}

static inline subscript literal(int32_t k) { return (subscript){-1, -1, -1, k}; }
static inline subscript slot(int s, int32_t k) { return (subscript){-1, (int16_t)s, -1, k}; }
static inline subscript level(int l, int32_t k) { return (subscript){(int8_t)l, -1, -1, k}; }
static inline subscript folded(int l, int32_t k, int m) { return (subscript){(int8_t)l, -1, (int16_t)m, k}; }
static inline reference ref0(int a) { return (reference){.array = (uint16_t)a}; }
static inline reference ref1(int a, subscript s) { return (reference){.array = (uint16_t)a, .dims = 1, .at = {s}}; }
static inline reference ref2(int a, subscript s, subscript t)
{
    return (reference){.array = (uint16_t)a, .dims = 2, .at = {s, t}};
}
static inline node load(graph *g, reference r) { return graph_load(g, &r); }
static inline node un(graph *g, operation op, node a) { return graph_op(g, op, a, 0, 0); }
static inline node bin(graph *g, operation op, node a, node b) { return graph_op(g, op, a, b, 0); }
static inline node sum_over(graph *g, int l, range r, node condition, node body)
{
    return graph_sum(g, l, &r, condition, body);
}

typedef struct fixture {
    arena arena;
    graph *g;
    world *w;
} fixture;

static inline fixture begin(world *w)
{
    fixture f = {.w = w};
    arena_init(&f.arena, NULL);
    return f;
}

/* The arena must not move once it is in use: the graph points to it. */
static inline graph *start(fixture *f)
{
    f->g = graph_create(&f->arena);
    assert_non_null(f->g);
    f->g->arrays = f->w->arrays;
    return f->g;
}

static inline bool same_bits(double a, double b) { return (isnan(a) && isnan(b)) || !memcmp(&a, &b, sizeof a); }

/* The value of a graph without loops, computed by the tape. */
static inline double run_one(fixture *f, node n, double t)
{
    output o = {.value = n, .to = ref0(TO_SCALAR)};
    program *p = program_create(f->g, &o, 1);
    tape *tp = p ? tape_create(&f->arena, p) : NULL;
    assert_non_null(tp);
    assert_true(tape_bind(tp, &f->w->binding));
    tape_run(tp, t, f->w->base);
    return f->w->a[0];
}

static inline node seed_one(graph *g, node leaf, void *ctx)
{
    (void)ctx;
    return graph_at(g, leaf)->op == OP_LOAD ? graph_const(g, 1) : 0;
}

typedef struct seen {
    int count, inside[8], first[8];
    reference ref[8];
    range range[8];
} seen;

static inline void see(void *ctx, const reference *ref, const range *sums, int first_level, int inside)
{
    seen *s = ctx;
    if (s->count < 0) return;
    assert_true(s->count < 8);
    s->ref[s->count] = *ref;
    s->inside[s->count] = inside;
    s->first[s->count] = first_level;
    if (inside) s->range[s->count] = sums[inside - 1];
    s->count++;
}

/* Allocation hooks that count, and fail from call number `left` on. */
typedef struct meter {
    long left, live, taken;
} meter;

static inline void *metered_take(void *ctx, size_t bytes)
{
    meter *m = ctx;
    m->taken++;
    if (m->left-- <= 0) return NULL;
    void *p = malloc(bytes);
    m->live += p != NULL;
    return p;
}

static inline void metered_give(void *ctx, void *block)
{
    ((meter *)ctx)->live--;
    free(block);
}

#endif
