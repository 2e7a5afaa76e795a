/* The report of a sweep that has ended, and of how the processes of a team shared its work. */
#include "base/decimal.h"
#include "cli/model/settle.h"
#include "cli/sweep/sweep.h"
#include "cli/words/complain.h"
#include "cli/words/text.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define MICRO 1e6

/* Returns the number that the process `rank` passes as `mine`. */
static uint64_t tell(const team *t, int rank, uint64_t mine) { return t->sum(t->context, t->rank == rank ? mine : 0); }
static double tell_seconds(const team *t, int rank, double mine)
{
    return (double)tell(t, rank, mine > 0 ? (uint64_t)(mine * MICRO) : 0) / MICRO;
}

sweep_share *sweep_report_gather(const team *t, const sweep_share *mine)
{
    sweep_share *all = calloc((size_t)t->size, sizeof *all), room;
    for (int k = 0; k < t->size; k++) {
        sweep_share *one = all ? all + k : &room;
        one->blocks = tell(t, k, mine->blocks);
        one->rows = tell(t, k, mine->rows);
        one->computing = tell_seconds(t, k, mine->computing);
        one->waiting = tell_seconds(t, k, mine->waiting);
        one->writing = tell_seconds(t, k, mine->writing);
    }
    return all;
}

static void put_ranks(json *j, const team *t, const sweep_share *all)
{
    json_open(j, "ranks", '[');
    for (int k = 0; all && k < t->size; k++) {
        json_open(j, NULL, '{');
        json_integer(j, "blocks", (int64_t)all[k].blocks);
        json_integer(j, "trajectories", (int64_t)all[k].rows);
        json_number(j, "computing", all[k].computing);
        json_number(j, "waiting", all[k].waiting);
        json_number(j, "writing", all[k].writing);
        json_close(j, '}');
    }
    json_close(j, ']');
}

static void report_json(const sweep *s, const sweep_file *f, double wall, const sweep_share *all)
{
    const motus_ensemble_statistics now = motus_ensemble_now(s->ensemble);
    char note[2 * MOTUS_TEXT_MAX], shard[SHARD_TEXT];
    complain_named(now.note, note, sizeof note);
    json j = text_json(stdout);
    json_string(&j, "model", s->options->operand);
    json_string(&j, "method", s->method);
    if (isnan(s->tolerance)) {
        json_number(&j, "step", s->step);
    } else {
        const bool exact = !isnan(s->accuracy);
        json_number(&j, exact ? "accuracy" : "tolerance", exact ? s->accuracy : s->tolerance);
        json_bool(&j, "absolute", s->absolute);
    }
    settle_json(&j, &s->model);
    json_integer(&j, "trajectories", (int64_t)s->rows);
    json_string(&j, "shard", shard_whole(&s->shard) ? NULL : shard_text(&s->shard, shard));
    json_integer(&j, "resumed", (int64_t)f->found);
    json_integer(&j, "steps", now.steps);
    json_string(&j, "machine", now.machine);
    json_number(&j, "compiled_from", now.compiled_from < 0 ? NAN : (double)now.compiled_from);
    json_integer(&j, "lanes", now.lanes);
    json_integer(&j, "threads", now.threads);
    json_string(&j, "note", note[0] ? note : NULL);
    json_string(&j, "switches", sweep_switches(s));
    json_bool(&j, "fast", s->options->fast);
    json_number(&j, "seconds", now.seconds);
    json_number(&j, "wall", wall);
    json_integer(&j, "lost", (int64_t)f->lost);
    json_integer(&j, "stopped", (int64_t)f->stopped);
    json_open(&j, "stopped_by", '{');
    for (int k = MOTUS_CAUSE_NONE + 1; k < MOTUS_CAUSE_COUNT; k++)
        if (f->stopped_by[k]) json_integer(&j, motus_cause_word((motus_cause)k), (int64_t)f->stopped_by[k]);
    json_close(&j, '}');
    json_string(&j, "output", s->options->plot && !f->regular ? NULL : f->path);
    if (s->options->team) put_ranks(&j, s->options->team, all);
    json_end(&j);
}

static void report(const sweep *s, const sweep_file *f, double wall)
{
    const motus_ensemble_statistics now = motus_ensemble_now(s->ensemble);
    bool output = strcmp(f->path, "-") == 0; /* the rows went to standard output, so the report must not */
    FILE *out = output ? stderr : stdout;
    char step[DECIMAL_MAX], until[DECIMAL_MAX], inside[DECIMAL_MAX], all[DECIMAL_MAX], shard[SHARD_TEXT];
    const double work = (double)(s->rows - f->found) * (double)now.steps;
    const bool exact = !isnan(s->accuracy), fixed = isnan(s->tolerance);
    decimal(exact ? s->accuracy : fixed ? s->step : s->tolerance, step);
    decimal(s->until, until);
    text_seconds(now.seconds, inside);
    text_seconds(wall, all);
    char how[96] = "", made[96] = "", of[DECIMAL_MAX + SHARD_TEXT + 32] = "", found[64] = "", each[64] = "";
    if (now.steps > 0) snprintf(how, sizeof how, "%lld steps ", (long long)now.steps);
    const bool elsewhere = f->archive && (f->found > 0 || s->options->team); /* other trajectories lie between ours */
    if (now.compiled_from > 0 && elsewhere)
        snprintf(made, sizeof made, "interpreter, then compiled");
    else if (now.compiled_from > 0)
        snprintf(made, sizeof made, "interpreter, then compiled from trajectory %llu",
                 (unsigned long long)(f->found + (uint64_t)now.compiled_from + 1));
    else
        snprintf(made, sizeof made, "%s", now.machine);
    text_say(out, "%s: %s, %s %s%s, %sto %s = %s, %s%s, %d lane%s, %d thread%s", s->model.title, s->method,
             exact   ? "accuracy"
             : fixed ? "step"
                     : "tolerance",
             step, s->absolute ? " absolute" : "", how, s->model.time, isnan(s->until) ? "its own end" : until, made,
             s->options->fast ? " (fast)" : "", now.lanes, now.lanes == 1 ? "" : "s", now.threads,
             now.threads == 1 ? "" : "s");
    if (!shard_whole(&s->shard))
        snprintf(of, sizeof of, " of %llu, shard %s", (unsigned long long)s->grid.total, shard_text(&s->shard, shard));
    if (f->found > 0) snprintf(found, sizeof found, ", %llu of them found in the file", (unsigned long long)f->found);
    if (work > 0 && now.seconds > 0)
        snprintf(each, sizeof each, ", %.3g ns per trajectory and step", now.seconds / work * 1e9);
    text_say(out, "%llu trajectories%s%s: %s, integration %s%s", (unsigned long long)s->rows, of, found, all, inside,
             each);
    if (!output && f->regular) {
        text_put(out, f->path);
        fprintf(out, ": %zu columns\n", s->columns);
    }
}

void sweep_report(const sweep *s, const sweep_file *f, double wall, const sweep_share *all)
{
    if (s->options->json)
        report_json(s, f, wall, all);
    else if (!s->options->quiet)
        report(s, f, wall);
}
