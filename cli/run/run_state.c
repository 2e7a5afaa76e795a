/* A state in the archive of a run. See run.h.
 *
 * It begins with a head, which zeros fill to HEAD bytes:
 *
 *     motus run
 *     rows 12801
 *     samples 0
 *     due 0
 *     state 1563
 */
#include "cli/run/run.h"

#include "base/decimal.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { HEAD = 256, PAGE = 4096 };

char *run_state_write(const run_state *s, size_t *length, char **rest)
{
    *length = HEAD + s->length + s->rest_length;
    char *bytes = calloc(1, *length + 1);
    if (!bytes) return NULL;
    snprintf(bytes, HEAD, "motus run\nrows %" PRIu64 "\nsamples %" PRId64 "\ndue %d\nstate %zu\n", s->rows, s->samples,
             s->due, s->length);
    memcpy(bytes + HEAD, s->text, s->length);
    *rest = bytes + HEAD + s->length;
    return bytes;
}

/* Reads a word, and a number behind it. */
static bool word(const char **at, const char *name, uint64_t *value)
{
    const size_t length = strlen(name);
    if (strncmp(*at, name, length) != 0) return false;
    const size_t digits = decimal_read_whole(*at + length, strlen(*at + length), value);
    if (digits == 0 || (*at)[length + digits] != '\n') return false;
    *at += length + digits + 1;
    return true;
}

bool run_state_read(const char *bytes, size_t length, run_state *s)
{
    const char *at = bytes;
    uint64_t samples, due, text;
    if (length < HEAD || !memchr(bytes, 0, HEAD) || !word(&at, "motus run\nrows ", &s->rows) ||
        !word(&at, "samples ", &samples) || !word(&at, "due ", &due) || !word(&at, "state ", &text) ||
        text > length - HEAD || samples > INT64_MAX)
        return false;
    s->samples = (int64_t)samples;
    s->due = due != 0;
    s->text = bytes + HEAD;
    s->length = (size_t)text;
    s->rest = s->text + s->length;
    s->rest_length = length - HEAD - s->length;
    return true;
}

size_t run_state_slot(size_t length, size_t rest)
{
    return (HEAD + length + length / 4 + rest + PAGE - 1) / PAGE * PAGE;
}
