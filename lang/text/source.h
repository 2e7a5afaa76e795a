/* The text of a model, and errors with a place in it.
 *
 * Invariant: only the first complaint is kept. It sets `failed`; the lexer then returns only END, and all callers
 * return.
 */
#ifndef LANG_TEXT_SOURCE_H
#define LANG_TEXT_SOURCE_H

#include "lang/base/arena.h"

enum {
    SOURCE_BYTES_MAX = 16 << 20, /* a model's text */
    SOURCE_NESTING_MAX = 256,    /* brackets within brackets */
    SOURCE_STATEMENTS_MAX = 1 << 20
};

typedef struct span {
    uint32_t text, from, to;
} span; /* bytes [from, to) of text number `text` */

/* The model's text is text 0; each setting, and each event that is added, is a text of its own. */
typedef struct source {
    arena *arena; /* names, and what lives as long as the model */
    arena *trees; /* what lives while the model is read; NULL: it is read */
    motus_error *error;
    struct source_text {
        const char *bytes;
        uint32_t length;
        const char *name;
        bool event; /* it is what stands behind `when` */
    } * texts;
    uint32_t count;
    motus_status status; /* of the first complaint */
    bool failed;
    /* The numbers that are no doubles are read as the double on their other side: for bars of error. */
    bool nudged;
    /* By place of the pool, where it is not 0: the place gets another number than the text gives it, of which a formula
     * knows nothing; NULL: none does. */
    const uint8_t *varied;
    size_t varied_count;
    struct {
        uint32_t text, at;
        int line;
    } known; /* cache: the last place whose line was counted */
} source;

bool source_failed(const source *); /* a complaint, or no memory */
void source_complain(source *, motus_status, const span *at, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
void source_hint(source *, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* Adds what an editor may write instead of a word, or, word "", as a line of its own; of the first complaint alone. */
void source_repair(source *, const char *word, const char *format, ...) __attribute__((format(printf, 3, 4)));
int source_line(source *, const span *at); /* 1-based */
/* The bytes of a span, shortened in the middle to fit `out`, newlines as blanks. */
const char *source_excerpt(const source *, const span *at, char *out, size_t size);

#endif
