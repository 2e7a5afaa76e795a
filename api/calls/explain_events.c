/* The events of a system in words: what each waits for and does, the modes that events assign, and the conditions that
 * already hold at the start, which are no events. */
#include "api/calls/explain.h"
#include "api/system/system.h"

#include <math.h>

enum { TARGETS_SHOWN = 8, HOLDING_SHOWN = 8, OCCASION = 200 };

/* Says what a rule does: "; it is a family of events; it assigns x[i]', n; it keeps 3 numbers; it is recorded; the run
 * stops at number 10". */
static void say_deeds(sentences *w, const model *m, const model_rule *r)
{
    size_t kept = 0, shown = 0;
    char name[MOTUS_NAME_MAX + 96];
    if (r->own) sentences_say(w, "; it is a family of events");
    for (size_t k = 0; k < r->assignments; k++) {
        if (r->assignment[k].kept) {
            kept++;
            continue;
        }
        if (shown++ == TARGETS_SHOWN) sentences_say(w, " …");
        if (shown > TARGETS_SHOWN) continue;
        model_reference_name(m, &r->assignment[k].to, name, sizeof name);
        sentences_say(w, "%s %s", shown == 1 ? "; it assigns" : ",", name);
    }
    if (kept) sentences_say(w, "; it keeps %zu number%s", kept, kept == 1 ? "" : "s");
    if (r->records) sentences_say(w, "; it is recorded");
    if (r->stop == 1) sentences_say(w, "; the run stops there");
    if (r->stop > 1) sentences_say(w, "; the run stops at number %lld", (long long)r->stop);
    sentences_say(w, "\n");
}

/* Says what a rule is. period: of a clock, by the numbers of the system. */
static void say_rule(sentences *w, const model *m, const model_rule *r, double period)
{
    char occasion[OCCASION];
    source_excerpt(&m->source, &r->occasion, occasion, sizeof occasion);
    switch (r->kind) {
    case RULE_ROOT:
        sentences_say(w, "%s happens when %s%s", r->name, occasion,
                      r->direction > 0   ? ", rising"
                      : r->direction < 0 ? ", falling"
                                         : "");
        break;
    case RULE_CONDITION: sentences_say(w, "%s happens when %s becomes true", r->name, occasion); break;
    case RULE_CLOCK: sentences_say(w, "%s happens every %.17g, from the start on", r->name, period); break;
    default: sentences_say(w, "%s happens where the events of %s accumulate", r->name, m->rules[r->of].name);
    }
    say_deeds(w, m, r);
}

static void say_modes(sentences *w, const motus_system *s)
{
    const model *m = s->model;
    for (uint32_t i = 0; i < s->definition_count; i++) {
        const model_definition *d = &s->definitions[i];
        const model_state *mode = d->mode ? &m->states[d->mode - 1] : NULL;
        if (!mode) continue;
        sentences_say(w, "%s is a mode: events assign this parameter", d->name);
        if (model_numbers(mode) == 1) sentences_say(w, "; at the start it is %.17g", s->x0[mode->base]);
        sentences_say(w, mode->kept ? ". Neither the force nor an event depends on it\n" : "\n");
    }
}

/* Finds the signs of the functions at the start: 0 where rounding may hide the sign, 2 where there is no number. */
static bool signs_at_start(const motus_system *s, const rules *r, int8_t *sign)
{
    const size_t nx = s->problem.nx, nv = s->problem.nv;
    double *room = take(&s->allocator, nx + nv + 2 * r->functions + 1, sizeof *room);
    if (!room) return false;
    double *x = room, *v = x + nx, *g = v + nv, *bound = g + r->functions;
    for (size_t k = 0; k < nx; k++) x[k] = s->x0[k];
    for (size_t k = 0; k < nv; k++) v[k] = s->v0[k];
    r->values(r->ctx, s->start, x, v, g);
    r->rounding(r->ctx, s->start, x, v, bound);
    for (size_t f = 0; f < r->functions; f++)
        sign[f] = isnan(g[f]) ? 2 : fabs(g[f]) <= bound[f] ? 0 : g[f] > 0 ? 1 : -1;
    give(&s->allocator, room);
    return true;
}

static void say_start(sentences *w, const motus_system *s, const rules *r)
{
    int8_t *sign = take(&s->allocator, r->functions + 1, 1);
    if (!sign || !signs_at_start(s, r, sign)) w->failed = true;
    for (size_t k = 0, shown = 0; !w->failed && k < r->count; k++) {
        const rule *one = &r->rule[k];
        for (size_t i = 0; i < one->instances && shown <= HOLDING_SHOWN; i++) {
            char name[MOTUS_NAME_MAX + 96];
            const bool root = one->kind == RULE_ROOT && sign[one->first + i] == 0;
            const bool holds = one->kind == RULE_CONDITION && sign[one->first + i] != 2 && rules_hold(one, i, sign);
            if (!root && !holds) continue;
            r->name(r->ctx, k, i, name, sizeof name);
            if (shown++ == HOLDING_SHOWN)
                sentences_say(w, "there are more events whose occasion holds at the start\n");
            else
                sentences_say(w,
                              root ? "at the start both sides of %s are equal, which is no event\n"
                                   : "at the start the condition of %s holds, which is no event\n",
                              name);
        }
    }
    give(&s->allocator, sign);
}

const char *motus_explain_events(motus_system *s)
{
    const rules *r;
    if (!s) return "";
    give(&s->allocator, s->events_text);
    s->events_text = NULL;
    if (!s->model || s->model->rule_count == 0) return "";
    modes m = modes_enter();
    sentences w = {.allocator = &s->allocator};
    if (system_rules(s, &r, NULL) == MOTUS_OK) {
        for (uint32_t k = 0; k < s->model->rule_count; k++)
            say_rule(&w, s->model, &s->model->rules[k], r->rule[k].period);
        if (cuts_by_state(s) && symmetry_gradient(s) && s->problem.traits.gradient)
            sentences_say(&w, "the state decides where an event that assigns ends a step: by a symplectic method that "
                              "step is not symplectic, while those between are\n");
        say_modes(&w, s);
        say_start(&w, s, r);
    }
    modes_leave(m);
    if (w.failed) { /* a part of the text would mislead */
        give(&s->allocator, w.text);
        w.text = NULL;
    }
    s->events_text = w.text;
    return w.text ? w.text : "";
}
