/* What the comments of a model say about its numbers. See load.h. */
#include "cli/model/load.h"

#include "base/utf8.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

enum { NAME = 256, MOST = 200 /* bytes of a comment */ };

/* Copies a name without blanks, indices and components: of "r[i]'.x(0)", out is "r'", and *initial is true. Returns
 * false if the text is not a name. */
static bool plain(const char *from, size_t length, char out[NAME], bool *initial)
{
    size_t n = 0;
    *initial = false;
    for (size_t k = 0; k < length; k++) {
        const char c = from[k];
        if (c == ' ' || c == '\t') continue;
        if (c == '[' || c == '(') {
            const char *end = memchr(from + k, c == '[' ? ']' : ')', length - k);
            if (!end) return false;
            *initial = *initial || c == '(';
            k = (size_t)(end - from);
        } else if (c == '.' && k + 1 < length && strchr("xyz", from[k + 1])) {
            k++;
        } else if (strchr("=<>!+-*/^,;:|", c) || n + 1 == NAME) {
            return false;
        } else {
            out[n++] = c;
        }
    }
    out[n] = 0;
    return n > 0;
}

/* Moves *column to the name in it, which is x in "max(x)" and in "x.error". Returns the length of the name. */
static size_t subject(const char **column)
{
    static const char *const of[] = {"min(", "max(", "mean(", "final("}, error[] = ".error";
    size_t length = strlen(*column);
    if (length > sizeof error - 1 && strcmp(*column + length - (sizeof error - 1), error) == 0)
        length -= sizeof error - 1;
    for (size_t k = 0; k < sizeof of / sizeof *of; k++) {
        const size_t n = strlen(of[k]);
        if (strncmp(*column, of[k], n) != 0 || (*column)[length - 1] != ')') continue;
        *column += n;
        return length - n - 1;
    }
    return length;
}

/* Copies a comment without the blanks around it. Returns NULL if it is empty, too long or not visible text. */
static char *copy(const char *from, size_t length)
{
    while (length > 0 && strchr(" \t#", *from)) from++, length--;
    while (length > 0 && strchr(" \t\r", from[length - 1])) length--;
    if (length == 0 || length > MOST) return NULL;
    for (size_t k = 0, n; k < length; k += n) {
        uint32_t c;
        n = utf8_read(from + k, length - k, &c);
        if (n == 0 || !utf8_visible(c)) return NULL;
    }
    char *out = calloc(1, length + 1);
    if (out) memcpy(out, from, length);
    return out;
}

char *comments_find(const char *model, const char *column)
{
    char wanted[NAME], name[NAME];
    bool initial, its;
    const size_t length = subject(&column);
    if (!plain(column, length, wanted, &initial)) return NULL;
    char *found = NULL;
    for (const char *line = model; *line && !found;) {
        const size_t all = strcspn(line, "\n"), code = strcspn(line, "#\n"), left = strcspn(line, "=#\n");
        /* the line is a single statement that gives a value */
        const bool gives = left < code && line[left + 1] != '=' && !memchr(line, ';', code);
        if (gives && code < all && plain(line, left, name, &its) && strcmp(name, wanted) == 0 && (its || !initial))
            found = copy(line + code, all - code);
        line += all + (line[all] == '\n');
    }
    return found;
}

char *comments_setting(const char *model, const char *word)
{
    const size_t length = strlen(word);
    for (const char *line = model; *line; line += strcspn(line, "\n"), line += *line == '\n') {
        const char *at = line + strspn(line, " \t");
        const size_t all = strcspn(at, "\n"), code = strcspn(at, "#\n");
        if (strncmp(at, word, length) == 0 && strchr(" \t", at[length]) && code < all)
            return copy(at + code, all - code);
    }
    return NULL;
}
