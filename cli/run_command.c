/* See run_command.h. */
#include "cli/run_command.h"

#include "base/decimal.h"
#include "base/error.h"
#include "cli/command.h"
#include "cli/complain.h"
#include "cli/words.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* How long the steps are. */
static motus_status steps(const options *o, const motus_run *run, file_out *f, motus_error *err)
{
    motus_statistics now = motus_default_statistics();
    motus_run_statistics(run, &now);
    char text[DECIMAL_MAX + 16], number[DECIMAL_MAX];
    if (isnan(now.tolerance)) return command_number(f, "--step", motus_run_step_size(run), err);
    snprintf(text, sizeof text, "%s%s", decimal(now.tolerance, number), now.absolute ? " absolute" : "");
    motus_status status = command_option(f, "--tolerance", text, err);
    if (!status && o->shortest_step > 0) status = command_number(f, "--shortest-step", o->shortest_step, err);
    if (!status && o->longest_step > 0) status = command_number(f, "--longest-step", o->longest_step, err);
    if (!status && o->most_steps > 0) status = command_whole(f, "--most-steps", (uint64_t)o->most_steps, err);
    return status;
}

static motus_status write(const options *o, const motus_run *run, double until, file_out *f, motus_error *err)
{
    char every[DECIMAL_MAX + 8];
    motus_status status = file_text(f, "motus run", err);
    if (!status) status = command_option(f, o->operand, NULL, err);
    for (size_t i = 0; !status && i < o->set.count; i++) status = command_option(f, "--set", o->set.items[i], err);
    for (size_t i = 0; !status && i < o->when.count; i++) status = command_option(f, "--when", o->when.items[i], err);
    if (!status && o->section) status = command_option(f, "--section", o->section, err);
    if (!status && o->most_points) status = command_whole(f, "--points", (uint64_t)(o->skip + o->most_points), err);
    if (!status) status = command_option(f, "--method", motus_run_method(run), err);
    if (!status) status = steps(o, run, f, err);
    if (!status && o->switches) status = command_option(f, "--switches", o->switches, err);
    if (!status) status = command_number(f, "--until", until, err);
    if (!status && o->every_steps > 0) {
        snprintf(every, sizeof every, "%" PRId64 " steps", o->every_steps);
        status = command_option(f, "--every", every, err);
    }
    if (!status && o->every_time > 0) status = command_number(f, "--every", o->every_time, err);
    if (!status && o->columns) status = command_option(f, "--columns", o->columns, err);
    if (!status) status = command_option(f, "--error", o->error ? o->error : "cheap", err);
    return status || !o->errors ? status : command_option(f, "--errors", NULL, err);
}

motus_status run_command_text(const options *o, const motus_run *run, double until, char **text, motus_error *err)
{
    char memory[] = "memory";
    size_t length;
    *text = NULL;
    file_out line = {.stream = open_memstream(text, &length), .path = memory};
    motus_status status = line.stream ? write(o, run, until, &line, err) : complain_memory(err);
    if (line.stream && fclose(line.stream) != 0 && !status) status = complain_memory(err);
    return status;
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

/* ---- a run that goes on ---- */

static motus_status no_run(const char *path, motus_error *err)
{
    fail(err, MOTUS_STATE, "%s is not the archive of a run", path);
    hint(err, "motus run goes on with a file that `motus run MODEL -o FILE.h5` has written");
    return MOTUS_STATE;
}

/* What belongs to the motion, or to the rows: the archive says it. */
static const char *decided(const options *o)
{
    return o->method               ? "--method"
           : !isnan(o->step)       ? "--step"
           : !isnan(o->accuracy)   ? "--accuracy"
           : !isnan(o->tolerance)  ? "--tolerance"
           : o->shortest_step > 0  ? "--shortest-step"
           : o->longest_step > 0   ? "--longest-step"
           : o->most_steps > 0     ? "--most-steps"
           : o->set.count > 0      ? "--set"
           : o->when.count > 0     ? "--when"
           : o->section            ? "--section"
           : o->switches           ? "--switches"
           : o->columns            ? "--columns"
           : o->every_time > 0     ? "--every"
           : o->every_steps > 0    ? "--every"
           : o->error || o->errors ? "--error"
           : o->restart            ? "--restart"
           : o->emit_c             ? "--emit-c"
           : o->share              ? "--share"
                                   : NULL;
}

/* What is not the motion is that of the command now. */
static void take_over(run_command *c, const options *o)
{
    options *own = &c->options;
    own->json = o->json, own->quiet = o->quiet, own->answered = o->answered, own->team = o->team;
    own->output = o->output ? o->output : o->operand;
    own->plot = o->plot, own->plot_of = o->plot_of, own->events = o->events, own->save_state = o->save_state;
    own->keep_steps = o->keep_steps, own->keep_seconds = o->keep_seconds;
    own->force = o->force, own->resume = o->resume, own->compress = o->compress;
    if (!isnan(o->until)) own->until = o->until, own->until_typed = o->until_typed;
    own->argc = o->argc, own->argv = o->argv;
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
    words[c->argv.count++] = "-o"; /* there is room for two more; some options need it */
    words[c->argv.count++] = "archive.h5";
    status = options_read(&c->options, VERB_RUN, (int)c->argv.count, (char **)words, 2, err);
    if (!status && (c->options.help || !c->options.operand)) return no_run(asked->operand, err);
    options *own = &c->options;
    own->text = c->model;
    own->output = own->plot = own->plot_of = own->events = own->save_state = own->restart = NULL;
    own->emit_c = own->share = own->json = own->resume = own->force = own->compress = false;
    own->threads = asked->threads, own->machine = asked->machine;
    return status;
}

motus_status run_command_read(run_command *c, const options *o, motus_error *err)
{
    *c = (run_command){0};
    if (decided(o)) {
        fail(err, MOTUS_ARGUMENT, "%s: %s decides it", decided(o), o->operand);
        hint(err, "take its model, motus archive %.80s -o model.motus, for a run of its own", o->operand);
        return MOTUS_ARGUMENT;
    }
    if ((o->force || o->resume) && !o->output) {
        fail(err, MOTUS_ARGUMENT, "%s: the run goes on in %s itself", o->force ? "--force" : "--resume", o->operand);
        hint(err, "leave it out, or name another file: -o other.h5");
        return MOTUS_ARGUMENT;
    }
    motus_archive *a;
    motus_status status = motus_archive_open(o->operand, 0, &a, err);
    if (!status) status = run_command_of(c, a, o, err);
    motus_archive_close(a);
    if (!status) take_over(c, o);
    return status;
}

void run_command_free(run_command *c)
{
    options_free(&c->options);
    free(c->argv.items);
    free(c->words);
    free(c->model);
    *c = (run_command){0};
}
