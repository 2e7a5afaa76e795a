/* The tree of a model's text, as the parser makes it; names are not resolved yet. It takes more memory than all else
 * that is read, so trees live while the model is read: afterwards a statement keeps its names and places alone, and its
 * trees can be parsed again. */
#ifndef LANG_TREE_TREE_H
#define LANG_TREE_TREE_H

#include "lang/text/source.h"
#include "lang/text/words.h"

typedef enum tree_kind {
    TREE_NUMBER, /* number */
    TREE_NAME,   /* name, item[0 … index_count) its indices, primes */
    /* x(0), r'(0), x[i](0), V(a, b): a TREE_NAME glued to a bracket: item[0] the name, then what the bracket holds */
    TREE_APPLY,
    TREE_CALL, /* operation, or one of the calls below; items are the arguments */
    TREE_NEGATE,
    TREE_ADD,
    TREE_SUBTRACT,
    TREE_MULTIPLY,
    TREE_DIVIDE,
    TREE_POWER,
    TREE_COMPARE, /* operation: OP_LT … OP_NE */
    TREE_AND,
    TREE_OR,
    TREE_NOT,
    TREE_VECTOR,
    TREE_LIST,
    TREE_COMPONENT, /* item[0] the vector, item[1] the number of the component, from 1 (x, y, z are numbers already) */
    TREE_NORM,      /* |item[0]| */
    TREE_SUM        /* loops, items: conditions, then the body last */
} tree_kind;

typedef struct loop {
    const char *name;
    struct tree *first, *last;
    span at;
} loop;

/* There is one for every number, name and operator of the text, so it is kept small. */
typedef struct tree {
    uint8_t kind;           /* tree_kind */
    bool bracketed : 1;     /* stood in ( ) of its own */
    bool blank_product : 1; /* MULTIPLY: a name and a bracket with a blank between, f (x) */
    bool divisor : 1;       /* APPLY: something is divided by it, a/f(x) */
    uint8_t primes, loop_count;
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
    STATEMENT_DEFINITION, /* name[indices] = value: parameter, quantity, boundary line */
    STATEMENT_EQUATION,   /* name[indices]' or '' = value */
    STATEMENT_START,      /* name[indices]'(at) = value */
    STATEMENT_FUNCTION,   /* name(argument, …) = value; the parser leaves it to the names whether it is a START */
    STATEMENT_EXACT,
    STATEMENT_INVARIANT,
    STATEMENT_WHEN,   /* when */
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
    tree *target, *value; /* ASSIGN: both; STOP: the value is the number behind `after`, or NULL */
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

/* What --set has put another expression in the place of: the model's own, and the place of that statement. */
typedef struct replaced {
    tree *value;
    span at;
} replaced;

/* There is one for every line, so it is kept small. */
typedef struct statement {
    uint8_t kind; /* statement_kind */
    uint8_t primes, loop_count;
    uint8_t progress; /* START: 0 not computed, 1 being computed (needed now, it depends on itself), 2 done */
    bool steps;       /* EVERY: every n steps */
    bool absolute;    /* TOLERANCE, ACCURACY: in the units of the numbers */
    uint16_t index_count;
    span at, name_at, value_at; /* value_at: the right side, without the indices' ranges */
    uint32_t next;              /* 1 + number of the next line about the same state or family; 0: none */
    const char *name;
    union {
        tree **index;
        const char *text; /* METHOD */
        when *when;       /* WHEN, whose name is that of the event, or NULL */
    };
    tree *applied; /* START, FUNCTION: the left side as an APPLY, x(c) or V(a, b) */
    tree *value;   /* the right side, or the setting's expression */
    loop *loops;
    replaced *replaced; /* NULL: it is the model's own */
} statement;

typedef struct statements {
    statement *item; /* it moves when there are more */
    uint32_t count, capacity;
    uint32_t operations; /* numbers, operators and different names in the trees, more or less */
} statements;

/* Parses text number `text` and appends its statements. False: complained or no memory. */
bool parse_text(source *, uint32_t text, statements *);
/* A statement of a model that has been read, with its trees, in an arena that the caller releases; not of a METHOD,
 * which has none. False: no memory. */
bool parse_again(const source *, const statement *, arena *, statement *);

#endif
