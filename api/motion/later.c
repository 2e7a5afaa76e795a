/* See later.h. */
#include "api/motion/later.h"

#include "api/motion/run_events.h"
#include "api/request/choice.h"

#include <math.h>

#define FIRST_LOOK 0.02 /* a run of unknown length considers compiling after this part of a compiler's work */
#define LEFT 1.0        /* part of a compiler's work that has to be left for compiling to pay */
#define SECONDS 5e-4    /* between two looks for the object */
/* The longer text makes a step up to two fifths faster, and takes a compiler up to three times as long. A compiled run
 * considers it after this many times the first compiler's work, some 0.2 seconds, and this much has to be left, some 2
 * seconds. */
#define LONGER_LOOK 2.0
#define LONGER_LEFT 20.0
#define EVENT_STEPS 16 /* steps that take as long as an event with its actions */

/* Counts steps in all legs. */
static int64_t steps_of(const motus_run *r) { return r->before + run_steps(r); }

/* Lets the run consider compiling after this part of a compiler's work. */
static void consider_after(motus_run *r, double work)
{
    const double steps = ceil(work / choice_worth(r->system, &r->chosen, r->card, 1));
    r->later.considers = true;
    r->later.when = r->later.look = (r->stepper ? steps_of(r) : 0) + (int64_t)fmin(steps, 0x1p60);
}

/* Lets a run that goes on compiled consider the longer text, if its object has one. */
static void expect_longer(motus_run *r)
{
    if (compiled_longer(r->system->compiled, &r->chosen))
        consider_after(r, r->rules ? LONGER_LOOK / EVENT_STEPS : LONGER_LOOK);
}

motus_status later_choose(motus_run *r, const char *wanted, double steps, motus_error *err)
{
    motus_system *s = r->system;
    bool automatic, compiled;
    r->machine = s->machine;
    r->note = "";
    r->compiled_from = -1;
    motus_status status = choice_machine(wanted, &automatic, &compiled, err);
    if (status != MOTUS_OK || !s->model || !compiled || (automatic && !compiled_anywhere())) return status;
    if (!row_adaptive(&r->chosen)) steps = (double)r->timing.total;
    /* A run of unknown length uses an object that is already there. */
    const double worth = steps > 0 ? choice_worth(s, &r->chosen, r->card, steps) : CHOICE_KEPT;
    if (automatic && worth < CHOICE_KEPT) return MOTUS_OK;
    compiled_state state;
    const char *why;
    r->later.automatic = automatic && worth >= 1;
    r->kept = automatic && worth < 1;
    if (r->later.automatic) {
        status = choice_begin(s, &r->chosen, &state, &r->machine, &why, err);
    } else {
        status = choice_compile(s, &r->chosen, !automatic, r->kept, &r->machine, &why, err);
        state = why ? COMPILED_FAILED : COMPILED_READY;
    }
    if (status != MOTUS_OK) return status;
    if (state == COMPILED_READY) r->compiled_from = 0;
    if (state == COMPILED_FAILED && !r->kept) r->note = why;
    r->later.waits = state == COMPILED_WAIT;
    if (state == COMPILED_FAILED && r->kept && !(steps > 0)) consider_after(r, FIRST_LOOK);
    if (r->later.waits) later_hurry(r);
    if (state == COMPILED_READY) expect_longer(r);
    return status;
}

int64_t later_room(const motus_run *r)
{
    const later *l = &r->later;
    if (!compiled_anywhere()) return INT64_MAX;
    if (l->exactly) return l->exactly - steps_of(r);
    return l->look ? l->look - steps_of(r) : INT64_MAX;
}

void later_hurry(motus_run *r)
{
    if (!compiled_anywhere()) return;
    r->later.piece = 1;
    r->later.looked = pace_now();
    r->later.look = (r->stepper ? steps_of(r) : 0) + 1;
}

/* Moves the run to the machine m. Without memory for that the run goes on where it is. */
static motus_status go_over(motus_run *r, const machine *m, motus_error *err)
{
    motus_error why = motus_default_error();
    motus_status status = stepper_move(&r->stepper, m, &why);
    if (status == MOTUS_MEMORY) {
        r->note = "there is no memory to go on compiled";
        return MOTUS_OK;
    }
    if (status != MOTUS_OK) {
        if (err) motus_struct_write(MOTUS_DEF_ERROR, &why, err);
        return status;
    }
    r->machine = *m;
    if (r->events) events_move(r->events, m);
    if (r->compiled_from < 0) r->compiled_from = steps_of(r);
    r->kept = false;
    r->synchronised = false;
    expect_longer(r);
    return r->company ? r->company->compile(r, err) : MOTUS_OK;
}

static motus_status take_object(motus_run *r, compiled_state state, const machine *m, const char *why, motus_error *err)
{
    r->later.waits = state == COMPILED_WAIT;
    if (state == COMPILED_FAILED && !r->chosen.written) r->note = why;
    if (state == COMPILED_FAILED) r->chosen.written = false;
    return state == COMPILED_READY ? go_over(r, m, err) : MOTUS_OK;
}

/* Returns whether the run or its company waits for an object. */
static bool waits(const motus_run *r) { return r->later.waits || (r->company && r->company->waits(r)); }

/* Returns whether the work that is left repays a compiler. */
static bool repays(const motus_run *r, bool longer)
{
    const double all = r->timing.until - r->timing.t0;
    const double part = (stepper_time(r->stepper) - r->timing.t0) / all;
    const double steps = (double)run_steps(r) + EVENT_STEPS * (double)run_events_acted(r);
    const double done = choice_worth(r->system, &r->chosen, r->card, steps) * (r->company ? 3 : 1);
    return done * (1 - part) >= (longer ? LONGER_LEFT : LEFT) * part;
}

static motus_status consider(motus_run *r, motus_error *err)
{
    const char *why = NULL;
    compiled_state state;
    machine m;
    const bool longer = r->compiled_from >= 0;
    r->later.when += r->later.when;
    if (!r->later.exactly && !repays(r, longer)) return MOTUS_OK;
    r->later.considers = false;
    r->later.automatic = r->later.automatic || !longer;
    r->chosen.written = longer;
    motus_status status = choice_begin(r->system, &r->chosen, &state, &m, &why, err);
    if (status == MOTUS_OK) status = take_object(r, state, &m, why, err);
    if (r->later.waits) later_hurry(r);
    return status;
}

static motus_status look(motus_run *r, motus_error *err)
{
    const char *why = NULL;
    compiled_state state = COMPILED_WAIT;
    machine m;
    motus_status status = MOTUS_OK;
    if (r->later.waits) {
        status = choice_look(r->system, &r->chosen, &state, &m, &why, err);
        r->later.waits = r->later.waits && state == COMPILED_WAIT;
        if (status == MOTUS_OK) status = take_object(r, state, &m, why, err);
    }
    return status == MOTUS_OK && r->company ? r->company->look(r, err) : status;
}

/* Plans the next look after steps that take about SECONDS. */
static void look_again(motus_run *r)
{
    later *l = &r->later;
    const double now = pace_now(), took = now - l->looked;
    if (took < SECONDS / 2)
        l->piece *= 2;
    else if (took > 2 * SECONDS && l->piece > 1)
        l->piece /= 2;
    if (waits(r)) beside_rest(&l->beside);
    l->looked = pace_now();
    l->look = waits(r) ? steps_of(r) + l->piece : l->considers ? l->when : 0;
}

motus_status later_look(motus_run *r, motus_error *err)
{
    later *l = &r->later;
    const bool considers = l->considers && !waits(r) && (l->exactly || steps_of(r) >= l->when);
    motus_status status = considers ? consider(r, err) : look(r, err);
    while (l->exactly && status == MOTUS_OK && waits(r)) {
        compiled_nap();
        status = look(r, err);
    }
    l->exactly = l->considers ? l->longer : 0;
    look_again(r);
    return status;
}

void later_end(motus_run *r)
{
    if (!compiled_anywhere()) return;
    if (r->later.waits) choice_leave(r->system, &r->chosen);
    r->later = (later){.waits = false};
}

motus_status later_at(motus_run *r, int64_t step, int64_t longer, motus_error *err)
{
    later_end(r);
    r->later = (later){.considers = true, .exactly = step, .longer = longer};
    r->machine = r->system->machine;
    r->compiled_from = -1;
    return stepper_move(&r->stepper, &r->machine, err);
}
