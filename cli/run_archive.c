/* See run_archive.h.
 *
 * The rows lie in blocks, which are written when they are complete. A state has the rows of the block that is not, so
 * that a run goes on from it even if that block was being written when the process was killed.
 *
 * Invariants: the file opens at any time and tells which blocks are there. It grows by another file, which takes its
 * name when it has all that the old one had. At the end its bytes depend on the run alone: how many rows it has room
 * for and how large the slots of states are follow from the rows and from the first and the last state. / */
#include "cli/run_archive.h"

#include "base/decimal.h"
#include "base/error.h"
#include "cli/complain.h"
#include "cli/run_again.h"
#include "cli/run_columns.h"
#include "cli/run_command.h"
#include "cli/stop.h"
#include "cli/sweep.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <motus-archive.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { BLOCK_BYTES = 1 << 20, BLOCK_MOST = 4096, UNKNOWN = 4 * BLOCK_MOST, HEAD = 256, PAGE = 4096, USUAL_S = 600 };

struct run_archive {
    run_archive_def of;
    const char *path;
    char *command, fingerprint[RUN_FINGERPRINT];
    int descriptor; /* of the lock */
    motus_archive *file;
    run_columns columns;
    double **rooms; /* of each column, for a block of rows */
    const void **written;
    size_t block;
    uint64_t rows, capacity;
    size_t slot;         /* what a state may have, */
    size_t first_slot;   /*   and what the first one asks for */
    size_t state_length; /* of the last that was written, without rows */
    int64_t samples;
    double time, *times;      /* of the row that is taken; of the last rows, that of row i in times[i % block] */
    bool made, kept, goes_on; /* the file is new; it has a state; the run stands at one */
};

/* ---- sizes ---- */

static size_t slot_for(const run_archive *a, size_t state)
{
    const size_t rows = a->block * (a->columns.width + 1) * sizeof(double);
    return (HEAD + state + state / 4 + rows + PAGE - 1) / PAGE * PAGE;
}

/* How many rows the run has up to its end, if nothing happens on the way; where steps adapt, a guess. */
static uint64_t expected_rows(const run_archive *a)
{
    const walk_observer *rows = a->of.rows;
    const int64_t total = motus_run_steps_total(a->of.run);
    if (rows->stride > 0 && total > 0) return (uint64_t)(total / rows->stride + 1 + (total % rows->stride != 0));
    if (rows->period > 0) {
        const double span = fabs(a->of.until - a->of.start), all = ceil(span / rows->period * (1 - 1e-12)) + 1;
        if (all < 1e15) return (uint64_t)all;
    }
    return UNKNOWN / a->block * a->block + a->block;
}

/* ---- the file ---- */

static motus_status create(const run_archive *a, const char *path, uint64_t rows, size_t slot, motus_error *err)
{
    const motus_archive_note notes[] = {{"motus", motus_version()},
                                        {"command", a->command},
                                        {"method", motus_run_method(a->of.run)},
                                        {"fingerprint", a->fingerprint},
                                        {"model", a->of.model->text}};
    motus_archive_def d = motus_archive_default();
    d.group = "run", d.scale = "row";
    d.rows = rows, d.block = a->block;
    d.columns = a->columns.described, d.column_count = a->columns.count;
    d.notes = notes, d.note_count = sizeof notes / sizeof *notes;
    d.links = a->columns.links, d.link_count = a->columns.link_count;
    d.attributes = a->columns.attributes, d.attribute_count = a->columns.attribute_count;
    d.slot = slot;
    return motus_archive_create(path, &d, err);
}

/* Only one program writes the file. */
static motus_status lock(run_archive *a, motus_error *err)
{
    bool regular = true;
    if (a->descriptor >= 0) close(a->descriptor);
    a->descriptor = -1;
    const motus_status status = sweep_file_lock(a->path, &a->descriptor, &regular, err);
    if (status || regular) return status;
    return fail(err, MOTUS_ARGUMENT, "%s is not a regular file, which an archive must be", a->path);
}

static motus_status copy_blocks(const run_archive *a, motus_archive *from, motus_archive *to, motus_error *err)
{
    double **rooms = calloc(a->columns.count, sizeof *rooms);
    motus_status status = rooms ? MOTUS_OK : complain_memory(err);
    for (size_t k = 0; !status && k < a->columns.count; k++)
        if (!(rooms[k] = malloc(a->block * a->columns.columns[k].width * sizeof **rooms)))
            status = complain_memory(err);
    for (uint64_t b = 0; !status && b < a->rows / a->block; b++) {
        for (size_t k = 0; !status && k < a->columns.count; k++)
            status = motus_archive_read(from, k, b * a->block, a->block, rooms[k], err);
        if (!status) status = motus_archive_write(to, b, (const void *const *)rooms, err);
    }
    for (size_t k = 0; rooms && k < a->columns.count; k++) free(rooms[k]);
    free(rooms);
    return status;
}

static motus_status copy_state(motus_archive *from, motus_archive *to, motus_error *err)
{
    char *bytes;
    size_t length;
    motus_status status = motus_archive_saved(from, 0, &bytes, &length, err);
    if (!status && bytes) status = motus_archive_save(to, bytes, length, err);
    free(bytes);
    return status;
}

/* Another file takes the place of this one, with the complete blocks and the state of `from`, which may be this one,
 * and other sizes. */
static motus_status rebuild(run_archive *a, motus_archive *from, uint64_t rows, size_t slot, motus_error *err)
{
    static const char ending[] = ".grown";
    motus_archive *to = NULL;
    char *where = realpath(a->path, NULL); /* where a link leads */
    const char *name = where ? where : a->path;
    char *beside = malloc(strlen(name) + sizeof ending);
    motus_status status = beside ? MOTUS_OK : complain_memory(err);
    if (beside) strcat(strcpy(beside, name), ending);
    if (!status) status = create(a, beside, rows, slot, err);
    const bool made = !status;
    if (!status) status = motus_archive_open(beside, 1, &to, err);
    if (!status) status = copy_blocks(a, from, to, err);
    if (!status) status = copy_state(from, to, err);
    if (!status) status = motus_archive_sync(to, err);
    if (!status && rename(beside, name) != 0)
        status = fail(err, MOTUS_FILE, "cannot write %s: %s", a->path, strerror(errno));
    if (!status) {
        file_synchronise_folder(name);
        motus_archive_close(a->file);
        a->file = to;
        a->capacity = rows;
        a->slot = slot;
        status = lock(a, err);
    } else {
        motus_archive_close(to);
        if (made) remove(beside);
    }
    free(beside);
    free(where);
    return status;
}

/* ---- rows ---- */

static motus_status write_block(run_archive *a, uint64_t block, motus_error *err)
{
    return motus_archive_write(a->file, block, a->written, err);
}

static motus_status take(void *context, const double *values, motus_error *err)
{
    run_archive *a = context;
    const size_t i = (size_t)(a->rows % a->block), count = a->of.plan->count;
    bool significant = true;
    if (a->rows == a->capacity) {
        const uint64_t more = (2 * a->capacity / a->block + 1) * a->block;
        const motus_status status = rebuild(a, a->file, more, a->slot, err);
        if (status) return status;
    }
    for (size_t k = count; a->of.plan->errors && k < 2 * count; k++)
        if (isinf(values[k])) significant = false;
    for (size_t c = 0; c < a->columns.count; c++) {
        const run_column *column = a->columns.columns + c;
        double *to = a->rooms[c] + i * column->width;
        if (column->from == SIZE_MAX)
            *to = significant;
        else
            memcpy(to, values + column->from, column->width * sizeof *to);
    }
    a->times[i] = a->time;
    a->rows++;
    return a->rows % a->block == 0 ? write_block(a, a->rows / a->block - 1, err) : MOTUS_OK;
}

static motus_status jump(void *context, const double *before, const double *after, motus_error *err)
{
    const motus_status status = take(context, before, err);
    return status ? status : take(context, after, err);
}

/* ---- states ---- */

static const char head_format[] = "motus run\nrows %" PRIu64 "\nsamples %" PRId64 "\nstate %zu\n";

/* The state of the run: a head of HEAD bytes, the library's restart state, and the first `rows` % block rows of the
 * block that is not complete, column after column. */
static motus_status write_state(run_archive *a, uint64_t rows, char **bytes, size_t *length, motus_error *err)
{
    const char *text;
    size_t count, some = (size_t)(rows % a->block) * sizeof(double);
    motus_status status = motus_run_save(a->of.run, &text, &count, err);
    if (status) return status;
    *length = HEAD + count + some * a->columns.width;
    a->state_length = count;
    char *out = *bytes = calloc(1, *length);
    if (!out) return complain_memory(err);
    snprintf(out, HEAD, head_format, rows, a->samples, count);
    memcpy(out + HEAD, text, count);
    out += HEAD + count;
    const bool written = rows / a->block < a->rows / a->block; /* then the rooms have later rows */
    for (size_t c = 0; !status && c < a->columns.count; c++) {
        const size_t size = some * a->columns.columns[c].width;
        if (written)
            status = motus_archive_read(a->file, c, rows / a->block * a->block, (size_t)(rows % a->block), out, err);
        else
            memcpy(out, a->rooms[c], size);
        out += size;
    }
    return status;
}

static motus_status keep(void *context, motus_error *err)
{
    run_archive *a = context;
    char *bytes = NULL;
    size_t length;
    motus_status status = write_state(a, a->rows, &bytes, &length, err);
    if (!status && length > a->slot) status = rebuild(a, a->file, a->capacity, slot_for(a, a->state_length), err);
    if (!status) status = motus_archive_save(a->file, bytes, length, err);
    a->kept = a->kept || !status;
    free(bytes);
    return status;
}

/* A number behind a word of the head of a state. */
static bool word(const char **at, const char *name, uint64_t *value)
{
    const size_t length = strlen(name);
    if (strncmp(*at, name, length) != 0) return false;
    const size_t digits = decimal_read_whole(*at + length, strlen(*at + length), value);
    if (digits == 0 || (*at)[length + digits] != '\n') return false;
    *at += length + digits + 1;
    return true;
}

typedef struct state_head {
    uint64_t rows, samples, count;
} state_head;

static bool read_head(const char *bytes, size_t length, state_head *h)
{
    const char *at = bytes;
    return length >= HEAD && memchr(bytes, 0, HEAD) && word(&at, "motus run\nrows ", &h->rows) &&
           word(&at, "samples ", &h->samples) && word(&at, "state ", &h->count) && h->count <= length - HEAD;
}

const char *run_archive_state(const char *bytes, size_t length, size_t *count)
{
    state_head h;
    if (!read_head(bytes, length, &h)) return NULL;
    *count = (size_t)h.count;
    return bytes + HEAD;
}

/* Moves the run to a state of `from`; *found false: it has not that state, or not the blocks before it. */
static motus_status take_state(run_archive *a, motus_archive *from, int back, bool *found, motus_error *err)
{
    char *bytes;
    size_t length;
    state_head h = {0};
    *found = false;
    motus_status status = motus_archive_saved(from, back, &bytes, &length, err);
    if (status || !bytes) return status;
    const bool good = read_head(bytes, length, &h) && h.rows <= motus_archive_rows(from) &&
                      (h.rows % a->block) * a->columns.width * sizeof(double) == length - HEAD - h.count;
    const uint64_t rows = h.rows;
    int whole = good;
    for (uint64_t b = 0; !status && whole && b < rows / a->block; b++)
        status = motus_archive_whole(from, b, &whole, err);
    if (!status && good && whole) status = motus_run_restore(a->of.run, bytes + HEAD, (size_t)h.count, err);
    if (!status && good && whole) {
        const size_t some = (size_t)(rows % a->block) * sizeof(double);
        const char *at = bytes + HEAD + h.count;
        for (size_t c = 0; c < a->columns.count; c++) {
            const size_t size = some * a->columns.columns[c].width;
            memcpy(a->rooms[c], at, size);
            at += size;
        }
        for (size_t i = 0; i < (size_t)(rows % a->block); i++) a->times[i] = NAN; /* before the state */
        a->rows = rows;
        a->samples = (int64_t)h.samples;
        a->goes_on = a->kept = *found = true;
    }
    free(bytes);
    return status;
}

/* ---- opening ---- */

static motus_status make_rooms(run_archive *a, motus_error *err)
{
    const size_t row = (a->columns.width + 1) * sizeof(double), rows = BLOCK_BYTES / row;
    a->block = rows < 1 ? 1 : rows < BLOCK_MOST ? rows : BLOCK_MOST;
    a->rooms = calloc(a->columns.count, sizeof *a->rooms);
    a->written = calloc(a->columns.count, sizeof *a->written);
    a->times = calloc(a->block, sizeof *a->times);
    if (!a->rooms || !a->written || !a->times) return complain_memory(err);
    for (size_t k = 0; k < a->columns.count; k++) {
        a->rooms[k] = calloc(a->block * a->columns.columns[k].width, sizeof **a->rooms);
        a->written[k] = a->rooms[k];
        if (!a->rooms[k]) return complain_memory(err);
    }
    return MOTUS_OK;
}

static motus_status another(const run_archive *a, motus_archive *file, motus_error *err)
{
    const char *command = motus_archive_note_of(file, "command");
    fail(err, MOTUS_STATE, "%s was made by another run", a->path);
    hint(err, command ? "it was made by: %.300s" : "--force replaces it%s", command ? command : "");
    return MOTUS_STATE;
}

/* Whether the file has the columns of this run in blocks of the same size. */
static bool fits(const run_archive *a, motus_archive *file)
{
    uint64_t first;
    size_t count;
    bool same = motus_archive_column_count(file) == a->columns.count;
    for (size_t k = 0; same && k < a->columns.count; k++) {
        motus_archive_column c;
        motus_archive_column_at(file, k, &c);
        same = strcmp(c.name, a->columns.described[k].name) == 0 && c.kind == MOTUS_ARCHIVE_NUMBER &&
               motus_archive_width(&c) == a->columns.columns[k].width;
    }
    motus_archive_block(file, 0, &first, &count);
    const uint64_t rows = motus_archive_rows(file);
    return same && count == (rows < a->block ? rows : a->block);
}

static bool says(motus_archive *file, const char *name, const char *text)
{
    const char *its = motus_archive_note_of(file, name);
    return its && strcmp(its, text) == 0;
}

static motus_status other_version(const char *path, const char *version, const char *why, motus_error *err)
{
    fail(err, MOTUS_STATE, "%s was begun by motus %.40s, and %s", path, version, why);
    hint(err, "finish it with that version, or begin anew with --force");
    return MOTUS_STATE;
}

/* A file that another version has begun goes on if its first rows have the bits that this one computes. */
static motus_status compare_versions(const run_archive *a, const char *path, motus_archive *from, const char *version,
                                     motus_error *err)
{
    enum { ROWS = 64 };
    int whole = 0;
    uint64_t first;
    size_t count;
    bool same = true;
    char where[RUN_WHERE] = "", why[RUN_WHERE + 64];
    motus_status status = motus_archive_whole(from, 0, &whole, err);
    motus_archive_block(from, 0, &first, &count);
    if (!status && !whole)
        return other_version(path, version, "there is no block by which to see whether the bits are the same", err);
    if (!status) status = run_again_rows(a->of.options, from, count < ROWS ? count : ROWS, &same, where, err);
    if (status) return status;
    snprintf(why, sizeof why, "this motus, %s, computes other bits: %s", motus_version(), where);
    if (!same) return other_version(path, version, why, err);
    if (!a->of.options->quiet)
        complain_note("%s was begun by motus %.40s; its first rows, computed again, have the same bits", path, version);
    return MOTUS_OK;
}

/* Opens the file to go on with; `same`: it must be of this very command. */
static motus_status open_source(run_archive *a, const char *path, bool same, motus_archive **from, motus_error *err)
{
    char print[RUN_FINGERPRINT];
    motus_status status = motus_archive_open(path, 0, from, err);
    if (status) return status;
    const char *version = motus_archive_note_of(*from, "motus");
    if (!version || !fits(a, *from)) return another(a, *from, err);
    run_command_fingerprint(version, a->of.model->text, a->command, print);
    if (same && !says(*from, "fingerprint", print)) return another(a, *from, err);
    if (strcmp(version, motus_version()) != 0) status = compare_versions(a, path, *from, version, err);
    bool found = false;
    if (!status) status = take_state(a, *from, 0, &found, err);
    if (!status && !found) status = take_state(a, *from, 1, &found, err);
    return status;
}

static motus_status make_new(run_archive *a, motus_error *err)
{
    a->capacity = expected_rows(a);
    a->slot = a->first_slot;
    motus_status status = create(a, a->path, a->capacity, a->slot, err);
    if (!status) status = motus_archive_open(a->path, 1, &a->file, err);
    return status ? status : lock(a, err);
}

/* The file that there is goes on as it is, or by another one of the right sizes. */
static motus_status go_on(run_archive *a, motus_archive *source, bool own, motus_error *err)
{
    if (own && says(source, "command", a->command)) { /* by whatever version it was begun */
        a->capacity = motus_archive_rows(source);
        a->slot = motus_archive_slot(source);
        return motus_archive_open(a->path, 1, &a->file, err);
    }
    const uint64_t capacity = expected_rows(a);
    return rebuild(a, source, a->rows > capacity ? a->rows : capacity, a->first_slot, err);
}

static motus_status begin(run_archive *a, motus_error *err)
{
    motus_archive *source = NULL;
    const char *text, *from = a->of.from;
    size_t length;
    struct stat about;
    const options *o = a->of.options;
    const bool own = from && file_same(from, a->path);
    a->made = stat(a->path, &about) != 0;
    const bool there = !a->made && about.st_size > 0;
    if (there && !own && !o->resume && !o->force) {
        fail(err, MOTUS_ARGUMENT, "%s exists", a->path);
        hint(err, "--resume continues it, --force replaces it");
        return MOTUS_ARGUMENT;
    }
    motus_status status = lock(a, err);
    if (!status) status = motus_run_save(a->of.run, &text, &length, err); /* the first state */
    if (status) return status;
    a->first_slot = slot_for(a, length);
    if (!from && !(there && o->resume)) return make_new(a, err);
    status = open_source(a, from ? from : a->path, !from, &source, err);
    if (!status) status = go_on(a, source, own || !from, err);
    motus_archive_close(source);
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

void run_archive_observe(run_archive *a, walk_observer *rows, walk_keeper *keeper)
{
    const options *o = a->of.options;
    rows->take = take;
    rows->jump = jump;
    rows->context = a;
    rows->had = a->samples;
    *keeper = (walk_keeper){.steps = o->keep_steps,
                            .seconds = o->keep_seconds > 0 ? o->keep_seconds : USUAL_S,
                            .keep = keep,
                            .context = a,
                            .samples = &a->samples,
                            .time = &a->time,
                            .goes_on = a->goes_on};
}

/* ---- the end ---- */

/* How many steps a restart state has. */
static int64_t steps_of(const char *state)
{
    uint64_t steps = 0;
    const char *at = strstr(state, "\nat ");
    if (at) decimal_read_whole(at + 4, strlen(at + 4), &steps);
    return (int64_t)steps;
}

/* How many rows, and samples, a run to a later end has too: those up to the last state, which is before a shorter last
 * step, but not that of the end, unless it was due there anyway. */
static motus_status rows_to_keep(run_archive *a, uint64_t *rows, motus_error *err)
{
    const char *text;
    size_t length;
    const motus_status status = motus_run_save(a->of.run, &text, &length, err);
    const walk_observer *o = a->of.rows;
    *rows = a->rows;
    if (status || a->rows == 0) return status;
    /* steps that adapt have no times that are known before, and no shorter last one that a longer run does not take */
    const bool adapts = isnan(motus_run_time_of(a->of.run, 0));
    const int64_t taken = motus_run_steps(a->of.run), steps = adapts ? taken : steps_of(text);
    const bool due = o->stride > 0 && taken % o->stride == 0 && steps == taken;
    const double now = motus_run_time_of(a->of.run, steps);
    *rows -= !due;
    if (o->period > 0 && steps < taken && !isnan(now))
        for (; *rows > 0 && fabs(a->times[(*rows - 1) % a->block] - a->of.start) > fabs(now - a->of.start); --*rows)
            a->samples--;
    return MOTUS_OK;
}

motus_status run_archive_finish(run_archive *a, motus_error *err)
{
    uint64_t rows;
    char *bytes = NULL;
    size_t length = 0;
    motus_status status = rows_to_keep(a, &rows, err);
    if (!status) status = write_state(a, rows, &bytes, &length, err);
    const size_t slot = length <= a->first_slot ? a->first_slot : slot_for(a, a->state_length);
    if (!status && (a->slot != slot || a->capacity != a->rows)) status = rebuild(a, a->file, a->rows, slot, err);
    if (!status && a->rows % a->block != 0) status = write_block(a, a->rows / a->block, err);
    if (!status) status = motus_archive_settle(a->file, bytes, length, err);
    if (!status) status = motus_archive_sync(a->file, err);
    a->kept = a->kept || !status;
    free(bytes);
    return status;
}

void run_archive_leave(run_archive *a)
{
    if (!a) return;
    if (a->kept && !a->of.options->quiet)
        complain_note("%s has %" PRIu64 " rows; the same command with --resume, or motus run %s, goes on", a->path,
                      a->rows, a->path);
    if (a->made && !a->kept) unlink(a->path);
}

void run_archive_close(run_archive *a)
{
    if (!a) return;
    motus_archive_close(a->file);
    if (a->descriptor >= 0) close(a->descriptor);
    for (size_t k = 0; a->rooms && k < a->columns.count; k++) free(a->rooms[k]);
    free(a->rooms);
    free(a->written);
    free(a->times);
    run_columns_free(&a->columns);
    free(a->command);
    free(a);
}
