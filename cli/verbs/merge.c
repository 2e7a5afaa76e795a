/* motus merge: joins the shards of a sweep to the file of the whole sweep.
 *
 * Invariant: the merged file is, byte for byte, what the command without --shard writes. It gets its name only when it
 * is complete.
 */
#include "cli/files/stop.h"
#include "cli/sweep/part.h"
#include "cli/sweep/sweep.h"
#include "cli/words/complain.h"
#include "cli/words/options.h"
#include "cli/words/text.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

typedef struct merge {
    const options *options;
    part *parts, **of; /* of[k] is the part with shard k + 1; NULL: the shard is missing */
    size_t count;
    uint64_t missing; /* blocks that no part has */
} merge;

static motus_status foreign(const part *a, const part *b, motus_error *err)
{
    char one[SHARD_TITLE], other[SHARD_TITLE];
    if (a->kind != b->kind) {
        static const char *const kinds[] = {"a table of rows", "a table of events", "a .npy", "an archive"};
        fail(err, MOTUS_STATE, "%s is %s, but %s is %s", a->path, kinds[a->kind], b->path, kinds[b->kind]);
        hint(err, "merge files of one kind");
    } else if (a->shard.count != b->shard.count || a->shard.block != b->shard.block) {
        fail(err, MOTUS_STATE, "%s is shard %s, but %s is shard %s", a->path, shard_title(&a->shard, one), b->path,
             shard_title(&b->shard, other));
        hint(err, "merge shards K/N with one N");
    } else {
        fail(err, MOTUS_STATE, "%s and %s are from different sweeps", a->path, b->path);
        hint(err, "the fingerprints in their heads differ, or their columns do");
    }
    return MOTUS_STATE;
}

/* Finds the part of each shard: there must be exactly one, or with --partial at most one. */
static motus_status arrange(merge *m, motus_error *err)
{
    char text[SHARD_TEXT];
    const part *first = &m->parts[0];
    const uint64_t count = first->shard.count;
    for (size_t k = 1; k < m->count; k++)
        if (m->parts[k].kind != first->kind || m->parts[k].shard.count != count ||
            m->parts[k].shard.block != first->shard.block || strcmp(m->parts[k].its, first->its) != 0)
            return foreign(first, &m->parts[k], err);
    m->of = calloc((size_t)count, sizeof *m->of);
    if (!m->of) return complain_memory(err);
    for (size_t k = 0; k < m->count; k++) {
        part *p = &m->parts[k], **place = &m->of[p->shard.number - 1];
        if (*place)
            return complain(err, MOTUS_STATE, "give each shard once", "%s and %s are both shard %s", (*place)->path,
                            p->path, shard_text(&p->shard, text));
        *place = p;
    }
    enum { NAMED = 8 };
    uint64_t missing = 0;
    char list[NAMED * 8 + 8] = "";
    for (uint64_t k = 0; k < count; k++) {
        if (m->of[k] || missing++ >= NAMED) continue;
        sprintf(list + strlen(list), "%s%" PRIu64, *list ? ", " : "", k + 1);
    }
    if (missing == 0 || m->options->partial) return MOTUS_OK;
    fail(err, MOTUS_STATE, "%" PRIu64 " of %" PRIu64 " shards are missing: %s%s", missing, count, list,
         missing > NAMED ? ", ..." : "");
    hint(err, first->kind == PART_ARCHIVE ? "compute them, or name their files too; --partial joins what is there"
                                          : "compute them, or name their files too");
    return MOTUS_STATE;
}

static motus_status check(const options *o, motus_error *err)
{
    if (!o->files.count || !o->output)
        return complain(err, MOTUS_ARGUMENT, "motus merge part*.csv -o all.csv",
                        o->files.count ? "-o is missing: the name of the merged file" : "no file to merge");
    for (size_t k = 0; k < o->files.count; k++)
        if (file_same(o->files.items[k], o->output) || target_replaces(o->output, o->files.items[k]))
            return fail(err, MOTUS_ARGUMENT, "%s is read and would be overwritten", o->output);
    if (o->partial && o->compress)
        return complain(err, MOTUS_ARGUMENT, "compress at the end: the sweep's command with --resume --compress",
                        "--partial and --compress exclude each other: only what is complete is compressed");
    return target_check(o, o->output, err);
}

/* Checks that the ending of the output's name fits the shards. */
static motus_status check_name(const merge *m, motus_error *err)
{
    static const char *const kinds[] = {"CSV", "CSV", ".npy", "archives"}, *const ends[] = {"csv", "csv", "npy", "h5"};
    const char *name = m->options->output;
    const part_kind kind = m->parts[0].kind;
    if (m->options->partial && kind != PART_ARCHIVE)
        return complain(err, MOTUS_ARGUMENT, "compute all shards, or write archives: motus sweep ... -o part%K.h5",
                        "--partial: only archives know which of their rows are missing");
    if (m->options->compress && kind != PART_ARCHIVE) {
        fail(err, MOTUS_ARGUMENT, "--compress is for archives");
        return MOTUS_ARGUMENT;
    }
    if (target_npy(name) == (kind == PART_NPY) && target_archive(name) == (kind == PART_ARCHIVE)) return MOTUS_OK;
    fail(err, MOTUS_ARGUMENT, "-o %s: the shards are %s", name, kinds[kind]);
    hint(err, "give the merged file a name such as all.%s", ends[kind]);
    return MOTUS_ARGUMENT;
}

static motus_status write_head(const merge *m, file_out *out, motus_error *err)
{
    const part *p = m->of[0];
    if (p->kind != PART_NPY) return file_text(out, p->head, err);
    char head[SWEEP_NPY_HEAD];
    sweep_npy_head(p->total, p->width / sizeof(double), head);
    return file_write(out, head, sizeof head, err);
}

static motus_status write_rows(const merge *m, file_out *out, stop_progress *progress, motus_error *err)
{
    const uint64_t total = m->of[0]->total, blocks = shard_blocks(&m->of[0]->shard, total),
                   count = m->of[0]->shard.count;
    motus_status status = MOTUS_OK;
    for (uint64_t b = 0; !status && b < blocks; b++) {
        status = part_copy(m->of[b % count], b, out, err);
        if (!status && stop_progress_hook(progress, (double)b / (double)blocks))
            status = fail(err, MOTUS_CANCELLED, "cancelled");
    }
    for (uint64_t k = 0; !status && k < count; k++) status = part_end(m->of[k], err);
    if (status || m->of[0]->kind != PART_EVENTS) return status;
    char line[SWEEP_EVENTS_LAST];
    snprintf(line, sizeof line, SWEEP_EVENTS_END, total);
    out->seen = NULL;
    return file_text(out, line, err);
}

static void report(const merge *m)
{
    const options *o = m->options;
    const part *p = &m->parts[0];
    FILE *out = strcmp(o->output, "-") == 0 ? stderr : stdout;
    if (o->json) {
        json j = text_json(stdout);
        json_integer(&j, "shards", (int64_t)p->shard.count);
        json_integer(&j, "trajectories", (int64_t)p->total);
        if (p->kind == PART_ARCHIVE) json_integer(&j, "missing", (int64_t)m->missing);
        json_string(&j, "output", o->output);
        json_end(&j);
    } else if (!o->quiet) {
        text_put(out, o->output);
        fprintf(out, ": ");
        if (m->count < p->shard.count) fprintf(out, "%zu of ", m->count);
        fprintf(out, "%" PRIu64 " shards, %s%" PRIu64 " trajectories", p->shard.count,
                p->kind == PART_EVENTS ? "events of " : "", p->total);
        if (m->missing)
            fprintf(out, "; %" PRIu64 " block%s missing, which the sweep's command with --resume computes", m->missing,
                    m->missing == 1 ? " is" : "s are");
        putc('\n', out);
    }
}

static motus_status write_all(merge *m, stop_progress *progress, motus_error *err)
{
    const char *output = m->options->output;
    if (m->parts[0].kind == PART_ARCHIVE)
        return part_archive_join(m->of, output, m->options->partial ? &m->missing : NULL, m->options->compress,
                                 progress, err);
    const bool npy = m->of[0]->kind == PART_NPY;
    char *beside = target_beside(output);
    if (!beside) return complain_memory(err);
    file_out rows = {0}, about = {0};
    checks c = {.descriptor = -1};
    motus_status status = file_create(&rows, output, err);
    if (!status && !rows.direct) status = checks_begin(&c, output, npy ? SWEEP_NPY_HEAD : 0, true, err);
    if (!status && npy) status = file_create(&about, beside, err);
    if (!status && npy) status = file_text(&about, m->of[0]->head, err);
    if (!status && npy) status = write_head(m, &rows, err);
    rows.seen = checks_seen, rows.with = &c;
    if (!status && !npy) status = write_head(m, &rows, err);
    if (!status) status = write_rows(m, &rows, progress, err);
    if (!status && npy) status = file_finish(&about, err);
    if (!status) status = file_finish(&rows, err);
    if (!status) status = checks_finish(&c, err);
    if (!status && npy) status = file_keep(&about, err);
    if (!status) status = file_keep(&rows, err);
    file_drop(&rows);
    file_drop(&about);
    checks_close(&c);
    free(beside);
    return status;
}

/* Prints a note if shards without checks were merged. */
static void note_unchecked(const merge *m)
{
    size_t count = 0;
    const part *first = NULL;
    for (size_t k = 0; k < m->count; k++) {
        if (m->parts[k].kind == PART_ARCHIVE || m->parts[k].checked < UINT64_MAX) continue;
        if (!count++) first = &m->parts[k];
    }
    if (count && !m->options->quiet)
        complain_note("%s.check is missing%s: the rows could not be checked", first->path,
                      count > 1 ? ", as are others" : "");
}

motus_status merge_verb(const options *o, motus_error *err)
{
    merge m = {.options = o, .count = o->files.count};
    stop_progress progress = stop_progress_begin("merge", o->quiet);
    motus_status status = check(o, err);
    if (!status) stop_catch_signals();
    m.parts = status ? NULL : calloc(m.count, sizeof *m.parts);
    if (!status && !m.parts) status = complain_memory(err);
    for (size_t k = 0; !status && k < m.count; k++) status = part_open(&m.parts[k], o->files.items[k], err);
    if (!status) status = arrange(&m, err);
    if (!status) status = check_name(&m, err);
    if (!status) status = write_all(&m, &progress, err);
    stop_progress_end(&progress);
    if (!status) note_unchecked(&m);
    if (!status) report(&m);
    for (size_t k = 0; m.parts && k < m.count; k++) part_close(&m.parts[k]);
    free(m.parts);
    free(m.of);
    return status ? status : file_flush_output(err);
}
