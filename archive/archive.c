/* An open archive: its blocks and states are read and written in place, by the directory, without HDF5.
 *
 * Invariants: nothing but blocks and states, and the hashes that tell they are there, is ever written; a hash is
 * written after the bytes of its block or state. So however many processes write different blocks, and whenever they
 * are killed, every block whose hash fits is whole. */
#include "archive/bytes.h"
#include "archive/directory.h"
#include "archive/make.h"
#include "base/disk.h"
#include "base/error.h"

#include <errno.h>
#include <fcntl.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

struct motus_archive {
    directory directory;
    char *path;
    int descriptor;
    unsigned char *room; /* room for a column of a block */
    uint64_t turn;       /* the turn of the latest state; 0: not asked for yet, or there is none */
    bool named;          /* the name of the file is on the disk, too */
    unpack_archive *unpack;
    unsigned char *piece, *unpacked;  /* of compressed rows: room for a block's piece, and the block unpacked last */
    uint64_t piece_room, unpacked_of; /* the bytes of `piece`; 1 + the number of the unpacked piece, 0: of none */
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
    if (bytes_get(a->descriptor, out, count, place)) return MOTUS_OK;
    if (errno) return cannot("read", a->path, err);
    return fail(err, MOTUS_STATE, "%s is truncated: it has fewer bytes than when it was opened", a->path);
}

static motus_status put(const motus_archive *a, const void *bytes, size_t count, uint64_t place, motus_error *err)
{
    return bytes_put(a->descriptor, bytes, count, place) ? MOTUS_OK : cannot("write", a->path, err);
}

/* ---- opening ---- */

/* Reads the directory, in a second go if it is larger than most are. */
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

static uint64_t widest(const directory *d)
{
    uint64_t width = sizeof(int64_t);
    for (size_t k = 0; k < d->column_count; k++)
        if (d->columns[k].width > width) width = d->columns[k].width;
    return width;
}

static motus_status make_room(motus_archive *a, motus_error *err)
{
    const directory *d = &a->directory;
    const uint64_t most = d->rows < d->block ? d->rows : d->block;
    const size_t size =
        (size_t)(most * widest(d)) + 1; /* no overflow: it is in the file, or directory_read() bounds it */
    a->room = malloc(size);
    if (a->room && d->packed_place) a->unpacked = malloc(size);
    if (!a->room || (d->packed_place && !a->unpacked))
        return fail(err, MOTUS_MEMORY, "no memory for a block of %s", a->path);
    return MOTUS_OK;
}

motus_status motus_archive_open(const char *path, int write, motus_archive **out, motus_error *err)
{
    if (out) *out = NULL;
    if (!path || !out) return fail(err, MOTUS_ARGUMENT, "motus_archive_open needs a path and a place for the archive");
    motus_archive *a = calloc(1, sizeof *a);
    if (!a || !(a->path = strdup(path))) {
        free(a);
        return fail(err, MOTUS_MEMORY, "no memory to open %s", path);
    }
    a->descriptor = open(path, (write ? O_RDWR : O_RDONLY) | O_CLOEXEC | O_NONBLOCK); /* of a pipe it would wait */
    motus_status status = a->descriptor < 0 ? cannot("open", path, err) : read_directory(a, err);
    if (!status) status = make_room(a, err);
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
    free(a->piece);
    free(a->unpacked);
    free(a->path);
    free(a);
}

int motus_archive_compressed(const motus_archive *a) { return a->directory.packed_place > 0; }

/* ---- what it says ---- */

uint64_t motus_archive_rows(const motus_archive *a) { return a->directory.rows; }
uint64_t motus_archive_blocks(const motus_archive *a)
{
    return directory_blocks(a->directory.rows, a->directory.block);
}
uint64_t motus_archive_block_rows(const motus_archive *a) { return a->directory.block; }
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
    *out = (motus_archive_column){c->name, c->kind, c->words, c->word_count, {c->shape[0], c->shape[1]}, c->comment};
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

static motus_status no_block(const motus_archive *a, uint64_t block, motus_error *err)
{
    return fail(err, MOTUS_ARGUMENT, "%s has no block %llu", a->path, (unsigned long long)block);
}

/* ---- compressed rows ---- */

#define NUMBERS ((size_t)-1) /* in place of a column: the numbers of the rows */

static motus_status find_unpack(motus_archive *a, motus_error *err)
{
    void *const found = a->unpack ? NULL : module_find(MAKE_UNPACK);
    if (!a->unpack) memcpy(&a->unpack, &found, sizeof a->unpack);
    if (a->unpack) return MOTUS_OK;
    fail(err, MOTUS_UNAVAILABLE, "%s is compressed, and this motus was built or runs without HDF5 and zlib", a->path);
    hint(err, "install HDF5, and build motus where libhdf5-dev is installed");
    return MOTUS_UNAVAILABLE;
}

static motus_status damaged(const motus_archive *a, uint64_t block, motus_error *err)
{
    return fail(err, MOTUS_STATE, "%s is damaged: block %llu cannot be unpacked", a->path,
                (unsigned long long)block + 1);
}

/* Unpacks the rows of a block into a->unpacked, unless they are there already. */
static motus_status unpack(motus_archive *a, size_t column, uint64_t block, uint64_t width, motus_error *err)
{
    const directory *d = &a->directory;
    const uint64_t number = (column + 1) * motus_archive_blocks(a) + block; /* that of NUMBERS is 0 */
    const uint64_t most = (d->rows < d->block ? d->rows : d->block) * width;
    const size_t unit = column == NUMBERS ? sizeof(int64_t) : directory_width(d->columns[column].kind);
    directory_piece p;
    if (a->unpacked_of == number + 1) return MOTUS_OK;
    motus_status status = find_unpack(a, err);
    if (!status) status = get(a, &p, sizeof p, d->packed_place + number * sizeof p, err);
    if (status) return status;
    if (p.size > most + most / 100 + 1024 || p.place > INT64_MAX / 2) return damaged(a, block, err);
    if (p.size > a->piece_room) {
        unsigned char *more = realloc(a->piece, (size_t)p.size);
        if (!more) return fail(err, MOTUS_MEMORY, "no memory for a block of %s", a->path);
        a->piece = more, a->piece_room = p.size;
    }
    a->unpacked_of = 0;
    status = get(a, a->piece, (size_t)p.size, p.place, err);
    if (status) return status;
    if (!a->unpack(a->piece, (size_t)p.size, p.left_out, unit, a->unpacked, (size_t)most))
        return damaged(a, block, err);
    a->unpacked_of = number + 1;
    return MOTUS_OK;
}

/* Reads rows of a column, or of NUMBERS. */
static motus_status get_rows(motus_archive *a, size_t column, uint64_t row, size_t count, void *out, motus_error *err)
{
    const directory *d = &a->directory;
    const uint64_t width = column == NUMBERS ? sizeof(int64_t) : d->columns[column].width;
    const uint64_t place = column == NUMBERS ? d->number_place : d->columns[column].place;
    if (!d->packed_place) return get(a, out, count * (size_t)width, place + row * width, err);
    motus_status status = MOTUS_OK;
    for (unsigned char *at = out; !status && count > 0;) {
        const uint64_t within = row % d->block, left = d->block - within;
        const size_t some = left < count ? (size_t)left : count;
        status = unpack(a, column, row / d->block, width, err);
        if (!status) memcpy(at, a->unpacked + within * width, some * (size_t)width);
        at += some * (size_t)width, row += some, count -= some;
    }
    return status;
}

/* ---- blocks ---- */

/* Returns the hash of a block, never 0, since 0 means that the block is missing. */
static uint64_t some(uint64_t hash) { return hash ? hash : 1; }
static uint64_t hash_begin(uint64_t block) { return directory_hash(DIRECTORY_HASH, &block, sizeof block); }

motus_status motus_archive_write(motus_archive *a, uint64_t block, const void *const *columns, motus_error *err)
{
    const directory *d = &a->directory;
    uint64_t first, hash = hash_begin(block);
    size_t count;
    if (block >= motus_archive_blocks(a)) return no_block(a, block, err);
    if (d->packed_place) {
        fail(err, MOTUS_STATE, "%s is compressed: its blocks are read, and never written again", a->path);
        hint(err, "compute them into a new file");
        return MOTUS_STATE;
    }
    motus_archive_block(a, block, &first, &count);
    motus_status status = MOTUS_OK;
    for (size_t k = 0; !status && k < d->column_count; k++) {
        const directory_column *c = d->columns + k;
        const size_t width = (size_t)c->width;
        hash = directory_hash(hash, columns[k], count * width);
        status = put(a, columns[k], count * width, c->place + first * width, err);
    }
    hash = some(hash);
    return status ? status : put(a, &hash, sizeof hash, d->done_place + block * sizeof hash, err);
}

motus_status motus_archive_sync(motus_archive *a, motus_error *err)
{
    /* Only now is the name brought to the disk: when the archive was made, the disk would first have written all that
     * fills the columns. */
    if (!a->named) disk_sync_name(a->path);
    a->named = true;
    return disk_sync(a->descriptor) ? MOTUS_OK : cannot("write", a->path, err);
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
        const size_t width = (size_t)c->width;
        status = get_rows(a, k, first, count, a->room, err);
        if (status == MOTUS_STATE && d->packed_place) return MOTUS_OK; /* what cannot be unpacked is damaged */
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
    motus_status status = rows_inside(a, row, count, err);
    return status ? status : get_rows(a, column, row, count, out, err);
}

motus_status motus_archive_numbers(motus_archive *a, uint64_t row, size_t count, int64_t *out, motus_error *err)
{
    motus_status status = rows_inside(a, row, count, err);
    return status ? status : get_rows(a, NUMBERS, row, count, out, err);
}

/* ---- states ---- */

/* A slot begins with this, which is written after the rest. The hash is that of all the other bytes of the slot that
 * count. */
typedef struct slot_head {
    uint64_t turn, length, hash, zero; /* turn 0: there is no state; the next one has the next, in the other slot */
} slot_head;
_Static_assert(sizeof(slot_head) == DIRECTORY_SLOT, "the room before a state");

size_t motus_archive_slot(const motus_archive *a)
{
    const uint64_t slot = a->directory.slot;
    return slot > sizeof(slot_head) ? (size_t)slot - sizeof(slot_head) : 0;
}

static uint64_t slot_place(const motus_archive *a, uint64_t turn)
{
    return a->directory.slots_place + (turn % 2) * a->directory.slot;
}

static uint64_t slot_hash(uint64_t turn, const void *bytes, uint64_t length)
{
    const uint64_t numbers[] = {turn, length};
    return directory_hash(directory_hash(DIRECTORY_HASH, numbers, sizeof numbers), bytes, (size_t)length);
}

/* Reads the state in slot 0 or 1; *bytes NULL: it is not whole. */
static motus_status read_slot(motus_archive *a, int which, slot_head *head, char **bytes, motus_error *err)
{
    const uint64_t place = slot_place(a, (uint64_t)which);
    *bytes = NULL;
    motus_status status = get(a, head, sizeof *head, place, err);
    if (status || head->turn == 0 || head->turn % 2 != (uint64_t)which || head->length > motus_archive_slot(a)) {
        head->turn = 0;
        return status;
    }
    char *room = malloc((size_t)head->length + 1);
    if (!room) return fail(err, MOTUS_MEMORY, "no memory for a state of %s", a->path);
    status = get(a, room, (size_t)head->length, place + sizeof *head, err);
    if (!status && slot_hash(head->turn, room, head->length) == head->hash) {
        room[head->length] = 0;
        *bytes = room;
        return MOTUS_OK;
    }
    head->turn = 0;
    free(room);
    return status;
}

static motus_status read_slots(motus_archive *a, slot_head heads[2], char *bytes[2], motus_error *err)
{
    bytes[0] = bytes[1] = NULL;
    heads[0].turn = heads[1].turn = 0;
    motus_status status = MOTUS_OK;
    for (int k = 0; !status && k < 2 && motus_archive_slot(a) > 0; k++)
        status = read_slot(a, k, heads + k, bytes + k, err);
    return status;
}

motus_status motus_archive_saved(motus_archive *a, int back, char **bytes, size_t *length, motus_error *err)
{
    slot_head heads[2];
    char *found[2];
    *bytes = NULL;
    *length = 0;
    const motus_status status = read_slots(a, heads, found, err);
    const int latest = heads[1].turn > heads[0].turn, which = back ? !latest : latest;
    if (!status) *bytes = found[which], *length = found[which] ? (size_t)heads[which].length : 0;
    for (int k = 0; k < 2; k++)
        if (status || k != which) free(found[k]);
    return status;
}

static motus_status put_zeros(motus_archive *a, uint64_t place, uint64_t count, motus_error *err)
{
    static const char zeros[1 << 16];
    motus_status status = MOTUS_OK;
    for (uint64_t done = 0; !status && done < count; done += sizeof zeros)
        status = put(a, zeros, count - done < sizeof zeros ? (size_t)(count - done) : sizeof zeros, place + done, err);
    return status;
}

/* Writes a state into a slot. last: sets the bytes after the state to 0. */
static motus_status write_slot(motus_archive *a, uint64_t turn, const void *bytes, size_t length, bool last,
                               motus_error *err)
{
    const slot_head none = {0}, head = {turn, length, slot_hash(turn, bytes, length), 0};
    const uint64_t place = slot_place(a, turn);
    motus_status status = motus_archive_sync(a, err);
    if (!status) status = put(a, &none, sizeof none, place, err);
    if (!status) status = put(a, bytes, length, place + sizeof none, err);
    if (!status && last) status = put_zeros(a, place + sizeof none + length, motus_archive_slot(a) - length, err);
    if (!status) status = motus_archive_sync(a, err);
    if (!status) status = put(a, &head, sizeof head, place, err);
    if (!status) status = motus_archive_sync(a, err);
    a->turn = status ? 0 : turn;
    return status;
}

static motus_status has_room(const motus_archive *a, size_t length, motus_error *err)
{
    if (motus_archive_slot(a) == 0) return fail(err, MOTUS_LIMIT, "%s has no slots for states", a->path);
    if (length <= motus_archive_slot(a)) return MOTUS_OK;
    return fail(err, MOTUS_LIMIT, "a state of %zu bytes has no room in the %zu of %s", length, motus_archive_slot(a),
                a->path);
}

/* Finds the turn of the latest state; 0: there is none. */
static motus_status latest_turn(motus_archive *a, uint64_t *turn, motus_error *err)
{
    slot_head heads[2];
    char *found[2];
    *turn = a->turn;
    if (*turn) return MOTUS_OK; /* it is known, since no other process writes states */
    const motus_status status = read_slots(a, heads, found, err);
    *turn = heads[0].turn > heads[1].turn ? heads[0].turn : heads[1].turn;
    free(found[0]);
    free(found[1]);
    return status;
}

motus_status motus_archive_save(motus_archive *a, const void *bytes, size_t length, motus_error *err)
{
    uint64_t turn;
    motus_status status = has_room(a, length, err);
    if (!status) status = latest_turn(a, &turn, err);
    return status ? status : write_slot(a, turn + 1, bytes, length, false, err);
}

/* Writes the state into both slots, with the turns 1 and 2. At any time one of them is whole. */
motus_status motus_archive_settle(motus_archive *a, const void *bytes, size_t length, motus_error *err)
{
    uint64_t turn;
    motus_status status = has_room(a, length, err);
    if (!status) status = latest_turn(a, &turn, err);
    if (!status) status = write_slot(a, turn + 1, bytes, length, true, err);
    for (uint64_t k = 0; !status && k < 2; k++)
        status = write_slot(a, (turn + k) % 2 ? 1 : 2, bytes, length, true, err);
    a->turn = 0; /* the latest state need not be the one that was written last */
    return status;
}

/* ---- a copy ---- */

motus_status archive_copy(const motus_archive *a, int slots, int descriptor, uint64_t place, motus_error *err)
{
    enum { AT_ONCE = 1 << 16 };
    const directory *d = &a->directory;
    char bytes[AT_ONCE];
    const uint64_t from = slots ? d->slots_place : d->done_place;
    const uint64_t count = slots ? 2 * d->slot : motus_archive_blocks(a) * sizeof(uint64_t);
    motus_status status = MOTUS_OK;
    for (uint64_t done = 0; !status && done < count; done += AT_ONCE) {
        const size_t some = count - done < AT_ONCE ? (size_t)(count - done) : AT_ONCE;
        status = get(a, bytes, some, from + done, err);
        if (!status && !bytes_put(descriptor, bytes, some, place + done)) status = cannot("write", "a copy", err);
    }
    return status;
}
