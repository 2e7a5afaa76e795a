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

#define GROWN 2.0 /* powers of ten: more is no motion any more */

static void note(const load *m, bool sweep, const motus_settings *set)
{
    char line[128], step[DECIMAL_MAX], until[DECIMAL_MAX], why[192];
    const bool both = m->suggested == (SETTLE_STEP | SETTLE_UNTIL);
    decimal(set->step, step);
    decimal(set->until, until);
    if (both)
        snprintf(line, sizeof line, "step %s; until %s", step, until);
    else
        snprintf(line, sizeof line, "%s %s", m->suggested == SETTLE_STEP ? "step" : "until",
                 m->suggested == SETTLE_STEP ? step : until);
    if (set->rate > 0)
        snprintf(why, sizeof why, "the fastest rate of %s, %.3g, and its longest period, or time of growth, %.3g",
                 sweep ? "the motions at the ends of what varies" : "its motion", set->rate, set->period);
    else
        snprintf(why, sizeof why, "its initial values, which change in a time of %.3g", set->period);
    complain_note("the model gives no %s: motus takes %s from %s. To keep %s, add to the model:",
                  both                          ? "step and no end"
                  : m->suggested == SETTLE_STEP ? "step"
                                                : "end",
                  both ? "them" : "it", why, both ? "them" : "it");
    fprintf(stderr, "%s\n", line);
}

static motus_status suggest(const load *m, const grid *sweep, motus_settings *set, motus_error *err)
{
    double **values;
    size_t rows;
    if (!sweep || !(m->suggested & SETTLE_STEP)) return motus_suggest(m->system, set, err);
    motus_status status = grid_extremes(sweep, &values, &rows, err);
    if (!status)
        status =
            motus_suggest_varied(m->system, sweep->count, sweep->names, rows, (const double *const *)values, set, err);
    grid_extremes_free(values);
    return status;
}

/* What nothing else would show: steps that grow where the motion does not. sweep: NULL: of a run. */
static motus_status judge(const load *m, const grid *sweep, const motus_settings *given, motus_error *err)
{
    double **values = NULL, powers = 0;
    size_t rows = 1;
    motus_settings set = *given;
    if (!set.method) set.method = "verlet";
    const motus_status status = sweep ? grid_extremes(sweep, &values, &rows, err) : MOTUS_OK;
    if (!status)
        motus_step_growth(m->system, sweep ? sweep->count : 0, sweep ? sweep->names : NULL, rows,
                          (const double *const *)values, &set, &powers, NULL);
    if (powers > GROWN) {
        char step[DECIMAL_MAX];
        complain_note(
            "steps of %s by %s are too long: where %s swings or decays they make it grow, and what is %s is not "
            "the motion. Give a smaller --step",
            decimal(set.step, step), set.method, sweep ? "a motion at the ends of what varies" : "the motion",
            sweep ? "recorded" : "printed");
    }
    if (sweep) grid_extremes_free(values);
    return status;
}

motus_status settle_timing(load *m, const options *o, int needed, const char *method, const grid *sweep,
                           motus_error *err)
{
    motus_settings set = motus_default_settings();
    motus_settings_of(m->system, &set);
    m->step = o->step;
    m->until = o->until;
    const motus_method *card = NULL;
    const char *name = method ? method : set.method;
    const bool adaptive = name && motus_method_find(name, &card, NULL) == MOTUS_OK && card->adaptive;
    m->suggested = (!adaptive && isnan(o->step) && isnan(set.step) ? SETTLE_STEP : 0) |
                   (isnan(o->until) && isnan(set.until) ? SETTLE_UNTIL : 0);
    m->suggested &= needed;
    if (!isnan(o->step)) set.step = o->step;
    if (!isnan(o->until)) set.until = o->until;
    if (method) set.method = method;
    const bool blind = sweep ? !o->errors : o->error && !strcmp(o->error, "none");
    const bool told = !blind || o->quiet || !(needed & SETTLE_STEP) || adaptive;
    if (!m->suggested) return told || isnan(set.step) || isnan(set.until) ? MOTUS_OK : judge(m, sweep, &set, err);
    motus_status status = suggest(m, sweep, &set, err);
    if (status) return status;
    if (m->suggested & SETTLE_STEP) m->step = set.step;
    if (m->suggested & SETTLE_UNTIL) m->until = set.until;
    if (!o->quiet) note(m, sweep != NULL, &set);
    return MOTUS_OK;
}

double settle_accuracy(const load *m, const options *o)
{
    motus_settings set = motus_default_settings();
    motus_settings_of(m->system, &set);
    if (!isnan(o->accuracy)) return o->accuracy;
    return o->method || !isnan(o->tolerance) || !isnan(o->step) ? NAN : set.accuracy;
}

void settle_json(json *j, const load *m)
{
    json_open(j, "suggested", '{');
    if (m->suggested & SETTLE_STEP) json_number(j, "step", m->step);
    if (m->suggested & SETTLE_UNTIL) json_number(j, "until", m->until);
    json_close(j, '}');
}
