/* The archive of a run, FILE.h5: its rows, and the states from which it continues.
 *
 * The rows lie in blocks, and a block is written when it is complete. A state has the rows of the incomplete block,
 * so that a run can continue from it even if the process was killed while it wrote that block.
 *
 * Invariants: the file can be opened at any time and shows which blocks it has. To grow, it is replaced by another
 * file, which takes its name when it has all that the old file has. The bytes of a finished file depend only on the
 * run: the number of rows and the size of the slots for states follow from the rows, the first and the last state. */
#include "cli/run/run.h"

#include "base/decimal.h"
#include "cli/files/archived.h"
#include "cli/files/file.h"
#include "cli/files/stop.h"
#include "cli/files/target.h"
#include "cli/words/complain.h"

#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <math.h>
#include <motus-archive.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { BLOCK_BYTES = 1 << 20, BLOCK_MOST = 4096, UNKNOWN = 4 * BLOCK_MOST, USUAL_S = 600, JUMPS = 256 };

struct run_archive {
    run_archive_def of;
    const char *path;
    char *command, fingerprint[RUN_FINGERPRINT];
    char first_end[64]; /* the note RUN_FIRST_END; "": the steps are fixed, or the run has had only one end */
    int descriptor;     /* of the lock */
    motus_archive *file;
    run_columns columns;
    double **rooms; /* for a block of rows */
    size_t block;
    uint64_t rows, capacity; /* rows that were taken; rows that the file has room for */
    uint64_t kept;           /* the rows before the last state in the file */
    size_t slot, first_slot; /* the size of a slot for states; the size that the first state needs */
    int64_t samples;
    double time;         /* of the row that is taken */
    double jumps[JUMPS]; /* the times of the last rows at jumps */
    uint64_t jump_rows;  /* the number of rows at jumps */
    bool made;           /* this command has made the file */
    bool goes_on;        /* the run has been moved to a state of the file */
    bool due;            /* the row that may be due at that state has not been taken */
    bool finished;       /* everything is in the file */
    char *last;          /* a state of the last steps, if there are events; NULL: there is none */
    size_t last_length, last_needs;
    bool end_row; /* the last row was taken at the end, and not at a jump */
};

/* ---- sizes ---- */

static size_t rest_most(const run_archive *a) { return a->block * a->columns.width * sizeof(double); }

/* Returns how many rows the run has up to its end, if no events add rows. *known is false if it is a guess, since the
 * steps are adaptive. */
static uint64_t expected_rows(const run_archive *a, bool *known)
{
    const walk_observer *rows = a->of.rows;
    const int64_t total = motus_run_now(a->of.run).steps_total;
    *known = true;
    if (rows->stride > 0 && total > 0) return (uint64_t)(total / rows->stride + 1 + (total % rows->stride != 0));
    if (rows->period > 0) {
        const double span = fabs(a->of.until - a->of.start), all = ceil(span / rows->period * (1 - 1e-12)) + 1;
        if (all < 1e15) return (uint64_t)all;
    }
    *known = false;
    return UNKNOWN / a->block * a->block + a->block;
}

/* ---- the file ---- */

/* Makes an archive in the empty file `descriptor`, or, if that is -1, under the name `path`. If `from` is not NULL,
 * it has the rows of that archive, compressed. */
static motus_status create(const run_archive *a, const char *path, int descriptor, uint64_t rows, size_t slot,
                           motus_archive *from, motus_error *err)
{
    enum { NOTES = 6 };
    const motus_archive_note notes[NOTES] = {
        {"motus", motus_version()},      {"command", a->command},      {"method", motus_run_now(a->of.run).method},
        {"fingerprint", a->fingerprint}, {"model", a->of.model->text}, {RUN_FIRST_END, a->first_end}};
    motus_archive_def d = motus_archive_default();
    d.group = "run", d.scale = "row";
    d.rows = rows, d.block = a->block;
    d.columns = a->columns.described, d.column_count = a->columns.count;
    d.notes = notes, d.note_count = a->first_end[0] ? NOTES : NOTES - 1;
    d.links = a->columns.links, d.link_count = a->columns.link_count;
    d.attributes = a->columns.attributes, d.attribute_count = a->columns.attribute_count;
    d.slot = slot;
    d.from = from;
    d.descriptor = descriptor + 1;
    d.stop = from ? stop_asked : NULL; /* a run that is stopped must still make its file the right size */
    return motus_archive_create(path, &d, err);
}

/* Locks the file, so that only one program writes it. */
static motus_status lock(const char *path, int *descriptor, motus_error *err)
{
    bool regular = true;
    const motus_status status = target_lock(path, descriptor, &regular, err);
    if (status || regular) return status;
    return fail(err, MOTUS_ARGUMENT, "%s is not a regular file, which an archive must be", path);
}

static motus_status copy_blocks(const run_archive *a, motus_archive *from, motus_archive *to, motus_error *err)
{
    double **rooms = run_columns_rooms(&a->columns, a->block);
    motus_status status = rooms ? MOTUS_OK : complain_memory(err);
    for (uint64_t b = 0; !status && b < a->rows / a->block; b++) {
        int whole;
        for (size_t k = 0; !status && k < a->columns.count; k++)
            status = motus_archive_read(from, k, b * a->block, a->block, rooms[k], err);
        if (!status) status = motus_archive_whole(from, b, &whole, err); /* the copy gets a new hash that matches */
        if (!status && !whole) status = fail(err, MOTUS_STATE, "block %" PRIu64 " of %s is damaged", b + 1, a->path);
        if (!status) status = motus_archive_write(to, b, (const void *const *)rooms, err);
    }
    run_columns_drop(&a->columns, rooms);
    return status;
}

/* Writes a state, or, if `bytes` is NULL, the latest state of `from`. */
static motus_status put_state(motus_archive *from, motus_archive *to, const char *bytes, size_t length,
                              motus_error *err)
{
    char *its = NULL;
    motus_status status = bytes ? MOTUS_OK : motus_archive_saved(from, 0, &its, &length, err);
    if (!status && (bytes || its)) status = motus_archive_save(to, bytes ? bytes : its, length, err);
    free(its);
    return status;
}

/* Locks a file that has no name yet, by another descriptor. */
static motus_status lock_beside(const run_archive *a, const file_beside *f, int *descriptor, motus_error *err)
{
    if (f->descriptor < 0) return lock(f->path, descriptor, err);
    *descriptor = fcntl(f->descriptor, F_DUPFD_CLOEXEC, 0);
    if (*descriptor < 0) return file_cannot("write", a->path, errno, err);
    (void)target_take(a->path, *descriptor); /* no other program can have the lock */
    return MOTUS_OK;
}

/* Makes the new file of replace(). */
static motus_status make_beside(const run_archive *a, const file_beside *f, motus_archive *from, uint64_t rows,
                                size_t slot, const char *state, size_t length, motus_error *err)
{
    struct stat about;
    motus_archive *to = NULL;
    motus_status status = create(a, f->descriptor < 0 ? f->path : a->path, f->descriptor, rows, slot, NULL, err);
    if (!status && stat(f->name, &about) == 0) (void)chmod(f->path, about.st_mode & 07777);
    if (!status) status = motus_archive_open(f->path, 1, &to, err);
    if (!status && from) status = copy_blocks(a, from, to, err);
    if (!status) status = put_state(from, to, state, length, err);
    if (!status) status = motus_archive_sync(to, err);
    motus_archive_close(to);
    return status;
}

/* Replaces the locked file by another one with the complete blocks of `from`, which may be a->file or NULL, the state
 * (NULL: the latest of `from`), and room for `rows` rows. The new file is locked before it takes the name. */
static motus_status replace(run_archive *a, motus_archive *from, uint64_t rows, size_t slot, const char *state,
                            size_t length, motus_error *err)
{
    int descriptor = -1;
    file_beside beside = FILE_BESIDE;
    motus_archive *to = NULL;
    motus_status status = file_beside_make(&beside, a->path, ARCHIVE_GROWN, err);
    if (!status) status = make_beside(a, &beside, from, rows, slot, state, length, err);
    if (!status) status = lock_beside(a, &beside, &descriptor, err);
    if (!status) status = file_beside_keep(&beside, err);
    if (status) file_beside_complain(&beside, a->path, err);
    if (!status) status = motus_archive_open(a->path, 1, &to, err); /* errors of `to` will have this name */
    if (!status) {
        motus_archive_close(a->file);
        close(a->descriptor);
        a->file = to;
        a->descriptor = descriptor;
        a->capacity = rows;
        a->slot = slot;
    } else if (descriptor >= 0) {
        close(descriptor);
    }
    file_beside_drop(&beside);
    return status;
}

/* ---- rows ---- */

static motus_status write_block(run_archive *a, uint64_t block, motus_error *err)
{
    return motus_archive_write(a->file, block, (const void *const *)a->rooms, err);
}

static motus_status add(run_archive *a, const double *values, motus_error *err)
{
    if (a->rows == a->capacity) {
        const uint64_t more = (2 * a->capacity / a->block + 1) * a->block;
        const motus_status status = replace(a, a->file, more, a->slot, NULL, 0, err);
        if (status) return status;
    }
    run_columns_put(&a->columns, a->of.plan, values, a->rooms, (size_t)(a->rows % a->block));
    a->rows++;
    return a->rows % a->block == 0 ? write_block(a, a->rows / a->block - 1, err) : MOTUS_OK;
}

static motus_status take(void *context, const double *values, motus_error *err)
{
    run_archive *a = context;
    a->end_row = motus_run_done(a->of.run) && a->time == motus_run_time(a->of.run);
    return add(a, values, err);
}

static motus_status jump(void *context, const double *before, const double *after, motus_error *err)
{
    run_archive *a = context;
    a->end_row = false;
    for (int k = 0; k < 2; k++) a->jumps[a->jump_rows++ % JUMPS] = a->time;
    const motus_status status = add(a, before, err);
    return status ? status : add(a, after, err);
}

/* ---- states ---- */

/* Makes the state of the run with its first `rows` rows; the caller frees *bytes. *needs is the size of its slot. */
static motus_status write_state(run_archive *a, uint64_t rows, bool due, char **bytes, size_t *length, size_t *needs,
                                motus_error *err)
{
    const size_t some = (size_t)(rows % a->block);
    run_state s = {
        .rows = rows, .samples = a->samples, .due = due, .rest_length = some * a->columns.width * sizeof(double)};
    char *rest;
    *bytes = NULL;
    motus_status status = motus_run_save(a->of.run, &s.text, &s.length, err);
    if (status) return status;
    *needs = run_state_slot(s.length, rest_most(a));
    *bytes = run_state_write(&s, length, &rest);
    if (!*bytes) return complain_memory(err);
    const bool written = rows / a->block < a->rows / a->block; /* if so, the rooms have later rows */
    for (size_t c = 0; !status && some > 0 && c < a->columns.count; c++) {
        const size_t size = some * a->columns.columns[c].width * sizeof(double);
        if (written)
            status = motus_archive_read(a->file, c, rows / a->block * a->block, some, rest, err);
        else
            memcpy(rest, a->rooms[c], size);
        rest += size;
    }
    return status;
}

static motus_status keep(void *context, motus_error *err)
{
    run_archive *a = context;
    char *bytes;
    size_t length, needs;
    motus_status status = write_state(a, a->rows, false, &bytes, &length, &needs, err);
    if (!status && length > a->slot)
        status = replace(a, a->file, a->capacity, needs, bytes, length, err);
    else if (!status)
        status = motus_archive_save(a->file, bytes, length, err);
    if (!status) a->kept = a->rows;
    free(bytes);
    return status;
}

/* Remembers a state of the last steps. With events, the library's state at the end is that before the last step,
 * with or without an event where that step begins; the state of an earlier step is then used for the end. */
static motus_status remember(void *context, motus_error *err)
{
    run_archive *a = context;
    char *bytes;
    motus_status status = write_state(a, a->rows, false, &bytes, &a->last_length, &a->last_needs, err);
    free(a->last);
    a->last = status ? NULL : bytes;
    if (status) free(bytes);
    return status;
}

static bool has_events(const char *state) { return strstr(state, "\nevents ") != NULL; }

/* Returns the time after this many fixed steps from the start, as in a run to a later end. */
static double time_of(const run_archive *a, int64_t steps)
{
    const double h = motus_run_now(a->of.run).step;
    return a->of.start + (a->of.until < a->of.start ? -h : h) * (double)steps;
}

/* Returns whether the last of fixed steps is shorter than the others. */
static bool shorter_last(const run_archive *a)
{
    const int64_t total = motus_run_now(a->of.run).steps_total;
    return total > 0 && fabs(time_of(a, total) - a->of.until) > 1e-6 * motus_run_now(a->of.run).step;
}

/* Returns whether remember() is needed: if there are events; or if the end is a whole number of steps only up to
 * rounding, so that a longer run has neither that time nor the times within the last step. */
static bool wants_last(const run_archive *a)
{
    const char *text;
    size_t length;
    motus_error ignored = motus_default_error();
    const int64_t total = motus_run_now(a->of.run).steps_total;
    if (total == 0 || motus_run_save(a->of.run, &text, &length, &ignored) != MOTUS_OK) return false;
    return has_events(text) || (!shorter_last(a) && time_of(a, total) != a->of.until);
}

/* Moves the run to a state of `from`. *found is false if `from` lacks that state or a block before it. */
static motus_status take_state(run_archive *a, motus_archive *from, int back, bool *found, motus_error *err)
{
    char *bytes;
    size_t length;
    run_state s;
    motus_status status = motus_archive_saved(from, back, &bytes, &length, err);
    *found = false;
    if (status || !bytes) return status;
    int whole = run_state_read(bytes, length, &s) && s.rows <= motus_archive_rows(from) &&
                (s.rows % a->block) * a->columns.width * sizeof(double) == s.rest_length;
    for (uint64_t b = 0; !status && whole && b < s.rows / a->block; b++)
        status = motus_archive_whole(from, b, &whole, err);
    if (!status && whole) status = motus_run_restore(a->of.run, s.text, s.length, err);
    if (!status && whole) {
        for (size_t c = 0; c < a->columns.count; c++) {
            const size_t size = (size_t)(s.rows % a->block) * a->columns.columns[c].width * sizeof(double);
            memcpy(a->rooms[c], s.rest, size);
            s.rest += size;
        }
        a->rows = a->kept = s.rows;
        a->samples = s.samples;
        a->due = s.due;
        a->goes_on = *found = true;
    }
    free(bytes);
    return status;
}

/* ---- opening ---- */

static motus_status make_rooms(run_archive *a, motus_error *err)
{
    const size_t row = (a->columns.width + 1) * sizeof(double), rows = BLOCK_BYTES / row;
    a->block = rows < 1 ? 1 : rows < BLOCK_MOST ? rows : BLOCK_MOST;
    a->rooms = run_columns_rooms(&a->columns, a->block);
    return a->rooms ? MOTUS_OK : complain_memory(err);
}

/* Returns whether the file has the columns of this run, in blocks of our size. */
static bool fits(const run_archive *a, motus_archive *file)
{
    uint64_t first;
    size_t count;
    const uint64_t rows = motus_archive_rows(file);
    motus_archive_block(file, 0, &first, &count);
    return run_columns_fit(&a->columns, file) && count == (rows < a->block ? rows : a->block);
}

/* Compares the first rows of a file that another version has begun with those that this version computes. Fails if a
 * bit differs. */
static motus_status compare_versions(const run_archive *a, const char *path, motus_archive *from, const char *version,
                                     motus_error *err)
{
    enum { ROWS = 64 };
    int whole = 0;
    uint64_t first;
    size_t count;
    bool same = true;
    char where[RUN_WHERE] = "";
    motus_status status = motus_archive_whole(from, 0, &whole, err);
    motus_archive_block(from, 0, &first, &count);
    if (!status && whole)
        status = run_again_rows(a->of.options, from, count < ROWS ? count : ROWS, &same, where, NULL, err);
    return status ? status : archived_compared(path, version, whole, same ? NULL : where, a->of.options->quiet, err);
}

/* Opens the file that the run continues, and moves the run to its latest state. If `same`, the file must be of this
 * command. */
static motus_status open_source(run_archive *a, const char *path, bool same, motus_archive **from, motus_error *err)
{
    char print[RUN_FINGERPRINT];
    bool found = false;
    motus_status status = motus_archive_open(path, 0, from, err);
    if (status) return status;
    const char *version = motus_archive_note_of(*from, "motus");
    if (!version || !fits(a, *from)) return archived_another(*from, path, "run", err);
    run_command_fingerprint(version, a->of.model->text, a->command, print);
    if (same && !archived_says(*from, "fingerprint", print)) return archived_another(*from, path, "run", err);
    if (strcmp(version, motus_version()) != 0) status = compare_versions(a, path, *from, version, err);
    for (int back = 0; !status && !found && back < 2; back++) status = take_state(a, *from, back, &found, err);
    if (status || found) return status;
    return complain(err, MOTUS_STATE, "use a copy of the file, or start again: its command with --force",
                    "%s is damaged: it has no state with all the rows before it", path);
}

/* Notes the end of the file that continues if its steps are adaptive: they landed on that end, where a run to the later
 * end would not, so the rows before it can only be verified by a run to that end. */
static void note_first_end(run_archive *a, motus_archive *source)
{
    char time[DECIMAL_MAX];
    const char *its = motus_archive_note_of(source, RUN_FIRST_END);
    if (its && strlen(its) < sizeof a->first_end)
        strcpy(a->first_end, its);
    else if (motus_run_now(a->of.run).steps_total == 0 && !archived_says(source, "command", a->command))
        snprintf(a->first_end, sizeof a->first_end, "%s %" PRIu64, decimal(motus_run_time(a->of.run), time), a->rows);
}

/* Continues the file, or replaces it by another one of the right size. */
static motus_status go_on(run_archive *a, motus_archive *source, bool own, motus_error *err)
{
    bool known;
    const uint64_t capacity = expected_rows(a, &known);
    const bool stays = own && archived_says(source, "command", a->command) && !motus_archive_compressed(source);
    if (!motus_archive_makes() && !(stays && known && capacity == motus_archive_rows(source)))
        return complain(err, MOTUS_UNAVAILABLE, "install HDF5, and build motus where libhdf5-dev is installed",
                        "%s: the file must be replaced by a new one, which needs HDF5", a->path);
    note_first_end(a, source);
    if (!stays) return replace(a, source, a->rows > capacity ? a->rows : capacity, a->first_slot, NULL, 0, err);
    a->capacity = motus_archive_rows(source);
    a->slot = motus_archive_slot(source);
    return motus_archive_open(a->path, 1, &a->file, err);
}

static motus_status begin(run_archive *a, motus_error *err)
{
    motus_archive *source = NULL;
    char *bytes;
    size_t length;
    struct stat about;
    bool known;
    const options *o = a->of.options;
    motus_status status = lock(a->path, &a->descriptor, err);
    if (!status && fstat(a->descriptor, &about) != 0) status = file_cannot("read", a->path, errno, err);
    if (status) return status;
    a->made = about.st_size == 0;
    const char *from = a->of.from;
    const bool own = from && file_same(from, a->path);
    if (!a->made && !own && !o->resume && !o->force)
        return complain(err, MOTUS_ARGUMENT, "--resume continues it, --force replaces it", "%s exists", a->path);
    if (!o->resume && !from && !motus_archive_makes())
        return complain(err, MOTUS_UNAVAILABLE,
                        "write CSV; or install HDF5, and build motus where libhdf5-dev is installed",
                        "%s: this motus cannot make archives, since it was built or runs without HDF5", a->path);
    target_tidy(a->path);
    const bool same = !a->made && o->resume;
    if (same) from = a->path;
    status = write_state(a, 0, true, &bytes, &length, &a->first_slot, err);
    if (!status && !from)
        status = replace(a, NULL, expected_rows(a, &known), a->first_slot, bytes, length, err);
    else if (!status)
        status = open_source(a, from, same, &source, err);
    if (!status && from) status = go_on(a, source, own || same, err);
    motus_archive_close(source);
    free(bytes);
    return status;
}

motus_status run_archive_open(run_archive **out, const run_archive_def *of, motus_error *err)
{
    run_archive *a = *out = calloc(1, sizeof *a);
    if (!a) return complain_memory(err);
    a->of = *of;
    a->path = of->options->output;
    a->descriptor = -1;
    motus_status status = run_columns_make(&a->columns, of->plan, err);
    if (!status) status = make_rooms(a, err);
    if (!status) status = run_command_text(of->options, of->run, of->until, &a->command, err);
    if (!status) run_command_fingerprint(motus_version(), of->model->text, a->command, a->fingerprint);
    return status ? status : begin(a, err);
}

int64_t run_archive_rows(const run_archive *a) { return (int64_t)a->rows; }

void run_archive_observe(run_archive *a, walk_observer *rows, walk_keeper *keeper)
{
    const options *o = a->of.options;
    rows->take = take;
    rows->jump = jump;
    rows->context = a;
    rows->had = a->samples;
    *keeper = (walk_keeper){.steps = o->checkpoint.steps,
                            .seconds = o->checkpoint.time > 0 ? o->checkpoint.time : USUAL_S,
                            .keep = keep,
                            .context = a,
                            .remember = wants_last(a) ? remember : NULL,
                            .samples = &a->samples,
                            .time = &a->time,
                            .goes_on = a->goes_on,
                            .due = a->due};
}

/* ---- the end ---- */

/* Returns how many samples of the period there are up to a time, as walk() counts them. */
static int64_t samples_up_to(const run_archive *a, double time)
{
    const double period = a->of.rows->period, sign = a->of.until < a->of.start ? -1 : 1;
    int64_t k = a->samples;
    while (k > 0 && sign * (a->of.start + sign * (double)(k - 1) * period - time) > 0) k--;
    return k;
}

/* Finds how many rows, and samples, a run to a later end has too: those up to the last state, without the row of the
 * end, unless it is due there anyway. With fixed steps, the last state is before the last step if that is shorter or
 * if there are events (motus_run_save). */
static motus_status rows_to_keep(run_archive *a, uint64_t *rows, bool *due, motus_error *err)
{
    const char *text;
    size_t length;
    const walk_observer *o = a->of.rows;
    const motus_status status = motus_run_save(a->of.run, &text, &length, err);
    if (status) return status;
    const int64_t taken = motus_run_steps(a->of.run), total = motus_run_now(a->of.run).steps_total;
    const bool before = total > 0 && taken == total && (has_events(text) || shorter_last(a));
    const bool regular = o->stride > 0 && taken % o->stride == 0 && !before;
    uint64_t more = a->end_row && !regular;
    if (o->period > 0) a->samples = samples_up_to(a, motus_run_time(a->of.run)); /* an event may have ended the run */
    *due = more > 0 && !before;
    if (before) {
        const double at = motus_run_time_of(a->of.run, total - 1), sign = a->of.until < a->of.start ? -1 : 1;
        const int64_t samples = o->period > 0 ? samples_up_to(a, at) : a->samples;
        more += (uint64_t)(a->samples - samples);
        a->samples = samples;
        for (uint64_t k = 1; k <= JUMPS && k <= a->jump_rows; k++)
            more += sign * (a->jumps[(a->jump_rows - k) % JUMPS] - at) > 0;
    }
    *rows = a->rows - (more < a->rows ? more : a->rows);
    return MOTUS_OK;
}

motus_status run_archive_finish(run_archive *a, motus_error *err)
{
    uint64_t rows;
    bool due;
    char *bytes = NULL;
    size_t length = 0, needs = 0;
    motus_status status = MOTUS_OK;
    if (a->last) {
        bytes = a->last, length = a->last_length, needs = a->last_needs;
        a->last = NULL;
    } else {
        status = rows_to_keep(a, &rows, &due, err);
        if (!status) status = write_state(a, rows, due, &bytes, &length, &needs, err);
    }
    const size_t slot = length <= a->first_slot ? a->first_slot : needs;
    if (!status && (a->slot != slot || a->capacity != a->rows))
        status = replace(a, a->file, a->rows, slot, bytes, length, err);
    if (!status && a->rows % a->block != 0) status = write_block(a, a->rows / a->block, err);
    if (!status) status = motus_archive_settle(a->file, bytes, length, err);
    if (!status) status = motus_archive_sync(a->file, err);
    if (!status) a->kept = a->rows;
    a->finished = !status;
    free(bytes);
    return status;
}

motus_status run_archive_compress(run_archive *a, motus_error *err)
{
    return create(a, a->path, -1, a->rows, a->slot, a->file, err);
}

void run_archive_leave(run_archive *a, bool whole)
{
    struct stat own, named;
    if (!a) return;
    motus_error ignored = motus_default_error();
    if (whole && a->file && !a->finished) (void)run_archive_finish(a, &ignored);
    if (a->file && a->kept > 0) {
        if (!a->of.options->quiet)
            complain_note("%s has %" PRIu64 " rows; the same command with --resume, or motus run %s, continues",
                          a->path, a->kept, a->path);
    } else if (a->made && a->descriptor >= 0 && fstat(a->descriptor, &own) == 0 && stat(a->path, &named) == 0 &&
               own.st_dev == named.st_dev && own.st_ino == named.st_ino) {
        unlink(a->path);
    }
}

void run_archive_close(run_archive *a)
{
    if (!a) return;
    motus_archive_close(a->file);
    if (a->descriptor >= 0) close(a->descriptor);
    run_columns_drop(&a->columns, a->rooms);
    run_columns_free(&a->columns);
    free(a->last);
    free(a->command);
    free(a);
}
