/* The head of a sweep's file: the command in one line, its fingerprint, the names of the columns.
 *
 * Invariant: the head depends only on what the numbers depend on: not on the machine, the threads, the name of the
 * file or interruptions. So two files of the same sweep are equal, and different fingerprints mean different numbers.
 */
#define _XOPEN_SOURCE 700
#include "cli/command.h"
#include "cli/complain.h"
#include "cli/csv.h"
#include "cli/sweep.h"
#include "cli/text.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static void mix_number(uint64_t *hash, double value) { command_mix(hash, &value, sizeof value); }
static void mix_count(uint64_t *hash, uint64_t value) { command_mix(hash, &value, sizeof value); }

static void mix_axis(uint64_t *hash, const axis *a)
{
    command_mix_text(hash, a->name);
    mix_count(hash, a->kind);
    mix_count(hash, a->count);
    if (a->kind == AXIS_LIST) {
        command_mix(hash, a->list, a->count * sizeof *a->list);
        return;
    }
    mix_number(hash, a->range.from);
    mix_number(hash, a->range.to);
    mix_count(hash, a->range.logarithmic);
}

static const char *how_told(const sweep *s) { return s->options->error ? s->options->error : "cheap"; }

/* Every option that changes a number is mixed in here, and nowhere else; test/sweep.sh tries all of them. */
const char *sweep_head_fingerprint(const sweep *s, const char *version, char out[SWEEP_FINGERPRINT])
{
    uint64_t hash = COMMAND_HASH;
    const options *o = s->options;
    command_mix_text(&hash, version);
    command_mix_text(&hash, s->model.text);
    for (size_t i = 0; i < o->set.count; i++) command_mix_text(&hash, o->set.items[i]);
    for (size_t i = 0; i < o->when.count; i++) command_mix_text(&hash, o->when.items[i]);
    if (o->section) command_mix_text(&hash, o->section);
    if (o->most_points) mix_count(&hash, (uint64_t)(o->skip + o->most_points));
    command_mix_text(&hash, s->method);
    mix_number(&hash, s->step);
    if (!isnan(s->tolerance)) {
        mix_number(&hash, s->tolerance);
        mix_count(&hash, (uint64_t)s->absolute);
        mix_number(&hash, o->shortest_step);
        mix_number(&hash, o->longest_step);
        if (o->most_steps) mix_count(&hash, (uint64_t)o->most_steps);
    }
    if (sweep_switches(s)) command_mix_text(&hash, sweep_switches(s));
    mix_number(&hash, s->until);
    mix_count(&hash, (uint64_t)s->every);
    mix_count(&hash, o->fast);
    for (size_t k = 0; k < s->grid.count; k++) mix_axis(&hash, &s->grid.axes[k]);
    mix_count(&hash, s->grid.zip);
    mix_count(&hash, s->grid.draws);
    mix_count(&hash, s->grid.seed);
    for (size_t k = 0; k < s->records.count; k++) {
        char name[SWEEP_NAME];
        sweep_record_name(&s->model, &s->records.items[k], name);
        command_mix_text(&hash, name);
    }
    if (s->records.ended) command_mix_text(&hash, "ended");
    if (s->errors) command_mix_text(&hash, how_told(s));
    if (!isnan(s->accuracy)) mix_number(&hash, s->accuracy);
    snprintf(out, SWEEP_FINGERPRINT, "%016" PRIx64, hash);
    return out;
}

/* How long the steps are. */
static motus_status steps(const sweep *s, file_out *f, motus_error *err)
{
    const options *o = s->options;
    char text[DECIMAL_MAX + 16], number[DECIMAL_MAX];
    const bool found = !isnan(s->accuracy);
    const double bound = found ? s->accuracy : s->tolerance;
    if (isnan(s->tolerance)) return command_number(f, "--step", s->step, err);
    snprintf(text, sizeof text, "%s%s", decimal(bound, number), s->absolute ? " absolute" : "");
    motus_status status = command_option(f, found ? "--accuracy" : "--tolerance", text, err);
    if (!status && o->shortest_step > 0) status = command_number(f, "--shortest-step", o->shortest_step, err);
    if (!status && o->longest_step > 0) status = command_number(f, "--longest-step", o->longest_step, err);
    if (!status && o->most_steps > 0) status = command_number(f, "--most-steps", (double)o->most_steps, err);
    return status;
}

/* A command that makes these rows, with every setting of the model and every default written out. */
static motus_status command(const sweep *s, file_out *f, motus_error *err)
{
    const options *o = s->options;
    motus_status status = file_text(f, "motus sweep", err);
    if (!status) status = csv_word(f, o->operand, err);
    for (size_t k = 0; !status && k < s->grid.count; k++)
        status =
            command_option(f, s->grid.axes[k].kind <= AXIS_LIST ? "--vary" : "--random", s->grid.axes[k].spec, err);
    if (!status && s->grid.zip) status = command_option(f, "--zip", NULL, err);
    if (!status && o->random.count > 0) {
        status = command_whole(f, "--count", s->grid.draws, err);
        if (!status) status = command_whole(f, "--seed", s->grid.seed, err);
    }
    for (size_t i = 0; !status && i < o->set.count; i++) status = command_option(f, "--set", o->set.items[i], err);
    for (size_t i = 0; !status && i < o->when.count; i++) status = command_option(f, "--when", o->when.items[i], err);
    if (!status && o->section) status = command_option(f, "--section", o->section, err);
    if (!status && o->most_points) status = command_whole(f, "--points", (uint64_t)(o->skip + o->most_points), err);
    if (!status) status = command_option(f, "--record", o->record ? o->record : "final", err);
    if (!status && s->errors) status = command_option(f, "--errors", NULL, err);
    if (!status && s->errors) status = command_option(f, "--error", how_told(s), err);
    if (!status) status = command_option(f, "--method", s->method, err);
    if (!status) status = steps(s, f, err);
    if (!status && sweep_switches(s)) status = command_option(f, "--switches", sweep_switches(s), err);
    if (!status && !isnan(s->until)) status = command_number(f, "--until", s->until, err);
    if (!status && s->every > 1) {
        char text[DECIMAL_MAX + 8];
        snprintf(text, sizeof text, "%" PRId64 " steps", s->every);
        status = command_option(f, "--every", text, err);
    }
    if (!status && o->fast) status = command_option(f, "--fast", NULL, err);
    char part[SHARD_TEXT];
    return status || shard_whole(&s->shard) ? status : command_option(f, "--shard", shard_text(&s->shard, part), err);
}

const char *sweep_head_name(const sweep *s, size_t k, char out[SWEEP_NAME])
{
    if (k == 0) return "index";
    if (k <= s->grid.count) return s->grid.names[k - 1];
    if (k == s->columns - 2) return "stopped";
    if (k == s->columns - 1) return "stopped_by";
    if (k == sweep_ended(s)) return "ended";
    k -= 1 + s->grid.count;
    const bool error = k >= s->records.count;
    for (size_t r = 0, left = k - s->records.count; error; r++) {
        if (r == s->records.count) return "significant";
        if (sweep_record_errs(&s->records.items[r]) && left-- == 0) {
            k = r;
            break;
        }
    }
    sweep_record_name(&s->model, &s->records.items[k], out);
    if (error) strcat(out, ".error");
    return out;
}

motus_status sweep_head_text(const sweep *s, char **text, motus_error *err)
{
    char memory[] = "memory";
    size_t length;
    *text = NULL;
    file_out line = {.stream = open_memstream(text, &length), .path = memory};
    motus_status status = line.stream ? command(s, &line, err) : complain_memory(err);
    if (line.stream && fclose(line.stream) != 0 && !status) status = complain_memory(err);
    return status;
}

motus_status sweep_head_command(const sweep *s, file_out *f, motus_error *err)
{
    motus_status status = file_text(f, "# ", err);
    if (!status) status = command(s, f, err);
    return status ? status : file_text(f, "\n", err);
}

const char *sweep_head_identity(const sweep *s, const char *what, char out[SWEEP_IDENTITY])
{
    char part[SHARD_TITLE];
    const bool whole = shard_whole(&s->shard);
    snprintf(out, SWEEP_IDENTITY, "# motus %s, %strajectories %" PRIu64 ", fingerprint %s%s%s\n", motus_version(), what,
             s->grid.total, s->fingerprint, whole ? "" : ", shard ", whole ? "" : shard_title(&s->shard, part));
    return out;
}

static motus_status csv_head(const sweep *s, file_out *f, motus_error *err)
{
    char line[SWEEP_IDENTITY], name[SWEEP_NAME];
    motus_status status = sweep_head_command(s, f, err);
    if (!status) status = file_text(f, sweep_head_identity(s, "", line), err);
    for (size_t k = 0; !status && k < s->columns; k++) {
        if (k > 0) status = file_text(f, ",", err);
        if (!status) status = csv_name(f, sweep_head_name(s, k, name), err);
    }
    return status ? status : file_text(f, "\n", err);
}

/* The words of the numbers in `ended`. */
static void put_events(const sweep *s, json *j)
{
    json_open(j, "events", '[');
    json_string(j, NULL, "");
    const char *name;
    for (size_t k = 0; (name = motus_ensemble_kind(s->ensemble, k)) != NULL; k++) json_string(j, NULL, name);
    json_close(j, ']');
}

static motus_status npy_head(const sweep *s, file_out *f, motus_error *err)
{
    char *text, name[SWEEP_NAME], part[SHARD_TITLE];
    motus_status status = sweep_head_text(s, &text, err);
    if (!status) {
        json j = text_json(f->stream);
        json_string(&j, "motus", motus_version());
        json_string(&j, "command", text);
        json_integer(&j, "trajectories", (int64_t)s->grid.total);
        json_string(&j, "fingerprint", s->fingerprint);
        if (!shard_whole(&s->shard)) json_string(&j, "shard", shard_title(&s->shard, part));
        json_open(&j, "columns", '[');
        for (size_t k = 0; k < s->columns; k++) json_string(&j, NULL, sweep_head_name(s, k, name));
        json_close(&j, ']');
        json_open(&j, "causes", '['); /* the words of the numbers in stopped_by */
        for (int k = 0; k < MOTUS_CAUSE_COUNT; k++) json_string(&j, NULL, motus_cause_word((motus_cause)k));
        json_close(&j, ']');
        if (s->records.ended) put_events(s, &j);
        json_end(&j);
    }
    free(text);
    return status;
}

motus_status sweep_head_make(sweep *s, bool npy, motus_error *err)
{
    sweep_head_fingerprint(s, motus_version(), s->fingerprint);
    char memory[] = "memory";
    file_out f = {.stream = open_memstream(&s->head, &s->head_length), .path = memory};
    if (!f.stream) return complain_memory(err);
    motus_status status = npy ? npy_head(s, &f, err) : csv_head(s, &f, err);
    bool failed = ferror(f.stream) != 0;
    if ((fclose(f.stream) != 0 || failed) && !status) status = complain_memory(err);
    return status;
}
