/* Expressions: operators, loosest last; parse_factor.c has their operands. Each function is headed by its grammar rule.
 * Numbers in brackets are the rules of the language as test/language_test.c numbers them. The lexer bounds brackets and
 * `deeper` bounds the rest, so no text exhausts the C stack. */
#include "lang/tree/parse_parts.h"

/* Returns -t, whose sign is at a place. */
static tree *negated(parser *p, span sign, tree *t)
{
    tree *negative = grow(p, TREE_NEGATE, &(span){sign.text, sign.from, t->at.to});
    add_item(p, negative, t);
    return negative;
}

/* power = factor [ "^" [ "-" | "+" ] power ]: right-associative [2] */
static tree *parse_power(parser *p)
{
    tree *base = parse_factor(p);
    if (failed(p) || !is(p, '^')) return base;
    advance(p);
    skip_lines(p);
    bool minus = is(p, '-');
    span sign = p->token.at;
    if (minus || is(p, '+')) advance(p);
    if (!deeper(p)) return base;
    tree *exponent = parse_power(p);
    p->depth--;
    if (failed(p)) return base;
    if (p->token.kind == TOKEN_PRIMES && !p->token.blank) {
        COMPLAIN(p, &p->token.at, "a prime follows a name, not a power");
        HINT(p, "write the derivative out");
        return base;
    }
    return two(p, TREE_POWER, base, minus ? negated(p, sign, exponent) : exponent);
}

/* Returns whether the token is a word of events, before which no factor ends in a product. */
static bool event_word(const parser *p)
{
    char name[MOTUS_NAME_MAX];
    const size_t length = p->token.at.to - p->token.at.from;
    if (length >= sizeof name) return false;
    memcpy(name, p->source->texts[p->token.at.text].bytes + p->token.at.from, length);
    name[length] = 0;
    return words_event_kind(name) == MOTUS_WORD_OPERATOR;
}

/* Returns whether a factor follows without a sign: a name, a call, a bracket, a norm [2, 7]. */
static bool juxtaposes(const parser *p)
{
    if (p->token.kind == TOKEN_NAME) {
        static const char *const words[] = {"and", "or", "not", "for", "steps"};
        for (size_t i = 0; i < sizeof words / sizeof *words; i++)
            if (word(p, words[i])) return false;
        if (p->error && (word(p, "absolute") || word(p, "relative"))) return false;
        return !(p->when && (event_word(p) || word(p, "then") || word(p, "do")));
    }
    return is(p, '(') || (is(p, '|') && p->bars == 0) || (is(p, '[') && p->token.blank) ||
           p->token.kind == TOKEN_NUMBER;
}

static bool quotient(const tree *t) { return t->kind == TREE_DIVIDE && !t->bracketed; }

/* Returns what the next factor would follow: the last factor of a product, or the divisor of a quotient. */
static const tree *last_factor(const tree *t)
{
    return (t->kind == TREE_MULTIPLY || t->kind == TREE_DIVIDE) && !t->bracketed ? t->item[1] : t;
}

static bool only_digits(const parser *p, span at)
{
    for (uint32_t i = at.from; i < at.to; i++)
        if (p->source->texts[at.text].bytes[i] < '0' || p->source->texts[at.text].bytes[i] > '9') return false;
    return true;
}

/* Complains about products that juxtaposition cannot write: x 2, 2 3, (a)2. */
static bool wrong_juxtaposition(parser *p, const tree *product)
{
    char a[80], b[80], c[80];
    const tree *left = last_factor(product);
    if (p->token.kind == TOKEN_NUMBER) {
        span at = {left->at.text, left->at.from, p->token.at.to};
        const bool list = p->lexer.depth > 0 && p->lexer.closer[p->lexer.depth - 1] == ']';
        quote(p, &left->at, a);
        quote(p, &p->token.at, b);
        COMPLAIN(p, &at, "a number comes first in a product: %s %s is not read", a, b);
        const bool round = p->lexer.depth > 0 && p->lexer.closer[p->lexer.depth - 1] == ')',
                   whole = only_digits(p, left->at) && only_digits(p, p->token.at);
        if (left->kind == TREE_NUMBER && whole && strlen(b) == 3)
            HINT(p, "a number has no blanks: write %s%s; a product %s*%s", a, b, a, b);
        if (left->kind == TREE_NUMBER && whole && round)
            HINT(p, "write %s*%s, %s.%s for a decimal number, (%s, %s) for a vector", a, b, a, b, a, b);
        if (list) HINT(p, "the entries of a list have commas between them: [1, 2]; a matrix is [[1, 2], [3, 4]]");
        if (left->kind == TREE_NAME && !strcmp(left->name, "to"))
            HINT(p, "a run has two lines: from 0, and until %s", b);
        if (p->when && left->kind == TREE_NAME && product != left)
            HINT(p, "an event is an equation or a condition: when x = 0: …, when x > 0: …");
        if (quotient(product))
            HINT(p, "write %s/%s*%s or %s/(%s*%s)", quote(p, &product->item[0]->at, c), a, b, c, a, b);
        else if (left->kind != TREE_NUMBER)
            HINT(p, "write %s %s or %s*%s", b, a, a, b);
        else if (whole)
            HINT(p, "write %s*%s, or %s.%s for a decimal number", a, b, a, b);
        else
            HINT(p, "write %s*%s", a, b);
        return true;
    }
    if (is(p, '[')) {
        COMPLAIN(p, &p->token.at, "an index stands directly behind the name");
        if (left->kind == TREE_NUMBER) HINT(p, "a unit is no part of a number: write it in a comment, behind #");
        return true;
    }
    return false;
}

/* Refuses a factor that touches a divisor [3]: most read 1/2x as 1/(2 x), and a program reads (1/2) x. Behind a blank a
 * factor multiplies the quotient, as in print: g/L sin(θ) is (g/L) sin(θ). */
static bool glued_to_divisor(parser *p, const tree *product, const tree *right)
{
    char a[80], b[80], c[80];
    const tree *divisor = product->item[1];
    COMPLAIN(p, (&(span){divisor->at.text, divisor->at.from, right->at.to}),
             "it is not clear whether %s multiplies the quotient or the divisor", quote(p, &right->at, c));
    HINT(p, "write %s/%s %s, with a blank, for (%s/%s) %s; or %s/(%s %s)", quote(p, &product->item[0]->at, a),
         quote(p, &divisor->at, b), c, a, b, c, a, b, c);
    return false;
}

/* Hints that the remainder of a, `a mod b`, is mod(a, b). */
static void hint_remainder(parser *p, const tree *a, const span *sign)
{
    char x[80], y[80];
    const span after = foreign_after(p->source, sign);
    const bool bracket = after.to > after.from + 1 && p->source->texts[after.text].bytes[after.from] == '(';
    quote(p, &a->at, x);
    HINT(p, "write mod(%s, %s)", x, quote(p, &(span){after.text, after.from + bracket, after.to - bracket}, y));
}

/* Multiplies t by a factor without a sign between them. */
static tree *parse_beside(parser *p, tree *t)
{
    if (wrong_juxtaposition(p, t)) return t;
    const tree *previous = last_factor(t);
    const bool remainder = word(p, "mod");
    const span sign = p->token.at;
    const bool blank = p->token.blank, opens = is(p, '('), named = previous->kind == TREE_NAME && !previous->bracketed;
    tree *right = parse_power(p);
    if (failed(p) && remainder) hint_remainder(p, previous, &sign);
    if (failed(p) || (quotient(t) && !blank && !glued_to_divisor(p, t, right))) return t;
    t = two(p, TREE_MULTIPLY, t, right);
    t->blank_product = named && opens && blank && right->bracketed;
    return t;
}

/* Multiplies or divides t by a factor, at its sign. */
static tree *parse_signed(parser *p, tree *t)
{
    const bool times = is(p, '*');
    const span sign = p->token.at;
    advance(p);
    skip_lines(p);
    if (is(p, '*') && times) {
        COMPLAIN(p, (&(span){sign.text, sign.from, p->token.at.to}), "powers are written with ^, not **");
        return t;
    }
    const bool minus = is(p, '-');
    const span at = p->token.at;
    if (minus) advance(p);
    tree *right = parse_power(p);
    if (failed(p)) return t;
    right->divisor = !times;
    if (minus) right = negated(p, at, right);
    tree *all = two(p, times ? TREE_MULTIPLY : TREE_DIVIDE, t, right);
    const char *const bytes = p->source->texts[sign.text].bytes + sign.from;
    if (times && bytes[0] != '*') all->operation = !memcmp(bytes, "×", 2) ? CALL_CROSS : CALL_DOT;
    return all;
}

/* product = power { "*" [ "-" ] power | "/" [ "-" ] power | power } from the left [2, 3] */
static tree *parse_product(parser *p)
{
    tree *t = parse_power(p);
    while (!failed(p) && (is(p, '*') || is(p, '/') || juxtaposes(p)))
        t = is(p, '*') || is(p, '/') ? parse_signed(p, t) : parse_beside(p, t);
    return t;
}

/* sum = [ "-" | "+" ] product { ("+" | "-") product } */
static tree *parse_terms(parser *p)
{
    tree *t = NULL;
    if (is(p, '-') || is(p, '+')) {
        bool minus = is(p, '-');
        span at = p->token.at;
        advance(p);
        skip_lines(p);
        if (is(p, '-') || is(p, '+')) {
            COMPLAIN(p, &p->token.at, "two signs in a row");
            HINT(p, "use a bracket: -(-x)");
            return nothing(p);
        }
        t = parse_product(p);
        if (failed(p)) return t;
        if (minus) t = negated(p, at, t);
    } else {
        t = parse_product(p);
    }
    while (!failed(p) && (is(p, '+') || is(p, '-'))) {
        tree_kind kind = is(p, '+') ? TREE_ADD : TREE_SUBTRACT;
        advance(p);
        skip_lines(p);
        if (is(p, '+') || is(p, '-')) {
            COMPLAIN(p, &p->token.at, "two signs in a row");
            HINT(p, "use a bracket: a + (-b); a comment begins with #");
            return t;
        }
        tree *right = parse_product(p);
        if (failed(p)) return t;
        t = two(p, kind, t, right);
    }
    return t;
}

static int relation(const parser *p)
{
    switch (p->token.kind) {
    case TOKEN_LE: return OP_LE;
    case TOKEN_GE: return OP_GE;
    case TOKEN_EQ: return OP_EQ;
    case TOKEN_NE: return OP_NE;
    default: return is(p, '<') ? OP_LT : is(p, '>') ? OP_GT : -1;
    }
}

/* Returns whether a chain goes on the same way: a < b <= c, a == b == c. */
static bool one_way(int before, int after)
{
    const bool less = before == OP_LT || before == OP_LE, greater = before == OP_GT || before == OP_GE;
    return less      ? after == OP_LT || after == OP_LE
           : greater ? after == OP_GT || after == OP_GE
                     : before == OP_EQ && after == OP_EQ;
}

/* Refuses a < b > c, whose last sign is at a place. */
static void refuse_chain(parser *p, const tree *before, const span *sign, const tree *last)
{
    char a[80], b[80], c[80];
    COMPLAIN(p, sign, "a chain of comparisons goes one way, as a < b < c or a >= b >= c");
    HINT(p, "write %s and %s %s %s", quote(p, &before->at, a), quote(p, &before->item[1]->at, b),
         source_excerpt(p->source, sign, (char[8]){0}, 8), quote(p, &last->at, c));
}

/* comparison = sum { ("<" | "<=" | ">" | ">=" | "==" | "!=") sum }: a < b < c is a < b and b < c [14] */
static tree *parse_comparison(parser *p)
{
    tree *side = parse_terms(p), *before = NULL, *all = NULL;
    int operation;
    while (!failed(p) && (operation = relation(p)) >= 0) {
        const span sign = p->token.at;
        advance(p);
        skip_lines(p);
        tree *right = parse_terms(p);
        if (failed(p)) break;
        if (before && !one_way(before->operation, operation)) {
            refuse_chain(p, before, &sign, right);
            break;
        }
        before = two(p, TREE_COMPARE, side, right);
        before->operation = (int16_t)operation;
        all = all ? two(p, TREE_AND, all, before) : before;
        side = right;
    }
    return all ? all : side;
}

/* not = "not" not | comparison */
static tree *parse_not(parser *p)
{
    if (!word(p, "not")) return parse_comparison(p);
    tree *t = grow(p, TREE_NOT, &p->token.at);
    advance(p);
    skip_lines(p);
    if (!deeper(p)) return t;
    tree *of = parse_not(p);
    p->depth--;
    add_item(p, t, of);
    t->at.to = of->at.to;
    return t;
}

/* and = not { "and" not } */
static tree *parse_and(parser *p)
{
    tree *t = parse_not(p);
    while (!failed(p) && word(p, "and")) {
        advance(p);
        skip_lines(p);
        t = two(p, TREE_AND, t, parse_not(p));
    }
    return t;
}

/* or = and { "or" and } */
tree *parse_or(parser *p)
{
    if (!deeper(p)) return nothing(p);
    tree *t = parse_and(p);
    while (!failed(p) && word(p, "or")) {
        advance(p);
        skip_lines(p);
        t = two(p, TREE_OR, t, parse_and(p));
    }
    p->depth--;
    return t;
}
