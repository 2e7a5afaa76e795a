/* Units in the comments of a model: `x(0) = 1  # m`, `g = 9.81  # m/s^2: on the ground`, `# [km/s]`, `# masses, in kg`.
 *
 * Invariant: a text is a unit only if each of its words is the symbol of one, and what follows it is punctuation. motus
 * never computes with units: they stand on the axes of pictures.
 */
#include "cli/model/load.h"

#include <stdlib.h>
#include <string.h>

/* Symbols that take a prefix, and those that take none. */
static const char *const scaled[] = {"m",  "g",  "s",   "A",   "K",  "mol", "Hz",  "N", "Pa", "J",  "W",
                                     "C",  "V",  "F",   "Ω",   "S",  "T",   "Wb",  "H", "lm", "lx", "Bq",
                                     "Gy", "Sv", "rad", "bar", "eV", "pc",  "cal", "L", "l"};
static const char *const whole[] = {"kn",     "min",    "h",       "d",      "yr",      "au",    "AU",     "ly",
                                    "u",      "Da",     "cd",      "sr",     "deg",     "°",     "°C",     "Å",
                                    "atm",    "ft",     "inch",    "rpm",    "year",    "years", "day",    "days",
                                    "hour",   "hours",  "minutes", "second", "seconds", "metre", "metres", "meter",
                                    "meters", "radian", "radians", "degree", "degrees"};
static const char *const prefixes[] = {"c", "m", "µ", "μ", "u", "n", "p", "f", "k", "M", "G", "T", "d", "h"};
#define COUNT(list) (sizeof(list) / sizeof *(list))

static bool among(const char *const *list, size_t count, const char *word, size_t length)
{
    for (size_t k = 0; k < count; k++)
        if (strlen(list[k]) == length && memcmp(list[k], word, length) == 0) return true;
    return false;
}

static bool is_symbol(const char *word, size_t length)
{
    if (among(scaled, COUNT(scaled), word, length) || among(whole, COUNT(whole), word, length)) return true;
    for (size_t k = 0; k < COUNT(prefixes); k++) {
        const size_t n = strlen(prefixes[k]);
        if (length > n && memcmp(word, prefixes[k], n) == 0 && among(scaled, COUNT(scaled), word + n, length - n))
            return true;
    }
    return false;
}

/* Returns the length of a character that raises to a power, or that joins factors; 0: it is none of them. */
static size_t mark(const char *at, bool power)
{
    static const char *const powers[] = {"¹", "²", "³", "⁻"}, *const joints[] = {"·", "⋅"};
    const char *const *list = power ? powers : joints;
    for (size_t k = 0; k < (power ? COUNT(powers) : COUNT(joints)); k++)
        if (strncmp(at, list[k], strlen(list[k])) == 0) return strlen(list[k]);
    return 0;
}

static const char *after_power(const char *at)
{
    for (size_t n; (n = mark(at, true)) > 0; at += n) continue;
    if (*at != '^') return at;
    const bool inside = at[1] == '(';
    const char *end = at + 1 + inside + (at[1 + inside] == '-');
    const size_t digits = strspn(end, inside ? "0123456789/" : "0123456789");
    if (digits == 0 || (inside && end[digits] != ')')) return NULL;
    return end + digits + inside;
}

static const char *product(const char *at, int depth);

/* Returns the end of a factor with its power; NULL: there is none. */
static const char *factor(const char *at, int depth)
{
    if (*at == '(' && depth < 4) {
        const char *end = product(at + 1, depth + 1);
        return end && *end == ')' ? after_power(end + 1) : NULL;
    }
    size_t n = 0;
    while (((at[n] >= 'a' && at[n] <= 'z') || (at[n] >= 'A' && at[n] <= 'Z') || (at[n] & 0x80)) &&
           !mark(at + n, true) && !mark(at + n, false))
        n++;
    return n > 0 && is_symbol(at, n) ? after_power(at + n) : NULL;
}

/* Returns the end of factors that blanks, "*", "·" and "/" join; NULL: a word among them is no unit. */
static const char *product(const char *at, int depth)
{
    const char *end = strncmp(at, "1/", 2) == 0 || strncmp(at, "1 /", 3) == 0 ? at + 1 : factor(at, depth);
    while (end) {
        const char *next = end + strspn(end, " ");
        const size_t joint = *next == '/' || *next == '*' ? 1 : mark(next, false);
        if (joint == 0 && (next == end || !*next || strchr("(),:;=].", *next))) break;
        next += joint;
        end = factor(next + strspn(next, " "), depth);
    }
    return end;
}

/* Returns the end of the unit at the beginning of a text. NULL: there is none. */
static const char *unit_end(const char *text)
{
    const char *end = product(text, 0);
    if (!end) return NULL;
    const char *next = end + strspn(end, " ");
    const bool stop = !*next || strchr(",:;=]", *next) || (*next == '(' && next > end) ||
                      (*next == '.' && (!next[1] || next[1] == ' '));
    return stop ? end : NULL;
}

bool units_read(const char *comment, char out[UNIT_MAX], bool *alone)
{
    const char *from = comment + strspn(comment, "# \t");
    if (*from == '[') from++;
    const char *end = unit_end(from);
    for (const char *in = from; !end && (in = strstr(in, "in ")) != NULL; in += 3) {
        if (in > from && in[-1] != ' ') continue;
        end = unit_end(in + 3);
        if (end && end[strspn(end, " .")]) end = NULL; /* "in s, as usual" tells nothing certain */
        if (end) from = in + 3;
    }
    if (!end || end - from >= UNIT_MAX) return false;
    memcpy(out, from, (size_t)(end - from));
    out[end - from] = 0;
    const char *const rest = end + strspn(end, " ]");
    *alone = !*rest || *rest == '=';
    return true;
}

/* Returns whether the model gives a value to a name, which is then no symbol of a unit in front of words. */
static bool is_given(const char *model, const char *name)
{
    const size_t length = strlen(name);
    for (const char *line = model; *line; line += strcspn(line, "\n"), line += *line == '\n') {
        const char *at = line + strspn(line, " \t");
        if (strncmp(at, name, length) == 0 && at[length + strspn(at + length, " \t")] == '=') return true;
    }
    return false;
}

static bool from_comment(const char *model, char *comment, char out[UNIT_MAX])
{
    bool alone = false;
    const bool found = comment && units_read(comment, out, &alone) && (alone || !is_given(model, out));
    free(comment);
    if (!found) out[0] = 0;
    return found;
}

/* Writes the unit of a velocity without a comment of its own: that of its position over that of the time. */
static void per_time(const char *model, const char *name, char out[UNIT_MAX])
{
    char position[MOTUS_NAME_MAX + 64], above[UNIT_MAX], below[UNIT_MAX];
    const char *prime = strchr(name, '\'');
    if (!prime) return;
    snprintf(position, sizeof position, "%.*s%s", (int)(prime - name), name, prime + 1);
    units_of(model, position, false, above);
    units_of(model, "", true, below);
    if (above[0] && below[0] && !strchr(above, '/') && !strpbrk(below, "/ ") && strlen(above) <= 20 &&
        strlen(below) <= 20)
        snprintf(out, UNIT_MAX, "%.20s/%.20s", above, below);
}

void units_of(const char *model, const char *name, bool time, char out[UNIT_MAX])
{
    char invariant[MOTUS_NAME_MAX + 80];
    snprintf(invariant, sizeof invariant, "invariant %s", name);
    out[0] = 0;
    if (time || strcmp(name, "until") == 0)
        (void)(from_comment(model, comments_setting(model, "until"), out) ||
               from_comment(model, comments_setting(model, "step"), out) ||
               from_comment(model, comments_setting(model, "time"), out));
    else
        (void)(from_comment(model, comments_find(model, name), out) ||
               from_comment(model, comments_find(model, invariant), out));
    if (!time && !out[0]) per_time(model, name, out);
}

void units_label(const char *model, const char *name, bool time, char *out, size_t size)
{
    char unit[UNIT_MAX];
    units_of(model, name, time, unit);
    snprintf(out, size, "%.200s%s%s%s", name, unit[0] ? " (" : "", unit, unit[0] ? ")" : "");
}
