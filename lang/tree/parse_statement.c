/* Statements: a statement ends with its line, or at a semicolon. Each function is headed by its grammar rule; parse.c
 * has the expressions. */
#include "lang/tree/parse_parts.h"

#include "base/utf8.h"

/* Parses the end of a statement, which began in `line`. */
static void parse_end(parser *p, int line)
{
    if (failed(p) || p->token.kind == TOKEN_NEWLINE || p->token.kind == TOKEN_END) return;
    char text[80], before[80];
    if (is(p, ',')) {
        lexer ahead = p->lexer;
        token next = lex_next(&ahead);
        COMPLAIN(p, &p->token.at, "the statement ends before this comma");
        if (next.kind == TOKEN_NUMBER && p->last.kind == TOKEN_NUMBER)
            HINT(p, "a decimal number is written with a point: %s.%s; a vector in brackets: (%s, %s)",
                 quote(p, &p->last.at, before), quote(p, &next.at, text), before, text);
        if (next.kind == TOKEN_NAME || next.kind == TOKEN_NEWLINE || next.kind == TOKEN_END)
            HINT(p, "one statement a line, or ; between them, not a comma");
        HINT(p, "a vector stands in brackets: (1, 2)");
        return;
    }
    if (is(p, '.')) {
        COMPLAIN(p, &p->token.at, "a point alone is no sign");
        HINT(p, "a product is written a b or a*b, the product of two vectors dot(a, b)");
        return;
    }
    if (is(p, '=')) {
        COMPLAIN(p, &p->token.at, "a second = in one statement");
        if (line != source_line(p->source, &p->token.at))
            HINT(p, "the statement of line %d goes on here: its line ends with an operator, a comma or =", line);
        if (spelled(p, &p->last, "t")) HINT(p, "an initial value is written x(0) = 1");
        HINT(p, "one statement a line, or ; between them; to compare write ==");
        return;
    }
    COMPLAIN(p, &p->token.at, "the statement should end here, but there is %s", quote(p, &p->token.at, text));
    if (p->token.kind == TOKEN_NAME) HINT(p, "one statement a line, or ; between them");
    if (p->token.kind == TOKEN_DOTS || is(p, ':'))
        HINT(p, "numbers in a row are a list, T[i] = i for i = 1..10; a run has two lines, from 0 and until 10");
}

static void parse_value(parser *p, statement *s)
{
    if (!is(p, '=')) {
        unexpected(p, "=");
        if (p->last.kind == TOKEN_CHARACTER) HINT(p, "write = alone");
        return;
    }
    advance(p);
    skip_lines(p);
    if (is(p, '=')) {
        COMPLAIN(p, &p->token.at, "one = is enough in a statement");
        return;
    }
    const span first = p->token.at;
    s->value = parse_or(p);
    s->value_at = (span){first.text, first.from, p->last.at.to};
    parse_for(p, s);
    parse_end(p, source_line(p->source, &s->at));
}

/* Refuses x'' = -x + x > 0, which is 1 where -x + x > 0, and may be meant as -x + (x > 0). */
static void refuse_condition(parser *p, const statement *s)
{
    const tree *first = s->value;
    while ((first->kind == TREE_AND || first->kind == TREE_OR) && !first->bracketed) first = first->item[0];
    if (first->kind != TREE_COMPARE || first->bracketed || first->item[0]->bracketed) return;
    const tree_kind compared = first->item[0]->kind;
    if (compared != TREE_ADD && compared != TREE_SUBTRACT && compared != TREE_MULTIPLY && compared != TREE_NEGATE)
        return;
    char all[80];
    COMPLAIN(p, &s->value_at, "this can be read in two ways: as a condition, 1 or 0, or as a term with one");
    HINT(p, "write (%s), or put the brackets around the condition alone", quote(p, &s->value_at, all));
}

/* Returns whether a terminal can show a text: it is UTF-8 without control characters. */
static bool plain_text(const char *bytes, uint32_t length)
{
    uint32_t c = 0;
    for (size_t i = 0, n; i < length; i += n) {
        n = utf8_read(bytes + i, length - i, &c);
        if (n == 0 || c < 0x20 || (c >= 0x7F && c < 0xA0)) return false;
    }
    return true;
}

/* method = "method" text, up to the end of the line or a semicolon: names have dashes, and arguments in brackets */
static void parse_method(parser *p, statement *s)
{
    const struct source_text *text = &p->source->texts[p->lexer.text];
    uint32_t from = p->last.at.to, to = from;
    while (to < text->length && !strchr("\n#;", text->bytes[to])) to++;
    uint32_t end = to;
    while (from < end && (text->bytes[from] == ' ' || text->bytes[from] == '\t')) from++;
    while (end > from && (text->bytes[end - 1] == ' ' || text->bytes[end - 1] == '\t' || text->bytes[end - 1] == '\r'))
        end--;
    s->at = (span){p->lexer.text, from, end};
    const bool equals = from < end && text->bytes[from] == '=';
    if (from == end || equals || !plain_text(text->bytes + from, end - from)) {
        COMPLAIN(p, &s->at, "the name of a method expected");
        while (equals && from < end && strchr("= ", text->bytes[from])) from++;
        char name[80];
        if (equals && from < end) HINT(p, "write: method %s", quote(p, &(span){s->at.text, from, end}, name));
        HINT(p, "write: method verlet");
        return;
    }
    if (end - from >= MOTUS_NAME_MAX) {
        source_complain(p->source, MOTUS_LIMIT, &s->at, "the name of a method has at most %d bytes",
                        MOTUS_NAME_MAX - 1);
        return;
    }
    s->text = arena_text(p->source->arena, text->bytes + from, end - from);
    p->lexer.at = to;
    p->lexer.depth = 0;
    advance(p);
}

/* setting = ("step" | "from" | "until") or | "every" or [ "steps" ] |
 *           ("tolerance" | "accuracy") or [ "absolute" | "relative" ] */
static void parse_setting(parser *p, statement *s)
{
    if (is(p, '=')) {
        char text[80], number[80];
        lexer ahead = p->lexer;
        const token next = lex_next(&ahead);
        COMPLAIN(p, &p->token.at, "a setting is written without =");
        HINT(p, "write: %s %s", quote(p, &p->last.at, text),
             next.kind == TOKEN_NUMBER ? quote(p, &next.at, number) : "0.01");
        return;
    }
    p->error = s->kind == STATEMENT_TOLERANCE || s->kind == STATEMENT_ACCURACY;
    s->value = parse_or(p);
    if (s->kind == STATEMENT_EVERY && !failed(p) && (word(p, "steps") || word(p, "step"))) {
        s->steps = true;
        advance(p);
    }
    if (p->error && !failed(p) && (word(p, "absolute") || word(p, "relative"))) {
        s->absolute = word(p, "absolute");
        advance(p);
    }
    p->error = false;
    parse_end(p, source_line(p->source, &s->at));
}

/* Complains about other ways to write a derivative: dx/dt, d2x/dt2 … */
static bool parse_leibniz(parser *p, const statement *s)
{
    static const char *const words[] = {"der", "ddt", "deriv", "derivative", "Derivative"};
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (!strcmp(s->name, words[i]) && is(p, '(')) {
            COMPLAIN(p, &s->at, "%s(…) is not read", s->name);
            return foreign_line(p->source, &s->name_at);
        }
    if (s->name[0] != 'd' || !(is(p, '/') || is(p, '^'))) return false;
    const struct source_text *text = &p->source->texts[s->at.text];
    uint32_t end = s->name_at.from;
    while (end < text->length && text->bytes[end] != '=' && text->bytes[end] != '\n') end++;
    bool second = false;
    for (uint32_t i = s->name_at.from; i < end; i++) second |= text->bytes[i] == '2';
    const char *x = s->name + 1;
    while (*x == '2' || *x == '^') x++;
    if (!*x) x = "x";
    COMPLAIN(p, (&(span){s->at.text, s->name_at.from, end}), "derivatives are written with primes");
    HINT(p, "write %s%s = …", x, second ? "''" : "'");
    return true;
}

/* left = name [ index ] [ primes ] [ "(" or ")" ] */
static void parse_left(parser *p, statement *s)
{
    if (p->token.kind != TOKEN_NAME && parse_sum_left(p, s)) return;
    if (p->token.kind != TOKEN_NAME) {
        lexer ahead = p->lexer;
        token next = is(p, '/') ? lex_next(&ahead) : p->token;
        bool slashes = is(p, '/') && next.kind == TOKEN_CHARACTER && (next.character == '/' || next.character == '*');
        unexpected(p, "a statement");
        if (slashes) HINT(p, "a comment begins with #");
        if (is(p, '+') || is(p, '-') || is(p, '*') || is(p, '/'))
            HINT(p, "a line goes on in the next where it ends with an operator, or inside a bracket");
        if (p->token.kind == TOKEN_PRIMES) HINT(p, "a comment begins with #");
        if (p->token.kind == TOKEN_NUMBER || is(p, '('))
            HINT(p, "a statement begins with a name: x'' = …, k = 2, x(0) = 1");
        return;
    }
    tree name = {.at = p->token.at};
    s->name_at = p->token.at;
    s->name = copy_name(p, &p->token.at);
    const bool reserved = words_reserved(s->name) && strcmp(s->name, "t"); /* collect.c knows whether t is the time */
    if (reserved || words_function(s->name) >= 0) {
        if (words_function(s->name) >= 0 && strcmp(s->name, "if") && parse_sum_left(p, s)) return;
        COMPLAIN(p, &s->name_at, "%s is a word of the language and cannot be defined", s->name);
        if (!strcmp(s->name, "diff")) foreign_line(p->source, &s->name_at);
        if (!strcmp(s->name, "for"))
            HINT(p, "a range stands behind a line: x[i](0) = 0 for i = 1..N; the end of a run is written: until 10");
        if (!strcmp(s->name, "if"))
            HINT(p, "for an event write when y < 0: y' = -y'; for a value with two cases if(y < 0, a, b)");
        HINT(p, "take another name");
        return;
    }
    advance(p);
    if (parse_leibniz(p, s)) return;
    if (is(p, '[') && !p->token.blank) {
        parse_index(p, &name);
        s->index = name.item;
        s->index_count = name.index_count;
    }
    if (failed(p)) return;
    if (p->token.kind == TOKEN_PRIMES) {
        s->primes = (uint8_t)p->token.primes;
        if (too_many_primes(p)) return;
        advance(p);
    }
    s->kind = s->primes ? STATEMENT_EQUATION : STATEMENT_DEFINITION;
    if (is(p, '(') && !(p->token.blank && s->primes == 2)) {
        if (p->token.blank) {
            COMPLAIN(p, &p->token.at, "the bracket of an initial value stands directly behind the name");
            foreign_line(p->source, &s->name_at);
            HINT(p, "write %s%s(0) = …", s->name, s->primes == 1 ? "'" : "");
            return;
        }
        tree *left = grow(p, TREE_NAME, &s->name_at);
        left->name = s->name;
        left->primes = s->primes;
        left->item = s->index;
        left->count = left->index_count = s->index_count;
        s->applied = parse_applied(p, left);
        if (failed(p)) return;
        const tree *start = s->applied->item[1];
        if (s->primes && start->kind == TREE_NAME && !strcmp(start->name, "t")) {
            COMPLAIN(p, &start->at, "a derivative has no argument");
            HINT(p, "write %s%s = …; the argument (t) is left out", s->name, s->primes == 1 ? "'" : "''");
            return;
        }
        s->kind = STATEMENT_START;
        if (p->token.kind == TOKEN_PRIMES) {
            COMPLAIN(p, &p->token.at, "primes follow the name, before the bracket");
            if (s->applied->item[1]->kind == TREE_NAME)
                HINT(p, "write %s%s = …; the argument (t) is left out", s->name, p->token.primes == 1 ? "'" : "''");
            else
                HINT(p, "write %s'(0) = …", s->name);
            return;
        }
        if (s->primes == 2) {
            COMPLAIN(p, &s->at, "%s'' at the start follows from the equation and cannot be given", s->name);
            return;
        }
    }
    s->at.to = p->last.at.to;
    if (is(p, '=')) return;
    if (parse_action(p, &s->name_at)) {
        unexpected(p, "=");
        HINT(p, "%s", PARSE_COMMAS);
    } else if (is(p, '.')) {
        COMPLAIN(p, &p->token.at, "a component cannot be given alone");
        HINT(p, "give the whole vector: %s = (…, …)", s->name);
    } else if (s->primes && is(p, '[')) {
        const char *const primes = s->primes == 1 ? "'" : "''";
        lexer ahead = p->lexer;
        const token inside = lex_next(&ahead);
        COMPLAIN(p, &p->token.at, "an index stands before the primes, and an initial value has its start in ( )");
        if (spelled(p, &inside, "t"))
            HINT(p, "write %s%s without an argument, and one = in an equation", s->name, primes);
        HINT(p, "write %s%s(0) = …", s->name, primes);
    } else if (p->token.kind == TOKEN_EQ || !parse_sum_left(p, s)) {
        char near[80];
        lexer ahead = p->lexer;
        const token next = failed(p) || !is(p, '*') ? p->token : lex_next(&ahead);
        unexpected(p, "=");
        if (p->token.kind == TOKEN_EQ || is(p, ':')) HINT(p, "write one = alone");
        if (foreign_line(p->source, &s->name_at) ||
            (next.kind == TOKEN_NAME && strcmp(s->name, "stop") && foreign_line(p->source, &next.at)))
            return;
        if ((p->token.kind == TOKEN_NUMBER || p->token.kind == TOKEN_NAME) &&
            words_nearest_statement(s->name, near, sizeof near))
            HINT(p, "did you mean %s?", near);
        if (is(p, '*') || is(p, '/') || is(p, '+') || is(p, '-') || is(p, '^') || p->token.kind == TOKEN_NAME)
            HINT(p, "a left side is one name, or it has a derivative: k = 2, m x'' = F");
    }
}

/* Returns whether a line names the time; `time` may be a name, too. */
static bool at_time(const parser *p)
{
    if (!word(p, "time")) return false;
    lexer ahead = p->lexer;
    return lex_next(&ahead).kind == TOKEN_NAME && lex_next(&ahead).kind != TOKEN_PRIMES;
}

/* time = "time" NAME */
static void parse_time(parser *p, statement *s)
{
    s->kind = STATEMENT_TIME;
    advance(p);
    s->name_at = p->token.at;
    s->name = copy_name(p, &p->token.at);
    const bool reserved = words_reserved(s->name) && strcmp(s->name, "t");
    if (reserved || words_function(s->name) >= 0) {
        COMPLAIN(p, &s->name_at, "%s is a word of the language and cannot name the time", s->name);
        HINT(p, "take another name: time tau");
        return;
    }
    advance(p);
    s->at.to = p->last.at.to;
    parse_end(p, source_line(p->source, &s->at));
}

static void parse_statement(parser *p, statement *s)
{
    s->at = p->token.at;
    if (p->source->texts[p->lexer.text].event || word(p, "when")) {
        parse_when(p, s);
        parse_end(p, source_line(p->source, &s->at));
        return;
    }
    static const struct {
        const char *word;
        statement_kind kind;
    } settings[] = {{"step", STATEMENT_STEP}, {"tolerance", STATEMENT_TOLERANCE}, {"accuracy", STATEMENT_ACCURACY},
                    {"from", STATEMENT_FROM}, {"until", STATEMENT_UNTIL},         {"every", STATEMENT_EVERY}};
    for (size_t i = 0; i < sizeof settings / sizeof *settings; i++)
        if (word(p, settings[i].word)) {
            s->kind = settings[i].kind;
            s->name = settings[i].word;
            advance(p);
            parse_setting(p, s);
            return;
        }
    if (at_time(p)) {
        parse_time(p, s);
        return;
    }
    if (word(p, "method")) {
        s->kind = STATEMENT_METHOD;
        s->name = "method";
        p->last = p->token;
        parse_method(p, s);
        return;
    }
    bool exact = word(p, "exact"), invariant = word(p, "invariant");
    if (exact || invariant) advance(p);
    parse_left(p, s);
    if (failed(p)) return;
    if (exact || invariant) {
        const char *what = exact ? "exact" : "invariant";
        if (s->kind != STATEMENT_DEFINITION) {
            COMPLAIN(p, &s->at, "after %s only a name may stand before the =", what);
            if (exact) HINT(p, "write: exact %s = …; its velocity is its derivative", s->name);
            return;
        }
        s->kind = exact ? STATEMENT_EXACT : STATEMENT_INVARIANT;
    }
    parse_value(p, s);
    if (s->kind == STATEMENT_EQUATION && !failed(p)) refuse_condition(p, s);
    if (s->kind == STATEMENT_EQUATION && s->applied && !failed(p)) parse_solve(p, s);
}

/* Estimates the number of statements: one for each = that stands alone. */
static uint32_t statements_ahead(const struct source_text *t)
{
    uint32_t count = 1;
    bool comment = false;
    for (uint32_t i = 0; i < t->length && count < SOURCE_STATEMENTS_MAX; i++) {
        const char c = t->bytes[i];
        comment = c == '#' || (comment && c != '\n');
        count += !comment && c == '=' && i > 0 && !strchr("=<>!", t->bytes[i - 1]);
    }
    return count;
}

bool parse_text(source *s, uint32_t text, statements *all)
{
    parser p = {.source = s, .arena = s->trees, .expression = parse_or};
    lex_start(&p.lexer, s, text);
    advance(&p);
    for (;;) {
        while (p.token.kind == TOKEN_NEWLINE) advance(&p);
        if (failed(&p) || p.token.kind == TOKEN_END) return !failed(&p);
        if (all->count == SOURCE_STATEMENTS_MAX) {
            source_complain(s, MOTUS_LIMIT, &p.token.at, "more than %d statements", SOURCE_STATEMENTS_MAX);
            return false;
        }
        if (all->count == all->capacity) {
            const uint32_t room =
                all->capacity ? all->capacity + all->capacity / 2 + 32 : statements_ahead(&s->texts[text]);
            statement *more = arena_replace(s->arena, all->item, all->capacity * sizeof *more, room * sizeof *more);
            if (!more) return false;
            all->item = more;
            all->capacity = room;
        }
        statement *one = &all->item[all->count];
        *one = (statement){0};
        parse_statement(&p, one);
        if (failed(&p)) return false;
        all->count++;
        all->operations = p.operations;
        if (p.token.kind != TOKEN_NEWLINE && p.token.kind != TOKEN_END) {
            unexpected(&p, "the end of the line");
            return false;
        }
    }
}

bool parse_again(const source *s, const statement *of, arena *a, statement *out)
{
    source silent = *s; /* the text has been read without an error */
    silent.error = NULL;
    silent.failed = false;
    silent.arena = silent.trees = a;
    parser p = {.source = &silent, .arena = a, .expression = parse_or};
    lex_start(&p.lexer, &silent, of->at.text);
    p.lexer.at = of->at.from;
    advance(&p);
    *out = (statement){0};
    parse_statement(&p, out);
    out->kind = of->kind;
    return !failed(&p);
}
