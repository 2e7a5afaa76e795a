/* Shared by the files that write C. Each uses only those before it on this list: emit_place.c (text, places),
 * emit_nature.c (how wide values are), emit_exact.c (operations that a number makes exact), emit_value.c (values),
 * emit_two.c (two operations at a time), emit_pair.c (pairs of cells), emit_loop.c (regions, loops, sums),
 * emit_series.c and emit_series_pair.c (Taylor series), emit.c (the functions). */
#ifndef LANG_EMIT_EMIT_PARTS_H
#define LANG_EMIT_EMIT_PARTS_H

#include "lang/emit/emit.h"
#include "lang/graph/expansion.h"
#include "lang/graph/plan.h"

typedef struct writer {
    emit *e;
    plan plan;
    uint32_t region;
    int depth;
    /* which function of the program is being written */
    enum { BINDING, BINDING_LANES, TERMS, RUNNING } part;
    uint32_t *fixed; /* by item of region AT_BIND: its place in u, or in w if it is wide */
    uint32_t pairs;  /* the loop over pairs that is being written, whose sums take each pair once; else NONE */
    uint8_t *parity, *exchanged; /* for emit_pair.c, by node */
    double *value;               /* by item of region AT_BIND: its present value, or NaN; NULL: nothing is known */
    uint8_t *nature;             /* by node: WIDE, PLAIN_TIME, CLOSED */
    uint32_t *term;              /* by node: its place in T, or NONE */
    /* the level whose index differs from lane to lane, while the inside of its loop is written; else -1 */
    int along;
    bool skips;          /* terms that a sum's condition leaves out are not computed */
    expansion expansion; /* for a program in series */
    uint32_t stores;     /* how many stores there are outside loops so far */
    /* for a program in series, by item, while a loop over pairs that takes each once is written; else NULL. The loop
     * `sharing` is that over the terms of one cell; its series and those of the pairs have separate frames. */
    struct shared_value *shared;
    uint32_t sharing, pair_frame, own_frame, fronts;
    bool in_pairs;          /* the values of pairs are being written */
    struct emit_twos *twos; /* of emit_two.c, if the values of region AT_RUN are in its order; else NULL */
    bool one_by_one;        /* lanes are written in a loop over l, so a place is that of lane l */
} writer;

enum {
    WIDE = 1,       /* it differs from lane to lane */
    PLAIN_TIME = 2, /* it is a function of time and of what all lanes share, without sums */
    CLOSED = 4
}; /* it contains no sum and no index */

/* How a value takes part in a loop over pairs: not; as a position or velocity of a cell; as a value of the pair; as a
 * value of the pair that the terms of both cells use. */
typedef enum pair_role { ALONE, CELL, PAIR, FRONT } pair_role;
typedef struct shared_value {
    pair_role role;
    uint32_t at, own, front; /* places in the frames of the pair and of the term; the number of a FRONT */
} shared_value;

#define EACH_SUM(k, r) for (uint32_t k = (r)->sums; k != NONE; k = w->plan.sums.at[w->plan.items.at[k].sum].next)
#define SAY(w, ...) emit_add(&(w)->e->text, __VA_ARGS__)
void emit_line(writer *, const char *format, ...) __attribute__((format(printf, 2, 3)));
#define OPEN(w, ...) (emit_line(w, __VA_ARGS__), (void)(w)->depth++) /* a line that ends in { */
#define CLOSE(w) ((void)(w)->depth--, emit_line(w, "}"))

enum { PLACE_MAX = 320 };
/* Returns whether a number that differs between lanes lies in an array of the pool. */
bool emit_varies(const writer *, const array *);
/* Write the text of an element, by the first `dims` of its indices. */
void emit_element(writer *, const reference *, int dims, char out[PLACE_MAX]); /* "q[3] + j0 * q[4] + j1" */
void emit_address(writer *, const reference *, int dims, char out[PLACE_MAX]); /* "AT(x, ELEMENT)" */
void emit_bound(writer *, const subscript *, char out[PLACE_MAX]);
/* Writes the result of sum k from its partial sums: eight of a long range, added in the order that defines its bits. */
void emit_total(writer *, uint32_t k, const char *type, const char *first, const char *last);
/* Where the lanes of a wide place are: side by side; side by side but for a wrap, which emit_around writes; or
 * anywhere. */
typedef enum spread { TOGETHER, AROUND, ANYWHERE } spread;
spread emit_spread(const writer *, const reference *);
void emit_around(writer *, const reference *, char out[3 * PLACE_MAX]);

/* emit_nature.c. emit_natures finds the nature of every node. False: no loop over a sum of parameters is wide. */
bool emit_natures(writer *, bool loops);
void emit_terms(writer *);
bool emit_wide(const writer *, node);
const char *emit_type(const writer *, node);
const char *emit_operation(const writer *, node, unsigned op);

void emit_exact(writer *, node user, unsigned *op, char operand[3][48]);
void emit_values(writer *);

void emit_operand(writer *, node, node user, char out[48]);
void emit_outputs(writer *, uint32_t first);
void emit_item(writer *, uint32_t item);

typedef struct emit_twos emit_twos;
/* emit_two.c. emit_two_order puts the values of region AT_RUN in an order; emit_two writes number `at` of them and one
 * that follows as one operation, if there is one. True: number `at` is written. */
void emit_two_order(writer *);
bool emit_two(writer *, uint32_t at);

/* emit_pair.c. Returns whether all sums of a loop leave out the term at which two indices are equal, and the levels of
 * these. */
bool emit_leaves_out(const writer *, const plan_region *, int level[2]);
/* Returns the loop within a family's that may take each pair once, or NONE. */
uint32_t emit_pairs(writer *, uint32_t family);
/* Returns the loop within a family's whose terms for (i, j) and (j, i) have parts that differ at most in their sign, or
 * NONE; fills w->parity. emit_is_odd returns whether such a part changes its sign. */
uint32_t emit_exchangeable(writer *, uint32_t family);
bool emit_is_odd(const writer *, node);
/* Writes the addition of the exchanged terms of a loop's sums to the partial sums of the other cells. */
void emit_pair_others(writer *, uint32_t region);

void emit_region(writer *, uint32_t region);

void emit_series_pass(writer *, const char *name);
/* emit_series_pair.c: returns whether the series of a family's pairs are taken once for both cells; fills w->shared. */
bool emit_series_shares(writer *, uint32_t family);

#endif
