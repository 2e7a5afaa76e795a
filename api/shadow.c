/* The shadow of a system. See shadow.h.
 *
 * Invariant: the shadow has the same columns and the same places in x and v.
 */
#include "api/shadow.h"

#include "api/parameters.h"

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

/* The numbers that were set; what depends on them is computed from the shadow's own. */
static motus_status take_over(const motus_system *from, motus_system *to, motus_error *err)
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

static bool alike(const motus_system *a, const motus_system *b)
{
    return a->problem.nx == b->problem.nx && a->problem.nv == b->problem.nv && a->column_count == b->column_count &&
           a->model->pool_count == b->model->pool_count && a->state_count == b->state_count;
}

motus_status shadow_create(const motus_system *s, motus_system **out, motus_error *err)
{
    *out = NULL;
    if (!s->model) return motus_system_clone(s, out, err);
    motus_error ours = motus_default_error();
    motus_status status = system_read(&s->text, true, out, &ours);
    if (status == MOTUS_OK && alike(s, *out)) status = take_over(s, *out, &ours);
    if (status == MOTUS_OK && alike(s, *out)) {
        (*out)->problem.traits = s->problem.traits; /* so that it admits the same methods */
        return MOTUS_OK;
    }
    motus_system_destroy(*out);
    *out = NULL;
    return status == MOTUS_MEMORY ? fail(err, status, "%s", ours.message) : motus_system_clone(s, out, err);
}
