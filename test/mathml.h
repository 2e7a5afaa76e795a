/* A strict reader of the MathML that the library writes; it accepts only the part of XML that the library uses.
 *
 * It knows each element, its attributes and its number of children, and rewrites the text in a short form that tests
 * compare: mrow {…}, others name{child|child}, leaves as their text; invisible times ~, the application of a function
 * @, a no-break space _, mspace a blank.
 */
#ifndef TEST_MATHML_H
#define TEST_MATHML_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

enum { MATHML_DEPTH_MAX = 250, MATHML_STACK = 256 };

typedef struct mathml_element {
    const char *name;
    int children;
    bool text;
    const char *attributes;
} mathml_element;

typedef struct mathml {
    const char *at;
    const char *wrong; /* NULL: none so far */
    char *out;
    size_t length, room;
    int depth, deepest;
} mathml;

static inline const mathml_element *mathml_known(const char *name, size_t length)
{
    static const mathml_element known[] = {
        {"math", -1, false, " xmlns=\"http://www.w3.org/1998/Math/MathML\" display=\"block\""},
        {"mrow", -1, false, " class=\"for\""},
        {"mi", -1, true, ""},
        {"mn", -1, true, ""},
        {"mtext", -1, true, ""},
        {"mo", -1, true,
         " form=\"prefix\" form=\"postfix\" stretchy=\"false\" class=\"prime\" lspace=\"0\" rspace=\"0\" "
         "lspace=\"0.22em\" rspace=\"0.22em\""},
        {"mspace", 0, false, " width=\"0.17em\" width=\"2em\""},
        {"mfrac", 2, false, ""},
        {"msup", 2, false, ""},
        {"msub", 2, false, ""},
        {"msubsup", 3, false, ""},
        {"munderover", 3, false, ""},
        {"mroot", 2, false, ""},
        {"msqrt", -1, false, ""},
        {"mtable", -1, false, " class=\"cases\" columnalign=\"left\""},
        {"mtr", 2, false, ""},
        {"mtd", -1, false, ""}};
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (strlen(known[i].name) == length && !memcmp(known[i].name, name, length)) return &known[i];
    return NULL;
}

static inline bool mathml_fails(mathml *m, const char *why)
{
    if (!m->wrong) m->wrong = why;
    return false;
}

static inline void mathml_say(mathml *m, const char *text, size_t length)
{
    for (size_t i = 0; i < length; i++)
        if (m->length + 1 < m->room) m->out[m->length++] = text[i];
    if (m->room) m->out[m->length] = 0;
}

/* One character of text: UTF-8 that XML allows, or one of the entities. */
static inline bool mathml_character(mathml *m)
{
    static const char *const entities[][2] = {{"&amp;", "&"},  {"&lt;", "<"},     {"&gt;", ">"},     {"&quot;", "\""},
                                              {"&apos;", "'"}, {"&#x2062;", "~"}, {"&#x2061;", "@"}, {"&#xA0;", "_"}};
    const unsigned char *p = (const unsigned char *)m->at;
    for (size_t i = 0; i < sizeof entities / sizeof *entities; i++)
        if (!strncmp(m->at, entities[i][0], strlen(entities[i][0]))) {
            mathml_say(m, entities[i][1], 1);
            m->at += strlen(entities[i][0]);
            return true;
        }
    if (*p < 0x20 || *p == 0x7F || *p == '&' || *p == '>' || *p == '"' || *p == '\'')
        return mathml_fails(m, "a character that should be escaped");
    int more = *p < 0x80 ? 0 : *p >> 5 == 6 ? 1 : *p >> 4 == 14 ? 2 : *p >> 3 == 30 ? 3 : -1;
    unsigned long c = more < 0 ? 0 : more ? *p & (0x3Fu >> more) : *p;
    for (int i = 1; i <= more; i++) {
        if ((p[i] & 0xC0) != 0x80) return mathml_fails(m, "not UTF-8");
        c = c << 6 | (p[i] & 0x3F);
    }
    static const unsigned long least[4] = {0, 0x80, 0x800, 0x10000};
    if (more < 0 || c < least[more] || c > 0x10FFFF || (c >= 0xD800 && c < 0xE000) || c == 0xFFFE || c == 0xFFFF ||
        (c >= 0x80 && c < 0xA0))
        return mathml_fails(m, "not a character of XML");
    mathml_say(m, m->at, (size_t)more + 1);
    m->at += more + 1;
    return true;
}

static inline bool mathml_attributes(mathml *m, const mathml_element *e)
{
    while (*m->at == ' ') {
        const char *quote = strchr(m->at, '"'), *end = quote ? strchr(quote + 1, '"') : NULL;
        char one[128];
        if (!end || (size_t)(end + 1 - m->at) >= sizeof one) return mathml_fails(m, "an attribute that does not end");
        snprintf(one, sizeof one, "%.*s", (int)(end + 1 - m->at), m->at);
        if (!strstr(e->attributes, one)) return mathml_fails(m, "an attribute that is not ours");
        m->at = end + 1;
    }
    return true;
}

static inline bool mathml_element_read(mathml *m)
{
    if (*m->at != '<') return mathml_fails(m, "an element expected");
    if (++m->depth > m->deepest) m->deepest = m->depth;
    if (m->depth > MATHML_DEPTH_MAX) return mathml_fails(m, "too deep");
    const char *name = ++m->at;
    size_t length = strspn(name, "abcdefghijklmnopqrstuvwxyz");
    const mathml_element *e = mathml_known(name, length);
    m->at += length;
    if (!e) return mathml_fails(m, "an element that is not ours");
    if (!mathml_attributes(m, e)) return false;
    bool empty = *m->at == '/', row = !strcmp(e->name, "mrow"),
         shows = !e->text && !row && strcmp(e->name, "math") && !empty;
    m->at += empty;
    if (*m->at++ != '>') return mathml_fails(m, "a tag that does not end");
    int children = 0;
    if (empty) mathml_say(m, " ", strcmp(e->name, "mspace") == 0);
    if (shows) mathml_say(m, e->name, length);
    if (shows || row) mathml_say(m, "{", 1);
    while (!empty && strncmp(m->at, "</", 2)) {
        if (children++ && shows && e->children > 0) mathml_say(m, "|", 1);
        if (e->text ? *m->at == '<' || *m->at == 0 : *m->at != '<')
            return mathml_fails(m, e->text ? "a leaf that does not end" : "text outside a leaf");
        if (!(e->text ? mathml_character(m) : mathml_element_read(m))) return false;
    }
    if (e->children >= 0 && children != e->children) return mathml_fails(m, "a wrong number of children");
    if (e->text && !children) return mathml_fails(m, "an empty leaf");
    if (!empty) {
        if (strncmp(m->at + 2, e->name, length) || m->at[2 + length] != '>')
            return mathml_fails(m, "tags that do not pair");
        m->at += 3 + length;
    }
    if (shows || row) mathml_say(m, "}", 1);
    m->depth--;
    return true;
}

/* NULL: the text is one well-formed element `math` of the known elements; else what is wrong. out: the short form,
 * cut to the room. */
static inline const char *mathml_read(const char *text, char *out, size_t room, int *deepest)
{
    mathml m = {.at = text, .out = out, .room = room};
    if (strncmp(text, "<math ", 6)) return "it does not begin with math";
    if (mathml_element_read(&m) && *m.at) return "something behind the end";
    if (deepest) *deepest = m.deepest;
    return m.wrong;
}

#endif
