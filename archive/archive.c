/* An open archive: its blocks are read and written in place, by the directory, without HDF5.
 *
 * Invariants: nothing but blocks, and the hashes that tell they are there, is ever written; a hash is written after the
 * bytes of its block. So however many processes write different blocks, and whenever they are killed, every block whose
 * hash fits is whole.
 */
#define _XOPEN_SOURCE 700
#include "archive/bytes.h"
#include "archive/directory.h"
#include "base/error.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

struct motus_archive {
    directory directory;
    char *path;
    int descriptor;
    unsigned char *room; /* for a column of a block */
};

motus_archive_def motus_archive_default(void)
{
    return (motus_archive_def){
        .size = sizeof(motus_archive_def), .group = "sweep", .scale = "trajectory", .block = 4096};
}

static motus_status cannot(const char *what, const char *path, motus_error *err)
{
    return fail(err, MOTUS_FILE, "cannot %s %s: %s", what, path, strerror(errno));
}

/* ---- bytes ---- */

static motus_status get(const motus_archive *a, void *out, size_t count, uint64_t place, motus_error *err)
{
    for (char *at = out; count > 0;) {
        const ssize_t got = pread(a->descriptor, at, count, (off_t)place);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return cannot("read", a->path, err);
        if (got == 0)
            return fail(err, MOTUS_STATE, "%s is truncated: it has fewer bytes than when it was opened", a->path);
        at += got, place += (uint64_t)got, count -= (size_t)got;
    }
    return MOTUS_OK;
}

static motus_status put(const motus_archive *a, const void *bytes, size_t count, uint64_t place, motus_error *err)
{
    return bytes_put(a->descriptor, bytes, count, place) ? MOTUS_OK : cannot("write", a->path, err);
}

/* ---- opening ---- */

/* The directory, in a second go where it is larger than most. */
static motus_status read_directory(motus_archive *a, motus_error *err)
{
    struct stat about;
    if (fstat(a->descriptor, &about) != 0) return cannot("read", a->path, err);
    if (!S_ISREG(about.st_mode)) return fail(err, MOTUS_FILE, "%s is not a regular file", a->path);
    const uint64_t size = (uint64_t)about.st_size;
    motus_status status = MOTUS_LIMIT;
    for (size_t wanted = 1 << 14, room = 0; status == MOTUS_LIMIT && wanted != room;) {
        room = wanted;
        const size_t count = size < room ? (size_t)size : room;
        char *bytes = malloc(room);
        if (!bytes) return fail(err, MOTUS_MEMORY, "no memory for the directory of %s", a->path);
        status = get(a, bytes, count, 0, err);
        directory_free(&a->directory);
        if (!status) status = directory_read(&a->directory, bytes, count, size, a->path, &wanted, err);
        free(bytes);
    }
    return status;
}

motus_status motus_archive_open(const char *path, int write, motus_archive **out, motus_error *err)
{
    *out = NULL;
    motus_archive *a = calloc(1, sizeof *a);
    if (!a || !(a->path = strdup(path))) {
        free(a);
        return fail(err, MOTUS_MEMORY, "no memory to open %s", path);
    }
    a->descriptor = open(path, (write ? O_RDWR : O_RDONLY) | O_CLOEXEC);
    motus_status status = a->descriptor < 0 ? cannot("open", path, err) : read_directory(a, err);
    if (!status) {
        const directory *d = &a->directory;
        const uint64_t most = d->rows < d->block ? d->rows : d->block;
        a->room = malloc((size_t)most * sizeof(double) + 1);
        if (!a->room) status = fail(err, MOTUS_MEMORY, "no memory for a block of %s", path);
    }
    if (status)
        motus_archive_close(a);
    else
        *out = a;
    return status;
}

void motus_archive_close(motus_archive *a)
{
    if (!a) return;
    if (a->descriptor >= 0) close(a->descriptor);
    directory_free(&a->directory);
    free(a->room);
    free(a->path);
    free(a);
}

/* ---- what it says ---- */

uint64_t motus_archive_rows(const motus_archive *a) { return a->directory.rows; }
uint64_t motus_archive_blocks(const motus_archive *a)
{
    return directory_blocks(a->directory.rows, a->directory.block);
}
size_t motus_archive_column_count(const motus_archive *a) { return a->directory.column_count; }

void motus_archive_block(const motus_archive *a, uint64_t block, uint64_t *first, size_t *count)
{
    const directory *d = &a->directory;
    *first = block * d->block;
    const uint64_t left = *first < d->rows ? d->rows - *first : 0;
    *count = (size_t)(left < d->block ? left : d->block);
}

int motus_archive_column_at(const motus_archive *a, size_t k, motus_archive_column *out)
{
    if (k >= a->directory.column_count) return 0;
    const directory_column *c = a->directory.columns + k;
    *out = (motus_archive_column){c->name, c->kind, c->words, c->word_count};
    return 1;
}

int motus_archive_note_at(const motus_archive *a, size_t k, motus_archive_note *out)
{
    if (k >= a->directory.note_count) return 0;
    *out = a->directory.notes[k];
    return 1;
}

const char *motus_archive_note_of(const motus_archive *a, const char *name)
{
    for (size_t k = 0; k < a->directory.note_count; k++)
        if (strcmp(a->directory.notes[k].name, name) == 0) return a->directory.notes[k].text;
    return NULL;
}

/* ---- blocks ---- */

static motus_status no_block(const motus_archive *a, uint64_t block, motus_error *err)
{
    return fail(err, MOTUS_ARGUMENT, "%s has no block %llu", a->path, (unsigned long long)block);
}

/* A hash is never 0, which says that a block is missing. */
static uint64_t some(uint64_t hash) { return hash ? hash : 1; }
static uint64_t hash_begin(uint64_t block) { return directory_hash(DIRECTORY_HASH, &block, sizeof block); }

motus_status motus_archive_write(motus_archive *a, uint64_t block, const void *const *columns, motus_error *err)
{
    const directory *d = &a->directory;
    uint64_t first, hash = hash_begin(block);
    size_t count;
    if (block >= motus_archive_blocks(a)) return no_block(a, block, err);
    motus_archive_block(a, block, &first, &count);
    motus_status status = MOTUS_OK;
    for (size_t k = 0; !status && k < d->column_count; k++) {
        const directory_column *c = d->columns + k;
        const size_t width = directory_width(c->kind);
        hash = directory_hash(hash, columns[k], count * width);
        status = put(a, columns[k], count * width, c->place + first * width, err);
    }
    hash = some(hash);
    return status ? status : put(a, &hash, sizeof hash, d->done_place + block * sizeof hash, err);
}

motus_status motus_archive_sync(motus_archive *a, motus_error *err)
{
    return bytes_sync(a->descriptor) ? MOTUS_OK : cannot("write", a->path, err);
}

motus_status motus_archive_written(motus_archive *a, uint64_t block, int *written, motus_error *err)
{
    uint64_t hash = 0;
    *written = 0;
    if (block >= motus_archive_blocks(a)) return no_block(a, block, err);
    const motus_status status = get(a, &hash, sizeof hash, a->directory.done_place + block * sizeof hash, err);
    *written = !status && hash != 0;
    return status;
}

motus_status motus_archive_whole(motus_archive *a, uint64_t block, int *whole, motus_error *err)
{
    const directory *d = &a->directory;
    uint64_t first, wanted, hash = hash_begin(block);
    size_t count;
    *whole = 0;
    if (block >= motus_archive_blocks(a)) return no_block(a, block, err);
    motus_status status = get(a, &wanted, sizeof wanted, d->done_place + block * sizeof wanted, err);
    if (status || wanted == 0) return status;
    motus_archive_block(a, block, &first, &count);
    for (size_t k = 0; !status && k < d->column_count; k++) {
        const directory_column *c = d->columns + k;
        const size_t width = directory_width(c->kind);
        status = get(a, a->room, count * width, c->place + first * width, err);
        if (!status) hash = directory_hash(hash, a->room, count * width);
    }
    *whole = !status && some(hash) == wanted;
    return status;
}

static motus_status rows_inside(const motus_archive *a, uint64_t row, size_t count, motus_error *err)
{
    const uint64_t rows = a->directory.rows;
    if (row <= rows && count <= rows - row) return MOTUS_OK;
    return fail(err, MOTUS_ARGUMENT, "%s has %llu rows", a->path, (unsigned long long)rows);
}

motus_status motus_archive_read(motus_archive *a, size_t column, uint64_t row, size_t count, void *out,
                                motus_error *err)
{
    const directory *d = &a->directory;
    if (column >= d->column_count) return fail(err, MOTUS_ARGUMENT, "%s has %zu columns", a->path, d->column_count);
    const size_t width = directory_width(d->columns[column].kind);
    motus_status status = rows_inside(a, row, count, err);
    return status ? status : get(a, out, count * width, d->columns[column].place + row * width, err);
}

motus_status motus_archive_numbers(motus_archive *a, uint64_t row, size_t count, int64_t *out, motus_error *err)
{
    motus_status status = rows_inside(a, row, count, err);
    return status ? status : get(a, out, count * sizeof *out, a->directory.number_place + row * sizeof *out, err);
}
