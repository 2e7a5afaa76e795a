/* json_check: checks that a file is exactly one JSON value (RFC 8259), in valid UTF-8, with no key twice in one
 * object.
 *
 * Stricter than most readers: no NaN, no leading zeros, no raw control characters, nothing after the value. Exit
 * status 0: valid; 1: not, and the first violation is printed with its place.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct reader {
    const unsigned char *text;
    size_t at, length;
    const char *offence;
} reader;

static int refuse(reader *r, const char *why)
{
    if (!r->offence) r->offence = why;
    return 0;
}

static int peek(const reader *r) { return r->at < r->length ? r->text[r->at] : -1; }

static void blanks(reader *r)
{
    while (peek(r) == ' ' || peek(r) == '\t' || peek(r) == '\n' || peek(r) == '\r') r->at++;
}

static int character(reader *r)
{
    int c = peek(r), more = c < 0x80 ? 0 : c < 0xE0 ? 1 : c < 0xF0 ? 2 : 3;
    unsigned code = (unsigned)c & (more == 0 ? 0x7Fu : 0x3Fu >> more);
    if (c < 0x20 || (c >= 0x80 && c < 0xC2) || c > 0xF4)
        return refuse(r, "a raw control character or a byte that is not UTF-8");
    for (r->at++; more > 0; more--, r->at++) {
        if ((peek(r) & 0xC0) != 0x80) return refuse(r, "UTF-8 cut short");
        code = code << 6 | ((unsigned)peek(r) & 0x3F);
    }
    if ((c >= 0xE0 && c < 0xF0 && code < 0x800) || (c >= 0xF0 && (code < 0x10000 || code > 0x10FFFF)) ||
        (code >= 0xD800 && code < 0xE000))
        return refuse(r, "UTF-8 of no character");
    return 1;
}

static int string(reader *r)
{
    if (peek(r) != '"') return refuse(r, "a string is due");
    r->at++;
    while (peek(r) != '"') {
        if (peek(r) < 0) return refuse(r, "a string without an end");
        if (peek(r) != '\\') {
            if (!character(r)) return 0;
            continue;
        }
        r->at++;
        int c = peek(r);
        if (c < 0 || !strchr("\"\\/bfnrtu", c)) return refuse(r, "an unknown escape");
        r->at++;
        for (int i = 0; c == 'u' && i < 4; i++, r->at++)
            if (peek(r) < 0 || !strchr("0123456789abcdefABCDEF", peek(r)))
                return refuse(r, "\\u wants four hexadecimal digits");
    }
    r->at++;
    return 1;
}

static int digits(reader *r)
{
    size_t start = r->at;
    while (peek(r) >= '0' && peek(r) <= '9') r->at++;
    return r->at > start ? 1 : refuse(r, "a digit is due");
}

static int number(reader *r)
{
    if (peek(r) == '-') r->at++;
    if (peek(r) == '0')
        r->at++;
    else if (!digits(r))
        return 0;
    if (peek(r) == '.') {
        r->at++;
        if (!digits(r)) return 0;
    }
    if (peek(r) == 'e' || peek(r) == 'E') {
        r->at++;
        if (peek(r) == '+' || peek(r) == '-') r->at++;
        return digits(r);
    }
    return 1;
}

static int value(reader *r, int depth);

static int object(reader *r, int depth)
{
    struct {
        size_t at, length;
    } keys[4096];
    size_t count = 0;
    r->at++;
    blanks(r);
    for (int first = 1; peek(r) != '}'; first = 0) {
        if (!first) {
            if (peek(r) != ',') return refuse(r, "a comma or } is due");
            r->at++;
            blanks(r);
        }
        size_t start = r->at;
        if (!string(r)) return 0;
        for (size_t i = 0; i < count; i++)
            if (keys[i].length == r->at - start && memcmp(r->text + keys[i].at, r->text + start, r->at - start) == 0)
                return refuse(r, "a key stands twice in one object");
        if (count < sizeof keys / sizeof *keys) {
            keys[count].at = start;
            keys[count++].length = r->at - start;
        }
        blanks(r);
        if (peek(r) != ':') return refuse(r, "a colon is due");
        r->at++;
        if (!value(r, depth + 1)) return 0;
    }
    r->at++;
    return 1;
}

static int list(reader *r, int depth)
{
    r->at++;
    blanks(r);
    for (int first = 1; peek(r) != ']'; first = 0) {
        if (!first) {
            if (peek(r) != ',') return refuse(r, "a comma or ] is due");
            r->at++;
        }
        if (!value(r, depth + 1)) return 0;
    }
    r->at++;
    return 1;
}

static int word(reader *r, const char *w)
{
    size_t n = strlen(w);
    if (r->length - r->at < n || memcmp(r->text + r->at, w, n) != 0) return refuse(r, "this is no JSON value");
    r->at += n;
    return 1;
}

static int value(reader *r, int depth)
{
    if (depth > 50) return refuse(r, "nested too deeply");
    blanks(r);
    int good, c = peek(r);
    switch (c) {
    case '{': good = object(r, depth); break;
    case '[': good = list(r, depth); break;
    case '"': good = string(r); break;
    case 't': good = word(r, "true"); break;
    case 'f': good = word(r, "false"); break;
    case 'n': good = word(r, "null"); break;
    default: good = c == '-' || (c >= '0' && c <= '9') ? number(r) : refuse(r, "a value is due");
    }
    blanks(r);
    return good;
}

int main(int argc, char **argv)
{
    FILE *file = argc > 1 ? fopen(argv[1], "rb") : stdin;
    if (!file) {
        perror(argv[1]);
        return 1;
    }
    size_t length = 0, room = 1 << 16;
    unsigned char *text = malloc(room);
    for (size_t got; text && (got = fread(text + length, 1, room - length, file)) > 0;) {
        length += got;
        unsigned char *larger = length == room ? realloc(text, room *= 2) : text;
        if (!larger) free(text);
        text = larger;
    }
    if (argc > 1) fclose(file);
    if (!text) {
        fputs("no memory\n", stderr);
        return 1;
    }
    reader r = {text, 0, length, NULL};
    int good = value(&r, 0) && (r.at == r.length || refuse(&r, "something stands behind the value"));
    if (!good) printf("byte %zu: %s\n", r.at, r.offence);
    free(text);
    return !good;
}
