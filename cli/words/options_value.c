/* The value of an option, read as its kind says.
 *
 * Invariant: a number is a constant expression of the language. The verbs get only values that were checked here.
 */
#include "cli/words/options.h"
#include "cli/words/words.h"

#include <math.h>
#include <string.h>

static bool read_number(const char *text, double *number, motus_error *inner)
{
    return typed_constant(text, "", number, inner) == MOTUS_OK;
}

static bool read_above(const char *text, double *number, motus_error *inner)
{
    return read_number(text, number, inner) && *number > 0;
}

/* Reads an integer above 0, exactly if it is written in digits. */
static bool read_count(const char *text, int64_t *count, motus_error *inner)
{
    const char *rest;
    double number;
    if (typed_count(text, count, &rest) && !*rest) return true;
    if (!read_number(text, &number, inner) || number < 1 || number != trunc(number)) return false;
    if (number >= TYPED_COUNT_MAX) {
        hint(inner, "at most %g", TYPED_COUNT_MAX);
        return false;
    }
    *count = (int64_t)number;
    return true;
}

enum { SHORT = 256 };
/* Copies a text without the word at its end and the blanks before it. Returns false if the text does not end in the
 * word, or is too long. */
static bool cut_word(const char *text, const char *word, char out[SHORT])
{
    const size_t n = strlen(word);
    size_t length = strlen(text);
    if (length < n || length - n >= SHORT || strcmp(text + length - n, word) != 0) return false;
    for (length -= n; length > 0 && text[length - 1] == ' ';) length--;
    snprintf(out, SHORT, "%.*s", (int)length, text);
    return true;
}

static bool read_steps(const char *text, int64_t *steps, motus_error *inner)
{
    char number[SHORT];
    return (cut_word(text, "steps", number) || cut_word(text, "step", number)) && read_count(number, steps, inner);
}

/* Reads a time, or "10 steps". */
static bool read_every(options_period *p, const char *text, motus_error *inner)
{
    *p = (options_period){0};
    return read_steps(text, &p->steps, inner) || read_above(text, &p->time, inner);
}

/* Reads a time with its unit, or "1e6 steps". */
static bool read_states(options_period *p, const char *text, motus_error *inner)
{
    static const struct {
        const char *word;
        double seconds;
    } units[] = {{"s", 1}, {"min", 60}, {"h", 3600}};
    char number[SHORT];
    *p = (options_period){0};
    if (read_steps(text, &p->steps, inner)) return true;
    for (size_t k = 0; k < sizeof units / sizeof *units; k++)
        if (cut_word(text, units[k].word, number) && read_above(number, &p->time, inner)) {
            p->time *= units[k].seconds;
            return true;
        }
    return false;
}

/* Sets o->absolute by the word at the end of a text, and copies the text before it. Returns false if it is too long. */
static bool read_unit(options *o, const char *text, char number[SHORT])
{
    o->absolute = cut_word(text, " absolute", number);
    if (o->absolute || cut_word(text, " relative", number)) return true;
    snprintf(number, SHORT, "%s", text);
    return strlen(text) < SHORT;
}

/* Reads "1e-3:1e-12", or one number. */
static bool read_accuracies(options *o, options_range *r, const char *text, motus_error *inner)
{
    char number[SHORT];
    if (!read_unit(o, text, number)) return false;
    char *colon = strchr(number, ':');
    if (colon) *colon = 0;
    return read_above(number, &r->coarsest, inner) && read_above(colon ? colon + 1 : number, &r->finest, inner);
}

static bool is_choice(const option *row, const char *word)
{
    const size_t length = strlen(word);
    for (const char *s = row->choices; *s; s += strspn(s, " ")) {
        const size_t n = strcspn(s, " ");
        if (n == length && strncmp(s, word, n) == 0) return true;
        s += n;
    }
    return false;
}

/* What the value of a kind must be, unless it is any text. */
static const char *const wanted[] = {
    [NUMBER] = "a number",
    [POSITIVE] = "a number above 0",
    [LENGTH] = "a number above 0",
    [TOLERANCE] = "a number above 0, or one as \"1e-6 absolute\"",
    [ACCURACIES] = "a range of numbers above 0, as 1e-3:1e-12",
    [COUNT] = "an integer above 0",
    [SEED] = "an integer, 0 or above",
    [EVERY] = "a time above 0, or a count as \"10 steps\"",
    [STATES] = "a time with its unit, 10min, 90s, 2h, or a count as \"1e6 steps\"",
    [NAMED] = "NAME=VALUE",
    [TEXTS] = NULL,
};

/* Returns false if the value is not what its kind wants, or if memory runs out (`inner`). */
static bool store(options *o, const option *row, const char *value, motus_error *inner)
{
    void *place = (char *)o + row->place;
    char number[SHORT];
    switch (row->kind) {
    case FLAG: return *(bool *)place = true;
    case CHOICE:
    case WORD: *(const char **)place = value; return true;
    case NUMBER: return read_number(value, place, inner);
    case POSITIVE:
    case LENGTH: return read_above(value, place, inner);
    case TOLERANCE: return read_unit(o, value, number) && read_above(number, place, inner);
    case ACCURACIES: return read_accuracies(o, place, value, inner);
    case COUNT: return read_count(value, place, inner);
    case SEED: return typed_seed(value, place) || read_count(value, place, inner);
    case EVERY: return read_every(place, value, inner);
    case STATES: return read_states(place, value, inner);
    case NAMES: words_free(place); return !words_part(value, row->name, place, inner);
    case NAMED: return strchr(value, '=') && value[0] != '=' && !words_add(place, value, inner);
    case TEXTS: return !words_add(place, value, inner);
    }
    return false;
}

motus_status options_value(options *o, size_t k, const char *value, motus_error *err)
{
    const option *row = options_row(k);
    motus_error inner = motus_default_error();
    o->given[k] = value;
    if (row->kind != FLAG && row->kind <= CHOICE && !*value)
        return fail(err, MOTUS_ARGUMENT, "%s: its value is empty", row->name);
    if (row->kind == CHOICE && !is_choice(row, value)) {
        fail(err, MOTUS_ARGUMENT, "%s %s: unknown value", row->name, value);
        hint(err, "write one of: %s", row->choices);
        return MOTUS_ARGUMENT;
    }
    if (store(o, row, value, &inner)) return MOTUS_OK;
    if (inner.status == MOTUS_MEMORY || !wanted[row->kind]) {
        *err = inner;
        return inner.status;
    }
    fail(err, MOTUS_ARGUMENT, "%s %s: this is not %s", row->name, value, wanted[row->kind]);
    if (inner.hint[0])
        hint(err, "%s", inner.hint);
    else
        options_hint(row, err);
    return MOTUS_ARGUMENT;
}
