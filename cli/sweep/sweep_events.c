/* The table of the events of a sweep, as CSV: the number of the trajectory, and then the columns of the table of a run.
 *
 * Invariants: those of the file of rows (sweep_file.c), and these. The head depends only on what the numbers depend on.
 * The events of a trajectory are on the disk, with their checks (checks.h), before its row is written. The file always
 * ends in a line that begins with # and has the number of trajectories whose events are above it: new events and a new
 * last line are first written behind its #, and their first byte then replaces the #. So a file without that line, and
 * without events of a trajectory that has no row yet, has been shortened. --resume removes the events of trajectories
 * without a row.
 *
 * Beside an archive, whose blocks come in any order, a table that is a file is joined from segments (segments.h) when
 * all blocks are there, and is empty until then. Segments are written before the rows, but reach the disk only when the
 * sweep ends; after a power cut, their hashes show which blocks are whole.
 */
#include "base/decimal.h"
#include "base/disk.h"
#include "cli/files/file.h"
#include "cli/files/segments.h"
#include "cli/files/stop.h"
#include "cli/run/csv.h"
#include "cli/sweep/sweep.h"
#include "cli/words/complain.h"

#include <errno.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

bool sweep_events_in_segments(const options *o)
{
    struct stat about;
    return o->events && o->output && target_archive(o->output) && strcmp(o->events, "-") != 0 &&
           (stat(o->events, &about) != 0 || S_ISREG(about.st_mode));
}

motus_status sweep_events_check(const options *o, motus_error *err)
{
    const char *rows = o->output ? o->output : "-";
    if (!o->events) return MOTUS_OK;
    const bool output = strcmp(o->events, "-") == 0, both = output && strcmp(rows, "-") == 0;
    if (both || (!output && strcmp(rows, "-") != 0 && (strcmp(rows, o->events) == 0 || file_same(rows, o->events)))) {
        fail(err, MOTUS_ARGUMENT,
             both ? "the rows and the events both go to standard output" : "%s is named for two outputs", o->events);
        hint(err, "write the %s", both ? "rows to a file: -o sweep.csv" : "events to another file");
        return MOTUS_ARGUMENT;
    }
    if (output && o->resume)
        return complain(err, MOTUS_ARGUMENT, "--events events.csv",
                        "--resume continues the table of events too, and needs a file");
    if (sweep_events_in_segments(o) && !o->plan && !o->resume && !o->force && segments_there(o->events))
        return complain(err, MOTUS_ARGUMENT, "--resume continues it, --force replaces it",
                        "%s.segments exists: an interrupted sweep leaves its events there", o->events);
    return target_check(o, o->events, err);
}

/* Writes the table and its checks to the disk. Returns an errno, or 0. */
static int synchronise(const sweep_events *f)
{
    return disk_sync(f->descriptor) && checks_sync(&f->checks) ? 0 : errno;
}

static int write_at(const sweep_events *f, uint64_t place, const char *text, size_t length)
{
    size_t written;
    return lseek(f->descriptor, (off_t)place, SEEK_SET) < 0 ? errno
                                                            : target_bytes(f->descriptor, text, length, &written);
}

/* Writes events and a new last line, `length` bytes, over the last line of the file; the first byte, in place of the #,
 * comes last. A pipe has no last line and gets only the events. */
static motus_status put(sweep_events *f, const char *text, size_t length, size_t events, motus_error *err)
{
    size_t written;
    int code = 0;
    if (!f->regular) {
        code = target_bytes(f->descriptor, text, events, &written);
    } else {
        code = write_at(f, f->bytes + 1, text + 1, length - 1);
        if (!code) code = synchronise(f);
        if (code && ftruncate(f->descriptor, (off_t)f->bytes + 1) != 0) code = errno;
        if (!code) code = write_at(f, f->bytes, text, 1);
        if (!code) checks_add(&f->checks, text, events);
        const motus_status status = code ? MOTUS_OK : checks_mark(&f->checks, err);
        if (status) return status;
        if (!code) code = synchronise(f);
    }
    if (code) return file_cannot_write(f->path, code, err);
    f->bytes += events;
    return MOTUS_OK;
}

/* Writes the last line of a table with the events of this many trajectories. Returns its length. */
static size_t last_line(uint64_t trajectories, char out[SWEEP_EVENTS_LAST])
{
    return (size_t)snprintf(out, SWEEP_EVENTS_LAST, SWEEP_EVENTS_END, trajectories);
}

static motus_status put_head(sweep_events *f, motus_error *err)
{
    char line[SWEEP_EVENTS_LAST];
    const size_t last = last_line(0, line);
    size_t written;
    const motus_status status = f->regular ? checks_begin(&f->checks, f->path, 0, false, err) : MOTUS_OK;
    if (status) return status;
    int code = f->regular && (ftruncate(f->descriptor, 0) != 0 || lseek(f->descriptor, 0, SEEK_SET) < 0) ? errno : 0;
    if (!code) code = target_bytes(f->descriptor, f->head, f->head_length, &written);
    if (!code && f->regular) code = target_bytes(f->descriptor, line, last, &written);
    if (code) return file_cannot_write(f->path, code, err);
    f->bytes = f->head_length;
    checks_add(&f->checks, f->head, f->head_length);
    return MOTUS_OK;
}

static motus_status make_head(sweep_events *f, motus_error *err)
{
    const sweep *s = f->sweep;
    char line[SWEEP_IDENTITY];
    file_memory m;
    motus_status status = file_memory_open(&m, err);
    if (!status) status = sweep_head_command(s, &m.file, err);
    if (!status) status = file_text(&m.file, sweep_head_identity(s, "events of ", line), err);
    if (!status) status = file_text(&m.file, "index,", err);
    if (!status)
        status = event_file_names(&m.file, &s->model, s->event_columns, s->event_columns_count, s->errors, err);
    status = file_memory_close(&m, status, err);
    f->head = m.text, f->head_length = m.length;
    return status;
}

/* ---- the table of an interrupted sweep ---- */

static motus_status another(const sweep_events *f, motus_error *err)
{
    return complain(err, MOTUS_STATE, "name the table of this sweep, or start again with --force",
                    "%s is not the table of events of this sweep", f->path);
}

/* Returns whether two heads are of one sweep. Their first lines may differ by another path to the model. */
static bool same_head(const char *ours, const char *theirs)
{
    const char *a = strchr(ours, '\n'), *b = strchr(theirs, '\n');
    return a && b && strncmp(theirs, "# motus sweep ", 14) == 0 && strncmp(a, b, strlen(a)) == 0;
}

static motus_status shortened(const sweep_events *f, uint64_t rows, motus_error *err)
{
    return complain(
        err, MOTUS_STATE, "restore the file as the sweep left it, or compute both again: --force instead of --resume",
        "%s does not have all events of the %" PRIu64 " trajectories in %s", f->path, rows, f->sweep->options->output);
}

static motus_status damaged(const sweep_events *f, motus_error *err)
{
    return complain(err, MOTUS_STATE,
                    "restore the file as the sweep left it, or compute both again: --force instead of --resume",
                    "%s is damaged: after byte %" PRIu64 ", it is not as it was written", f->path, f->checks.end);
}

/* Reads what follows the head, and sets f->bytes after the complete events of the first `rows` trajectories. All of
 * them are there if an event of a later trajectory or the last line follows. */
static motus_status find_rows(sweep_events *f, uint64_t rows, FILE *in, motus_error *err)
{
    static const char end[] = SWEEP_EVENTS_WORDS;
    const uint64_t behind = shard_trajectory(&f->sweep->shard, rows); /* the first trajectory without a row */
    char *line = NULL;
    size_t room = 0;
    ssize_t length;
    uint64_t number;
    bool all = rows == 0;
    if (rows > 0 && f->bytes > 0 && f->checks.missing) return checks_refuse(&f->checks, f->path, err);
    while ((length = getline(&line, &room, in)) > 0) {
        if (line[0] == '#') { /* a line that was being replaced may have no number */
            const bool told = strncmp(line, end, sizeof end - 1) == 0 && line[length - 1] == '\n' &&
                              decimal_read_whole(line + sizeof end - 1, (size_t)length - sizeof end + 1, &number);
            all = !told || number >= rows;
            break;
        }
        const size_t digits = decimal_read_whole(line, (size_t)length, &number);
        if (!digits || line[digits] != ',' || line[length - 1] != '\n') break;
        if (f->bytes + (uint64_t)length > f->checks.end && (number < behind || f->checks.broken)) break;
        all = all || number >= behind;
        if (number >= behind) break;
        f->bytes += (uint64_t)length;
    }
    free(line);
    const bool needed = rows > 0 && f->bytes > 0; /* 0: the file is empty */
    if (needed && f->checks.broken && (!all || f->bytes >= f->checks.end)) return damaged(f, err);
    return all ? MOTUS_OK : shortened(f, rows, err);
}

/* Sets f->bytes after the events of the first `rows` trajectories, or to 0 if the head is incomplete. */
static motus_status find_end(sweep_events *f, uint64_t rows, FILE *in, motus_error *err)
{
    char *line = NULL;
    size_t room = 0;
    ssize_t length;
    file_memory theirs;
    motus_status status = file_memory_open(&theirs, err);
    for (int k = 0; !status && k < 3 && (length = getline(&line, &room, in)) > 0; k++)
        status = file_write(&theirs.file, line, (size_t)length, err);
    status = file_memory_close(&theirs, status, err);
    free(line);
    const bool begun = !status && rows == 0 && strncmp(f->head, theirs.text, theirs.length) == 0;
    f->bytes = begun && theirs.length < f->head_length ? 0 : theirs.length;
    if (!status && f->bytes && !same_head(f->head, theirs.text)) status = another(f, err);
    if (!status && (f->bytes || rows > 0)) status = find_rows(f, rows, in, err);
    free(theirs.text);
    return status;
}

static motus_status find_table(sweep_events *f, uint64_t rows, motus_error *err)
{
    FILE *in = fopen(f->path, "re");
    if (!in) return file_cannot("read", f->path, errno, err);
    motus_status status = checks_find(&f->checks, f->path, fileno(in), 0, err);
    if (!status) status = find_end(f, rows, in, err);
    fclose(in);
    return status;
}

static motus_status go_on(sweep_events *f, uint64_t rows, motus_error *err)
{
    motus_status status = find_table(f, rows, err);
    if (status) return status;
    if (!f->bytes || rows == 0) return put_head(f, err);
    status = checks_go_on(&f->checks, f->descriptor, f->bytes, err);
    if (status) return status;
    char line[SWEEP_EVENTS_LAST];
    const size_t last = last_line(rows, line);
    const int code = write_at(f, f->bytes, line, last);
    if (code || ftruncate(f->descriptor, (off_t)(f->bytes + last)) != 0)
        return file_cannot_write(f->path, code ? code : errno, err);
    return MOTUS_OK;
}

/* Removes what a new sweep replaces, so that --resume will not find it. The first process does so before the others
 * write segments. */
static motus_status begin_segments(sweep_events *f, motus_error *err)
{
    if (f->sweep->options->resume) return MOTUS_OK;
    const motus_status status = segments_remove(f->segments, err);
    return status || ftruncate(f->descriptor, 0) == 0 ? status : file_cannot_write(f->path, errno, err);
}

/* Locks the table until it is joined, and makes an empty one if there is none. */
static motus_status lock_table(sweep_events *f, motus_error *err)
{
    const options *o = f->sweep->options;
    const motus_status status = target_lock(f->path, &f->descriptor, &f->regular, err);
    if (status || !file_same(o->output, f->path)) return status;
    return fail(err, MOTUS_ARGUMENT, "%s is named for two outputs", f->path);
}

/* Removes a table that is still empty, unless segments remain that --resume can join. */
static void unlock_table(const sweep_events *f)
{
    struct stat own, named;
    if (f->descriptor < 0 || fstat(f->descriptor, &own) != 0 || own.st_size > 0 || segments_there(f->path)) return;
    if (stat(f->path, &named) == 0 && named.st_dev == own.st_dev && named.st_ino == own.st_ino) unlink(f->path);
}

static size_t first_segment(const sweep *s) { return 1 + (s->options->team ? (size_t)s->options->team->rank : 0); }

motus_status sweep_events_begin(sweep_events *f, const sweep *s, motus_error *err)
{
    *f = (sweep_events){.sweep = s, .path = s->options->events, .descriptor = -1};
    if (!f->path) return MOTUS_OK;
    motus_status status = make_head(f, err);
    if (!status && sweep_events_in_segments(s->options))
        status = segments_make(&f->segments, f->path, f->head, same_head, shard_blocks(&s->shard, s->rows),
                               first_segment(s), err);
    const bool first = team_first(s->options->team); /* the first process joins the segments */
    if (!status && f->segments && first && !s->options->plan) status = lock_table(f, err);
    struct stat about;
    if (status || !s->options->resume || stat(f->path, &about) != 0) return status;
    if (!f->segments) return find_table(f, 0, err);
    if (about.st_size == 0 || !first) return MOTUS_OK; /* an empty table is not joined yet */
    status = find_table(f, s->rows, err);
    f->complete = !status;
    return status;
}

motus_status sweep_events_find(sweep_events *f, motus_error *err)
{
    return f->segments ? segments_find(f->segments, err) : MOTUS_OK;
}

bool sweep_events_have(const sweep_events *f, uint64_t block)
{
    return !f->segments || f->complete || segments_have(f->segments, block);
}

motus_status sweep_events_open(sweep_events *f, uint64_t rows, motus_error *err)
{
    const sweep *s = f->sweep;
    if (!f->path) return MOTUS_OK;
    f->values = malloc((2 * (s->event_columns_count + s->event_columns_more) + 1) * sizeof *f->values);
    if (!f->values) return complain_memory(err);
    if (f->segments) return team_first(s->options->team) ? begin_segments(f, err) : MOTUS_OK;
    motus_status status = MOTUS_OK;
    if (strcmp(f->path, "-") == 0)
        f->descriptor = STDOUT_FILENO;
    else
        status = target_lock(f->path, &f->descriptor, &f->regular, err);
    if (!status) status = target_check(s->options, f->path, err);
    if (status) return status;
    return s->options->resume && f->regular ? go_on(f, rows, err) : put_head(f, err);
}

/* ---- rows ---- */

static motus_status put_table(const sweep_events *f, file_out *out, uint64_t first, size_t k, motus_error *err)
{
    const sweep *s = f->sweep;
    const size_t count = s->event_columns_count, all = count + s->event_columns_more;
    const int64_t rows = motus_ensemble_events(s->ensemble, k);
    char number[DECIMAL_MAX + 1];
    motus_status status = MOTUS_OK;
    number[decimal_write_whole(shard_trajectory(&s->shard, first + k), number)] = 0;
    strcat(number, ",");
    for (int64_t i = 0; !status && i < rows; i++) {
        motus_event_row row = motus_default_event_row();
        motus_ensemble_event(s->ensemble, k, i, &row, f->values, f->values + all);
        status = file_text(out, number, err);
        if (!status) status = event_file_row(out, &row, s->errors, f->values, f->values + all, count, err);
    }
    return status;
}

/* Writes the events of `count` trajectories, followed by `last`. The caller frees m->text. */
static motus_status table_text(const sweep_events *f, uint64_t first, size_t from, size_t count, const char *last,
                               file_memory *m, motus_error *err)
{
    motus_status status = file_memory_open(m, err);
    for (size_t k = from; !status && k < from + count; k++) status = put_table(f, &m->file, first, k, err);
    if (!status) status = file_text(&m->file, last, err);
    return file_memory_close(m, status, err);
}

/* Appends events to the segment, block by block. */
static motus_status to_segments(sweep_events *f, uint64_t first, size_t count, motus_error *err)
{
    motus_status status = MOTUS_OK;
    for (size_t from = 0, some; !status && from < count; from += some) {
        const uint64_t row = first + from;
        const uint64_t block = f->sweep->shard.block;
        const size_t left = (size_t)(block - row % block);
        file_memory m;
        some = left < count - from ? left : count - from;
        status = table_text(f, first, from, some, "", &m, err);
        if (!status) status = segments_put(f->segments, m.text, m.length, err);
        free(m.text);
        if (!status && (some == left || row + some == f->sweep->rows))
            status = segments_end_block(f->segments, row / block, err);
    }
    return status;
}

motus_status sweep_events_rows(sweep_events *f, uint64_t first, size_t count, motus_error *err)
{
    if (!f->path) return MOTUS_OK;
    if (f->complete) return MOTUS_OK;
    if (f->segments) return to_segments(f, first, count, err);
    file_memory m;
    char line[SWEEP_EVENTS_LAST];
    const size_t last = last_line(first + count, line);
    motus_status status = table_text(f, first, 0, count, line, &m, err);
    if (!status) status = put(f, m.text, m.length, m.length - last, err);
    free(m.text);
    return status;
}

motus_status sweep_events_finish(sweep_events *f, motus_error *err)
{
    const int descriptor = f->descriptor;
    if (f->segments) return segments_finish(f->segments, err);
    const motus_status checked = checks_finish(&f->checks, err);
    if (checked) return checked;
    if (f->path && !f->regular) {
        char line[SWEEP_EVENTS_LAST];
        const size_t last = last_line(f->sweep->rows, line);
        const motus_status status = put(f, line, last, last, err);
        if (status) return status;
    }
    f->descriptor = -1;
    return descriptor > STDERR_FILENO && close(descriptor) != 0 ? file_cannot_write(f->path, errno, err) : MOTUS_OK;
}

motus_status sweep_events_join(sweep_events *f, stop_progress *progress, motus_error *err)
{
    if (!f->segments) return MOTUS_OK;
    char line[SWEEP_EVENTS_LAST];
    last_line(f->sweep->rows, line);
    return f->complete ? segments_remove(f->segments, err) : segments_join(f->segments, line, progress, err);
}

void sweep_events_close(sweep_events *f)
{
    if (f->segments) unlock_table(f);
    if (f->descriptor > STDERR_FILENO) close(f->descriptor);
    segments_free(f->segments);
    checks_close(&f->checks);
    free(f->head);
    free(f->values);
    *f = (sweep_events){.descriptor = -1};
}
