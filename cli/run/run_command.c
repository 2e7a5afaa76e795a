/* The command that makes the rows of a run, the command in an archive, and the run that a command describes. */
#include "cli/run/run.h"

#include "cli/files/command.h"
#include "cli/model/settle.h"
#include "cli/words/complain.h"
#include "cli/words/words.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

motus_status run_command_text(const options *asked, const motus_run *run, double until, char **text, motus_error *err)
{
    options o = *asked;
    const motus_run_statistics now = motus_run_now(run);
    o.most_points = o.most_points ? o.skip + o.most_points : 0;
    o.skip = 0;
    o.method = now.method;
    o.step = now.step;
    o.tolerance = now.tolerance;
    o.accuracy = NAN; /* the tolerance that was found for it is enough */
    o.absolute = now.absolute;
    if (!o.switches && !isnan(now.accuracy) && now.switches >= 0) o.switches = "locate"; /* trials may have chosen it */
    o.until = until;
    if (!o.error) o.error = "cheap";
    return command_text(&o, text, err);
}

const char *run_command_fingerprint(const char *version, const char *model, const char *command,
                                    char out[RUN_FINGERPRINT])
{
    uint64_t hash = COMMAND_HASH;
    command_mix_text(&hash, version);
    command_mix_text(&hash, model);
    command_mix_text(&hash, command);
    snprintf(out, RUN_FINGERPRINT, "%016" PRIx64, hash);
    return out;
}

/* ---- a run that continues ---- */

static motus_status no_run(const char *path, motus_error *err)
{
    return complain(err, MOTUS_STATE, "motus run continues a file that `motus run MODEL -o FILE.h5` has written",
                    "%s is not the archive of a run", path);
}

motus_status run_command_of(run_command *c, motus_archive *a, const options *asked, motus_error *err)
{
    *c = (run_command){0};
    const char *command = motus_archive_note_of(a, "command"), *model = motus_archive_note_of(a, "model");
    if (!command || !model) return no_run(asked->operand, err);
    if (!(c->model = strdup(model))) return complain_memory(err);
    motus_status status = words_split(command, &c->words, &c->argv, err);
    if (status) return status;
    const char **words = c->argv.items;
    if (c->argv.count < 2 || strcmp(words[0], "motus") != 0 || strcmp(words[1], "run") != 0)
        return no_run(asked->operand, err);
    status = options_read(&c->options, VERB_RUN, (int)c->argv.count, (char **)words, 2, err);
    if (!status && (c->options.help || !c->options.operand)) return no_run(asked->operand, err);
    options *own = &c->options;
    own->text = c->model;
    own->restart = NULL;
    options_forget(own, OF_WHATEVER);
    options_take(own, asked, OF_MACHINE);
    return status;
}

/* Takes the end, and the settings that do not change the motion, from the present command. The archive decides the
 * others. */
static motus_status take_over(run_command *c, const options *o, motus_error *err)
{
    options *own = &c->options;
    for (size_t k = 0; k < OPTION_COUNT; k++) {
        const option *row = options_row(k);
        if (!o->given[k] || k == OPTION_until || !(row->setting & (OF_MOTION | OF_ANOTHER))) continue;
        fail(err, MOTUS_ARGUMENT, "%s: %s decides it", row->name, o->operand);
        hint(err, "take its model, motus archive %.80s -o model.motus, for a run of its own", o->operand);
        return MOTUS_ARGUMENT;
    }
    options_take(own, o, OF_FILES);
    if (!own->output) own->output = o->operand;
    if (!isnan(o->until)) own->until = o->until;
    own->answered = o->answered, own->team = o->team;
    own->argc = o->argc, own->argv = o->argv;
    return MOTUS_OK;
}

motus_status run_command_read(run_command *c, const options *o, motus_error *err)
{
    motus_archive *a;
    *c = (run_command){0};
    motus_status status = motus_archive_open(o->operand, 0, &a, err);
    if (!status) status = run_command_of(c, a, o, err);
    motus_archive_close(a);
    if (!status) status = take_over(c, o, err);
    if (status || o->output || !o->resume) return status;
    return complain(err, MOTUS_ARGUMENT, "leave it out, or name another file: -o other.h5",
                    "--resume: the run continues in %s itself", o->operand);
}

void run_command_free(run_command *c)
{
    options_free(&c->options);
    free(c->argv.items);
    free(c->words);
    free(c->model);
    *c = (run_command){0};
}

/* ---- the run that a command describes ---- */

motus_run_def run_make_asked(const options *o)
{
    motus_run_def def = motus_default_run();
    SETTLE_ASK(&def, o);
    def.threads = (int)o->threads;
    return def;
}

motus_status run_make(const options *o, load *m, stop_progress *progress, motus_bars error, motus_run_def *def,
                      motus_run **run, motus_error *err)
{
    *def = run_make_asked(o);
    motus_status status = settle_run(m, o, def, err);
    if (status) return status;
    def->progress = stop_progress_hook;
    def->context = progress;
    def->error = error;
    status = motus_run_create(m->system, def, run, err);
    if (status || o->quiet) return status;
    const motus_run_statistics now = motus_run_now(*run);
    if (now.note[0]) complain_note("the interpreter runs this: %s", now.note);
    if (now.not_located[0]) complain_note("%s", now.not_located);
    if (now.cut[0]) complain_note("%s", now.cut);
    return MOTUS_OK;
}

bool run_make_asks_rows(const options *o, const load *m)
{
    return o->every.time > 0 || o->every.steps > 0 || m->set.every_time > 0 || m->set.every_steps > 0;
}

walk_observer run_make_rows(const options *o, const load *m, const motus_run *run)
{
    walk_observer w = {.errors = o->errors};
    const bool ours = o->every.time > 0 || o->every.steps > 0;
    const double period = ours ? o->every.time : m->set.every_time > 0 ? m->set.every_time : 0;
    const int64_t steps = ours ? o->every.steps : m->set.every_steps;
    w.stride = steps > 0 ? steps : period > 0 ? walk_steps_of_run(run, period) : 1;
    w.period = w.stride > 0 ? 0 : period;
    return w;
}
