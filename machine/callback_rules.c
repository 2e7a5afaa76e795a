/* The events of a callback as rules. */
#include "machine/machine.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static int values(void *ctx, double t, double *x, double *v, double *out)
{
    calling *c = ctx;
    const int returned = c->def->event_functions(c->def->context, t, x, v, out);
    if (returned) c->returned = returned;
    for (size_t k = 0; k < c->def->event_count; k++)
        if (c->own_events[k].every > 0) out[k] = NAN; /* no function of its own */
    return returned;
}

static int act(void *ctx, size_t rule, size_t instance, double t, double *x, double *v, bool *in_v, size_t *which)
{
    calling *c = ctx;
    const motus_callback_def *def = c->def;
    (void)instance;
    const int returned = def->event_action(def->context, rule, t, x, v);
    if (returned) c->returned = returned;
    for (size_t k = 0; !returned && k < def->positions + def->first_order; k++) {
        const bool in_x = k < def->positions && !isfinite(x[k]);
        if (!in_x && isfinite(v[k])) continue;
        *in_v = !in_x, *which = k;
        return 1;
    }
    return returned;
}

static void name(void *ctx, size_t rule, size_t instance, char *out, size_t size)
{
    const calling *c = ctx;
    (void)instance;
    snprintf(out, size, "%s", c->rule_names[rule]);
}

static motus_status check(const motus_callback_def *def, size_t k, motus_error *err)
{
    const motus_event_def *e = &def->events[k];
    if (e->direction < -1 || e->direction > 1)
        return fail(err, MOTUS_ARGUMENT, "the direction of event %zu is 1, -1 or 0, not %d", k + 1, e->direction);
    if (!isfinite(e->every) || e->every < 0)
        return fail(err, MOTUS_ARGUMENT, "event %zu happens every T > 0 or not by the clock, 0; not %g", k + 1,
                    e->every);
    if (e->stop < 0) return fail(err, MOTUS_ARGUMENT, "event %zu stops after %lld events", k + 1, (long long)e->stop);
    if (e->every == 0 && !def->event_functions)
        return fail(err, MOTUS_ARGUMENT, "event %zu needs the callback event_functions", k + 1);
    if (e->assigns && !def->event_action)
        return fail(err, MOTUS_ARGUMENT, "event %zu needs the callback event_action", k + 1);
    if (e->name && strlen(e->name) >= MOTUS_NAME_MAX)
        return fail(err, MOTUS_ARGUMENT, "the name of event %zu has more than %d bytes", k + 1, MOTUS_NAME_MAX - 1);
    return MOTUS_OK;
}

motus_status callback_rules(calling *c, arena *a, const rules **out, motus_error *err)
{
    const motus_callback_def *def = c->def;
    const size_t n = def->event_count;
    *out = NULL;
    if (n == 0) return MOTUS_OK;
    if (n > RULES_MOST) return fail(err, MOTUS_LIMIT, "at most %d events fit", RULES_MOST);
    motus_event_def *own = arena_room(a, n * sizeof *own);
    rules *made = arena_room(a, sizeof *made);
    rule *each = arena_room(a, n * sizeof *each);
    c->rule_names = arena_room(a, n * sizeof *c->rule_names);
    if (!own || !made || !each || !c->rule_names) return fail(err, MOTUS_MEMORY, "no memory for the events");
    for (size_t k = 0; k < n; k++) {
        const motus_event_def *e = &def->events[k];
        char number[MOTUS_NAME_MAX];
        const motus_status status = check(def, k, err);
        if (status) return status;
        snprintf(number, sizeof number, "event%zu", k + 1);
        const char *text = e->name ? e->name : number;
        c->rule_names[k] = arena_text(a, text, strlen(text));
        if (!c->rule_names[k]) return fail(err, MOTUS_MEMORY, "no memory for the events");
        for (size_t j = 0; j < k; j++)
            if (!strcmp(c->rule_names[j], c->rule_names[k]))
                return fail(err, MOTUS_ARGUMENT, "two events have the name %s", c->rule_names[k]);
        each[k] = (rule){.name = c->rule_names[k],
                         .kind = e->every > 0 ? RULE_CLOCK : RULE_ROOT,
                         .direction = e->direction,
                         .first = k,
                         .leaves = 1,
                         .instances = 1,
                         .period = e->every,
                         .records = !e->silent,
                         .assigns = e->assigns != 0,
                         .stop = e->stop};
    }
    memcpy(own, def->events, n * sizeof *own);
    c->own_events = own;
    *made = (rules){.ctx = c,
                    .rule = each,
                    .count = n,
                    .functions = def->event_functions ? n : 0,
                    .values = values,
                    .act = act,
                    .name = name};
    *out = made;
    return MOTUS_OK;
}
