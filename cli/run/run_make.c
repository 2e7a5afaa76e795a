/* See run_make.h. */
#include "cli/run/run_make.h"

#include "cli/words/complain.h"
#include "cli/model/settle.h"

#include <math.h>

/* Which of step and end must be known: a step where a method is named whose steps have one size, and no accuracy. */
static int settled(const load *m, const options *o)
{
    motus_settings set = motus_default_settings();
    motus_settings_of(m->system, &set);
    const bool own = !o->method && isnan(o->accuracy); /* what the model says of its method counts */
    const char *const name = o->method ? o->method : own ? set.method : NULL;
    const motus_method *card = NULL;
    if (!isnan(settle_accuracy(m, o)) || !name || motus_method_find(name, &card, NULL) != MOTUS_OK) return SETTLE_UNTIL;
    return card->adaptive ? SETTLE_UNTIL : SETTLE_STEP | SETTLE_UNTIL;
}

motus_run_def run_make_asked(const options *o)
{
    motus_run_def def = motus_default_run();
    def.method = o->method;
    def.step = o->step;
    def.tolerance = o->tolerance;
    def.accuracy = o->accuracy;
    def.absolute = o->absolute;
    def.shortest_step = o->shortest_step;
    def.longest_step = o->longest_step;
    def.most_steps = o->most_steps;
    def.switches = options_switches(o);
    def.machine = o->machine ? o->machine : "auto";
    def.threads = (int)o->threads;
    return def;
}

motus_status run_make(const options *o, load *m, stop_progress *progress, motus_bars error, motus_run_def *def,
                      motus_run **run, motus_error *err)
{
    *def = run_make_asked(o);
    motus_status status = settle_timing(m, o, settled(m, o), o->method, NULL, err);
    if (status) return status;
    def->step = m->step;
    def->until = m->until;
    def->progress = stop_progress_hook;
    def->context = progress;
    def->error = error;
    status = motus_run_create(m->system, def, run, err);
    if (status || o->quiet) return status;
    if (motus_run_note(*run)[0]) complain_note("the interpreter runs this: %s", motus_run_note(*run));
    if (motus_run_not_located(*run)[0]) complain_note("%s", motus_run_not_located(*run));
    if (motus_run_cut(*run)[0]) complain_note("%s", motus_run_cut(*run));
    return MOTUS_OK;
}

walk_observer run_make_rows(const options *o, const load *m, const motus_run *run)
{
    motus_settings settings = motus_default_settings();
    motus_settings_of(m->system, &settings);
    walk_observer w = {.errors = o->errors};
    const bool ours = o->every.time > 0 || o->every.steps > 0;
    const double period = ours ? o->every.time : settings.every_time > 0 ? settings.every_time : 0;
    const int64_t steps = ours ? o->every.steps : settings.every_steps;
    w.stride = steps > 0 ? steps : period > 0 ? walk_steps_of_run(run, period) : 1;
    w.period = w.stride > 0 ? 0 : period;
    return w;
}
