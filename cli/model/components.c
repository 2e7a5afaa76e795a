/* --set for one component of a vector or family. See load.h.
 *
 * Invariant: components of parameters are set before those of initial values, so that no parameter changes an initial
 * value that was set.
 */
#include "cli/model/load.h"

#include "cli/words/complain.h"
#include "cli/words/words.h"

#include <stdlib.h>
#include <string.h>

enum { NAME = 2 * MOTUS_NAME_MAX };

/* Returns the length of NAME in NAME=VALUE or NAME(start)=VALUE. */
static size_t name_length(const char *item) { return strcspn(item, "=("); }

bool components_are(const char *item) { return memchr(item, '.', name_length(item)) != NULL; }

static motus_status unknown(const char *item, motus_error *err)
{
    return complain(err, MOTUS_NAME, "write \"r.x(0)=1\", \"r'.y(0)=1\" or g.x=1",
                    "--set %s: the model has no such component", item);
}

/* Sets a parameter or an initial value to its `numbers`, with `value` in place `at`. */
static motus_status set_one(motus_system *s, const char *name, size_t count, size_t at, double value, double *numbers,
                            motus_error *err)
{
    numbers[at] = value;
    return motus_system_set(s, name, numbers, count, err);
}

/* Reads x, y, z or 1, 2, …, with blanks after it. Returns the place, from 0; SIZE_MAX: it is none of them. */
static size_t place(const char *letter, size_t length)
{
    while (length > 0 && letter[length - 1] == ' ') length--;
    if (length == 1 && *letter >= 'x' && *letter <= 'z') return (size_t)(*letter - 'x');
    char digits[16];
    if (length == 0 || length >= sizeof digits || strspn(letter, "0123456789") < length || *letter == '0')
        return SIZE_MAX;
    snprintf(digits, sizeof digits, "%.*s", (int)length, letter);
    return (size_t)strtoul(digits, NULL, 10) - 1;
}

static motus_status set_parameter(motus_system *s, const char *item, double value, motus_error *err)
{
    const char *dot = memchr(item, '.', name_length(item));
    const size_t length = (size_t)(dot - item), at = place(dot + 1, name_length(item) - length - 1);
    for (size_t k = 0; k < motus_parameter_count(s); k++) {
        motus_parameter p = motus_default_parameter();
        motus_parameter_at(s, k, &p);
        if (strlen(p.name) != length || memcmp(p.name, item, length) || p.list || at >= p.count) continue;
        double *numbers = malloc(p.count * sizeof *numbers);
        if (!numbers) return complain_memory(err);
        motus_parameter_values(s, k, numbers);
        const motus_status status = set_one(s, p.name, p.count, at, value, numbers, err);
        free(numbers);
        return status;
    }
    return unknown(item, err);
}

/* Sets a component of an initial value. Its place is that of the column, since both have one order. */
static motus_status set_initial(motus_system *s, const char *item, double value, motus_error *err)
{
    char name[NAME];
    const size_t length = name_length(item);
    const char *close = strchr(item, ')');
    size_t first, count;
    snprintf(name, sizeof name, "%.*s", (int)length, item);
    if (length >= sizeof name || !close || motus_column_find(s, name, &first, &count, NULL) != MOTUS_OK || count != 1)
        return unknown(item, err);
    for (size_t k = 0; k < motus_initial_count(s); k++) {
        motus_initial i = motus_default_initial();
        size_t begin, all;
        motus_initial_at(s, k, &i);
        const size_t bare = name_length(i.name);
        snprintf(name, sizeof name, "%.*s", (int)bare, i.name);
        if (strncmp(i.name + bare, item + length, (size_t)(close - item) + 1 - length) ||
            motus_column_find(s, name, &begin, &all, NULL) != MOTUS_OK || first < begin || first >= begin + all)
            continue;
        double *numbers = malloc(i.count * sizeof *numbers);
        if (!numbers) return complain_memory(err);
        motus_initial_values(s, k, numbers);
        const motus_status status = set_one(s, i.name, i.count, first - begin, value, numbers, err);
        free(numbers);
        return status;
    }
    return unknown(item, err);
}

motus_status components_set(motus_system *s, const options_list *set, motus_error *err)
{
    for (int initial = 0; initial < 2; initial++)
        for (size_t k = 0; k < set->count; k++) {
            const char *item = set->items[k], *equals = strchr(item, '=');
            if (!components_are(item) || (item[name_length(item)] == '(') != initial) continue;
            char where[NAME];
            double value;
            snprintf(where, sizeof where, "--set %.*s", (int)(equals - item), item);
            motus_status status = typed_constant(equals + 1 + strspn(equals + 1, " "), where, &value, err);
            if (!status) status = (initial ? set_initial : set_parameter)(s, item, value, err);
            if (status) return status;
        }
    return MOTUS_OK;
}
