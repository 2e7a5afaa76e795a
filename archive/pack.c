/* See pack.h.
 *
 * Invariant: a file whose pieces do not unpack to the bytes of the archive they were made from is not kept.
 */
#include "archive/pack.h"

#include "archive/bytes.h"
#include "archive/make.h"
#include "base/error.h"

#include <stdlib.h>
#include <string.h>
#include <zlib.h>

enum { LEVEL = 6 };

static motus_status no_memory(const char *path, motus_error *err)
{
    return fail(err, MOTUS_MEMORY, "no memory to compress %s", path);
}

/* ---- writing, by HDF5 ---- */

bool pack_layout(hid_t list, int dimensions, const hsize_t *chunk)
{
    return H5Pset_chunk(list, dimensions, chunk) >= 0 && H5Pset_shuffle(list) >= 0 && H5Pset_deflate(list, LEVEL) >= 0;
}

/* The kind of the numbers of a column, or of the rows' numbers (column 0). */
typedef struct kind {
    hid_t type;
    size_t unit, width;
    int dimensions;
    hsize_t shape[2];
} kind;

static kind kind_of(const motus_archive_def *d, size_t column)
{
    if (column == 0) return (kind){H5T_STD_I64LE, sizeof(int64_t), sizeof(int64_t), 1, {0, 0}};
    const motus_archive_column *c = d->columns + column - 1;
    const size_t unit = directory_width(c->kind);
    return (kind){c->kind == MOTUS_ARCHIVE_WORD ? H5T_STD_U8LE : H5T_IEEE_F64LE,
                  unit,
                  unit * motus_archive_width(c),
                  c->shape[1]   ? 3
                  : c->shape[0] ? 2
                                : 1,
                  {c->shape[0], c->shape[1]}};
}

static motus_status read_rows(const motus_archive_def *d, size_t column, uint64_t first, size_t count, void *out,
                              motus_error *err)
{
    return column ? motus_archive_read(d->from, column - 1, first, count, out, err)
                  : motus_archive_numbers(d->from, first, count, out, err);
}

static bool write_rows(hid_t set, const kind *k, uint64_t first, size_t count, const void *rows)
{
    const hsize_t from[] = {first, 0, 0}, some[] = {count, k->shape[0], k->shape[1]};
    const hid_t file = H5Dget_space(set), memory = H5Screate_simple(k->dimensions, some, NULL);
    const bool good = H5Sselect_hyperslab(file, H5S_SELECT_SET, from, NULL, some, NULL) >= 0 &&
                      H5Dwrite(set, k->type, memory, file, H5P_DEFAULT, rows) >= 0;
    H5Sclose(memory);
    H5Sclose(file);
    return good;
}

static bool find_piece(hid_t set, uint64_t first, directory_piece *p)
{
    const hsize_t at[] = {first, 0, 0};
    unsigned left_out = 0;
    haddr_t place = 0;
    hsize_t size = 0;
    const bool good = H5Dget_chunk_info_by_coord(set, at, &left_out, &place, &size) >= 0 && place != HADDR_UNDEF;
    *p = (directory_piece){place, size, left_out};
    return good;
}

motus_status pack_rows(hid_t set, const motus_archive_def *d, size_t column, directory_piece *pieces, const char *path,
                       motus_error *err)
{
    const kind k = kind_of(d, column);
    const uint64_t blocks = directory_blocks(d->rows, d->block);
    void *rows = malloc((size_t)(d->rows < d->block ? d->rows : d->block) * k.width + 1);
    motus_status status = rows ? MOTUS_OK : no_memory(path, err);
    for (uint64_t b = 0; !status && b < blocks; b++) {
        uint64_t first;
        size_t count;
        int whole = 1;
        motus_archive_block(d->from, b, &first, &count);
        if (column == 0) status = motus_archive_whole(d->from, b, &whole, err);
        if (!status && !whole) {
            fail(err, MOTUS_STATE, "%s is not compressed, since block %llu of its %llu is missing", path,
                 (unsigned long long)b + 1, (unsigned long long)blocks);
            hint(err, "--resume computes it");
            status = MOTUS_STATE;
        }
        if (!status && d->stop && d->stop(d->context)) status = fail(err, MOTUS_CANCELLED, "cancelled");
        if (!status) status = read_rows(d, column, first, count, rows, err);
        if (!status && !write_rows(set, &k, first, count, rows))
            status = fail(err, MOTUS_FILE, "cannot write %s: HDF5 cannot compress it; is the disk full?", path);
    }
    for (uint64_t b = 0; !status && b < blocks; b++)
        if (!find_piece(set, b * d->block, pieces + b))
            status = fail(err, MOTUS_FILE, "cannot write %s: HDF5 cannot compress it; is the disk full?", path);
    free(rows);
    return status;
}

/* ---- reading, without HDF5 ---- */

/* Undoes the shuffle: `in` has the first bytes of all numbers, then the second ones. */
static void unshuffle(const unsigned char *in, size_t width, unsigned char *out, size_t count)
{
    const size_t numbers = count / width;
    for (size_t b = 0; b < width; b++)
        for (size_t i = 0; i < numbers; i++) out[i * width + b] = in[b * numbers + i];
}

int unpack_piece_2(const void *bytes, size_t size, uint64_t left_out, size_t width, void *out, size_t count)
{
    enum { SHUFFLE = 1, DEFLATE = 2 };
    const bool shuffled = !(left_out & SHUFFLE) && width > 1;
    uLongf got = (uLongf)count;
    unsigned char *room = shuffled ? malloc(count + 1) : out;
    if (!room) return 0;
    int good = left_out & DEFLATE ? size == count : uncompress(room, &got, bytes, (uLong)size) == Z_OK && got == count;
    if (good && left_out & DEFLATE) memcpy(room, bytes, count);
    if (good && shuffled) unshuffle(room, width, out, count);
    if (shuffled) free(room);
    return good;
}

typedef struct checker {
    const motus_archive_def *d;
    int descriptor;
    unsigned char *packed, *unpacked, *rows; /* room for the bytes of a block */
    size_t room;                             /* of `packed` */
} checker;

/* Tells whether the piece has the rows of a block. */
static motus_status same(checker *c, size_t column, uint64_t block, directory_piece p, bool *yes, motus_error *err)
{
    const motus_archive_def *d = c->d;
    const kind k = kind_of(d, column);
    const size_t all = (size_t)(d->rows < d->block ? d->rows : d->block) * k.width;
    uint64_t first;
    size_t count;
    motus_archive_block(d->from, block, &first, &count);
    const motus_status status = read_rows(d, column, first, count, c->rows, err);
    *yes = !status && p.size <= c->room && bytes_get(c->descriptor, c->packed, (size_t)p.size, p.place) &&
           unpack_piece_2(c->packed, (size_t)p.size, p.left_out, k.unit, c->unpacked, all) &&
           memcmp(c->unpacked, c->rows, count * k.width) == 0;
    return status;
}

motus_status pack_check(const motus_archive_def *d, directory_piece *pieces, int descriptor, uint64_t before,
                        const char *path, motus_error *err)
{
    const uint64_t blocks = directory_blocks(d->rows, d->block), count = (d->column_count + 1) * blocks;
    size_t width = sizeof(int64_t);
    for (size_t k = 1; k <= d->column_count; k++)
        if (kind_of(d, k).width > width) width = kind_of(d, k).width;
    const size_t most = (size_t)(d->rows < d->block ? d->rows : d->block) * width + 1;
    checker c = {d, descriptor, malloc(most + most / 100 + 1024), malloc(most), malloc(most), most + most / 100 + 1024};
    motus_status status = c.packed && c.unpacked && c.rows ? MOTUS_OK : no_memory(path, err);
    bool good = true;
    if (!status && count > 0) status = same(&c, 0, 0, pieces[0], &good, err);
    for (uint64_t k = 0; !good && k < count; k++) pieces[k].place += before;
    good = true;
    for (uint64_t k = 0; !status && good && k < count; k++) {
        status = same(&c, (size_t)(k / blocks), k % blocks, pieces[k], &good, err);
        if (!status && d->stop && d->stop(d->context)) status = fail(err, MOTUS_CANCELLED, "cancelled");
    }
    if (!status && !good)
        status = fail(err, MOTUS_FILE, "cannot write %s: what HDF5 compressed does not unpack to the same bytes", path);
    free(c.packed);
    free(c.unpacked);
    free(c.rows);
    return status;
}
