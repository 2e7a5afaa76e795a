/* Shards of a sweep that are archives. See part.h.
 *
 * Invariant: the joined archive is, byte for byte, what the command without --shard makes: it has the description of
 * one shard, without the name of the shard, and the blocks of all.
 */
#include "cli/files/archived.h"
#include "cli/files/file.h"
#include "cli/files/target.h"
#include "cli/sweep/part.h"
#include "cli/words/complain.h"

#include <motus-archive.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Returns the command without the option --shard. */
static char *whole_command(const char *command, const part *p)
{
    char option[SHARD_TEXT + 16], number[SHARD_TEXT], *out = strdup(command);
    snprintf(option, sizeof option, " --shard %s", shard_text(&p->shard, number));
    const size_t length = strlen(option);
    if (out && strlen(out) >= length && strcmp(out + strlen(out) - length, option) == 0) out[strlen(out) - length] = 0;
    return out;
}

/* Makes an archive with the columns and the notes of a shard, in the empty file `descriptor`, or, if that is -1, under
 * the name `output`. If `from` is not NULL, it has the rows of that archive, compressed. */
static motus_status make(const part *p, const char *output, int descriptor, motus_archive *from, motus_error *err)
{
    motus_archive *a;
    motus_status status = motus_archive_open(p->path, 0, &a, err);
    if (status) return status;
    motus_archive_def d = motus_archive_default();
    size_t notes = 0;
    motus_archive_note n;
    while (motus_archive_note_at(a, notes, &n)) notes++;
    d.column_count = motus_archive_column_count(a);
    motus_archive_column *columns = calloc(d.column_count, sizeof *columns);
    motus_archive_note *kept = calloc(notes + 1, sizeof *kept);
    char *command = whole_command(motus_archive_note_of(a, "command"), p);
    const bool room = columns && kept && command;
    if (!room) status = complain_memory(err);
    for (size_t k = 0; room && k < d.column_count; k++) motus_archive_column_at(a, k, columns + k);
    for (size_t k = 0; room && k < notes; k++) {
        motus_archive_note_at(a, k, &n);
        if (strcmp(n.name, "shard") == 0) continue;
        if (strcmp(n.name, "command") == 0) n.text = command;
        kept[d.note_count++] = n;
    }
    d.rows = p->total, d.block = p->shard.block, d.columns = columns, d.notes = kept;
    d.stop = stop_asked;
    d.from = from;
    d.descriptor = descriptor + 1;
    if (!status) status = motus_archive_create(output, &d, err);
    free(columns);
    free(kept);
    free(command);
    motus_archive_close(a);
    return status;
}

typedef struct joining {
    motus_archive *to;
    block_room room;
    uint64_t copied;
    bool partial; /* blocks may be missing */
    stop_progress *progress;
} joining;

static motus_status copy_block(joining *j, const part *p, motus_archive *from, uint64_t b, motus_error *err)
{
    uint64_t first;
    size_t count;
    int whole;
    motus_status status = motus_archive_whole(from, b, &whole, err);
    if (!status && !whole) return j->partial ? MOTUS_OK : part_unfinished(p, err);
    motus_archive_block(from, b, &first, &count);
    for (size_t k = 0; !status && k < j->room.count; k++)
        status = motus_archive_read(from, k, first, count, j->room.columns[k], err);
    if (!status) status = motus_archive_write(j->to, p->shard.number - 1 + b * p->shard.count, j->room.written, err);
    j->copied += !status;
    return status;
}

static motus_status copy(joining *j, const part *p, motus_error *err)
{
    motus_archive *from;
    motus_status status = motus_archive_open(p->path, 0, &from, err);
    if (status) return status;
    const uint64_t blocks = motus_archive_blocks(from);
    for (uint64_t b = 0; !status && b < blocks; b++) {
        status = copy_block(j, p, from, b, err);
        const double done = (double)(p->shard.number - 1) + (double)(b + 1) / (double)blocks;
        if (!status && stop_progress_hook(j->progress, done / (double)p->shard.count))
            status = fail(err, MOTUS_CANCELLED, "cancelled");
    }
    motus_archive_close(from);
    return status;
}

motus_status part_archive_join(part *const *of, const char *output, uint64_t *missing, bool compress,
                               stop_progress *progress, motus_error *err)
{
    joining j = {.partial = missing, .progress = progress};
    size_t some = 0;
    while (!of[some]) some++; /* at least one is not NULL */
    const uint64_t count = of[some]->shard.count;
    file_beside beside = FILE_BESIDE;
    motus_status status = file_beside_make(&beside, output, ARCHIVE_JOINED, err);
    struct stat about;
    const bool there = beside.name && stat(beside.name, &about) == 0;
    int lock = -1; /* of the file that is replaced; target_lock() makes an empty one if there is none */
    bool regular = true;
    if (!status) status = target_lock(beside.name, &lock, &regular, err);
    const bool locked = !status;
    if (!status) status = make(of[some], beside.descriptor < 0 ? beside.path : output, beside.descriptor, NULL, err);
    if (!status) status = motus_archive_open(beside.path, 1, &j.to, err);
    if (!status)
        status = block_room_make(&j.room, motus_archive_column_count(j.to), (size_t)of[some]->shard.block, err);
    for (uint64_t k = 0; !status && k < count; k++)
        if (of[k] && shard_rows(&of[k]->shard, of[k]->total) > 0) status = copy(&j, of[k], err);
    if (!status && missing) *missing = motus_archive_blocks(j.to) - j.copied;
    if (!status) status = motus_archive_sync(j.to, err);
    if (!status && compress)
        status = make(of[some], beside.name, -1, j.to, err);
    else if (!status)
        status = file_beside_keep(&beside, err);
    motus_archive_close(j.to);
    if (status) file_beside_complain(&beside, output, err);
    if (status && locked && !there) remove(beside.name);
    if (lock >= 0) close(lock);
    file_beside_drop(&beside);
    block_room_free(&j.room);
    return status;
}
