/* The library's stepper in an engine's clothes. See stepping.h. */
#include "machine/stepping.h"

static stepper *of(engine *e) { return (stepper *)e; }
static const stepper *seen(const engine *e) { return (const stepper *)e; }

motus_status stepping_open(const problem *p, const chosen *c, double t0, double h, const double *x, const double *v, const motus_allocator *a, engine **out,
                           motus_error *err)
{
    stepper *s = NULL;
    motus_status status = stepper_create(p, c, t0, h, x, v, a, &s, err);
    *out = (engine *)s;
    return status;
}

void stepping_close(engine *e) { stepper_destroy(of(e)); }
motus_status stepping_advance(engine *e, int64_t steps, motus_error *err) { return stepper_advance(of(e), steps, err); }
motus_status stepping_trace(engine *e, const tracer *to, motus_error *err) { return stepper_trace(of(e), to, err); }
motus_status stepping_sync(engine *e, double *x, double *v, double *a, motus_error *err) { return stepper_sync(of(e), x, v, a, err); }
int64_t stepping_steps(const engine *e) { return stepper_steps(seen(e)); }
int64_t stepping_evaluations(const engine *e) { return stepper_evaluations(seen(e)); }
int64_t stepping_iterations(const engine *e) { return stepper_iterations(seen(e)); }
size_t stepping_carry(const engine *e) { return stepper_carry(seen(e)); }
void stepping_save(const engine *e, double *carry) { stepper_save(seen(e), carry); }

motus_status stepping_load(engine *e, int64_t step, int64_t evaluations, int64_t iterations, const double *carry, motus_error *err)
{
    return stepper_load(of(e), step, evaluations, iterations, carry, err);
}
