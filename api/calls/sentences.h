/* A growing text of sentences about a system. */
#ifndef API_CALLS_SENTENCES_H
#define API_CALLS_SENTENCES_H

#include "base/memory.h"

#include <stdbool.h>

typedef struct sentences {
    const motus_allocator *allocator;
    char *text; /* from the hooks; NULL: no sentence yet */
    size_t length, room;
    bool failed; /* memory ran out: the text is not whole */
} sentences;

void sentences_say(sentences *, const char *format, ...) __attribute__((format(printf, 2, 3)));

#endif
