/* Shared by the files that write C. From the lowest, each uses only those above it on this list: emit_place.c (text,
 * places), emit_nature.c (how wide values are), emit_exact.c (operations that a number makes exact), emit_value.c
 * (values), emit_pair.c (pairs of cells), emit_loop.c (regions, loops, sums), emit_series.c and emit_series_pair.c
 * (Taylor series), emit.c (the functions). */
#ifndef LANG_EMIT_EMIT_PARTS_H
#define LANG_EMIT_EMIT_PARTS_H

#include "lang/emit/emit.h"
#include "lang/base/operation.h"
#include "lang/graph/expansion.h"
#include "lang/graph/plan.h"

typedef struct writer {
    emit *e;
    plan plan;
    uint32_t region;
    int depth;
    /* of the program's functions: which one is being written */
    enum { BINDING, BINDING_LANES, TERMS, RUNNING } part;
    uint32_t *fixed; /* by item of region AT_BIND: its place in u, or in w where it is wide */
    uint32_t pairs;  /* the loop over pairs whose sums take each pair once, while it is written; else NONE */
    uint8_t *parity, *exchanged; /* by node: of emit_pair.c */
    double *value;               /* by item of region AT_BIND: what it is now, or NaN; NULL: nothing is known */
    uint8_t *nature;             /* by node: NATURE_ */
    uint32_t *term;              /* by node: its place in T, or NONE */
    /* the level whose index differs from lane to lane, while the inside of its loop is written; else -1 */
    int along;
    bool skips;          /* the terms that a sum's condition leaves out are not computed */
    expansion expansion; /* of a program in series */
    uint32_t stores;     /* outside of loops, so far */
    /* of a program in series, by item, while a loop over pairs is written that takes each once; else NULL. The loop
     * `sharing` is that over the terms of one cell; its series and those of the pairs have frames of their own. */
    struct shared_value *shared;
    uint32_t sharing, pair_frame, own_frame, fronts;
    bool in_pairs;   /* the values of the pairs are being written */
    bool one_by_one; /* lanes are written in a loop over l, and a place is that of lane l */
} writer;

enum {
    WIDE = 1,       /* differs from lane to lane */
    PLAIN_TIME = 2, /* a function of time and of what all lanes share, without sums */
    CLOSED = 4
}; /* no sum in it, no index */

/* How a value takes part in a loop over pairs: not; as a position or velocity of one of its cells; as a value of the
 * pair; as one that the terms of both cells use. */
typedef enum pair_role { ALONE, CELL, PAIR, FRONT } pair_role;
typedef struct shared_value {
    pair_role role;
    uint32_t at, own, front; /* in the pair's frame; of those alone and of fronts in the term's; of fronts: which */
} shared_value;

/* Each sum of a loop. */
#define EACH_SUM(k, r) for (uint32_t k = (r)->sums; k != NONE; k = w->plan.sums.at[w->plan.items.at[k].sum].next)
#define SAY(w, ...) emit_add(&(w)->e->text, __VA_ARGS__)
void emit_line(writer *, const char *format, ...) __attribute__((format(printf, 2, 3)));

enum { PLACE_MAX = 320 };
/* Whether one of the lanes' own numbers lies in an array of the pool. */
bool emit_varies(const writer *, const array *);
/* Of an element's indices the first `dims`. */
void emit_element(writer *, const reference *, int dims, char out[PLACE_MAX]); /* "q[3] + j0 * q[4] + j1" */
void emit_address(writer *, const reference *, int dims, char out[PLACE_MAX]); /* "AT(x, ELEMENT)" */
void emit_bound(writer *, const subscript *, char out[PLACE_MAX]);
/* The result of sum k from its partial sums: eight of a long range, added in the order that defines its bits. */
void emit_total(writer *, uint32_t k, const char *type, const char *first, const char *last);
/* Where the lanes of a wide place are: next to one another; the same except for a wrap, which emit_around writes;
 * or anywhere. */
typedef enum spread { TOGETHER, AROUND, ANYWHERE } spread;
spread emit_spread(const writer *, const reference *);
void emit_around(writer *, const reference *, char out[3 * PLACE_MAX]);

/* emit_nature.c. The nature of every node. False: no loop over a sum of parameters is wide. */
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

/* emit_pair.c. Whether all sums of a loop leave out the term at which two indices are equal, and which levels these
 * have. */
bool emit_leaves_out(const writer *, const plan_region *, int level[2]);
/* The loop in a family's that may take each pair once, or NONE. */
uint32_t emit_pairs(writer *, uint32_t family);
/* The loop in a family's whose terms for (i, j) and (j, i) have parts that differ at most in their sign, or NONE; it
 * fills w->parity. Whether such a part changes its sign. */
uint32_t emit_exchangeable(writer *, uint32_t family);
bool emit_is_odd(const writer *, node);
/* Adds the exchanged terms of the sums of a loop to the partial sums of the other cells. */
void emit_pair_others(writer *, uint32_t region);

void emit_region(writer *, uint32_t region);

void emit_series_pass(writer *, const char *name);
/* emit_series_pair.c: whether the series of a family's pairs are taken once for both cells; it fills w->shared. */
bool emit_series_shares(writer *, uint32_t family);

#endif
