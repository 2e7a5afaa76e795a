/* Characters, names and numbers of a typeset statement.
 *
 * Invariant: only `escaped` writes text of the model, so no such text can begin or end an element.
 */
#include "lang/typeset/typeset_parts.h"

#include "base/utf8.h"

static void put(typesetter *p, const char *text, size_t length)
{
    if (p->failed) return;
    if (length >= p->room - p->length) {
        size_t room = 2 * p->room + length + 1024;
        char *more = take_more(p->allocator, p->text, p->length, room, 1);
        if (!more) {
            p->failed = true;
            return;
        }
        p->text = more;
        p->room = room;
    }
    memcpy(p->text + p->length, text, length);
    p->length += length;
    p->text[p->length] = 0;
}

void typeset_put(typesetter *p, const char *text) { put(p, text, strlen(text)); }

/* Returns the bytes of a character that XML allows; 0: it does not, or the bytes are not UTF-8. */
static size_t character(const char *text, size_t length)
{
    uint32_t c = 0;
    const size_t n = utf8_read(text, length, &c);
    return c < 0x20 || (c >= 0x7F && c < 0xA0) || c == 0xFFFE || c == 0xFFFF ? 0 : n;
}

static void escaped(typesetter *p, const char *text, size_t length)
{
    for (size_t i = 0, n; i < length; i += n) {
        n = character(text + i, length - i);
        switch (text[i]) {
        case '&': typeset_put(p, "&amp;"); break;
        case '<': typeset_put(p, "&lt;"); break;
        case '>': typeset_put(p, "&gt;"); break;
        case '"': typeset_put(p, "&quot;"); break;
        case '\'': typeset_put(p, "&apos;"); break;
        default: n ? put(p, text + i, n) : typeset_put(p, "\uFFFD"); break;
        }
        n += n == 0;
    }
}

void typeset_plain(typesetter *p, const char *text) { escaped(p, text, strlen(text)); }

/* Names ------------------------------------------------------------------------------------------------------------ */

static bool digit(char c) { return c >= '0' && c <= '9'; }

/* Returns what a subscript that a name may contain (U+2080 … U+209C) stands for, or 0. */
static char lowered(const char *at)
{
    static const char means[] = "0123456789+-=()\0aeox\0hklmnpst";
    unsigned char last = (unsigned char)at[0] == 0xE2 && (unsigned char)at[1] == 0x82 ? (unsigned char)at[2] : 0;
    return last >= 0x80 && last < 0x80 + sizeof means - 1 ? means[last - 0x80] : 0;
}

/* Returns the bytes before the subscript of x_max, omega0, m1_max, x₁; *tail is the subscript, empty if there is
 * none. */
static size_t split(const char *name, const char **tail)
{
    size_t length = strlen(name), line = strcspn(name, "_"), n = line;
    for (;;)
        if (n > 0 && digit(name[n - 1]))
            n--;
        else if (n > 3 && lowered(name + n - 3))
            n -= 3;
        else
            break;
    *tail = name + (n < line || line == length ? n : line + 1);
    unsigned char first = (unsigned char)**tail;
    bool marked = first == 0xCC || first == 0xCD; /* a mark (U+0300 …) would sit on the end of a tag */
    if (n == 0 || marked || (line < length && !name[line + 1])) {
        *tail = name + length;
        return length;
    }
    return n;
}

static const char *const greek[] = {
    "alpha", "beta",    "gamma", "delta", "epsilon", "zeta",  "eta", "theta",   "iota", "kappa", "lambda", "mu",   "nu",
    "xi",    "omicron", "pi",    "rho",   "",        "sigma", "tau", "upsilon", "phi",  "chi",   "psi",    "omega"};

/* Returns the Greek letter that is spelled out: U+03B1 + its number, or the capital 32 before it; 0: none is. */
static unsigned letter(const char *name, size_t length)
{
    for (unsigned i = 0; i < sizeof greek / sizeof *greek; i++)
        if (length > 1 && strlen(greek[i]) == length && !memcmp(greek[i] + 1, name + 1, length - 1) &&
            (greek[i][0] | 0x20) == (name[0] | 0x20))
            return 0x3B1 + i - (name[0] & 0x20 ? 0 : 0x20);
    return 0;
}

static void identifier(typesetter *p, const char *name, size_t length)
{
    unsigned c = letter(name, length);
    typeset_put(p, "<mi>");
    if (c)
        put(p, (char[]){(char)(0xC0 | c >> 6), (char)(0x80 | (c & 0x3F))}, 2);
    else
        escaped(p, name, length);
    typeset_put(p, "</mi>");
}

void typeset_name(typesetter *p, const char *name)
{
    const char *tail;
    identifier(p, name, split(name, &tail));
}

bool typeset_has_tail(const char *name)
{
    const char *tail;
    split(name, &tail);
    return *tail != 0;
}

bool typeset_is_word(const char *name)
{
    const char *tail;
    size_t length = split(name, &tail), letters = 0;
    for (size_t i = 0; i < length; i++) letters += ((unsigned char)name[i] & 0xC0) != 0x80;
    return letters > 1 && !letter(name, length);
}

/* Writes a subscript: "max", "0", "1,max". */
void typeset_tail(typesetter *p, const char *name)
{
    char plain[MOTUS_NAME_MAX];
    size_t n = 0, digits = 0;
    split(name, &name);
    while (*name && n + 1 < sizeof plain) {
        char c = lowered(name);
        plain[n] = c ? c : *name == '_' ? ',' : *name;
        digits += digit(plain[n++]);
        name += c ? 3 : 1;
    }
    if (digits < n) {
        identifier(p, plain, n);
        return;
    }
    typeset_put(p, "<mn>");
    escaped(p, plain, n);
    typeset_put(p, "</mn>");
}

/* Numbers ---------------------------------------------------------------------------------------------------------- */

/* Finds a number as it is spelled: its span may be that of brackets around it, with line ends and comments. */
static const char *spelling(const source *s, const tree *t, size_t *length)
{
    const char *at = s->texts[t->at.text].bytes + t->at.from, *end = s->texts[t->at.text].bytes + t->at.to;
    while (at < end && !digit(*at)) {
        if (*at == '#')
            while (at < end && *at != '\n') at++;
        else
            at++;
    }
    size_t n = 0, left = (size_t)(end - at);
    while (n < left && digit(at[n])) n++;
    if (n + 1 < left && at[n] == '.' && digit(at[n + 1]))
        for (n++; n < left && digit(at[n]);) n++;
    if (n + 1 < left && (at[n] == 'e' || at[n] == 'E')) {
        size_t e = n + 1 + (at[n + 1] == '-' || at[n + 1] == '+');
        if (e < left && digit(at[e]))
            for (n = e; n < left && digit(at[n]);) n++;
    }
    *length = n;
    return at;
}

static size_t mantissa(const char *spelled, size_t length)
{
    for (size_t i = 0; i < length; i++)
        if (spelled[i] == 'e' || spelled[i] == 'E') return i;
    return length;
}

bool typeset_has_exponent(const source *s, const tree *t)
{
    size_t length;
    const char *spelled = spelling(s, t, &length);
    return mantissa(spelled, length) < length;
}

static void digits(typesetter *p, const char *text, size_t length)
{
    typeset_put(p, "<mn>");
    escaped(p, text, length < TYPESET_DIGITS_MAX ? length : TYPESET_DIGITS_MAX);
    if (length > TYPESET_DIGITS_MAX) typeset_put(p, "…");
    typeset_put(p, "</mn>");
}

void typeset_number(typesetter *p, const tree *t)
{
    size_t length;
    const char *spelled = spelling(&p->model->source, t, &length);
    size_t n = mantissa(spelled, length);
    if (n == length) {
        digits(p, spelled, n);
        return;
    }
    typeset_put(p, "<mrow>");
    digits(p, spelled, n);
    typeset_put(p, "<mo>×</mo><msup><mn>10</mn>");
    bool minus = spelled[++n] == '-';
    n += minus || spelled[n] == '+';
    while (n + 1 < length && spelled[n] == '0') n++;
    if (minus) typeset_put(p, "<mrow><mo form=\"prefix\">−</mo>");
    digits(p, spelled + n, length - n);
    if (minus) typeset_put(p, "</mrow>");
    typeset_put(p, "</msup></mrow>");
}
