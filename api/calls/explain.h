/* What the explanations of a system and of a run share. */
#ifndef API_CALLS_EXPLAIN_H
#define API_CALLS_EXPLAIN_H

#include "api/system/system.h"

#include <stdbool.h>

/* ---- sentences.c: a growing text of sentences ---- */

typedef struct sentences {
    const motus_allocator *allocator;
    char *text; /* from the hooks; NULL: no sentence yet */
    size_t length, room;
    bool failed; /* memory ran out: the text is not whole */
} sentences;

void sentences_say(sentences *, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* ---- cuts.c: what becomes of a method's geometry where events assign ---- */

/* Returns whether an event that assigns ends steps at a time that the state decides. */
bool cuts_by_state(const motus_system *);
/* Returns how events affect the geometry of a run's method: `cut` of motus_run_statistics. */
const char *cuts_sentence(const motus_run *);

#endif
