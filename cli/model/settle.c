/* See settle.h.
 *
 * Invariant: the line that a note prints, added to the model, gives the same run without a note.
 */
#include "cli/model/settle.h"

#include "base/decimal.h"
#include "cli/words/complain.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define GROWN 2.0 /* powers of ten; steps that grow by more do not give the motion */

static bool suggested(motus_said who) { return who == MOTUS_SAID_SUGGESTED; }

static void note(const motus_settings *set, bool sweep)
{
    char line[128], step[DECIMAL_MAX], until[DECIMAL_MAX], why[192];
    const bool steps = suggested(set->step_said), both = steps && suggested(set->until_said);
    decimal(set->step, step);
    decimal(set->until, until);
    if (both)
        snprintf(line, sizeof line, "step %s; until %s", step, until);
    else
        snprintf(line, sizeof line, "%s %s", steps ? "step" : "until", steps ? step : until);
    if (set->rate > 0)
        snprintf(why, sizeof why, "the fastest rate of %s, %.3g, and its longest period, or time of growth, %.3g",
                 sweep ? "the motions at the ends of what varies" : "its motion", set->rate, set->period);
    else
        snprintf(why, sizeof why, "its initial values, which change in a time of %.3g", set->period);
    complain_note("the model gives no %s: motus takes %s from %s. To keep %s, add to the model:",
                  both    ? "step and no end"
                  : steps ? "step"
                          : "end",
                  both ? "them" : "it", why, both ? "them" : "it");
    fprintf(stderr, "%s\n", line);
}

/* Prints a note if the steps grow where the motion does not, which nothing else would show. */
static void judge(const load *m, const grid *sweep, size_t rows, const double *const *values)
{
    const motus_settings *set = &m->set;
    char step[DECIMAL_MAX];
    double powers = 0;
    if (isnan(set->step) || isnan(set->until)) return;
    motus_step_growth(m->system, sweep ? sweep->count : 0, sweep ? sweep->names : NULL, rows, values, set, &powers,
                      NULL);
    if (powers > GROWN)
        complain_note(
            "steps of %s by %s are too long: where %s swings or decays, they make it grow, and what is %s is not "
            "the motion. Give a smaller --step",
            decimal(set->step, step), set->method, sweep ? "a motion at the ends of what varies" : "the motion",
            sweep ? "recorded" : "printed");
}

/* Copies what was suggested to a definition. Returns whether something was. */
static bool take(const motus_settings *set, double *step, double *until)
{
    if (suggested(set->step_said)) *step = set->step;
    if (suggested(set->until_said)) *until = set->until;
    return suggested(set->step_said) || suggested(set->until_said);
}

motus_status settle_run(load *m, const options *o, motus_run_def *def, motus_error *err)
{
    const motus_status status = motus_run_settings(m->system, def, &m->set, err);
    const bool taken = !status && take(&m->set, &def->step, &def->until);
    if (status || o->quiet) return status;
    if (taken)
        note(&m->set, false);
    else if (o->error && !strcmp(o->error, "none"))
        judge(m, NULL, 1, NULL);
    return MOTUS_OK;
}

motus_status settle_sweep(load *m, const options *o, const grid *sweep, motus_ensemble_def *def, motus_error *err)
{
    double **values;
    size_t rows;
    motus_status status = grid_extremes(sweep, &values, &rows, err);
    const double *const *ends = (const double *const *)values;
    if (!status) status = motus_ensemble_settings(m->system, def, rows, ends, &m->set, err);
    const bool taken = !status && take(&m->set, &def->step, &def->until);
    if (!status && !o->quiet && taken)
        note(&m->set, true);
    else if (!status && !o->quiet && !o->errors)
        judge(m, sweep, rows, ends);
    grid_extremes_free(values);
    return status;
}

void settle_json(json *j, const load *m)
{
    json_open(j, "suggested", '{');
    if (suggested(m->set.step_said)) json_number(j, "step", m->set.step);
    if (suggested(m->set.until_said)) json_number(j, "until", m->set.until);
    json_close(j, '}');
}
