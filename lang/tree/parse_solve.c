/* Equations with more than a derivative on the left side, as physicists write them: m x'' + c x' + k x = F. They are
 * solved for the highest derivative, which stands on one side once, in terms and factors that can go to the other side.
 */
#include "lang/tree/parse_parts.h"

/* Returns whether the statement that begins at a place has an = and primes. */
static bool derives(const parser *p, uint32_t from)
{
    lexer ahead = p->lexer;
    ahead.at = from;
    ahead.depth = 0;
    bool primes = false, equals = false;
    for (token t = lex_next(&ahead); !failed(p); t = lex_next(&ahead)) {
        primes |= t.kind == TOKEN_PRIMES;
        equals |= t.kind == TOKEN_EQ || (t.kind == TOKEN_CHARACTER && t.character == '=');
        if (t.kind == TOKEN_END || t.kind == TOKEN_NEWLINE) return primes && equals;
    }
    return false;
}

/* What stands for a derivative in an expression: its highest one, and how often derivatives of that order stand there.
 * An initial value x'(0) is none. */
typedef struct highest {
    tree *first, *other;
    int count;
} highest;

static void find(highest *h, tree *t)
{
    for (;; t = t->item[0]) {
        if (t->kind == TREE_NAME && t->primes && (!h->first || t->primes >= h->first->primes)) {
            const bool higher = !h->first || t->primes > h->first->primes;
            *h = higher ? (highest){t, NULL, 1} : (highest){h->first, t, h->count + 1};
        }
        if (t->count == 0 || t->kind == TREE_NAME) return;
        for (uint32_t i = 1; i < t->count; i++) find(h, t->item[i]);
        if (t->kind == TREE_APPLY) return;
    }
}

bool parse_sum_left(parser *p, statement *s)
{
    if (failed(p) || !derives(p, s->at.from)) return false;
    p->lexer.at = s->at.from;
    p->lexer.depth = 0;
    advance(p);
    tree *left = p->expression(p);
    char a[80], b[80];
    s->at = (span){s->at.text, s->at.from, p->last.at.to};
    s->kind = STATEMENT_EQUATION;
    s->name = "x"; /* parse_solve finds it */
    s->applied = left;
    if (failed(p) || left->kind != TREE_COMPARE || left->operation != OP_EQ) return true;
    COMPLAIN(p, &left->at, "an equation has one =");
    HINT(p, "write %s = %s", quote(p, &left->item[0]->at, a), quote(p, &left->item[1]->at, b));
    return true;
}

/* Returns whether a tree has another one in it. */
static bool holds(const tree *t, const tree *of)
{
    for (; t != of; t = t->item[0]) {
        if (t->count == 0 || t->kind == TREE_NAME) return false;
        for (uint32_t i = 1; i < t->count; i++)
            if (holds(t->item[i], of)) return true;
    }
    return true;
}

static tree *negative(parser *p, tree *of)
{
    tree *t = grow(p, TREE_NEGATE, &of->at);
    add_item(p, t, of);
    return t;
}

static bool is_zero(const tree *t) { return t->kind == TREE_NUMBER && t->number == 0; }

/* Returns the right side when the outermost operator of the left side, one of whose operands holds the derivative, has
 * gone there. NULL: it cannot. */
static tree *taken_over(parser *p, const tree *left, bool second, tree *right)
{
    tree *other = left->count == 2 ? left->item[!second] : NULL;
    switch (left->kind) {
    case TREE_NEGATE: return is_zero(right) ? right : negative(p, right);
    case TREE_ADD: return is_zero(right) ? negative(p, other) : two(p, TREE_SUBTRACT, right, other);
    case TREE_SUBTRACT:
        if (is_zero(right)) return other;
        return second ? two(p, TREE_SUBTRACT, other, right) : two(p, TREE_ADD, right, other);
    case TREE_MULTIPLY: return is_zero(right) ? right : two(p, TREE_DIVIDE, right, other);
    case TREE_DIVIDE: return second ? NULL : two(p, TREE_MULTIPLY, right, other);
    default: return NULL;
    }
}

/* Takes the name of an equation from its highest derivative. False: there is none, or more than one. */
static bool named(parser *p, statement *s, const highest *h)
{
    char a[80], b[80];
    if (!h->first) {
        COMPLAIN(p, &s->at, "this equation has no derivative");
        HINT(p, "a name, x'' or x'(0) stands alone on the left side, or an equation has its derivative there");
        return false;
    }
    s->name = h->first->name;
    s->name_at = h->first->at;
    s->primes = h->first->primes;
    s->index = h->first->item;
    s->index_count = h->first->index_count;
    if (h->count == 1) return true;
    const bool in_order = h->first->at.from < h->other->at.from;
    quote(p, in_order ? &h->first->at : &h->other->at, a);
    quote(p, in_order ? &h->other->at : &h->first->at, b);
    if (strcmp(a, b)) {
        COMPLAIN(p, &s->at, "%s and %s stand on one side of an equation, and motus does not solve for both", a, b);
        HINT(p, "solve the equations by hand, one for %s and one for %s", a, b);
    } else {
        COMPLAIN(p, &s->at, "%s stands twice on one side of an equation", a);
        HINT(p, "collect its factors: (a + b) %s = …", a);
    }
    return false;
}

void parse_solve(parser *p, statement *s)
{
    const span all = {s->at.text, s->at.from, s->value_at.to};
    tree *left = s->applied;
    char a[80], b[80];
    highest h = {0}, other = {0};
    find(&h, left);
    find(&other, s->value);
    if (other.first && (!h.first || other.first->primes > h.first->primes)) { /* -k x = m x'' */
        left = s->value;
        s->value = s->applied;
        h = other;
    }
    s->applied = NULL;
    if (!named(p, s, &h)) return;
    while (left != h.first && !failed(p)) {
        const bool second = left->count == 2 && holds(left->item[1], h.first);
        tree *right = taken_over(p, left, second, s->value);
        if (!right) {
            COMPLAIN(p, &left->at, "%s stands inside %s: motus solves for it where it is a term or a factor",
                     quote(p, &h.first->at, a), quote(p, &left->at, b));
            HINT(p, "solve the equation for it: %s = …", a);
            return;
        }
        const bool made = right != s->value && right != left->item[0] && right != left->item[left->count - 1];
        if (made) right->at = all; /* its operands stand on both sides of the = */
        s->value = right;
        left = left->item[second];
    }
}
