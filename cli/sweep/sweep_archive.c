/* The archive of a sweep, FILE.h5. Its blocks may be written in any order, and whole ones are kept. Processes that
 * compute it together take the missing blocks from a common counter.
 *
 * Invariant: f->rows is the next row of the present block; a->room has the rows of that block before it. A block is
 * written when its last row has been computed.
 */
#include "base/decimal.h"
#include "cli/files/archived.h"
#include "cli/files/stop.h"
#include "cli/model/load.h"
#include "cli/sweep/sweep.h"
#include "cli/words/complain.h"

#include <math.h>
#include <motus-archive.h>
#include <stdlib.h>
#include <string.h>

struct sweep_archive {
    motus_archive *file;
    uint64_t blocks, *missing, missing_count;
    uint64_t next, end; /* this process computes missing[next] to missing[end - 1] */
    block_room room;    /* the columns of the present block, without the number of the row */
    double *numbers;    /* the numbers of AT_A_TIME rows, column after column */
};
enum { AT_A_TIME = 256 };

/* What a process that fails or is warned adds to the counter; no sweep has that many blocks. */
#define GIVEN_UP (UINT64_C(1) << 50)

uint64_t sweep_archive_block(const options *o)
{
    motus_archive *a;
    if (!o->resume || !o->output || !target_archive(o->output) ||
        motus_archive_open(o->output, 0, &a, NULL) != MOTUS_OK)
        return 0;
    const uint64_t rows = motus_archive_block_rows(a);
    motus_archive_close(a);
    return rows <= SHARD_BLOCK ? rows : 0;
}

/* ---- the description of the file ---- */

static uint64_t number_of(void *s, uint64_t row) { return shard_trajectory(&((const sweep *)s)->shard, row); }

/* Returns whether a column has words in place of numbers. */
static bool has_words(const sweep *s, size_t k) { return k == sweep_ended(s) || k == s->columns - 1; }

/* Returns the words of a column, which the caller frees. NULL: it has numbers, or memory ran out and *count is not
 * 0. */
static const char **words_of(const sweep *s, size_t k, size_t *count)
{
    const bool cause = k == s->columns - 1;
    if (!has_words(s, k)) return NULL;
    size_t kinds = 0;
    while (motus_ensemble_kind(s->ensemble, kinds)) kinds++;
    *count = cause ? MOTUS_CAUSE_COUNT : kinds + 1;
    const char **words = calloc(*count, sizeof *words);
    for (size_t w = 0; words && w < *count; w++)
        words[w] = cause ? motus_cause_word((motus_cause)w) : w ? motus_ensemble_kind(s->ensemble, w - 1) : "";
    return words;
}

typedef struct description {
    motus_archive_column *columns;
    char (*names)[SWEEP_NAME], **comments; /* of the columns; a comment may be NULL */
    const char **words[2];
    size_t word_columns;
    char *command;
    char total[DECIMAL_MAX + 1], seed[DECIMAL_MAX + 1], shard[SHARD_TEXT];
    motus_archive_note notes[8];
    motus_archive_def def;
} description;

static void note(description *d, const char *name, const char *text)
{
    d->notes[d->def.note_count++] = (motus_archive_note){name, text};
}

static motus_status describe_columns(description *d, const sweep *s, motus_error *err)
{
    const size_t count = s->columns - 1;
    d->columns = calloc(count, sizeof *d->columns);
    d->names = calloc(count, sizeof *d->names);
    d->comments = calloc(count, sizeof *d->comments);
    if (!d->columns || !d->names || !d->comments) return complain_memory(err);
    for (size_t k = 0; k < count; k++) {
        size_t words = 0;
        const char **list = words_of(s, k + 1, &words);
        const char *name = sweep_head_name(s, k + 1, d->names[k]);
        if (!list) d->comments[k] = comments_find(s->model.text, name);
        d->columns[k] =
            (motus_archive_column){.name = name, .words = list, .word_count = words, .comment = d->comments[k]};
        if (list) {
            d->columns[k].kind = MOTUS_ARCHIVE_WORD;
            d->words[d->word_columns++] = list;
        } else if (words) {
            return complain_memory(err);
        }
        if (words > 255) return fail(err, MOTUS_LIMIT, "an archive has room for 254 events, and the model has more");
    }
    d->def.columns = d->columns;
    d->def.column_count = count;
    return MOTUS_OK;
}

/* Describes the archive of a sweep. Call description_free() in any case. */
static motus_status describe(description *d, const sweep *s, motus_error *err)
{
    *d = (description){.def = motus_archive_default()};
    motus_status status = describe_columns(d, s, err);
    if (!status) status = sweep_head_text(s, &d->command, err);
    if (status) return status;
    d->def.rows = s->rows;
    d->def.block = s->shard.block;
    d->def.number = number_of;
    d->def.stop = stop_asked;
    d->def.context = (void *)s;
    d->total[decimal_write_whole(s->grid.total, d->total)] = 0;
    d->seed[decimal_write_whole(s->grid.seed, d->seed)] = 0;
    note(d, "motus", motus_version());
    note(d, "command", d->command);
    note(d, "method", s->method);
    if (s->options->random.count > 0) note(d, "seed", d->seed);
    note(d, "trajectories", d->total);
    note(d, "fingerprint", s->fingerprint);
    if (!shard_whole(&s->shard)) note(d, "shard", shard_text(&s->shard, d->shard));
    note(d, "model", s->model.text);
    d->def.notes = d->notes;
    return MOTUS_OK;
}

static void description_free(description *d)
{
    for (size_t k = 0; k < d->word_columns; k++) free(d->words[k]);
    for (size_t k = 0; d->comments && k < d->def.column_count; k++) free(d->comments[k]);
    free(d->comments);
    free(d->columns);
    free(d->names);
    free(d->command);
}

/* ---- a file that exists ---- */

/* Returns whether a version of motus made the archive by this sweep. */
static bool same_sweep(const sweep_file *f, const description *d, const char *version)
{
    char part[SHARD_TEXT], print[SWEEP_FINGERPRINT];
    const sweep *s = f->sweep;
    motus_archive *file = f->archive->file;
    bool same = archived_sweep(file) && motus_archive_rows(file) == s->rows && version &&
                archived_says(file, "fingerprint", sweep_head_fingerprint(s, version, print)) &&
                archived_says(file, "shard", shard_whole(&s->shard) ? NULL : shard_text(&s->shard, part)) &&
                motus_archive_column_count(file) == d->def.column_count;
    for (size_t k = 0; same && k < d->def.column_count; k++) {
        motus_archive_column c;
        same = motus_archive_column_at(file, k, &c) && c.kind == d->columns[k].kind &&
               strcmp(c.name, d->columns[k].name) == 0;
    }
    return same && motus_archive_block_rows(file) == s->shard.block;
}

/* Compares some rows of an archive that another version has begun with those that this version computes. Fails if a bit
 * differs. */
static motus_status compare_versions(const sweep_file *f, const char *version, motus_error *err)
{
    enum { BLOCKS = 8, ROWS = 64 };
    motus_archive *file = f->archive->file;
    const uint64_t blocks = motus_archive_blocks(file);
    sweep_again *again = NULL;
    uint64_t compared = 0;
    char where[SWEEP_WHERE];
    bool same = true;
    motus_status status = sweep_again_make(&again, f->sweep, err);
    for (uint64_t b = 0; !status && same && b < blocks && compared < BLOCKS; b++) {
        uint64_t first;
        size_t count;
        int whole;
        status = motus_archive_whole(file, b, &whole, err);
        if (status || !whole) continue;
        compared++;
        motus_archive_block(file, b, &first, &count);
        status = sweep_again_rows(again, file, first, count < ROWS ? count : ROWS, &same, where, err);
    }
    sweep_again_free(again);
    if (status) return status;
    return archived_compared(f->path, version, compared > 0, same ? NULL : where, f->sweep->options->quiet, err);
}

static motus_status compare(const sweep_file *f, const description *d, motus_error *err)
{
    const char *version = motus_archive_note_of(f->archive->file, "motus");
    if (!same_sweep(f, d, version)) return archived_another(f->archive->file, f->path, "sweep", err);
    if (strcmp(version, motus_version()) == 0 || !team_first(f->sweep->options->team)) return MOTUS_OK;
    return compare_versions(f, version, err);
}

/* Counts the trajectories of a block that stopped, by their causes. */
static motus_status count_stopped(sweep_file *f, uint64_t block, motus_error *err)
{
    sweep_archive *a = f->archive;
    uint64_t first;
    size_t count;
    motus_archive_block(a->file, block, &first, &count);
    unsigned char *causes = (unsigned char *)a->room.columns[a->room.count - 1];
    motus_status status = motus_archive_read(a->file, a->room.count - 2, first, count, a->room.columns[0], err);
    if (!status) status = motus_archive_read(a->file, a->room.count - 1, first, count, causes, err);
    for (size_t i = 0; !status && i < count; i++) {
        f->stopped += a->room.columns[0][i] == a->room.columns[0][i];
        f->stopped_by[causes[i] < MOTUS_CAUSE_COUNT ? causes[i] : MOTUS_CAUSE_NONE]++;
    }
    return status;
}

/* Finds the missing blocks. The first process does so for all. */
static motus_status find_blocks(sweep_file *f, bool found, motus_error *err)
{
    sweep_archive *a = f->archive;
    motus_status status = f->sweep->options->resume ? sweep_events_find(f->events, err) : MOTUS_OK;
    for (uint64_t b = 0; !status && b < a->blocks; b++) {
        int whole = 0;
        if (found) status = motus_archive_whole(a->file, b, &whole, err);
        if (found && !status) status = archived_numbers(a->file, f->path, b, err);
        if (status || !whole || !sweep_events_have(f->events, b)) {
            a->missing[a->missing_count++] = b;
            continue;
        }
        uint64_t first;
        size_t count;
        motus_archive_block(a->file, b, &first, &count);
        f->found += count;
        status = count_stopped(f, b, err);
    }
    if (status || a->missing_count == 0 || !motus_archive_compressed(a->file)) return status;
    return complain(err, MOTUS_STATE, "--force computes all of it again",
                    "%s is compressed, and %llu of its blocks are damaged, or their events are missing", f->path,
                    (unsigned long long)a->missing_count);
}

/* ---- opening ---- */

static motus_status make_room(sweep_archive *a, motus_error *err)
{
    a->blocks = motus_archive_blocks(a->file);
    a->missing = calloc((size_t)a->blocks + 1, sizeof *a->missing);
    a->numbers = malloc(motus_archive_column_count(a->file) * AT_A_TIME * sizeof *a->numbers);
    if (!a->missing || !a->numbers) return complain_memory(err);
    return block_room_make(&a->room, motus_archive_column_count(a->file), (size_t)motus_archive_block_rows(a->file),
                           err);
}

static uint64_t block_of(const sweep_file *f) { return f->sweep->shard.block; }

/* Takes blocks from the common counter. The fewer are left, the fewer it takes, so that all processes end together; but
 * it takes enough to fill the lanes, if there are that many for each process. */
static void take_blocks(sweep_file *f)
{
    enum { AT_ONCE = 16 * SHARD_BLOCK, SHARES = 4 };
    sweep_archive *a = f->archive;
    const team *t = f->sweep->options->team;
    if (team_size(t) == 1) {
        a->end = a->missing_count;
        return;
    }
    const uint64_t left = a->missing_count - a->end, even = left / (uint64_t)t->size, most = AT_ONCE / block_of(f);
    const uint64_t lanes = shard_blocks(&f->sweep->shard, sweep_batch_lanes(f->sweep));
    const uint64_t share = even / SHARES < lanes ? (even < lanes ? even : lanes) : even / SHARES;
    const uint64_t count = share < 1 ? 1 : share > most ? most : share;
    const double asked = stop_clock();
    a->next = t->take(t->context, count);
    const double waited = stop_clock() - asked;
    f->share.waiting += waited;
    f->share.writing -= waited; /* the caller counts this time as writing */
    if (a->next > a->missing_count) a->next = a->missing_count;
    a->end = a->next + count < a->missing_count ? a->next + count : a->missing_count;
}

/* Moves to the next row that this process computes. */
static void move(sweep_file *f)
{
    sweep_archive *a = f->archive;
    if (a->next == a->end) take_blocks(f);
    f->rows = a->next < a->end ? a->missing[a->next] * block_of(f) : f->sweep->rows;
}

motus_status sweep_archive_open(sweep_file *f, bool found, motus_error *err)
{
    description d;
    const team *t = f->sweep->options->team;
    sweep_archive *a = f->archive = calloc(1, sizeof *a);
    if (!a) return complain_memory(err);
    motus_status status = describe(&d, f->sweep, err);
    if (!status && found && team_first(t)) target_tidy(f->path);
    if (!status && !found && team_first(t)) status = motus_archive_create(f->path, &d.def, err);
    if (!status) status = motus_archive_open(f->path, 1, &a->file, err);
    if (!status) status = compare(f, &d, err);
    if (!status) status = make_room(a, err);
    if (!status && team_first(t)) status = find_blocks(f, found, err);
    description_free(&d);
    return status;
}

void sweep_archive_begin(sweep_file *f)
{
    sweep_archive *a = f->archive;
    const team *t = f->sweep->options->team;
    if (team_size(t) > 1) {
        t->share(t->context, &a->missing_count, sizeof a->missing_count);
        t->share(t->context, a->missing, a->missing_count * sizeof *a->missing);
        t->reset(t->context);
    }
    move(f);
}

void sweep_archive_close(sweep_file *f)
{
    sweep_archive *a = f->archive;
    if (!a) return;
    motus_archive_close(a->file);
    block_room_free(&a->room);
    free(a->missing);
    free(a->numbers);
    free(a);
    f->archive = NULL;
}

/* ---- rows ---- */

uint64_t sweep_archive_left(const sweep_file *f)
{
    const sweep_archive *a = f->archive;
    uint64_t run = a->next;
    if (run == a->end) return 0;
    while (run + 1 < a->end && a->missing[run + 1] == a->missing[run] + 1) run++;
    const uint64_t end = (a->missing[run] + 1) * block_of(f), rows = f->sweep->rows;
    return (end < rows ? end : rows) - f->rows;
}

void sweep_archive_give_up(sweep_file *f)
{
    const team *t = f->sweep->options->team;
    if (f->archive && team_size(t) > 1) t->take(t->context, GIVEN_UP);
}

bool sweep_archive_given_up(const sweep_file *f)
{
    const team *t = f->sweep->options->team;
    return f->archive && team_size(t) > 1 && t->take(t->context, 0) >= GIVEN_UP;
}

double sweep_archive_done(const sweep_file *f)
{
    const sweep_archive *a = f->archive;
    const double rows = (double)f->found + (double)(a->next * block_of(f) + f->rows % block_of(f));
    return fmin(rows, (double)f->sweep->rows);
}

/* Writes the present block, which is complete. */
static motus_status write_block(sweep_file *f, motus_error *err)
{
    sweep_archive *a = f->archive;
    const uint64_t block = (f->rows - 1) / block_of(f), rows = f->rows - block * block_of(f);
    const motus_status status = motus_archive_write(a->file, block, a->room.written, err);
    if (status) {
        f->rows -= rows; /* nothing of this block is in the file */
        return status;
    }
    f->share.blocks++;
    f->share.rows += rows;
    a->next++;
    move(f);
    return MOTUS_OK;
}

motus_status sweep_archive_rows(sweep_file *f, size_t count, const sweep_rows *given, motus_error *err)
{
    sweep_archive *a = f->archive;
    motus_status status = MOTUS_OK;
    for (size_t done = 0, some; !status && done < count; done += some) {
        const size_t at = (size_t)(f->rows % block_of(f)), left = (size_t)block_of(f) - at;
        some = count - done < left ? count - done : left;
        if (some > AT_A_TIME) some = AT_A_TIME;
        sweep_row_numbers(f->sweep, given, done, some, a->numbers, 1, AT_A_TIME);
        for (size_t k = 0; k < a->room.count; k++) {
            const double *numbers = a->numbers + k * AT_A_TIME;
            unsigned char *words = (unsigned char *)a->room.columns[k] + at;
            if (has_words(f->sweep, k + 1))
                for (size_t i = 0; i < some; i++) words[i] = (unsigned char)numbers[i];
            else
                memcpy(a->room.columns[k] + at, numbers, some * sizeof *numbers);
        }
        f->rows += some;
        if (some == left || f->rows == f->sweep->rows) status = write_block(f, err);
    }
    return status;
}

motus_status sweep_archive_finish(sweep_file *f, motus_error *err) { return motus_archive_sync(f->archive->file, err); }

motus_status sweep_archive_compress(sweep_file *f, motus_error *err)
{
    description d;
    if (motus_archive_compressed(f->archive->file)) return MOTUS_OK;
    motus_status status = describe(&d, f->sweep, err);
    /* opened again, since some file systems only then show what other machines have written */
    if (!status) status = motus_archive_open(f->path, 0, &d.def.from, err);
    if (!status) status = motus_archive_create(f->path, &d.def, err);
    motus_archive_close(d.def.from);
    description_free(&d);
    return status;
}

uint64_t sweep_archive_have(const sweep_file *f)
{
    const team *t = f->sweep->options->team;
    const uint64_t rows = f->share.rows;
    return f->found + (team_size(t) > 1 ? t->sum(t->context, rows) : rows);
}

motus_status sweep_archive_look(sweep_file *f, motus_error *err)
{
    sweep_archive *a = f->archive;
    uint64_t lost = 0;
    motus_status status = MOTUS_OK;
    for (uint64_t b = 0; !status && b < a->blocks; b++) {
        int written = 0;
        status = motus_archive_written(a->file, b, &written, err);
        lost += !status && !written;
    }
    if (status || !lost) return status;
    return complain(
        err, MOTUS_FILE,
        "the file system loses what several machines write into one file: use shards; --resume computes the blocks",
        "%llu of %llu blocks were written, but are not in %s", (unsigned long long)lost, (unsigned long long)a->blocks,
        f->path);
}
