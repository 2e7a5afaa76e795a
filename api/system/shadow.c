/* The shadow of a system. See system.h.
 *
 * Invariant: system and shadow have equal columns and equal places in x and v.
 */
#include "api/system/system.h"

#include "api/system/parameters.h"
#include "lang/model/vary.h"

#include <math.h>
#include <string.h>

static motus_status give_numbers(const motus_system *from, motus_system *to, const char *name, bool parameter, size_t k,
                                 size_t count, motus_error *err)
{
    parameters_target t;
    motus_status status = parameters_find(to, name, &t, err);
    if (status != MOTUS_OK || !from->model->overridden[t.first]) return status;
    double *numbers = take(&from->allocator, count + 1, sizeof *numbers);
    if (!numbers) return fail(err, MOTUS_MEMORY, "no memory for the numbers of %s", name);
    status = parameter ? motus_parameter_values(from, k, numbers) : motus_initial_values(from, k, numbers);
    if (status == MOTUS_OK) status = motus_system_set(to, name, numbers, count, err);
    give(&from->allocator, numbers);
    return status;
}

motus_status shadow_numbers(const motus_system *from, motus_system *to, motus_error *err)
{
    motus_parameter p = motus_default_parameter();
    motus_initial i = motus_default_initial();
    motus_status status = MOTUS_OK;
    if (!from->model->overridden) return status;
    for (size_t k = 0; status == MOTUS_OK && motus_parameter_at(to, k, &p) == MOTUS_OK; k++)
        status = give_numbers(from, to, p.name, true, k, p.count, err);
    for (size_t k = 0; status == MOTUS_OK && motus_initial_at(to, k, &i) == MOTUS_OK; k++)
        status = give_numbers(from, to, i.name, false, k, i.count, err);
    return status;
}

/* A parameter that was rounded when it was computed, such as a long sum, may have the same number in system and shadow;
 * its number in the shadow moves to the next double. A parameter that depends on decimals or on moved parameters stays:
 * the direction of its rounding is not known, and the two changes must not cancel. */

enum {
    PARAMETERS_MAX = 256
}; /* in a model with more parameters none is moved, since each is compared with all
                                * others */

static bool in_name(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c & 0x80;
}

static bool mentions(const motus_parameter *p, const char *name)
{
    const size_t length = strlen(name);
    for (size_t at = 0; at + length <= p->length; at++)
        if (!memcmp(p->text + at, name, length) && !(at && in_name(p->text[at - 1])) &&
            !(at + length < p->length && in_name(p->text[at + length])))
            return true;
    return false;
}

/* Reads a number: value[0] in the system, value[1] in the shadow. */
static motus_status value_of(const motus_system *s, const motus_system *shadow, size_t k, double value[2])
{
    motus_status status = motus_parameter_values(s, k, &value[0]);
    return status == MOTUS_OK ? motus_parameter_values(shadow, k, &value[1]) : status;
}

/* Returns whether the text of a parameter has no decimals, no pi, and only parameters with one number in system and
 * shadow. */
static bool stands_alone(const motus_system *s, const motus_system *shadow, const motus_parameter *p)
{
    motus_parameter other = motus_default_parameter();
    double value[2];
    if (memchr(p->text, '.', p->length) || mentions(p, "pi")) return false;
    for (size_t k = 0; motus_parameter_at(s, k, &other) == MOTUS_OK; k++)
        if (mentions(p, other.name) &&
            (other.count != 1 || value_of(s, shadow, k, value) != MOTUS_OK || value[0] != value[1]))
            return false;
    return true;
}

/* Returns whether a number uses all of its bits. One in 4096 rounded numbers ends in ZEROS zeros and is taken for
 * exact. */
static bool is_full(double number)
{
    enum { ZEROS = 12 };
    uint64_t bits;
    memcpy(&bits, &number, sizeof bits);
    return bits & ((1u << ZEROS) - 1);
}

/* Returns whether a number follows from what a caller changes. */
static bool changes(const motus_system *s, const uint8_t *affected, const char *name)
{
    parameters_target t;
    return affected && parameters_find(s, name, &t, NULL) == MOTUS_OK && affected[t.first];
}

static motus_status move_rounded(const motus_system *s, const uint8_t *affected, motus_system *shadow, motus_error *err)
{
    motus_parameter p = motus_default_parameter();
    double value[2];
    motus_status status = MOTUS_OK;
    if (motus_parameter_count(s) > PARAMETERS_MAX) return status;
    for (size_t k = 0; status == MOTUS_OK && motus_parameter_at(s, k, &p) == MOTUS_OK; k++) {
        if (p.count != 1 || p.decides || changes(s, affected, p.name) || value_of(s, shadow, k, value) != MOTUS_OK)
            continue;
        if (value[0] != value[1] || !is_full(value[0]) || !stands_alone(s, shadow, &p)) continue;
        const double next = nextafter(value[1], INFINITY);
        status = motus_system_set(shadow, p.name, &next, 1, err);
    }
    return status;
}

static bool alike(const motus_system *a, const motus_system *b)
{
    return a->problem.nx == b->problem.nx && a->problem.nv == b->problem.nv && a->column_count == b->column_count &&
           a->model->pool_count == b->model->pool_count && a->state_count == b->state_count;
}

motus_status shadow_create(const motus_system *s, const uint8_t *affected, motus_system **out, motus_error *err)
{
    *out = NULL;
    if (!s->model) return motus_system_clone(s, out, err);
    motus_error ours = motus_default_error();
    uint8_t *varied = NULL;
    if (!vary_changed(s->model, affected, &s->allocator, &varied))
        return fail(err, MOTUS_MEMORY, "no memory for the shadow of a system");
    motus_status status = system_again(s, true, varied, out, &ours);
    give(&s->allocator, varied);
    if (status == MOTUS_OK && alike(s, *out)) status = move_rounded(s, affected, *out, &ours);
    if (status == MOTUS_OK && alike(s, *out)) status = shadow_numbers(s, *out, &ours);
    if (status == MOTUS_OK && alike(s, *out)) {
        (*out)->problem.traits = s->problem.traits; /* so that it admits the methods of the system */
        return MOTUS_OK;
    }
    motus_system_destroy(*out);
    *out = NULL;
    return status == MOTUS_MEMORY ? fail(err, status, "%s", ours.message) : motus_system_clone(s, out, err);
}
