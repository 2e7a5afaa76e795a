/* Characters to tokens. See lex.h. */
#include "lang/text/lex.h"

#include "base/utf8.h"
#include "lang/text/foreign.h"

#include <math.h>
#include <string.h>

void lex_start(lexer *l, source *s, uint32_t text)
{
    *l = (lexer){.source = s, .text = text};
    const struct source_text *t = &s->texts[text];
    if (t->length >= 3 && memcmp(t->bytes, "\xEF\xBB\xBF", 3) == 0) l->at = 3; /* a byte order mark */
}

/* Returns the character at `at`; its size is 0 where the bytes are not UTF-8. */
static uint32_t decode(const char *bytes, uint32_t length, uint32_t at, uint32_t *size)
{
    uint32_t c = 0;
    *size = (uint32_t)utf8_read(bytes + at, length - at, &c);
    return c;
}

/* Returns whether c is a letter. Outside ASCII all is one but signs, blanks, punctuation, private and control
 * characters. */
static bool letter(uint32_t c)
{
    static const uint32_t not_letters[][2] = {
        {0x80, 0xA9},     {0xAB, 0xB4},     {0xB6, 0xB9},     {0xBB, 0xBF},       {0xD7, 0xD7},
        {0xF7, 0xF7},     {0x300, 0x36F},   {0x37E, 0x37E},   {0x387, 0x387},     {0x1680, 0x1680},
        {0x180E, 0x180E}, {0x2000, 0x20FF}, {0x2190, 0x2BFF}, {0x2E00, 0x2E7F},   {0x3000, 0x3004},
        {0x3008, 0x3020}, {0x3030, 0x3030}, {0xE000, 0xF8FF}, {0xFE00, 0xFE6F},   {0xFEFF, 0xFF20},
        {0xFF3B, 0xFF40}, {0xFF5B, 0xFF65}, {0xFFE0, 0xFFFF}, {0x1F000, 0x1FAFF}, {0xE0000, 0x10FFFF}};
    if (c < 0x80) return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
    for (size_t i = 0; i < sizeof not_letters / sizeof *not_letters; i++)
        if (c >= not_letters[i][0] && c <= not_letters[i][1]) return false;
    return true;
}

/* Returns whether c may follow the first letter: letters, digits, subscripts (x₁) and combining marks (ẋ as x +
 * dot). */
static bool name_part(uint32_t c)
{
    return letter(c) || (c >= '0' && c <= '9') || (c >= 0x2080 && c <= 0x209C) || (c >= 0x300 && c <= 0x36F);
}

static bool digit(const char *bytes, uint32_t length, uint32_t at)
{
    return at < length && bytes[at] >= '0' && bytes[at] <= '9';
}

static token make(lexer *l, token_kind kind, uint32_t from, bool blank)
{
    return (token){.kind = kind, .blank = blank, .at = {l->text, from, l->at}};
}

static token stop(lexer *l, uint32_t from)
{
    l->at = l->source->texts[l->text].length;
    return (token){.kind = TOKEN_END, .blank = true, .at = {l->text, from, from}};
}

static token lex_number(lexer *l, bool blank)
{
    const char *b = l->source->texts[l->text].bytes;
    uint32_t n = l->source->texts[l->text].length, from = l->at;
    while (digit(b, n, l->at)) l->at++;
    if (l->at < n && b[l->at] == '.' && !(l->at + 1 < n && b[l->at + 1] == '.')) {
        if (!digit(b, n, l->at + 1)) {
            span at = {l->text, from, l->at + 1};
            source_complain(l->source, MOTUS_SYNTAX, &at, "a number cannot end with a point");
            source_hint(l->source, "write %.*s or %.*s.0", (int)(l->at - from), b + from, (int)(l->at - from),
                        b + from);
            return stop(l, from);
        }
        l->at++;
        while (digit(b, n, l->at)) l->at++;
    }
    if (l->at < n && (b[l->at] == 'e' || b[l->at] == 'E')) {
        uint32_t e = l->at + 1;
        if (e < n && (b[e] == '+' || b[e] == '-')) e++;
        if (digit(b, n, e)) {
            while (digit(b, n, e)) e++;
            l->at = e;
        }
    }
    token t = make(l, TOKEN_NUMBER, from, blank);
    if (l->at < n && b[l->at] == '.' && digit(b, n, l->at + 1)) {
        t.at.to++;
        source_complain(l->source, MOTUS_SYNTAX, &t.at, "a number has one decimal point");
        return stop(l, from);
    }
    double other, rest;
    decimal_read_between(b + from, l->at - from, &t.number, &other, &rest);
    if (l->source->nudged) t.number = other;
    if (!isfinite(t.number)) {
        source_complain(l->source, MOTUS_LIMIT, &t.at, "this number is beyond the range of a double (1.8e308)");
        return stop(l, from);
    }
    return t;
}

static token lex_name(lexer *l, bool blank)
{
    const char *b = l->source->texts[l->text].bytes;
    uint32_t n = l->source->texts[l->text].length, from = l->at, size, c;
    while (l->at < n && (c = decode(b, n, l->at, &size), size > 0) && name_part(c)) l->at += size;
    token t = make(l, TOKEN_NAME, from, blank);
    if (l->at - from >= MOTUS_NAME_MAX) {
        source_complain(l->source, MOTUS_LIMIT, &t.at, "a name has at most %d bytes", MOTUS_NAME_MAX - 1);
        return stop(l, from);
    }
    return t;
}

static int prime_of(uint32_t c)
{
    return c == '\'' || c == 0x2032 || c == 0x2019 ? 1 : c == 0x2033 || c == '"' ? 2 : c == 0x2034 ? 3 : 0;
}

static token lex_primes(lexer *l, bool blank)
{
    const char *b = l->source->texts[l->text].bytes;
    uint32_t n = l->source->texts[l->text].length, from = l->at, size, c;
    int primes = 0;
    while (l->at < n && (c = decode(b, n, l->at, &size), size > 0) && prime_of(c) && primes < 100) {
        primes += prime_of(c);
        l->at += size;
    }
    token t = make(l, TOKEN_PRIMES, from, blank);
    t.primes = primes;
    return t;
}

/* Matches brackets, since line ends inside them are blanks. */
static bool bracket(lexer *l, char c, uint32_t from)
{
    span at = {l->text, from, from + 1};
    if (c == '(' || c == '[') {
        if (l->depth == SOURCE_NESTING_MAX) {
            source_complain(l->source, MOTUS_LIMIT, &at, "brackets are nested more than %d deep", SOURCE_NESTING_MAX);
            return false;
        }
        l->opened[l->depth] = from;
        l->closer[l->depth++] = c == '(' ? ')' : ']';
    } else if (c == ')' || c == ']') {
        if (l->depth == 0) {
            source_complain(l->source, MOTUS_SYNTAX, &at, "this %c has no opening bracket", c);
            source_hint(l->source, "remove it, or open it with %c before", c == ')' ? '(' : '[');
            return false;
        }
        if (l->closer[--l->depth] != c) {
            span open = {l->text, l->opened[l->depth], l->opened[l->depth] + 1};
            source_complain(l->source, MOTUS_SYNTAX, &at, "%c expected here, for the %c in line %d, but there is %c",
                            l->closer[l->depth], l->closer[l->depth] == ')' ? '(' : '[', source_line(l->source, &open),
                            c);
            return false;
        }
    }
    return true;
}

static token wrong_character(lexer *l, uint32_t from, uint32_t c, uint32_t size)
{
    static const char raised[] = "raised characters are not read as powers", powers[] = "write ^2, ^3 …",
                      sign[] = "this sign is not an operator here";
    static const struct {
        uint32_t first, last;
        const char *what, *hint;
    } known[] = {
        {0xB2, 0xB3, raised, powers},
        {0xB9, 0xB9, raised, powers},
        {0x2070, 0x207F, raised, powers},
        {0xF7, 0xF7, sign, "divide with /"},
        {0x221A, 0x221A, sign, "write sqrt(…)"},
        {0x2211, 0x2211, sign, "write sum(i = 1..N: …)"},
        {';', ';', "; ends a statement, and here a bracket is open",
         "close the bracket; a comma stands between components, arguments and conditions"},
        {0xBC, 0xBE, "a fraction in one sign is not read", "write 1/2, 1/4, 3/4"},
        {0xB1, 0xB1, "this sign is not an operator here", "write + or -"},
        {0x2010, 0x2015, "a dash is not a minus", "write -"},
        {'{', '{', "there are no braces in the language",
         "group with ( ); a vector is (1, 2), a list [1, 2], a choice if(condition, a, b); what an event does stands "
         "behind "
         "a colon"},
        {'}', '}', "there are no braces in the language", "group with ( )"},
        {'&', '&', "there is no & in the language", "write: and"},
        {'!', '!', "! alone means nothing", "write != for unequal, not for the logical not; a comment begins with #"},
        {0xB0, 0xB0, "angles are in radians", "write 30 pi/180 for 30 degrees"},
        {'\\', '\\', "the character \\ has no meaning here", "write Greek letters as they are, ω, or by name, omega"},
        {'?', '?', "the character ? has no meaning here", "write if(condition, a, b)"},
        {'$', '$', "the character $ has no meaning here", "write formulas in plain text: x'' = -x"},
        {'@', '@', "the character @ has no meaning here", "a function is written f(t, x) = …"},
        {'~', '~', "the character ~ has no meaning here", "write: not"},
        {0x2202, 0x2202, "the character ∂ has no meaning here", "write diff(U(x), x), where U(x) = … is a function"},
        {0x2207, 0x2207, "the character ∇ has no meaning here", "write diff(U(r), r), where U(r) = … is a function"},
        {0x222B, 0x222B, "the character ∫ has no meaning here", "an integral is a first-order variable: s' = …"},
        {'%', '%', "the character % has no meaning here", "a comment begins with #; a remainder is mod(a, b)"}};
    source *s = l->source;
    const span at = {l->text, from, from + (size ? size : 1)};
    const char next = from + size < s->texts[l->text].length ? s->texts[l->text].bytes[from + size] : 0;
    if (c == 0xB0 && (next == 'C' || next == 'F')) {
        source_complain(s, MOTUS_SYNTAX, &at, "a unit is no part of a number");
        source_hint(s, "write it in a comment, behind #");
        return stop(l, from);
    }
    for (size_t i = 0; size && i < sizeof known / sizeof *known; i++)
        if (c >= known[i].first && c <= known[i].last) {
            source_complain(s, MOTUS_SYNTAX, &at, "%s", known[i].what);
            if (known[i].what == raised) foreign_raised(s, &at);
            if (c == '\\') foreign_latex(s, &at);
            source_hint(s, "%s", known[i].hint);
            return stop(l, from);
        }
    if (size == 0) {
        source_complain(s, MOTUS_SYNTAX, &at, "this byte (0x%02X) is not UTF-8 text",
                        (unsigned char)s->texts[l->text].bytes[from]);
        source_hint(s, "save the model as UTF-8");
    } else if (c < 0x20 || c == 0x7F) {
        source_complain(s, MOTUS_SYNTAX, &at, "a control character (U+%04X) stands here", c);
        source_hint(s, "a model is plain text: remove it");
    } else if (c < 0x7F) {
        source_complain(s, MOTUS_SYNTAX, &at, "the character %c has no meaning here", (char)c);
    } else {
        source_complain(s, MOTUS_SYNTAX, &at, "the character U+%04X has no meaning here", c);
    }
    return stop(l, from);
}

token lex_next(lexer *l)
{
    source *s = l->source;
    const char *b = s->texts[l->text].bytes;
    uint32_t n = s->texts[l->text].length;
    bool blank = l->at == 0;
    for (;;) {
        if (source_failed(s)) return stop(l, l->at);
        if (l->at >= n) {
            if (l->depth > 0) {
                span open = {l->text, l->opened[l->depth - 1], l->opened[l->depth - 1] + 1};
                source_complain(s, MOTUS_SYNTAX, &open, "this %c is never closed", b[open.from]);
                source_hint(s, "add the missing %c", l->closer[l->depth - 1]);
            }
            return stop(l, n);
        }
        char c = b[l->at];
        if (c == ' ' || c == '\t' || c == '\r') {
            l->at++;
        } else if (c == '#') {
            while (l->at < n && b[l->at] != '\n') l->at++;
        } else if (c == '\n') {
            l->at++;
            if (l->depth == 0) return make(l, TOKEN_NEWLINE, l->at - 1, true);
        } else if (c == ';' && l->depth == 0) {
            l->at++;
            token t = make(l, TOKEN_NEWLINE, l->at - 1, true);
            t.character = ';';
            return t;
        } else if (l->at + 1 < n && (unsigned char)c == 0xC2 && (unsigned char)b[l->at + 1] == 0xA0) {
            l->at += 2; /* a no-break space, from a word processor */
        } else {
            break;
        }
        blank = true;
    }
    uint32_t from = l->at, size, c = decode(b, n, from, &size);
    if (size == 0) return wrong_character(l, from, 0, 0);
    if (c >= '0' && c <= '9') return lex_number(l, blank);
    if (letter(c)) return lex_name(l, blank);
    if (prime_of(c)) return lex_primes(l, blank);
    static const struct {
        char text[3];
        token_kind kind;
    } pairs[] = {{"..", TOKEN_DOTS}, {"<=", TOKEN_LE}, {">=", TOKEN_GE}, {"==", TOKEN_EQ}, {"!=", TOKEN_NE}};
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++)
        if (from + 1 < n && b[from] == pairs[i].text[0] && b[from + 1] == pairs[i].text[1]) {
            l->at += 2;
            return make(l, pairs[i].kind, from, blank);
        }
    token_kind relation = c == 0x2264 ? TOKEN_LE : c == 0x2265 ? TOKEN_GE : c == 0x2260 ? TOKEN_NE : TOKEN_END;
    if (relation != TOKEN_END) {
        l->at += size;
        return make(l, relation, from, blank);
    }
    if (c == 0x2212) /* printed signs: −, and · × between factors */
        c = '-';
    if (c == 0xB7 || c == 0xD7 || c == 0x22C5 || c == 0x2217) c = '*';
    if (c == '.' && digit(b, n, from + 1) &&
        (blank || from == 0 || !(b[from - 1] == ')' || b[from - 1] == ']' || b[from - 1] == '\''))) {
        span at = {l->text, from, from + 2};
        source_complain(s, MOTUS_SYNTAX, &at, "a number needs a digit before the point");
        source_hint(s, "write 0.%c", b[from + 1]);
        return stop(l, from);
    }
    if (c > 0 && c < 0x80 && strchr("+-*/^()[]|,.=<>:", (int)c)) {
        l->at += size;
        if (!bracket(l, (char)c, from)) return stop(l, from);
        token t = make(l, TOKEN_CHARACTER, from, blank);
        t.character = (char)c;
        return t;
    }
    return wrong_character(l, from, c, size);
}
