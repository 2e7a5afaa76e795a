/* The trees of a model's text, with names that are not resolved yet. They take more memory than everything else, so
 * they live while the model is read; afterwards a statement keeps its names and places, and can be parsed again. */
#ifndef LANG_TREE_TREE_H
#define LANG_TREE_TREE_H

#include "lang/text/source.h"
#include "lang/text/words.h"

typedef enum tree_kind {
    TREE_NUMBER, /* .number */
    TREE_NAME,   /* .name, .primes; item[0 … index_count) are its indices */
    /* x(0), r'(0), x[i](0), V(a, b): item[0] is the TREE_NAME, then come the items in the bracket */
    TREE_APPLY,
    TREE_CALL, /* .operation is an operation or CALL_…; items are the arguments */
    TREE_NEGATE,
    TREE_ADD,
    TREE_SUBTRACT,
    TREE_MULTIPLY, /* .operation: CALL_CROSS for the sign ×, CALL_DOT for ·, which differ between vectors */
    TREE_DIVIDE,
    TREE_POWER,
    TREE_COMPARE, /* .operation: OP_LT … OP_NE */
    TREE_AND,
    TREE_OR,
    TREE_NOT,
    TREE_VECTOR,
    TREE_LIST,
    TREE_COMPONENT, /* item[0] is the vector, item[1] the number of the component, from 1, also for x, y, z */
    TREE_NORM,      /* |item[0]| */
    TREE_SUM        /* .loops; items are the conditions, then the body */
} tree_kind;

typedef struct loop {
    const char *name;
    struct tree *first, *last;
    span at;
} loop;

/* Every number, name and operator of the text has one, so it is small. */
typedef struct tree {
    uint8_t kind;               /* tree_kind */
    bool bracketed : 1;         /* it stood in ( ) of its own */
    bool blank_product : 1;     /* MULTIPLY: a name, a blank and a bracket: f (x) */
    bool divisor : 1;           /* APPLY: it is a divisor: a/f(x) */
    uint8_t primes, loop_count; /* CALL of a table: primes 1: `hold` is the item after the last */
    int16_t operation;
    uint16_t index_count;
    uint32_t count;
    span at;
    union {
        const char *name; /* NAME, CALL */
        double number;    /* NUMBER */
        loop *loops;      /* SUM */
    };
    struct tree **item;
} tree;

typedef enum statement_kind {
    STATEMENT_DEFINITION, /* name[indices] = value: a parameter, quantity or boundary cell */
    STATEMENT_EQUATION,   /* name[indices]' or '' = value */
    STATEMENT_START,      /* name[indices]'(at) = value */
    STATEMENT_FUNCTION, /* name(argument, …) = value; the parser makes a START, and lang/read/ decides which it is */
    STATEMENT_EXACT,
    STATEMENT_INVARIANT,
    STATEMENT_WHEN,
    STATEMENT_TIME,   /* the name of the time */
    STATEMENT_METHOD, /* text */
    STATEMENT_STEP,
    STATEMENT_TOLERANCE,
    STATEMENT_ACCURACY,
    STATEMENT_FROM,
    STATEMENT_UNTIL,
    STATEMENT_EVERY
} statement_kind;

typedef enum when_kind { WHEN_EQUAL, WHEN_CONDITION, WHEN_EVERY, WHEN_ACCUMULATES } when_kind;
typedef enum action_kind { ACTION_RECORD, ACTION_STOP, ACTION_ASSIGN } action_kind;

typedef struct action {
    uint8_t kind; /* action_kind */
    span at;
    tree *target, *value; /* ASSIGN: both; STOP: the value is the number after `after`, or NULL */
    struct action *next;
} action;

typedef struct when {
    uint8_t kind;       /* when_kind */
    int8_t direction;   /* EQUAL: 1 rising, -1 falling, 0 both */
    tree *left, *right; /* EQUAL: both; CONDITION, EVERY: left */
    const char *of;     /* ACCUMULATES: the name of an event */
    span of_at;
    action *actions;
} when;

/* The value of a statement that --set replaced, and the place of that statement. */
typedef struct replaced {
    tree *value;
    span at;
} replaced;

/* Every line has one, so it is small. */
typedef struct statement {
    uint8_t kind; /* statement_kind */
    uint8_t primes, loop_count;
    uint8_t progress; /* START: 0 not computed, 1 being computed (if it is needed now, it depends on itself), 2 done */
    bool steps;       /* EVERY: it counts steps */
    bool absolute;    /* TOLERANCE, ACCURACY: it is in the units of the numbers */
    uint16_t index_count;
    span at, name_at, value_at; /* value_at: the right side, without the indices' ranges */
    uint32_t next;              /* 1 + number of the next statement about the same variable; 0: there is none */
    const char *name;
    union {
        tree **index;
        const char *text; /* METHOD */
        when *when;       /* WHEN; .name is the event's, or NULL */
    };
    tree *applied; /* START, FUNCTION: the left side as an APPLY, x(c) or V(a, b) */
    tree *value;   /* the right side, or the setting's expression */
    loop *loops;
    replaced *replaced; /* NULL: the value is the model's own */
} statement;

typedef struct statements {
    statement *item; /* it moves when statements are added */
    uint32_t count, capacity;
    uint32_t operations; /* an estimate: the numbers, operators and different names in all trees */
} statements;

/* Parses text number `text` and appends its statements. False: there was a complaint, or no memory. */
bool parse_text(source *, uint32_t text, statements *);
/* Parses a statement of a model that has been read, into an arena that the caller releases; a METHOD has no trees.
 * False: no memory. */
bool parse_again(const source *, const statement *, arena *, statement *);

#endif
