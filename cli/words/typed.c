/* Numbers on the command line.
 *
 * Invariant: an expression that is not a plain decimal is read by the language, as an initial value of a model, so it
 * has the same meaning as in a model.
 */
#include "cli/words/typed.h"

#include "base/decimal.h"
#include "cli/words/complain.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

bool typed_decimal(const char *s, double *value)
{
    const bool negative = *s == '-';
    s += negative || *s == '+';
    const size_t length = decimal_read(s, SIZE_MAX, value);
    *value = negative ? -*value : *value;
    return length > 0 && !s[length];
}

bool typed_count(const char *s, int64_t *count, const char **rest)
{
    uint64_t n;
    size_t length = decimal_read_whole(s, SIZE_MAX, &n);
    if (length == 0) return false;
    if (s[length] == 'e' || s[length] == 'E' || s[length] == '.') {
        double d;
        length = decimal_read(s, SIZE_MAX, &d);
        if (!(d >= 1 && d < TYPED_COUNT_MAX) || d != trunc(d)) return false;
        n = (uint64_t)d;
    }
    *count = (int64_t)n;
    *rest = s + length;
    return n >= 1 && n <= INT64_MAX;
}

bool typed_seed(const char *s, uint64_t *seed)
{
    const size_t length = decimal_read_whole(s, SIZE_MAX, seed);
    return length > 0 && !s[length];
}

motus_status typed_constant(const char *expression, const char *where, double *value, motus_error *err)
{
    motus_status status = MOTUS_OK;
    motus_error inner = motus_default_error();
    if (!typed_decimal(expression, value)) { /* a decimal, the usual case, needs no model */
        static const char name[] = "x(0)=";
        size_t length = strlen(expression);
        char *set = malloc(sizeof name + length);
        if (!set) return complain_memory(err);
        memcpy(set, name, sizeof name - 1);
        memcpy(set + sizeof name - 1, expression, length + 1);
        const char *items[] = {set};
        motus_text_def text = motus_default_text();
        text.text = "x' = 0\nx(0) = 0\nstep 1\nuntil 1";
        text.set = items;
        text.set_count = 1;
        motus_system *system = NULL;
        motus_run *run = NULL;
        status = motus_system_from_text(&text, &system, &inner);
        if (!status && motus_velocities(system) != 1) {
            fail(&inner, MOTUS_SHAPE, "%s is not a single number", expression);
            status = MOTUS_SHAPE;
        }
        if (!status) status = motus_run_create(system, NULL, &run, &inner);
        if (!status) status = motus_run_state(run, NULL, value, &inner);
        motus_run_destroy(run);
        motus_system_destroy(system);
        free(set);
        if (status == MOTUS_MEMORY) return complain_memory(err);
    }
    if (!status && isfinite(*value)) return MOTUS_OK;
    fail(err, MOTUS_ARGUMENT, "%s: %s is not a constant", where, *expression ? expression : "nothing");
    if (strchr(expression, ','))
        hint(err, "numbers are written with a point: 0.5");
    else if (status && inner.message[0])
        hint(err, "%s", inner.message);
    else if (!status)
        hint(err, "its value is not finite");
    return MOTUS_ARGUMENT;
}
