/* See archived.h. */
#include "cli/files/archived.h"

#include "cli/files/shard.h"
#include "cli/words/complain.h"

#include <inttypes.h>
#include <motus-archive.h>
#include <stdlib.h>
#include <string.h>

bool archived_sweep(const motus_archive *a)
{
    const size_t count = motus_archive_column_count(a);
    motus_archive_column c;
    for (size_t k = 0; motus_archive_column_at(a, k, &c); k++)
        if (motus_archive_width(&c) != 1) return false;
    return count >= 2 && motus_archive_column_at(a, count - 2, &c) && c.kind == MOTUS_ARCHIVE_NUMBER &&
           strcmp(c.name, "stopped") == 0 && motus_archive_column_at(a, count - 1, &c) &&
           c.kind == MOTUS_ARCHIVE_WORD && strcmp(c.name, "stopped_by") == 0;
}

motus_status archived_numbers(motus_archive *a, const char *path, uint64_t block, motus_error *err)
{
    enum { SOME = 512 };
    int64_t its[SOME];
    shard of;
    uint64_t row;
    size_t left;
    motus_status status = shard_read(&of, motus_archive_note_of(a, "shard"), err);
    of.block = motus_archive_block_rows(a);
    motus_archive_block(a, block, &row, &left);
    for (size_t some; !status && left > 0; left -= some, row += some) {
        some = left < SOME ? left : SOME;
        status = motus_archive_numbers(a, row, some, its, err);
        for (size_t i = 0; !status && i < some; i++) {
            const uint64_t number = archived_sweep(a) ? shard_trajectory(&of, row + i) : row + i;
            if (its[i] == (int64_t)number) continue;
            status = complain(err, MOTUS_STATE, "use a copy of the file, or compute it again: --force",
                              "%s is damaged: row %" PRIu64 " has the number %" PRId64 " instead of %" PRIu64, path,
                              row + i, its[i], number);
        }
    }
    return status;
}

motus_status archived_another(motus_archive *file, const char *path, const char *what, motus_error *err)
{
    const char *command = motus_archive_note_of(file, "command");
    fail(err, MOTUS_STATE, "%s was made by another %s", path, what);
    hint(err, command ? "it was made by: %.300s" : "--force replaces it%s", command ? command : "");
    return MOTUS_STATE;
}

const char *archived_note(const motus_archive *file, const char *name)
{
    const char *text = motus_archive_note_of(file, name);
    return text ? text : "";
}

bool archived_says(const motus_archive *file, const char *name, const char *text)
{
    const char *its = motus_archive_note_of(file, name);
    return its ? text && strcmp(its, text) == 0 : !text;
}

motus_status archived_compared(const char *path, const char *version, bool compared, const char *where, bool quiet,
                               motus_error *err)
{
    if (compared && !where) {
        if (!quiet)
            complain_note("%s was begun by motus %.40s; some of its rows, computed again, have the same bits", path,
                          version);
        return MOTUS_OK;
    }
    if (compared)
        fail(err, MOTUS_STATE, "%s was begun by motus %.40s, and this motus, %s, computes other bits: %s", path,
             version, motus_version(), where);
    else
        fail(err, MOTUS_STATE, "%s was begun by motus %.40s, and has no block that shows whether the bits are the same",
             path, version);
    hint(err, "finish it with that version, or start again with --force");
    return MOTUS_STATE;
}

motus_status block_room_make(block_room *r, size_t count, size_t rows, motus_error *err)
{
    *r = (block_room){calloc(count, sizeof *r->columns), calloc(count, sizeof *r->written), count};
    bool good = r->columns && r->written;
    for (size_t k = 0; good && k < count; k++) {
        r->columns[k] = malloc((rows + 1) * sizeof **r->columns);
        r->written[k] = r->columns[k];
        good = r->columns[k];
    }
    return good ? MOTUS_OK : complain_memory(err);
}

void block_room_free(block_room *r)
{
    for (size_t k = 0; r->columns && k < r->count; k++) free(r->columns[k]);
    free(r->columns);
    free(r->written);
    *r = (block_room){0};
}
