/* A statement of the model as presentation MathML: what the parser understood, set as in a book.
 *
 * Invariant: whatever the model's text, what comes out is one well-formed XML element `math`, of at most some
 * TYPESET_BYTES_MAX bytes and some 4 TYPESET_LEVELS_MAX elements within one another; text of the model stands in it
 * as escaped characters only. What is cut shows as an ellipsis.
 */
#ifndef LANG_TYPESET_TYPESET_H
#define LANG_TYPESET_TYPESET_H

#include "lang/model/model.h"

enum {
    TYPESET_BYTES_MAX = 1 << 16, /* then expressions are left out, and only what is open is closed */
    TYPESET_LEVELS_MAX = 48,     /* expressions within one another */
    TYPESET_TERMS_MAX = 64,      /* of a sum, a product … */
    TYPESET_ITEMS_MAX = 12,      /* of a list, a vector, a call */
    TYPESET_DIGITS_MAX = 48      /* of a number */
};

/* Statement k, in memory of the hooks, to be given back; NULL: no memory. */
char *typeset_statement(const model *, const motus_allocator *, size_t k);

#endif
