/* The parser's state and helpers. Each file uses only those before it on this list: parse_factor.c (operands), parse.c
 * (operators), parse_solve.c (left sides that are sums), parse_when.c (events), parse_statement.c (statements). */
#ifndef LANG_TREE_PARSE_PARTS_H
#define LANG_TREE_PARSE_PARTS_H

#include "lang/base/limits.h"
#include "lang/base/operation.h"
#include "lang/text/foreign.h"
#include "lang/text/lex.h"
#include "lang/tree/tree.h"

#include <stdio.h>
#include <string.h>

enum { DEPTH_MAX = 2 * SOURCE_NESTING_MAX, ITEMS_FIRST = 2, NAMES_KNOWN = 256 };

typedef struct parser parser;
struct parser {
    lexer lexer;
    source *source;
    arena *arena;
    token token, last; /* the token to be read, and the one before it */
    int bars;          /* how many | are open in the present bracket [7] */
    int depth;
    bool error; /* a tolerance or an accuracy is read: `absolute` and `relative` are words */
    bool when;  /* a `when` is read: `rising`, `falling`, `as`, `record` … are words */
    struct {
        const char *name;
        bool counted;
    } known[NAMES_KNOWN];                 /* names read before, by their hash, so that no name is copied twice */
    uint32_t name;                        /* the index in `known` of the name that was read last */
    uint32_t operations;                  /* see struct statements */
    tree *(*expression)(struct parser *); /* parse_or: factors hold expressions, which hold factors */
};

static inline bool failed(const parser *p) { return source_failed(p->source); }

static inline void advance(parser *p)
{
    p->last = p->token;
    p->token = lex_next(&p->lexer);
}

static inline bool is(const parser *p, char c) { return p->token.kind == TOKEN_CHARACTER && p->token.character == c; }

static inline void skip_lines(parser *p)
{
    while (p->token.kind == TOKEN_NEWLINE && p->token.character != ';') advance(p);
}

static inline bool spelled(const parser *p, const token *t, const char *word)
{
    return t->kind == TOKEN_NAME && strlen(word) == t->at.to - t->at.from &&
           memcmp(p->source->texts[t->at.text].bytes + t->at.from, word, t->at.to - t->at.from) == 0;
}

static inline bool word(const parser *p, const char *text) { return spelled(p, &p->token, text); }

/* Copies a name, unless a copy is known; π is pi. */
static inline const char *copy_name(parser *p, const span *at)
{
    const char *bytes = p->source->texts[at->text].bytes + at->from;
    const size_t length = at->to - at->from;
    if (length == 2 && !memcmp(bytes, "π", 2)) return "pi";
    uint32_t hash = 0;
    for (size_t i = 0; i < length; i++) hash = hash * 31 + (unsigned char)bytes[i];
    p->name = hash % NAMES_KNOWN;
    const char *known = p->known[p->name].name;
    if (known && strncmp(known, bytes, length) == 0 && !known[length]) return known;
    const char *copy = arena_text(p->source->arena, bytes, length);
    if (failed(p)) return copy;
    p->known[p->name].name = copy;
    p->known[p->name].counted = false;
    return copy;
}

static inline tree *grow(parser *p, tree_kind kind, const span *at)
{
    tree *t = arena_take(p->arena, sizeof *t);
    p->operations += kind != TREE_NAME && kind != TREE_APPLY && kind != TREE_LIST && kind != TREE_VECTOR;
    t->kind = (uint8_t)kind;
    t->at = *at;
    return t;
}

static inline void add_item(parser *p, tree *t, tree *item)
{
    if (failed(p)) return;
    const bool power_of_two = t->count >= ITEMS_FIRST && (t->count & (t->count - 1)) == 0;
    if (t->count == 0 || power_of_two) {
        size_t room = t->count == 0 ? ITEMS_FIRST : 2 * (size_t)t->count;
        tree **more = arena_replace(p->arena, t->item, t->count * sizeof *more, room * sizeof *more);
        if (!more) return;
        t->item = more;
    }
    t->item[t->count++] = item;
}

static inline tree *two(parser *p, tree_kind kind, tree *a, tree *b)
{
    struct pair {
        tree tree;
        tree *item[2];
    } *both = arena_take(p->arena, sizeof *both); /* in one piece, since most trees have two items */
    tree *t = &both->tree;
    p->operations++;
    t->kind = (uint8_t)kind;
    t->at = (span){a->at.text, a->at.from, b->at.to};
    if (failed(p)) return t;
    t->item = both->item;
    t->item[0] = a;
    t->item[1] = b;
    t->count = 2;
    return t;
}

static inline tree *nothing(parser *p) { return grow(p, TREE_NUMBER, &p->token.at); }

#define COMPLAIN(p, at, ...) (source_complain((p)->source, MOTUS_SYNTAX, (at), __VA_ARGS__))
#define HINT(p, ...) (source_hint((p)->source, __VA_ARGS__))

static inline const char *quote(const parser *p, const span *at, char out[80])
{
    return source_excerpt(p->source, at, out, 80);
}

static inline bool deeper(parser *p)
{
    if (++p->depth <= DEPTH_MAX) return true;
    source_complain(p->source, MOTUS_LIMIT, &p->token.at, "the expression is nested too deeply");
    HINT(p, "give parts of it names of their own");
    return false;
}

static inline bool too_many_primes(parser *p)
{
    if (p->token.primes <= 2) return false;
    COMPLAIN(p, &p->token.at, "%d primes: the highest derivative is x''", p->token.primes);
    HINT(p, "Newton's second law is of second order; for more, add a first-order variable s' = …");
    return true;
}

/* Complains that the present token is not the expected one. */
static inline void unexpected(parser *p, const char *wanted)
{
    char text[80];
    if (p->token.kind == TOKEN_END || p->token.kind == TOKEN_NEWLINE)
        COMPLAIN(p, &p->token.at, "%s expected, but the line ends here", wanted);
    else
        COMPLAIN(p, &p->token.at, "%s expected, but here is %s", wanted, quote(p, &p->token.at, text));
}

/* Complains at a bracket that is open since an earlier line, if there is one. Line ends inside it do not count [8], so
 * it swallows the next statement. */
static inline bool left_open(parser *p)
{
    if (p->lexer.depth == 0 || failed(p)) return false;
    uint32_t from = p->lexer.opened[p->lexer.depth - 1];
    span open = {p->token.at.text, from, from + 1};
    if (source_line(p->source, &open) == source_line(p->source, &p->token.at)) return false;
    char closer = p->lexer.closer[p->lexer.depth - 1];
    COMPLAIN(p, &open, "this %c is not closed before the next statement", closer == ')' ? '(' : '[');
    HINT(p, "add the missing %c", closer);
    return true;
}

static inline bool expect(parser *p, char c, const char *where)
{
    if (is(p, c)) {
        advance(p);
        return true;
    }
    if (is(p, '=') && (c == ')' || c == ']')) {
        if (!left_open(p)) {
            COMPLAIN(p, &p->token.at, "%c %s expected, but here is =", c, where);
            HINT(p, "to compare write ==");
        }
        return false;
    }
    char wanted[80];
    snprintf(wanted, sizeof wanted, "%c %s", c, where);
    unexpected(p, wanted);
    return false;
}

/* parse_factor.c; parse_for reads the ranges after `for`, if there are any */
tree *parse_inside(parser *p);
void parse_for(parser *p, statement *s);
void parse_index(parser *p, tree *t);
tree *parse_applied(parser *p, tree *name);
tree *parse_factor(parser *p);
/* parse.c */
tree *parse_or(parser *p);
/* parse_solve.c; parse_sum_left reads the left side, which is more than a derivative, from the beginning of a statement
 * that has a derivative; the value is due then, and parse_solve solves the equation. */
bool parse_sum_left(parser *p, statement *s);
void parse_solve(parser *p, statement *s);
/* parse_when.c; parse_action says whether a misplaced text begins with the word of an action */
void parse_when(parser *p, statement *s);
bool parse_action(const parser *p, const span *at);
#define PARSE_COMMAS "a comma joins what an event does: when y = 0: y' = -y', record"

#endif
