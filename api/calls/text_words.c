/* The words of a text for an editor, and those of the language. See motus_text_words.
 *
 * The lexer of lang/text/ reads the text, and goes on after every error. Invariant: words are in the order of the
 * text, do not overlap, and every name in them has been compared with every definition among them.
 */
#include "lang/text/lex.h"
#include "lang/text/words.h"

#include <string.h>

typedef struct reading {
    const char *text;
    motus_word *words;
    size_t count, room;
    size_t statement; /* the word that begins the present statement */
    bool events;      /* the text has a `when` */
} reading;

static bool is(const reading *r, size_t k, const char *sign)
{
    return k < r->count && r->words[k].length == strlen(sign) &&
           memcmp(r->text + r->words[k].from, sign, r->words[k].length) == 0;
}

static void add(reading *r, motus_word_kind kind, size_t from, size_t to)
{
    if (r->count < r->room) r->words[r->count++] = (motus_word){from, to - from, kind, 0};
}

/* Adds the comments between two tokens, where there are only blanks and line ends besides. */
static void add_comments(reading *r, size_t from, size_t to)
{
    for (; from < to; from++) {
        if (r->text[from] != '#') continue;
        const char *end = memchr(r->text + from, '\n', to - from);
        const size_t stop = end ? (size_t)(end - r->text) : to;
        add(r, MOTUS_WORD_COMMENT, from, stop);
        from = stop;
    }
}

static void add_name(reading *r, size_t from, size_t to)
{
    char name[MOTUS_NAME_MAX];
    motus_word_kind kind = MOTUS_WORD_UNKNOWN;
    if (to - from < sizeof name) {
        memcpy(name, r->text + from, to - from);
        name[to - from] = 0;
        kind = words_kind(name);
        if (is(r, r->statement, "method")) kind = MOTUS_WORD_SETTING;
        if (kind == MOTUS_WORD_UNKNOWN && is(r, r->statement, "when") && words_event_kind(name) == MOTUS_WORD_OPERATOR)
            kind = MOTUS_WORD_OPERATOR;
    }
    add(r, kind, from, to);
}

/* Marks what a `when` defines: its name after `as`, and indices after `for`. */
static void define_event(reading *r)
{
    bool ranges = false;
    for (size_t i = r->statement; i < r->count; i++) {
        ranges |= is(r, i, "for");
        if (r->words[i].kind == MOTUS_WORD_UNKNOWN && i > 0 && (is(r, i - 1, "as") || (ranges && is(r, i + 1, "="))))
            r->words[i].defines = 1;
    }
    r->events = true;
    r->statement = r->count;
}

/* Marks what a statement, the words from r->statement on, defines: x'' = …, k[i] = … for i = 1..N, V(q) = …, exact x =
 * … */
static void define(reading *r)
{
    if (is(r, r->statement, "when")) {
        define_event(r);
        return;
    }
    size_t k = r->statement, equals = k;
    if (is(r, k, "exact") || is(r, k, "invariant")) k++;
    while (equals < r->count && !is(r, equals, "=")) equals++;
    const bool equation = equals < r->count;
    for (size_t i = k; i < r->count; i++) {
        motus_word *w = &r->words[i];
        if (w->kind != MOTUS_WORD_UNKNOWN) continue;
        const bool primes = i + 1 < r->count && strchr("'\"", r->text[r->words[i + 1].from]);
        if (i == k ? equation || primes : is(r, i + 1, "=")) w->defines = 1;
        /* an argument, or an index, on the left */
        if (i > k && i < equals && equation && (is(r, i + 1, ")") || is(r, i + 1, ",") || is(r, i + 1, "]")))
            w->defines = 1;
    }
    r->statement = r->count;
}

/* Returns whether word i names a number that events keep: count(bounce), time(bounce, last). */
static bool keeps(const reading *r, size_t i)
{
    char name[8] = "";
    if (r->words[i].length < sizeof name) memcpy(name, r->text + r->words[i].from, r->words[i].length);
    return words_event_kind(name) == MOTUS_WORD_FUNCTION && is(r, i + 1, "(");
}

static void know_events(reading *r)
{
    for (size_t i = 0; r->events && i < r->count; i++) {
        motus_word *w = &r->words[i];
        if (w->kind != MOTUS_WORD_UNKNOWN) continue;
        if (keeps(r, i)) w->kind = MOTUS_WORD_FUNCTION;
        if (is(r, i, "last") && i > 3 && is(r, i - 1, ",") && keeps(r, i - 4)) w->kind = MOTUS_WORD_OPERATOR;
    }
}

static void know(reading *r)
{
    for (size_t i = 0; i < r->count; i++) {
        motus_word *w = &r->words[i];
        for (size_t k = 0; k < r->count && w->kind == MOTUS_WORD_UNKNOWN; k++) {
            const motus_word *d = &r->words[k];
            if (d->defines && d->length == w->length && memcmp(r->text + d->from, r->text + w->from, w->length) == 0)
                w->kind = MOTUS_WORD_KNOWN;
        }
    }
}

static void read_words(reading *r, source *s)
{
    lexer l;
    lex_start(&l, s, 0);
    size_t done = l.at;
    while (r->count < r->room) {
        const token t = lex_next(&l);
        add_comments(r, done, t.at.from);
        done = t.at.to;
        if (s->failed) { /* the number has no end, or the character is wrong */
            const size_t from = t.at.from, size = s->texts[0].length;
            if (from >= size) break;
            const bool number = r->text[from] && strchr("0123456789", r->text[from]);
            for (done = from + 1; done < size && (r->text[done] & 0xC0) == 0x80;) done++;
            while (number && done < size && r->text[done] && strchr("0123456789.", r->text[done])) done++;
            add(r, number ? MOTUS_WORD_NUMBER : MOTUS_WORD_WRONG, from, done);
            s->failed = false;
            l.at = (uint32_t)done;
        } else if (t.kind == TOKEN_END) {
            break;
        } else if (t.kind == TOKEN_NEWLINE) {
            define(r);
        } else {
            if (t.kind == TOKEN_NAME)
                add_name(r, t.at.from, t.at.to);
            else
                add(r, t.kind == TOKEN_NUMBER ? MOTUS_WORD_NUMBER : MOTUS_WORD_OPERATOR, t.at.from, t.at.to);
        }
    }
    define(r);
    know(r);
    know_events(r);
}

size_t motus_text_words(const char *text, size_t length, motus_word *words, size_t room)
{
    if (!text || (!words && room)) return 0;
    if (length == SIZE_MAX) length = strlen(text);
    if (length > SOURCE_BYTES_MAX) length = SOURCE_BYTES_MAX;
    arena none = {.failed = false};
    struct source_text whole = {text, (uint32_t)length, NULL, false};
    source s = {.arena = &none, .texts = &whole, .count = 1};
    reading r = {.text = text, .words = words, .room = room};
    read_words(&r, &s);
    return r.count;
}

const char *motus_language_word(size_t k, motus_word_kind *kind)
{
    const char *word = words_at(k);
    if (word && kind) *kind = words_event_kind(word) != MOTUS_WORD_UNKNOWN ? words_event_kind(word) : words_kind(word);
    return word;
}
