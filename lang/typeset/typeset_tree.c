/* Expressions of a typeset statement.
 *
 * Brackets are written where the meaning needs them, whether or not the text has them: a fraction, a root, bars and
 * raised exponents need none.
 */
#include "lang/typeset/typeset_parts.h"

#include "lang/model/symbols.h"

/* Shapes ----------------------------------------------------------------------------------------------------------- */

/* Returns the name of a function that is written by its name; NULL: it has a notation of its own. */
static const char *function_name(const tree *t)
{
    if (t->kind != TREE_CALL) return NULL;
    switch (t->operation) {
    case OP_SQRT:
    case OP_CBRT:
    case OP_ABS:
    case OP_FLOOR:
    case OP_MOD:
    case CALL_DOT:
    case CALL_CROSS:
    case CALL_IF:
    case CALL_DIFF: return NULL;
    case OP_ASIN: return "arcsin";
    case OP_ACOS: return "arccos";
    case OP_ATAN: return "arctan";
    case OP_LOG: return "ln";
    case OP_SIGN: return "sgn";
    default: return t->name;
    }
}

/* Returns whether a power is written sin²(x); sin⁻¹(x) would be read as the inverse. */
static bool raised_function(const tree *power)
{
    const tree *exponent = power->item[1];
    return function_name(power->item[0]) && power->item[0]->count == 1 && exponent->kind == TREE_NUMBER &&
           exponent->number >= 2 && exponent->number < 100 && exponent->number == (int)exponent->number;
}

/* Returns whether a derivative is written ∂V/∂x, not (∂/∂x) (a + b). */
static bool names_slope(const tree *diff)
{
    head h;
    return typeset_head(diff->item[0], &h);
}

/* Returns whether a < b and b < c was written a < b < c: then b is one tree. */
static bool chained(const tree *t)
{
    if (t->kind != TREE_AND || t->item[1]->kind != TREE_COMPARE) return false;
    const tree *before = t->item[0]->kind == TREE_AND ? t->item[0]->item[1] : t->item[0];
    return before->kind == TREE_COMPARE && before->item[1] == t->item[1]->item[0];
}

static tight tight_of(const typesetter *p, const tree *t, bool small)
{
    switch (t->kind) {
    case TREE_OR: return TIGHT_OR;
    case TREE_AND: return chained(t) ? TIGHT_COMPARE : TIGHT_AND;
    case TREE_NOT: return TIGHT_NOT;
    case TREE_COMPARE: return TIGHT_COMPARE;
    case TREE_ADD:
    case TREE_SUBTRACT: return TIGHT_SUM;
    case TREE_NEGATE: return TIGHT_MINUS;
    case TREE_MULTIPLY: return TIGHT_PRODUCT;
    case TREE_DIVIDE: return small ? TIGHT_SLASH : TIGHT_POWER;
    case TREE_POWER:
    case TREE_SUM: return TIGHT_POWER;
    case TREE_NUMBER: return typeset_has_exponent(&p->model->source, t) ? TIGHT_POWER : TIGHT_ATOM;
    case TREE_CALL:
        return t->operation == OP_MOD                                   ? TIGHT_MOD
               : t->operation == CALL_DOT || t->operation == CALL_CROSS ? TIGHT_DOT
               : t->operation == CALL_DIFF && small && names_slope(t)   ? TIGHT_SLASH
               : t->operation == CALL_DIFF                              ? TIGHT_POWER
               : t->operation == CALL_IF || function_name(t)            ? TIGHT_POWER
                                                                        : TIGHT_ATOM;
    default: return TIGHT_ATOM;
    }
}

/* Returns whether an expression without brackets is one element. */
static bool single(const tree *t, bool small)
{
    switch (t->kind) {
    case TREE_NUMBER:
    case TREE_NAME:
    case TREE_APPLY:
    case TREE_VECTOR:
    case TREE_LIST:
    case TREE_COMPONENT:
    case TREE_NORM: return true;
    case TREE_DIVIDE: return !small;
    case TREE_POWER: return !raised_function(t);
    case TREE_CALL:
        if (t->operation == CALL_DIFF) return !small && names_slope(t);
        return !function_name(t) && t->operation != OP_MOD && t->operation != CALL_DOT && t->operation != CALL_CROSS;
    default: return false;
    }
}

/* Products --------------------------------------------------------------------------------------------------------- */

static bool digit_first(const tree *t)
{
    while (t->kind == TREE_POWER || t->kind == TREE_MULTIPLY || t->kind == TREE_DIVIDE) t = t->item[0];
    return t->kind == TREE_NUMBER;
}

static bool barred(const tree *t) { return t->kind == TREE_NORM || typeset_calls(t, OP_ABS); }

/* Writes the sign of a product. A number after a factor needs a dot; so does a fraction of numbers after a number,
 * which would be read as 2½, and a bracket after a state, which would be read as its value at that time. Words and bars
 * need some space. */
static void times(typesetter *p, const tree *a, const tree *b, place at)
{
    head h;
    const tree *before = a->kind == TREE_MULTIPLY ? a->item[1] : a, *first = b->kind == TREE_POWER ? b->item[0] : b;
    bool brackets = tight_of(p, b, at & PLACE_SMALL) < TIGHT_POWER, state = false, word = function_name(first) != NULL;
    bool dot = !brackets && digit_first(b) && (b->kind != TREE_DIVIDE || before->kind == TREE_NUMBER);
    if (typeset_head(before, &h) && !h.applied) {
        state = symbols_find(p->model, h.name->name).state != NULL;
        word |= typeset_is_word(h.name->name);
    }
    dot |= (brackets && state) || (b->kind == TREE_VECTOR && before->kind != TREE_NUMBER);
    word |=
        !brackets && ((typeset_head(first, &h) && typeset_is_word(h.name->name)) || (barred(before) && barred(first)));
    typeset_sign(p, dot ? "<mo>⋅</mo>" : word ? "<mo>&#x2062;</mo><mspace width=\"0.17em\"/>" : "<mo>&#x2062;</mo>");
}

/* Chains of one operator, which lean left and may be as long as the text
 * -------------------------------------------- */

static int chain_of(tree_kind kind)
{
    switch (kind) {
    case TREE_ADD:
    case TREE_SUBTRACT: return 1;
    case TREE_MULTIPLY: return 2;
    case TREE_AND: return 3;
    case TREE_OR: return 4;
    default: return 0;
    }
}

/* Writes the beginning of a chain that is too long, and an ellipsis. False: it is not too long. */
static bool shortened(typesetter *p, const tree *t, place at)
{
    static const char *const rest[] = {"", "<mo>+</mo><mi>⋯</mi>", "<mi>⋯</mi>",
                                       "<mtext>&#xA0;and&#xA0;</mtext><mi>⋯</mi>",
                                       "<mtext>&#xA0;or&#xA0;</mtext><mi>⋯</mi>"};
    int chain = chain_of(t->kind);
    size_t terms = 0;
    for (const tree *u = t; chain_of(u->kind) == chain; u = u->item[0]) terms++;
    if (terms <= TYPESET_TERMS_MAX) return false;
    for (; terms > TYPESET_TERMS_MAX; terms--) t = t->item[0];
    typeset_then(p, t, (at & ~(uint32_t)PLACE_FOLLOW) | PLACE_CHAIN | FOLLOW_FACTOR);
    typeset_sign(p, rest[chain]);
    return true;
}

static void infix(typesetter *p, const tree *t, place at, tight a, uint32_t follow, const char *sign, tight b)
{
    const tree *right = chained(t) ? t->item[1]->item[1] : t->item[1];
    place of_left = place_left(at, a, follow);
    if (chain_of(t->kind) && chain_of(t->item[0]->kind) == chain_of(t->kind))
        of_left = (of_left | PLACE_CHAIN) - PLACE_LEVEL;
    typeset_then(p, t->item[0], of_left);
    const bool signs = t->kind == TREE_MULTIPLY && t->operation;
    if (sign || signs)
        typeset_sign(p, sign ? sign : t->operation == CALL_CROSS ? "<mo>×</mo>" : "<mo>⋅</mo>");
    else
        times(p, t->item[0], right, at);
    typeset_then(p, right, place_last(at, b));
}

/* Sums, calls, powers, quotients ----------------------------------------------------------------------------------- */

static void sum(typesetter *p, const tree *t, place at)
{
    place in = place_script(at);
    for (uint32_t i = 0; i < t->loop_count; i++) {
        typeset_tag(p, "<munderover><mo>∑</mo><mrow>");
        typeset_range(p, &t->loops[i], NULL, in);
        for (uint32_t k = 0; i + 1 == t->loop_count && k + 1 < t->count; k++) {
            typeset_sign(p, "<mo>,</mo>");
            typeset_then(p, t->item[k], place_inside(in) | TIGHT_AND);
        }
        typeset_tag(p, "</mrow>");
        typeset_then(p, t->loops[i].last, in);
        typeset_tag(p, "</munderover>");
    }
    typeset_then(p, t->item[t->count - 1], place_last(at, TIGHT_DOT));
}

static void function(typesetter *p, const tree *t, const tree *power, place at)
{
    typeset_tag(p, power ? "<msup><mi>" : "<mi>");
    typeset_tag(p, function_name(t));
    typeset_tag(p, "</mi>");
    if (power) {
        typeset_then(p, power, place_script(at));
        typeset_tag(p, "</msup>");
    }
    typeset_tag(p, TYPESET_APPLY);
    typeset_items(p, FENCE_ROUND, t, at);
}

/* Writes a derivative: of something with a name as a fraction, else by an operator before the bracket; in small print
 * in a line. */
static void slope(typesetter *p, const tree *t, place at)
{
    const bool small = at & PLACE_SMALL, named = names_slope(t);
    typeset_tag(p, small ? "" : "<mfrac>");
    typeset_tag(p, named ? "<mrow><mi>∂</mi>" : "<mi>∂</mi>");
    if (named) typeset_then(p, t->item[0], place_element(at));
    typeset_tag(p, named ? "</mrow>" : "");
    typeset_tag(p, small ? "<mo lspace=\"0\" rspace=\"0\">/</mo>" : "");
    typeset_tag(p, "<mrow><mi>∂</mi>");
    typeset_then(p, t->item[1], place_element(at));
    typeset_tag(p, small ? "</mrow>" : "</mrow></mfrac>");
    if (!named) typeset_itself(p, FENCE_ROUND, t->item[0], at);
}

static void call(typesetter *p, const tree *t, place at)
{
    switch (t->operation) {
    case OP_SQRT:
        typeset_tag(p, "<msqrt>");
        typeset_then(p, t->item[0], place_inside(at));
        typeset_tag(p, "</msqrt>");
        return;
    case OP_CBRT:
        typeset_tag(p, "<mroot>");
        typeset_then(p, t->item[0], place_element(at));
        typeset_tag(p, "<mn>3</mn></mroot>");
        return;
    case OP_ABS: typeset_items(p, FENCE_BARS, t, at); return;
    case OP_FLOOR: typeset_items(p, FENCE_FLOOR, t, at); return;
    case OP_MOD:
        infix(p, t, at, TIGHT_PRODUCT, FOLLOW_FACTOR, "<mo lspace=\"0.22em\" rspace=\"0.22em\">mod</mo>",
              TIGHT_PRODUCT);
        return;
    case CALL_DOT: infix(p, t, at, TIGHT_POWER, FOLLOW_FACTOR, "<mo>⋅</mo>", TIGHT_POWER); return;
    case CALL_CROSS: infix(p, t, at, TIGHT_POWER, FOLLOW_FACTOR, "<mo>×</mo>", TIGHT_POWER); return;
    case CALL_IF: typeset_cases(p, t, at); return;
    case CALL_DIFF: slope(p, t, at); return;
    default: function(p, t, NULL, at); return;
    }
}

static void power(typesetter *p, const tree *t, place at)
{
    head h;
    if (typeset_head(t->item[0], &h)) {
        typeset_scripted(p, &h, t->item[1], at);
        return;
    }
    if (raised_function(t)) {
        function(p, t->item[0], t->item[1], at);
        return;
    }
    typeset_tag(p, "<msup>");
    typeset_then(p, t->item[0], place_element(at) | TIGHT_ATOM);
    typeset_then(p, t->item[1], place_script(at));
    typeset_tag(p, "</msup>");
}

static void quotient(typesetter *p, const tree *t, place at)
{
    if (at & PLACE_SMALL) {
        infix(p, t, at, TIGHT_SLASH, FOLLOW_FACTOR, "<mo lspace=\"0\" rspace=\"0\">/</mo>", TIGHT_POWER);
        return;
    }
    typeset_tag(p, "<mfrac>");
    typeset_then(p, t->item[0], place_element(at));
    typeset_then(p, t->item[1], place_element(at));
    typeset_tag(p, "</mfrac>");
}

static void unbracketed(typesetter *p, const tree *t, place at)
{
    static const char *const relations[] = {"<mo>&lt;</mo>", "<mo>≤</mo>", "<mo>&gt;</mo>",
                                            "<mo>≥</mo>",    "<mo>=</mo>", "<mo>≠</mo>"};
    head h;
    if (chain_of(t->kind) && !(at & PLACE_CHAIN) && shortened(p, t, at)) return;
    switch (t->kind) {
    case TREE_NUMBER: typeset_number(p, t); return;
    case TREE_NAME:
    case TREE_APPLY:
    case TREE_COMPONENT:
        if (typeset_head(t, &h))
            typeset_scripted(p, &h, NULL, at);
        else
            typeset_component(p, t, at);
        return;
    case TREE_CALL: call(p, t, at); return;
    case TREE_NEGATE:
        typeset_sign(p, "<mo form=\"prefix\">−</mo>");
        typeset_then(p, t->item[0], place_last(at, TIGHT_DOT));
        return;
    case TREE_ADD: infix(p, t, at, TIGHT_SUM, FOLLOW_TERM, "<mo>+</mo>", TIGHT_DOT); return;
    case TREE_SUBTRACT: infix(p, t, at, TIGHT_SUM, FOLLOW_TERM, "<mo>−</mo>", TIGHT_DOT); return;
    case TREE_MULTIPLY: infix(p, t, at, TIGHT_PRODUCT, FOLLOW_FACTOR, NULL, TIGHT_POWER); return;
    case TREE_DIVIDE: quotient(p, t, at); return;
    case TREE_POWER: power(p, t, at); return;
    case TREE_COMPARE: infix(p, t, at, TIGHT_MOD, FOLLOW_TERM, relations[t->operation - OP_LT], TIGHT_MOD); return;
    case TREE_AND:
        if (chained(t)) {
            infix(p, t, at, TIGHT_COMPARE, FOLLOW_TERM, relations[t->item[1]->operation - OP_LT], TIGHT_MOD);
            return;
        }
        infix(p, t, at, TIGHT_AND, FOLLOW_TERM, "<mtext>&#xA0;and&#xA0;</mtext>", TIGHT_NOT);
        return;
    case TREE_OR: infix(p, t, at, TIGHT_OR, FOLLOW_TERM, "<mtext>&#xA0;or&#xA0;</mtext>", TIGHT_AND); return;
    case TREE_NOT:
        typeset_sign(p, "<mtext>not&#xA0;</mtext>");
        typeset_then(p, t->item[0], place_last(at, TIGHT_NOT));
        return;
    case TREE_VECTOR: typeset_items(p, FENCE_ROUND, t, at); return;
    case TREE_LIST: typeset_items(p, FENCE_SQUARE, t, at); return;
    case TREE_NORM: typeset_items(p, FENCE_BARS, t, at); return;
    case TREE_SUM: sum(p, t, at); return;
    }
}

void typeset_tree(typesetter *p, const tree *t, place at)
{
    bool deep = at / PLACE_LEVEL > TYPESET_LEVELS_MAX, ends = !p->full && p->length > TYPESET_BYTES_MAX;
    if (p->full || deep || ends) {
        typeset_put(p, !p->full ? "<mi>…</mi>" : at & PLACE_ELEMENT ? "<mrow></mrow>" : "");
        p->full |= ends;
        return;
    }
    uint32_t follow = at & PLACE_FOLLOW;
    bool swallows =
        (t->kind == TREE_SUM && follow == FOLLOW_FACTOR) || (typeset_calls(t, CALL_IF) && follow != FOLLOW_NOTHING);
    if (tight_of(p, t, at & PLACE_SMALL) < (at & PLACE_TIGHT) || swallows) {
        typeset_itself(p, FENCE_ROUND, t, at);
    } else if (at & PLACE_ELEMENT && !single(t, at & PLACE_SMALL)) {
        typeset_tag(p, "<mrow>");
        typeset_then(p, t, at & ~(uint32_t)PLACE_ELEMENT);
        typeset_tag(p, "</mrow>");
    } else {
        unbracketed(p, t, at);
    }
}
