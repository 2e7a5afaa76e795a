/* How signs of print and of LaTeX are written here: x², \ddot{x}, 0,5. See foreign.h. */
#include "lang/text/foreign.h"

#include "base/utf8.h"
#include "lang/text/words.h"

#include <stdio.h>
#include <string.h>

enum { SHOWN = 80 };

static bool digit(char c) { return c >= '0' && c <= '9'; }
static bool letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

bool foreign_decimal(source *s, const span *in)
{
    const char *const b = s->texts[in->text].bytes;
    for (uint32_t i = in->from + 1; i + 1 < in->to; i++) {
        uint32_t from = i, to = i + 1;
        if (b[i] != ',' || !digit(b[i - 1]) || !digit(b[to])) continue;
        while (from > in->from && digit(b[from - 1])) from--;
        while (to < in->to && digit(b[to])) to++;
        source_hint(s, "a decimal number is written with a point: %.*s.%.*s", (int)(i - from), b + from,
                    (int)(to - i - 1), b + i + 1);
        return true;
    }
    return false;
}

/* Reads a raised sign as one of the line; 0: it is none. */
static char lowered(uint32_t c)
{
    return (char)(c == 0xB9                   ? '1'
                  : c == 0xB2 || c == 0xB3    ? '0' + (int)(c - 0xB0)
                  : c >= 0x2070 && c < 0x207A ? '0' + (int)(c - 0x2070)
                  : c == 0x207B               ? '-'
                  : c == 0x207F               ? 'n'
                                              : 0);
}

void foreign_raised(source *s, const span *at)
{
    const struct source_text *const t = &s->texts[at->text];
    const char *const b = t->bytes;
    char power[16] = "", base[SHOWN], unit[SHOWN], digits[SHOWN];
    uint32_t to = at->from, c = 0, first;
    for (size_t n = 0, size; to < t->length && n + 1 < sizeof power; to += (uint32_t)size) {
        size = utf8_read(b + to, t->length - to, &c);
        if (!size || !lowered(c)) break;
        power[n++] = lowered(c);
    }
    const span before = foreign_before(s, at);
    source_excerpt(s, &before, base, sizeof base);
    if (!strcmp(base, "d") && to < t->length && letter(b[to])) { /* d²x/dt² */
        for (first = to; to < t->length && letter(b[to]);) to++;
        source_hint(s, "derivatives are written with primes: %.*s%s = …", (int)(to - first), b + first,
                    !strcmp(power, "2") ? "''" : "'");
        return;
    }
    for (first = before.from; first > 0 && (letter(b[first - 1]) || strchr("/*", b[first - 1]));) first--;
    const span number = foreign_before(s, &(span){at->text, first, first});
    if (first < before.to && letter(b[first]) && number.to < first && number.from < number.to &&
        digit(b[number.from])) { /* 9.81 m/s² */
        source_excerpt(s, &number, digits, sizeof digits);
        source_excerpt(s, &(span){at->text, first, to}, unit, sizeof unit);
        source_hint(s, "write %s^%s; a unit is no part of a number: write it in a comment, %s # %s", base, power,
                    digits, unit);
    }
    source_hint(s, "write %s^%s", base, power);
}

/* Reads the argument of a command, {x} or x, and returns where it ends. */
static uint32_t argument(source *s, uint32_t text, uint32_t from, char out[SHOWN])
{
    const struct source_text *const t = &s->texts[text];
    const char *const b = t->bytes;
    uint32_t to = from;
    while (from < t->length && b[from] == ' ') from++;
    const bool brace = from < t->length && b[from] == '{';
    for (to = from += brace; to < t->length && (brace ? !strchr("}\n", b[to]) : letter(b[to]));) to++;
    source_excerpt(s, &(span){text, from, to}, out, SHOWN);
    return to + (brace && to < t->length);
}

void foreign_latex(source *s, const span *at)
{
    const struct source_text *const t = &s->texts[at->text];
    char name[16] = "", a[SHOWN], c[SHOWN];
    uint32_t to = at->from + 1;
    for (size_t n = 0; to < t->length && letter(t->bytes[to]) && n + 1 < sizeof name;) name[n++] = t->bytes[to++];
    to = argument(s, at->text, to, a);
    if (!strcmp(name, "dot") || !strcmp(name, "ddot")) {
        source_hint(s, "derivatives are written with primes: %s%s", a, name[1] == 'd' ? "''" : "'");
    } else if (strstr(name, "frac")) {
        argument(s, at->text, to, c);
        const bool plain = !a[strcspn(a, "+- *")] && !c[strcspn(c, "+- */")];
        source_hint(s, plain ? "write %s/%s" : "write (%s)/(%s)", a, c);
    } else if (!strcmp(name, "cdot") || !strcmp(name, "times")) {
        source_hint(s, "a product is written a b or a*b");
    } else if (!strcmp(name, "left") || !strcmp(name, "right")) {
        source_hint(s, "write the bracket alone");
    } else if (words_function(name) >= 0) {
        source_hint(s, "write %s(%s)", name, a[0] ? a : "…");
    } else if (name[0]) {
        source_hint(s, "write %s, or the letter itself", name);
    }
}
