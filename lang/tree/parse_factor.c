/* Factors: numbers, names, calls, brackets, lists and norms. Each function is headed by its grammar rule; numbers in
 * brackets are the rules of the language as test/language_test.c numbers them. */
#include "lang/tree/parse_parts.h"

/* Parses an expression inside brackets; bars | outside do not pair with bars inside [7]. */
tree *parse_inside(parser *p)
{
    int bars = p->bars;
    p->bars = 0;
    skip_lines(p);
    tree *t = p->expression(p);
    p->bars = bars;
    return t;
}

/* loop = name "=" inside ".." inside */
static bool parse_loop(parser *p, loop *l)
{
    if (p->token.kind != TOKEN_NAME) {
        unexpected(p, "the name of an index");
        HINT(p, "write i = 1..N; values for parts of the time are chosen by if(t < 5, a, b)");
        return false;
    }
    l->at = p->token.at;
    l->name = copy_name(p, &p->token.at);
    if (!strcmp(l->name, "t")) {
        COMPLAIN(p, &l->at, "t is a word of the language and cannot be an index");
        HINT(p, "take i, j, k …; values for parts of the time are chosen by if(t < 5, a, b)");
        return false;
    }
    if (words_reserved(l->name) || words_function(l->name) >= 0) {
        COMPLAIN(p, &l->at, "%s is a word of the language and cannot be an index", l->name);
        HINT(p, "take i, j, k …");
        return false;
    }
    advance(p);
    if (!is(p, '=')) {
        unexpected(p, "= after the index");
        HINT(p, "write %s = 1..N", l->name);
        return false;
    }
    advance(p);
    skip_lines(p);
    l->first = parse_inside(p);
    if (failed(p)) return false;
    if (p->token.kind != TOKEN_DOTS) {
        unexpected(p, ".. between the bounds of the index");
        HINT(p, "write %s = 1..N", l->name);
        return false;
    }
    advance(p);
    skip_lines(p);
    l->last = parse_inside(p);
    l->at.to = p->last.at.to;
    return !failed(p);
}

static void add_loop(parser *p, loop **loops, uint8_t *count, const loop *l)
{
    loop *more = arena_grow(p->arena, *loops, *count * sizeof *more, (*count + 1) * sizeof *more);
    if (!more) return;
    *loops = more;
    more[(*count)++] = *l;
}

/* for = "for" loop { "," loop } */
void parse_for(parser *p, statement *s)
{
    if (!word(p, "for")) return;
    do {
        advance(p);
        skip_lines(p);
        loop l = {0};
        if (s->loop_count == MAX_DIMS) {
            source_complain(p->source, MOTUS_LIMIT, &p->token.at, "at most %d indices", MAX_DIMS);
            return;
        }
        if (!parse_loop(p, &l)) return;
        add_loop(p, &s->loops, &s->loop_count, &l);
    } while (is(p, ',') && !failed(p));
}

/* Returns whether a loop begins here: a name, then "=" (not "=="). */
static bool at_loop(parser *p)
{
    if (p->token.kind != TOKEN_NAME) return false;
    lexer ahead = p->lexer;
    if (source_failed(p->source)) return false;
    token next = lex_next(&ahead);
    return next.kind == TOKEN_CHARACTER && next.character == '=';
}

/* sum = "sum" "(" loop { "," (loop | condition) } ":" body ")" [12] */
static tree *parse_sum(parser *p, span name)
{
    tree *t = grow(p, TREE_SUM, &name);
    do {
        advance(p); /* the bracket or the comma */
        skip_lines(p);
        if (at_loop(p)) {
            loop l = {0};
            if (t->count > 0) {
                COMPLAIN(p, &p->token.at, "in a sum the indices come before the conditions");
                return t;
            }
            if (t->loop_count == MAX_DIMS) {
                source_complain(p->source, MOTUS_LIMIT, &p->token.at, "a sum has at most %d indices", MAX_DIMS);
                return t;
            }
            if (!parse_loop(p, &l)) return t;
            add_loop(p, &t->loops, &t->loop_count, &l);
        } else {
            if (t->loop_count == 0) {
                COMPLAIN(p, &p->token.at, "a sum begins with its index");
                HINT(p, "write sum(j = 1..N: …) or sum(j = 1..N, j != i: …)");
                return t;
            }
            add_item(p, t, parse_inside(p));
        }
        if (failed(p)) return t;
    } while (is(p, ','));
    if (!is(p, ':')) {
        unexpected(p, ": before what is summed");
        HINT(p, "write sum(j = 1..N: …)");
        return t;
    }
    advance(p);
    add_item(p, t, parse_inside(p));
    t->at.to = p->token.at.to;
    expect(p, ')', "at the end of the sum");
    return t;
}

/* items = inside { "," inside } and the closing bracket; the opening one is the present token */
static tree *parse_items(parser *p, tree *t, char close, const char *where)
{
    do {
        advance(p);
        add_item(p, t, parse_inside(p));
        if (failed(p)) return t;
    } while (is(p, ','));
    t->at.to = p->token.at.to;
    expect(p, close, where);
    return t;
}

static int arity(int operation)
{
    if (operation >= OPERATIONS) return operation == CALL_IF ? 3 : 2;
    return operation_is(operation, OF_MANY) ? -2 : operation_at(operation)->arity; /* -2: at least two */
}

static bool of_table(int operation) { return operation == CALL_INTERP || operation == CALL_SPLINE; }

/* Takes the word `hold` from the end of the arguments of a table [19]. */
static void take_hold(tree *t)
{
    const tree *last = t->item[t->count - 1];
    if (last->kind != TREE_NAME || last->primes || last->index_count || strcmp(last->name, "hold")) return;
    t->count--;
    t->primes = 1;
}

/* call = function "(" inside { "," inside } ")" [5] */
static tree *parse_call(parser *p, span name)
{
    const char *text = copy_name(p, &name);
    int operation = words_function(text);
    char argument[80];
    if (failed(p)) return nothing(p);
    if (!is(p, '(')) {
        if (operation == CALL_IF) {
            COMPLAIN(p, &name, "if has its condition and both values in one bracket");
            foreign_choice(p->source, &name);
        } else if (is(p, '^')) {
            lexer ahead = p->lexer;
            token power = lex_next(&ahead);
            COMPLAIN(p, &name, "%s needs its argument in brackets", text);
            HINT(p, "write %s(x)^%s", text, power.kind == TOKEN_NUMBER ? quote(p, &power.at, argument) : "2");
        } else if (arity(operation) == 2 && operation < OPERATIONS) {
            COMPLAIN(p, &name, "%s has its arguments in brackets", text);
            if (operation != OP_MOD) HINT(p, "write %s(a, b)", text); /* a mod b: parse.c */
        } else if (p->token.kind == TOKEN_NAME || p->token.kind == TOKEN_NUMBER) {
            const span at = {p->token.at.text, p->token.at.from, p->token.at.from}, all = foreign_after(p->source, &at);
            COMPLAIN(p, &name, "%s needs its argument in brackets", text);
            HINT(p, "write %s(%s)", text, quote(p, &all, argument));
        } else if (p->token.kind == TOKEN_PRIMES) {
            COMPLAIN(p, &p->token.at, "a function takes no primes");
        } else {
            COMPLAIN(p, &name, "%s is a function and needs its argument in brackets", text);
            HINT(p, "write %s(…)", text);
        }
        return nothing(p);
    }
    if (!strcmp(text, "sum")) return parse_sum(p, name);
    tree *t = grow(p, TREE_CALL, &name);
    t->operation = (int16_t)operation;
    t->name = text;
    parse_items(p, t, ')', "or a comma");
    if (failed(p)) return t;
    if (of_table(operation)) {
        take_hold(t);
        if (t->count == 3 || t->count == 4) return t;
        COMPLAIN(p, &t->at, "%s takes one argument and one table, so three or four things in all, not %u", text,
                 t->count);
        if (t->count > 4) foreign_decimal(p->source, &t->at);
        HINT(p, "write %s(t, T, A) with lists of points and values, or %s(t, t0, dt, A) on a uniform grid", text, text);
        return t;
    }
    int wanted = arity(operation);
    if (wanted < 0 ? t->count < (uint32_t)-wanted : t->count != (uint32_t)wanted) {
        COMPLAIN(p, &t->at, "%s takes %s%d argument%s, not %u", text, wanted < 0 ? "at least " : "",
                 wanted < 0 ? -wanted : wanted, wanted == 1 ? "" : "s", t->count);
        if (operation == CALL_IF && t->count == 1) foreign_choice(p->source, &name);
        if (operation == CALL_IF) HINT(p, "write if(condition, value if true, value if false)");
        foreign_decimal(p->source, &t->at);
        if (!strcmp(text, "atan2")) HINT(p, "write atan2(y, x), the angle of (x, y); or atan(x)");
        if (wanted == 2 && operation < OPERATIONS && operation != OP_MOD) HINT(p, "write %s(a, b)", text);
        if (operation == CALL_DIFF) HINT(p, "write diff(V(x), x): what is differentiated, then by what");
    }
    return t;
}

/* index = "[" inside { "," inside } "]" */
void parse_index(parser *p, tree *t)
{
    parse_items(p, t, ']', "after the index");
    t->index_count = (uint16_t)(t->count < UINT16_MAX ? t->count : UINT16_MAX);
    if (t->index_count > MAX_DIMS) source_complain(p->source, MOTUS_LIMIT, &t->at, "at most %d indices", MAX_DIMS);
}

static tree *component(parser *p, tree *of, tree *number, span at)
{
    tree *t = two(p, TREE_COMPONENT, of, number);
    t->at = (span){of->at.text, of->at.from, at.to};
    return t;
}

/* Hints at np.sin(x) and r'.r', of which the present token follows the point. */
static void hint_product(parser *p, const tree *before)
{
    char a[80], b[80];
    const span after = foreign_after(p->source, &(span){p->token.at.text, p->token.at.from, p->token.at.from});
    quote(p, &before->at, a);
    quote(p, &p->token.at, b);
    if (!strcmp(b, "diff") || ((!strcmp(b, "dot") || !strcmp(b, "ddot")) && after.to == p->token.at.to))
        HINT(p, "derivatives by the time are written with primes: x', x''");
    else if (words_function(b) >= 0)
        HINT(p, "write %s(…), without %s", b, a);
    else if (p->token.kind == TOKEN_NAME)
        HINT(p, "the product of two vectors is written dot(%s, %s)", a, quote(p, &after, b));
}

/* components = { "." ("x" | "y" | "z") | "[" inside "]" } */
static tree *parse_components(parser *p, tree *t)
{
    while (!failed(p) && !p->token.blank) {
        if (is(p, '.')) {
            advance(p);
            int k = word(p, "x") ? 1 : word(p, "y") ? 2 : word(p, "z") ? 3 : 0;
            if (k == 0) {
                char text[80];
                if (p->token.kind == TOKEN_END || p->token.kind == TOKEN_NEWLINE || p->token.blank)
                    COMPLAIN(p, &p->last.at, "a point stands alone here");
                else
                    COMPLAIN(p, &p->token.at, "the components of a vector are .x .y .z or [1], [2] …, not .%s",
                             quote(p, &p->token.at, text));
                hint_product(p, t);
                return t;
            }
            tree *number = grow(p, TREE_NUMBER, &p->token.at);
            number->number = k;
            t = component(p, t, number, p->token.at);
            advance(p);
        } else if (is(p, '[')) {
            advance(p);
            tree *number = parse_inside(p);
            t = component(p, t, number, p->token.at);
            if (!expect(p, ']', "after the number of a component")) return t;
        } else if (p->token.kind == TOKEN_PRIMES) {
            COMPLAIN(p, &p->token.at, "primes follow a name or its index, before the component");
            HINT(p, "write r'.x");
            return t;
        } else {
            break;
        }
    }
    return t;
}

/* Complains about f(), and x(t = 0). */
static bool applied_wrongly(parser *p, const tree *name)
{
    char a[80], b[80];
    lexer ahead = p->lexer;
    const token first = lex_next(&ahead), second = failed(p) ? first : lex_next(&ahead);
    if (failed(p)) return true;
    if (first.kind == TOKEN_CHARACTER && first.character == ')') {
        COMPLAIN(p, &p->token.at, "this bracket is empty");
        HINT(p,
             strncmp(name->name, "rand", 4)
                 ? "a quantity without arguments is written %s"
                 : "a force has no random numbers: it is a function of the state and the time",
             quote(p, &name->at, a));
    } else if (first.kind == TOKEN_NAME && second.kind == TOKEN_CHARACTER && second.character == '=') {
        const token start = lex_next(&ahead);
        COMPLAIN(p, &second.at, "the bracket of an initial value holds the start alone");
        HINT(p, "write %s(%s)", quote(p, &name->at, a), quote(p, &start.at, b));
    }
    return failed(p);
}

/* applied = name "(" inside { "," inside } ")": x(0), V(a, b) [4, 16] */
tree *parse_applied(parser *p, tree *name)
{
    if (applied_wrongly(p, name)) return name;
    tree *t = grow(p, TREE_APPLY, &name->at);
    add_item(p, t, name);
    return parse_items(p, t, ')', "at the end of the bracket");
}

/* name = NAME [ index ] [ primes ] [ applied ] components [4, 6] */
static tree *parse_name(parser *p)
{
    tree *t = grow(p, TREE_NAME, &p->token.at);
    t->name = copy_name(p, &p->token.at);
    p->operations += !p->known[p->name].counted;
    p->known[p->name].counted = true;
    advance(p);
    if (is(p, '[') && !p->token.blank) parse_index(p, t);
    if (failed(p)) return t;
    if (p->token.kind == TOKEN_PRIMES && !p->token.blank) {
        t->primes = (uint8_t)p->token.primes;
        t->at.to = p->token.at.to;
        if (too_many_primes(p)) return t;
        advance(p);
    } else if (p->token.kind == TOKEN_PRIMES) {
        COMPLAIN(p, &p->token.at, "primes stand directly behind the name");
        return t;
    }
    if (is(p, '(') && !p->token.blank) {
        t = parse_applied(p, t);
        if (p->token.kind == TOKEN_PRIMES && !p->token.blank && !failed(p)) {
            COMPLAIN(p, &p->token.at, "primes follow the name, before the bracket");
            HINT(p, "write x'(0)");
        }
    }
    return parse_components(p, t);
}

/* bracket = "(" inside { "," inside } ")" components: a group, or a vector */
static tree *parse_bracket(parser *p)
{
    span at = p->token.at;
    tree *vector = NULL, *t = NULL;
    do {
        advance(p);
        tree *item = parse_inside(p);
        if (failed(p)) return item;
        if (!t) {
            t = item;
        } else {
            if (!vector) {
                vector = grow(p, TREE_VECTOR, &at);
                add_item(p, vector, t);
            }
            add_item(p, vector, item);
        }
    } while (is(p, ','));
    if (vector) t = vector;
    t->at = (span){at.text, at.from, p->token.at.to};
    t->bracketed = true;
    if (!expect(p, ')', "or a comma")) return t;
    if (p->token.kind == TOKEN_PRIMES && !p->token.blank) {
        COMPLAIN(p, &p->token.at, "a prime follows a name, not a bracket");
        HINT(p, "write the derivative out");
        return t;
    }
    return parse_components(p, t);
}

/* list = "[" inside { "," inside } "]" */
static tree *parse_list(parser *p)
{
    return parse_items(p, grow(p, TREE_LIST, &p->token.at), ']', "or a comma, in the list");
}

/* norm = "|" or "|" [7] */
static tree *parse_norm(parser *p)
{
    tree *t = grow(p, TREE_NORM, &p->token.at);
    advance(p);
    p->bars++;
    if (!deeper(p)) return t;
    add_item(p, t, p->expression(p));
    p->depth--;
    p->bars--;
    if (failed(p)) return t;
    t->at.to = p->token.at.to;
    if (!is(p, '|')) {
        COMPLAIN(p, &t->at, "this | is never closed");
        HINT(p, "write |…|, or abs(…)");
        return t;
    }
    advance(p);
    return t;
}

/* factor = NUMBER | name | call | bracket | list | norm */
tree *parse_factor(parser *p)
{
    if (failed(p)) return nothing(p);
    if (p->token.kind == TOKEN_NUMBER) {
        tree *t = grow(p, TREE_NUMBER, &p->token.at);
        t->number = p->token.number;
        advance(p);
        if (p->token.kind == TOKEN_PRIMES && !p->token.blank) {
            char a[80], b[80];
            lexer ahead = p->lexer;
            const token next = lex_next(&ahead);
            COMPLAIN(p, &p->token.at, "a prime follows a name, not a number or a power");
            if (next.kind == TOKEN_NUMBER && !next.blank)
                HINT(p, "a number has no marks for thousands: write %s%s", quote(p, &t->at, a), quote(p, &next.at, b));
            HINT(p, "write the derivative out");
        }
        return t;
    }
    if (p->token.kind == TOKEN_NAME) {
        span at = p->token.at;
        char text[MOTUS_NAME_MAX + 1];
        snprintf(text, sizeof text, "%.*s", (int)(at.to - at.from), p->source->texts[at.text].bytes + at.from);
        if (words_function(text) >= 0 || !strcmp(text, "sum")) {
            advance(p);
            tree *t = parse_call(p, at);
            return failed(p) ? t : parse_components(p, t);
        }
        if (words_reserved(text) && strcmp(text, "t") && strcmp(text, "pi")) {
            if (left_open(p)) return nothing(p);
            COMPLAIN(p, &at, "%s is a word of the language and cannot stand here", text);
            if (!strcmp(text, "for")) HINT(p, "something is missing before it");
            if (!strcmp(text, "not")) HINT(p, "as a number a negation stands in brackets: (not x > 0)");
            return nothing(p);
        }
        return parse_name(p);
    }
    if (is(p, '(')) return parse_bracket(p);
    if (is(p, '[')) return parse_list(p);
    if (is(p, '|')) return parse_norm(p);
    unexpected(p, "a value");
    if (is(p, '.')) HINT(p, "a number needs a digit before the point: 0.5");
    if (is(p, '<')) HINT(p, "a vector stands in round brackets: (1, 2)");
    if (is(p, '/') || is(p, '*')) HINT(p, "a comment begins with #");
    return nothing(p);
}
