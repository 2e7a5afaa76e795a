/* The head of a sweep's file: the command in one line, its fingerprint, the names of the columns.
 *
 * Invariant: the head depends only on what the numbers depend on, and not on the machine, the threads, the name of the
 * file or interruptions. So two files of one sweep are equal, and different numbers have different fingerprints.
 */
#include "cli/files/command.h"
#include "cli/run/csv.h"
#include "cli/sweep/sweep.h"
#include "cli/words/complain.h"
#include "cli/words/text.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static void mix_axis(uint64_t *hash, const axis *a)
{
    command_mix_text(hash, a->name);
    command_mix_count(hash, a->kind);
    command_mix_count(hash, a->count);
    if (a->kind == AXIS_LIST) {
        command_mix(hash, a->list, a->count * sizeof *a->list);
        return;
    }
    command_mix(hash, &a->range.from, sizeof a->range.from);
    command_mix(hash, &a->range.to, sizeof a->range.to);
    command_mix_count(hash, a->range.logarithmic);
}

static void mix_records(uint64_t *hash, const sweep *s)
{
    char name[SWEEP_NAME];
    for (size_t k = 0; k < s->records.count; k++) {
        sweep_record_name(&s->model, &s->records.items[k], name);
        command_mix_text(hash, name);
    }
    if (s->records.ended) command_mix_text(hash, "ended");
}

const char *sweep_switches(const sweep *s)
{
    const motus_switches how = motus_ensemble_now(s->ensemble).switches;
    const bool fixed = isnan(s->tolerance); /* fixed steps cross switches by default */
    if (how == MOTUS_SWITCHES_USUAL || (fixed && how == MOTUS_SWITCHES_STEP)) return NULL;
    return how == MOTUS_SWITCHES_LOCATE ? "locate" : "step";
}

/* Returns the options with every setting of the model and every default. They share the lists of s->options. */
static options settled(const sweep *s)
{
    options o = *s->options;
    o.count = (int64_t)s->grid.draws;
    o.most_points = o.most_points ? o.skip + o.most_points : 0;
    o.skip = 0;
    if (!o.record) o.record = "final";
    o.errors = s->errors;
    o.error = !s->errors ? NULL : o.error ? o.error : "cheap";
    o.method = s->method;
    o.step = s->step;
    o.tolerance = s->tolerance;
    o.accuracy = s->accuracy;
    o.absolute = s->absolute;
    o.switches = sweep_switches(s);
    o.until = s->until;
    o.every = (options_period){.steps = s->every};
    return o;
}

const char *sweep_head_fingerprint(const sweep *s, const char *version, char out[SWEEP_FINGERPRINT])
{
    uint64_t hash = COMMAND_HASH;
    const options o = settled(s);
    command_mix_text(&hash, version);
    command_mix_text(&hash, s->model.text);
    for (size_t k = 0; k < 2 * OPTION_COUNT; k++) {
        const size_t number = k % OPTION_COUNT;
        const option *row = options_row(number);
        if (row->setting != OF_MOTION || !(row->verbs & VERB_SWEEP) || row->late != (k >= OPTION_COUNT)) continue;
        if (number == OPTION_vary)
            for (size_t i = 0; i < s->grid.count; i++) mix_axis(&hash, &s->grid.axes[i]);
        else if (number == OPTION_record)
            mix_records(&hash, s);
        else
            command_mix_option(&hash, &o, row);
    }
    snprintf(out, SWEEP_FINGERPRINT, "%016" PRIx64, hash);
    return out;
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
    char part[SHARD_TEXT];
    options o = settled(s);
    if (o.random.count == 0) o.count = 0;
    o.given[OPTION_seed] = o.random.count > 0 ? "" : NULL;
    if (!isnan(o.accuracy)) o.tolerance = NAN; /* the tolerance was found, not given */
    if (s->every == 1) o.every.steps = 0;
    o.shard = shard_whole(&s->shard) ? NULL : shard_text(&s->shard, part);
    return command_text(&o, text, err);
}

motus_status sweep_head_command(const sweep *s, file_out *f, motus_error *err)
{
    char *text;
    motus_status status = sweep_head_text(s, &text, err);
    if (!status) status = file_text(f, "# ", err);
    if (!status) status = file_text(f, text, err);
    free(text);
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

/* Writes the words of the numbers in `ended`. */
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
    file_memory m;
    motus_status status = file_memory_open(&m, err);
    if (!status) status = npy ? npy_head(s, &m.file, err) : csv_head(s, &m.file, err);
    status = file_memory_close(&m, status, err);
    s->head = m.text, s->head_length = m.length;
    return status;
}

void sweep_npy_head(uint64_t rows, size_t columns, char out[SWEEP_NPY_HEAD])
{
    static const char magic[] = "\x93NUMPY\x01\x00";
    bool little = *(const char *)&(int){1} == 1;
    memset(out, ' ', SWEEP_NPY_HEAD);
    memcpy(out, magic, sizeof magic - 1);
    out[8] = SWEEP_NPY_HEAD - 10; /* the length of what follows, two bytes */
    out[9] = 0;
    char text[SWEEP_NPY_HEAD];
    int length = snprintf(text, sizeof text, "{'descr': '%cf8', 'fortran_order': False, 'shape': (%llu, %zu), }",
                          little ? '<' : '>', (unsigned long long)rows, columns);
    memcpy(out + 10, text, (size_t)length);
    out[SWEEP_NPY_HEAD - 1] = '\n';
}
