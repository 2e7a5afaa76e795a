/* Events: what is to happen when. Each function is headed by its grammar rule.
 *
 * `rising`, `falling`, `as`, `accumulates`, `record`, `stop` and `after` are words only here, where they cannot be
 * factors, so models may use them as names.
 */
#include "lang/tree/parse_parts.h"

static bool ahead_is(const parser *p, const char *text)
{
    lexer ahead = p->lexer;
    const token next = failed(p) ? p->token : lex_next(&ahead);
    return spelled(p, &next, text);
}

bool parse_action(const parser *p, const span *at)
{
    token first = {.kind = TOKEN_NAME, .at = *at};
    for (first.at.to = at->from; first.at.to < at->to && p->source->texts[at->text].bytes[first.at.to] != ' ';)
        first.at.to++;
    return spelled(p, &first, "record") || spelled(p, &first, "stop");
}

/* Returns whether a tree is certainly a condition; a name or a call may be one, too. */
static bool decides(const tree *t)
{
    return t->kind == TREE_COMPARE || t->kind == TREE_AND || t->kind == TREE_OR || t->kind == TREE_NOT;
}

/* Refuses `x = 0 and y > 0`, `x > 0 and y = 0`. */
static void refuse_equals(parser *p, const span *at)
{
    COMPLAIN(p, at, "one = in an event stands between two numbers, not in a condition");
    HINT(p, "in a condition write < or >: `when not up and y < h` happens where y falls through h; "
            "rising and falling do not go with `and`");
}

/* occasion = or "=" or [ "rising" | "falling" ] | or */
static void parse_occasion(parser *p, when *w)
{
    w->kind = WHEN_CONDITION;
    w->left = parse_or(p);
    if (failed(p)) return;
    if (is(p, '=')) {
        const span equals = p->token.at;
        advance(p);
        skip_lines(p);
        if (decides(w->left)) {
            refuse_equals(p, &equals);
            return;
        }
        w->kind = WHEN_EQUAL;
        w->right = parse_or(p);
        if (failed(p)) return;
        if (decides(w->right)) {
            refuse_equals(p, &equals);
            return;
        }
    }
    if (!word(p, "rising") && !word(p, "falling")) return;
    if (w->kind == WHEN_CONDITION) {
        char text[80];
        COMPLAIN(p, &p->token.at, "%s stands behind an equation", quote(p, &p->token.at, text));
        char condition[80];
        if (word(p, "falling"))
            HINT(p, "a condition happens when it becomes true: write when not (%s)", quote(p, &w->left->at, condition));
        HINT(p, "a condition happens when it becomes true; write x = 0 %s for one direction", text);
        return;
    }
    w->direction = word(p, "rising") ? 1 : -1;
    advance(p);
}

/* event = "as" NAME */
static void parse_event_name(parser *p, statement *s)
{
    if (failed(p) || !word(p, "as")) return;
    advance(p);
    if (p->token.kind != TOKEN_NAME) {
        unexpected(p, "the name of the event");
        return;
    }
    s->name_at = p->token.at;
    s->name = copy_name(p, &p->token.at);
    if (words_reserved(s->name) || words_function(s->name) >= 0) {
        COMPLAIN(p, &s->name_at, "%s is a word of the language and cannot name an event", s->name);
        HINT(p, "take another name");
        return;
    }
    advance(p);
    if (!failed(p) && (word(p, "rising") || word(p, "falling"))) {
        char text[80];
        COMPLAIN(p, &p->token.at, "%s stands before `as`", quote(p, &p->token.at, text));
        HINT(p, "write %s as %s", text, s->name);
    }
}

/* assignment = name "=" or */
static void parse_assignment(parser *p, action *a)
{
    a->kind = ACTION_ASSIGN;
    if (p->token.kind != TOKEN_NAME) {
        unexpected(p, "record, stop or an assignment");
        HINT(p, "write what happens: record, stop, x' = -x' …, with commas between them");
        return;
    }
    a->target = parse_factor(p);
    if (failed(p)) return;
    if (!is(p, '=')) {
        if (p->token.kind == TOKEN_EQ) {
            COMPLAIN(p, &p->token.at, "an assignment has one =");
            return;
        }
        unexpected(p, "=");
        if (is(p, ':')) HINT(p, "write one = alone");
        HINT(p, "what happens is record, stop, stop after 10, or an assignment: x' = -x'");
        return;
    }
    advance(p);
    skip_lines(p);
    if (is(p, '=')) {
        COMPLAIN(p, &p->token.at, "one = is enough in an assignment");
        return;
    }
    a->value = parse_or(p);
}

/* Returns whether a word of an action stands here, not an assignment to a variable of this name. */
static bool at_word(const parser *p, const char *text)
{
    if (!word(p, text)) return false;
    lexer ahead = p->lexer;
    const token next = lex_next(&ahead);
    if (next.kind == TOKEN_PRIMES) return false;
    return next.kind != TOKEN_CHARACTER || next.character == ',' || next.character == '-' || next.character == '(';
}

/* action = "record" | "stop" [ "after" or ] | assignment */
static void parse_deed(parser *p, action *a)
{
    a->at = p->token.at;
    if (at_word(p, "record")) {
        a->kind = ACTION_RECORD;
        advance(p);
    } else if (at_word(p, "stop")) {
        a->kind = ACTION_STOP;
        advance(p);
        if (word(p, "after")) {
            advance(p);
            skip_lines(p);
            a->value = parse_or(p);
        }
    } else {
        parse_assignment(p, a);
    }
    a->at.to = p->last.at.to;
}

/* actions = action { "," action } */
static void parse_actions(parser *p, when *w)
{
    action **next = &w->actions;
    if (!is(p, ':')) {
        unexpected(p, ": before what happens");
        if (word(p, "then") || word(p, "do")) HINT(p, "write a colon in its place: when y < 0: y' = -y'");
        if (w->left && parse_action(p, &w->left->at)) HINT(p, "%s", PARSE_COMMAS);
        HINT(p, "write when y = 0: record, or when y = 0 falling as bounce: y' = -y'");
        return;
    }
    do {
        advance(p); /* the colon or the comma */
        skip_lines(p);
        *next = arena_take(p->arena, sizeof **next);
        if (p->arena->failed) return;
        parse_deed(p, *next);
        next = &(*next)->next;
    } while (!failed(p) && is(p, ','));
    if (failed(p) || (!word(p, "record") && !word(p, "stop"))) return;
    char text[80];
    COMPLAIN(p, &p->token.at, "a comma is missing before %s", quote(p, &p->token.at, text));
}

/* when = [ "when" ] ( "every" or | NAME "accumulates" | occasion ) [ event ] ":" actions [ for ] */
void parse_when(parser *p, statement *s)
{
    when *w = arena_take(p->arena, sizeof *w);
    s->kind = STATEMENT_WHEN;
    s->when = w;
    s->name_at = p->token.at;
    p->when = true;
    if (word(p, "when")) advance(p); /* an event that is added to the text may omit the word */
    skip_lines(p);
    if (word(p, "every")) {
        w->kind = WHEN_EVERY;
        advance(p);
        w->left = parse_or(p);
    } else if (p->token.kind == TOKEN_NAME && ahead_is(p, "accumulates")) {
        w->kind = WHEN_ACCUMULATES;
        w->of_at = p->token.at;
        w->of = copy_name(p, &p->token.at);
        advance(p);
        advance(p);
    } else {
        parse_occasion(p, w);
    }
    parse_event_name(p, s);
    if (!failed(p)) parse_actions(p, w);
    if (!failed(p)) parse_for(p, s);
    s->at.to = p->last.at.to;
    s->value_at = s->at;
    p->when = false;
}
