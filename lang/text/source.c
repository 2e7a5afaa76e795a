/* Complaints with line, column, the line itself and a caret. See source.h. */
#include "lang/text/source.h"

#include <stdarg.h>
#include <stdio.h>

bool source_failed(const source *s) { return s->failed || s->arena->failed || (s->trees && s->trees->failed); }

static bool continues(unsigned char byte) { return (byte & 0xC0) == 0x80; }

int source_line(source *s, const span *at)
{
    const struct source_text *text = &s->texts[at->text];
    if (s->known.text != at->text || s->known.at > at->from || s->known.line == 0) {
        s->known.text = at->text;
        s->known.at = 0;
        s->known.line = 1;
    }
    for (; s->known.at < at->from && s->known.at < text->length; s->known.at++)
        s->known.line += text->bytes[s->known.at] == '\n';
    return s->known.line;
}

/* Copies characters [from, to) of a line for a terminal: control characters become '?', and tabs blanks. */
static size_t show(char *out, size_t size, const char *bytes, uint32_t from, uint32_t to)
{
    size_t n = 0;
    for (uint32_t i = from; i < to && n + 5 < size; i++) {
        unsigned char c = (unsigned char)bytes[i];
        if (c == '\t')
            out[n++] = ' ';
        else if (c < 0x20 || c == 0x7F)
            out[n++] = '?';
        else
            out[n++] = (char)c;
    }
    while (n > 0 && n + 6 >= size && continues((unsigned char)out[n])) n--;
    out[n] = 0;
    return n;
}

/* Fills in the part of the line around the place that fits the error's fields, and a caret line of the same width. */
static void point(source *s, const span *at, motus_error *e)
{
    const struct source_text *text = &s->texts[at->text];
    enum { ROOM = 160 };
    uint32_t begin = at->from < text->length ? at->from : text->length, end = begin;
    while (begin > 0 && text->bytes[begin - 1] != '\n') begin--;
    int column = 1;
    for (uint32_t i = begin; i < at->from && i < text->length; i++) column += !continues((unsigned char)text->bytes[i]);
    while (end < text->length && text->bytes[end] != '\n') end++;
    if (end > begin && text->bytes[end - 1] == '\r') end--;
    if (at->from > begin + ROOM / 2 && end - begin > ROOM) {
        begin = at->from - ROOM / 2;
        while (begin > 0 && continues((unsigned char)text->bytes[begin])) begin--;
    }
    if (end - begin > ROOM) {
        end = begin + ROOM;
        while (end > begin && continues((unsigned char)text->bytes[end])) end--;
    }
    show(e->source, sizeof e->source, text->bytes, begin, end);
    size_t n = 0;
    for (uint32_t i = begin; i < at->from && i < text->length && n + 2 < sizeof e->caret; i++)
        if (!continues((unsigned char)text->bytes[i])) e->caret[n++] = ' ';
    uint32_t to = at->to > at->from ? at->to : at->from + 1;
    bool any = false;
    for (uint32_t i = at->from; (i < to && i < end && n + 1 < sizeof e->caret) || !any; i++) {
        if (i >= end || !continues((unsigned char)text->bytes[i])) e->caret[n++] = '^';
        any = true;
    }
    e->caret[n] = 0;
    e->line = source_line(s, at);
    e->column = column;
    snprintf(e->file, sizeof e->file, "%s", text->name ? text->name : "");
}

void source_complain(source *s, motus_status status, const span *at, const char *format, ...)
{
    if (source_failed(s)) /* running out of memory is no error of the text */
        return;
    s->failed = true;
    s->status = status;
    if (!s->error) return;
    char message[MOTUS_TEXT_MAX];
    va_list list;
    va_start(list, format);
    vsnprintf(message, sizeof message, format, list);
    va_end(list);
    fail(s->error, status, "%s", message);
    if (at->text < s->count) point(s, at, s->error);
}

void source_hint(source *s, const char *format, ...)
{
    if (!s->error || s->error->hint[0]) return;
    char text[MOTUS_TEXT_MAX];
    va_list list;
    va_start(list, format);
    vsnprintf(text, sizeof text, format, list);
    va_end(list);
    hint(s->error, "%s", text);
}

void source_repair(source *s, const char *word, const char *format, ...)
{
    if (!s->error || s->error->instead[0]) return;
    char text[MOTUS_TEXT_MAX];
    va_list list;
    va_start(list, format);
    vsnprintf(text, sizeof text, format, list);
    va_end(list);
    error_repair(s->error, word, "%s", text);
}

const char *source_excerpt(const source *s, const span *at, char *out, size_t size)
{
    const char *bytes = s->texts[at->text].bytes;
    uint32_t from = at->from, to = at->to < s->texts[at->text].length ? at->to : s->texts[at->text].length;
    if (to - from + 6 <= size) {
        show(out, size, bytes, from, to);
    } else {
        size_t half = size / 2 - 4;
        uint32_t left = from + (uint32_t)half, right = to - (uint32_t)half;
        while (left > from && continues((unsigned char)bytes[left])) left--;
        while (right < to && continues((unsigned char)bytes[right])) right++;
        size_t n = show(out, size, bytes, from, left);
        n += (size_t)snprintf(out + n, size - n, "…");
        show(out + n, size - n, bytes, right, to);
    }
    for (char *p = out; *p; p++)
        if (*p == '\n') *p = ' ';
    return out;
}
