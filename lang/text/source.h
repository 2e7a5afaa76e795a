/* The text of a model, and complaints about a place in it. */
#ifndef LANG_TEXT_SOURCE_H
#define LANG_TEXT_SOURCE_H

#include "lang/base/arena.h"

enum {
    SOURCE_BYTES_MAX = 16 << 20, /* a model's text */
    SOURCE_NESTING_MAX = 256,    /* depth of brackets */
    SOURCE_STATEMENTS_MAX = 1 << 20
};

typedef struct span {
    uint32_t text, from, to;
} span; /* bytes [from, to) of a text, by its number */

/* The model's text is text 0; each setting, and each event that is added, is a text of its own. */
typedef struct source {
    arena *arena; /* for names, and what lives as long as the model */
    arena *trees; /* for what lives while the model is read; NULL: it has been read */
    motus_error *error;
    struct source_text {
        const char *bytes;
        uint32_t length;
        const char *name;
        bool event; /* its text is the part of a line after `when` */
    } * texts;
    uint32_t count;
    motus_status status; /* of the first complaint */
    bool failed;
    /* Numbers that no double equals are read as the double on their other side: the shadow, for bars of error. */
    bool nudged;
    /* By place of the pool; not 0: that place gets a number that differs from the text, so nothing is known of its
     * decimals. NULL: no place does. */
    const uint8_t *varied;
    size_t varied_count;
    struct {
        uint32_t text, at;
        int line;
    } known; /* a cache: the last place whose line was counted */
} source;

bool source_failed(const source *); /* whether there was a complaint, or memory ran out */
void source_complain(source *, motus_status, const span *at, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
void source_hint(source *, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* Adds, to the first complaint alone, what an editor may write in place of a word, or as a line of its own if the word
 * is "". */
void source_repair(source *, const char *word, const char *format, ...) __attribute__((format(printf, 3, 4)));
int source_line(source *, const span *at); /* 1-based */
/* Returns the bytes of a span, shortened in the middle to fit `out`, with blanks for newlines. */
const char *source_excerpt(const source *, const span *at, char *out, size_t size);

#endif
