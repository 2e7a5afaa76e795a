/* A statement of the model as presentation MathML: what the parser understood, set as in a book.
 *
 * Invariant: from any model's text comes one well-formed XML element `math`, of about TYPESET_BYTES_MAX bytes and 4
 * TYPESET_LEVELS_MAX nested elements at most, with text of the model only as escaped characters. An ellipsis shows what
 * is cut.
 */
#ifndef LANG_TYPESET_TYPESET_H
#define LANG_TYPESET_TYPESET_H

#include "lang/model/model.h"

enum {
    TYPESET_BYTES_MAX = 1 << 16, /* beyond this, expressions are left out, and only what is open is closed */
    TYPESET_LEVELS_MAX = 48,     /* nested expressions */
    TYPESET_TERMS_MAX = 64,      /* terms of a sum, a product … */
    TYPESET_ITEMS_MAX = 12,      /* items of a list, a vector, a call */
    TYPESET_DIGITS_MAX = 48      /* digits of a number */
};

/* Returns statement k, in memory of the hooks that the caller gives back; NULL: no memory. */
char *typeset_statement(const model *, const motus_allocator *, size_t k);

#endif
