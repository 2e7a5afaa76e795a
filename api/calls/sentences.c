/* See explain.h. */
#include "api/calls/explain.h"

#include <stdarg.h>
#include <stdio.h>

void sentences_say(sentences *w, const char *format, ...)
{
    va_list list, again;
    va_start(list, format);
    va_copy(again, list);
    const int n = vsnprintf(NULL, 0, format, list);
    if (n >= 0 && w->length + (size_t)n + 1 > w->room) {
        const size_t room = 2 * w->room + (size_t)n + 256;
        char *more = take_more(w->allocator, w->text, w->length, room, 1);
        w->failed |= !more;
        if (more) w->text = more, w->room = room;
    }
    if (n >= 0 && w->length + (size_t)n + 1 <= w->room)
        w->length += (size_t)vsnprintf(w->text + w->length, w->room - w->length, format, again);
    va_end(again);
    va_end(list);
}
