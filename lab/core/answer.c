/* The answer to the page: one text that grows, and is written again by the next call. */
#include "lab/core/core.h"

#include <stdlib.h>
#include <string.h>

static void add(void *to, const char *bytes, size_t count)
{
    lab_text *t = to;
    if (t->failed) return;
    if (t->length + count + 1 > t->capacity) {
        const size_t capacity = 2 * (t->length + count) + 256;
        char *more = realloc(t->text, capacity);
        if (!more) {
            t->failed = true;
            return;
        }
        t->text = more;
        t->capacity = capacity;
    }
    memcpy(t->text + t->length, bytes, count);
    t->length += count;
    t->text[t->length] = 0;
}

json lab_answer(lab *l)
{
    l->answer.length = 0;
    l->answer.failed = false;
    json j = {.write = add, .to = &l->answer};
    json_open(&j, NULL, '{');
    return j;
}

const char *lab_answered(lab *l, json *j)
{
    json_end(j);
    return l->answer.failed ? NULL : l->answer.text;
}
