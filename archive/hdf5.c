/* Makes the file of an archive, by HDF5, and fills it: a module of its own, since that library takes longer to load
 * than the program (make.h).
 *
 * Invariant: the file has its name only when it is complete. Its bytes depend on the definition alone: HDF5 writes no
 * times into it, in one version of its format, and everything has its place before any block is written. Those of a
 * compressed one depend on its numbers and on the versions of HDF5 and zlib, too.
 */
#include "archive/bytes.h"
#include "archive/directory.h"
#include "archive/make.h"
#include "archive/pack.h"
#include "base/disk.h"
#include "base/error.h"
#include "base/platform.h"

#include <errno.h>
#include <fcntl.h>
#include <hdf5.h>
#include <hdf5_hl.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum {
    ALIGNED = DIRECTORY_LEAST, /* columns begin at pages, so that two machines write no page of a block in common */
    ATTRIBUTE_MOST = 60000,    /* bytes: HDF5 has no room for more in an object's head */
    FILL = 1 << 20
};
static const char MISSING[] = "\xff"; /* the value of a word that is missing */

enum { TAKEN = 1 << 26, SYNCED = 1 << 25 }; /* bytes between two looks whether to stop */

typedef struct maker {
    const motus_archive_def *def;
    const char *path;
    hid_t file, group, blocks, scale;
    uint64_t *places;
    directory_piece *pieces; /* of compressed rows, as in the file */
    motus_error *err;
} maker;

static motus_status refused(const maker *m, const char *what)
{
    return fail(m->err, MOTUS_FILE, "cannot write %s: HDF5 refuses %s", m->path, what);
}

static motus_status no_room(const maker *m, int code)
{
    fail(m->err, MOTUS_FILE, "cannot write %s: %s", m->path, strerror(code));
    if (code == ENOSPC || code == EDQUOT || code == EFBIG)
        hint(m->err, "an archive takes all its room at the beginning; record less, or write to another disk");
    return MOTUS_FILE;
}

/* ---- what HDF5 writes ---- */

/* Makes the type of a text of fixed length. */
static hid_t text_type(const char *text)
{
    const hid_t type = H5Tcopy(H5T_C_S1);
    const size_t length = strlen(text);
    H5Tset_size(type, length ? length : 1);
    H5Tset_cset(type, H5T_CSET_UTF8);
    H5Tset_strpad(type, H5T_STR_NULLPAD);
    return type;
}

static bool put_attribute(hid_t object, const char *name, hid_t type, hid_t space, const void *value)
{
    const hid_t attribute = H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
    const bool good = attribute >= 0 && H5Awrite(attribute, type, value) >= 0;
    if (attribute >= 0) H5Aclose(attribute);
    return good;
}

static bool put_text(hid_t object, const char *name, const char *text)
{
    const hid_t type = text_type(text), space = H5Screate(H5S_SCALAR);
    const bool good = put_attribute(object, name, type, space, text);
    H5Sclose(space);
    H5Tclose(type);
    return good;
}

static bool put_texts(hid_t object, const char *name, const char *text, hid_t space, size_t count)
{
    const hid_t type = text_type(text);
    const size_t length = H5Tget_size(type);
    char *all = calloc(count + 1, length);
    for (size_t k = 0; all && k < (count ? count : 1); k++) memcpy(all + k * length, text, strlen(text));
    const bool good = all && put_attribute(object, name, type, space, all);
    free(all);
    H5Tclose(type);
    return good;
}

static bool put_format(hid_t file, int format)
{
    const hid_t space = H5Screate(H5S_SCALAR);
    const bool good = put_attribute(file, "motus_archive", H5T_NATIVE_INT, space, &format);
    H5Sclose(space);
    return good;
}

static bool put_model(hid_t file, const char *text)
{
    const hid_t type = text_type(text), space = H5Screate(H5S_SCALAR), list = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_obj_track_times(list, false);
    const hid_t set = H5Dcreate2(file, "model", type, space, H5P_DEFAULT, list, H5P_DEFAULT);
    const bool good = set >= 0 && H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text) >= 0;
    if (set >= 0) H5Dclose(set);
    H5Pclose(list);
    H5Sclose(space);
    H5Tclose(type);
    return good;
}

/* Writes the words of a column as the CF conventions have them: values, and their meanings separated by spaces. */
static bool put_words(hid_t set, const motus_archive_column *c)
{
    unsigned char values[255];
    size_t length = 1;
    for (size_t k = 0; k < c->word_count; k++) length += strlen(c->words[k]) + sizeof "none";
    char *meanings = calloc(1, length);
    const char *none = "none";
    if (!meanings) return false;
    for (size_t k = 0; k < c->word_count; k++)
        if (strcmp(c->words[k], none) == 0) none = "-";
    for (size_t k = 0; k < c->word_count; k++) {
        values[k] = (unsigned char)k;
        if (k) strcat(meanings, " ");
        char *word = meanings + strlen(meanings);
        strcat(meanings, c->words[k][0] ? c->words[k] : none);
        for (; *word; word++)
            if (*word == ' ') *word = '_';
    }
    const hsize_t count = c->word_count;
    const hid_t space = H5Screate_simple(1, &count, NULL);
    const bool good =
        put_attribute(set, "flag_values", H5T_NATIVE_UCHAR, space, values) && put_text(set, "flag_meanings", meanings);
    H5Sclose(space);
    free(meanings);
    return good;
}

/* Returns the name without slashes, which HDF5 would take for folders. */
static char *link_name(const char *name)
{
    static const char slash[] = "\u2215";
    size_t length = 1;
    for (const char *at = name; *at; at++) length += *at == '/' ? sizeof slash - 1 : 1;
    char *out = calloc(1, length), *to = out;
    for (const char *at = name; out && *at; at++) {
        const size_t more = *at == '/' ? sizeof slash - 1 : 1;
        memcpy(to, *at == '/' ? slash : at, more);
        to += more;
    }
    return out;
}

/* Makes a data set of `count` rows at their place, which HDF5 does not fill. shape: of the numbers in a row; NULL: one.
 * chunk above 0: the rows will be compressed, `chunk` at a time, and have no place yet. The caller closes the set. */
static hid_t make_set(hid_t group, const char *name, hid_t type, uint64_t count, const size_t *shape,
                      const void *missing, uint64_t chunk, uint64_t *place)
{
    const hsize_t sizes[] = {count, shape ? shape[0] : 0, shape ? shape[1] : 0};
    const int dimensions = sizes[2] ? 3 : sizes[1] ? 2 : 1;
    const hid_t space = H5Screate_simple(dimensions, sizes, NULL), list = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_obj_track_times(list, false);
    H5Pset_fill_value(list, type, missing);
    if (chunk > 0 && !pack_layout(list, dimensions, (const hsize_t[]){chunk, sizes[1], sizes[2]})) {
        H5Pclose(list);
        H5Sclose(space);
        return H5I_INVALID_HID;
    }
    if (chunk == 0) {
        H5Pset_layout(list, H5D_CONTIGUOUS);
        H5Pset_alloc_time(list, H5D_ALLOC_TIME_EARLY);
        H5Pset_fill_time(list, H5D_FILL_TIME_NEVER);
    }
    char *link = link_name(name);
    const hid_t set = link ? H5Dcreate2(group, link, type, space, H5P_DEFAULT, list, H5P_DEFAULT) : H5I_INVALID_HID;
    free(link);
    H5Pclose(list);
    H5Sclose(space);
    if (set >= 0) *place = chunk > 0 ? 0 : count > 0 ? H5Dget_offset(set) : DIRECTORY_LEAST; /* of no rows: any */
    if (set < 0 || *place != HADDR_UNDEF) return set;
    H5Dclose(set);
    return H5I_INVALID_HID;
}

/* Returns how many rows are compressed together; 0: they are not compressed. */
static uint64_t chunk_of(const maker *m)
{
    const motus_archive_def *d = m->def;
    return d->from ? d->rows < d->block ? d->rows : d->block : 0;
}

static motus_status put_column(maker *m, size_t k)
{
    const motus_archive_column *c = m->def->columns + k;
    const bool word = c->kind == MOTUS_ARCHIVE_WORD;
    const double none = NAN;
    const hid_t set = make_set(m->group, c->name, word ? H5T_STD_U8LE : H5T_IEEE_F64LE, m->def->rows, c->shape,
                               word ? (const void *)MISSING : &none, chunk_of(m), m->places + 2 + k);
    if (set < 0) return refused(m, c->name);
    /* Not where a row has several numbers: netCDF wants a scale for each dimension of a column, or for none. */
    const bool scaled = c->shape[0] || H5DSattach_scale(set, m->scale, 0) >= 0;
    const bool good = scaled && (!word || put_words(set, c)) && (!c->comment || put_text(set, "comment", c->comment));
    H5Dclose(set);
    return good ? MOTUS_OK : refused(m, c->name);
}

static motus_status put_sets(maker *m)
{
    const int64_t no_number = -1;
    const uint64_t no_hash = 0;
    const motus_archive_def *d = m->def;
    m->scale = make_set(m->group, d->scale, H5T_STD_I64LE, d->rows, NULL, &no_number, chunk_of(m), m->places);
    if (m->scale < 0 || H5DSset_scale(m->scale, d->scale) < 0) return refused(m, d->scale);
    const hid_t done = make_set(m->blocks, "done", H5T_STD_U64LE, directory_blocks(d->rows, d->block), NULL, &no_hash,
                                0, m->places + 1);
    if (done < 0) return refused(m, "the list of blocks");
    H5Dclose(done);
    motus_status status = MOTUS_OK;
    for (size_t k = 0; !status && k < d->column_count; k++) status = put_column(m, k);
    return status;
}

static hid_t make_group(hid_t file, const char *name);

/* Makes /checkpoint/slots, where states are written in turn. */
static motus_status put_slots(maker *m)
{
    if (!m->def->slot) return MOTUS_OK;
    const size_t shape[] = {m->def->slot + DIRECTORY_SLOT, 0};
    const unsigned char zero = 0;
    const hid_t group = make_group(m->file, "checkpoint");
    const hid_t set = make_set(group, "slots", H5T_STD_U8LE, 2, shape, &zero, 0, m->places + 2 + m->def->column_count);
    if (set >= 0) H5Dclose(set);
    if (group >= 0) H5Gclose(group);
    return set < 0 ? refused(m, "room for states") : MOTUS_OK;
}

/* ---- other conventions ---- */

/* Returns the group of a path, and makes the groups on the way one by one: what HDF5 makes by itself has the time in
 * it. */
static hid_t group_at(hid_t file, const char *path)
{
    hid_t group = H5Gopen2(file, "/", H5P_DEFAULT);
    char *copy = strdup(path);
    for (char *at = copy, *end = copy; group >= 0 && end && *at; at = end) {
        at += strspn(at, "/");
        end = at + strcspn(at, "/");
        const char behind = *end;
        *end = 0;
        const hid_t inner =
            H5Lexists(group, at, H5P_DEFAULT) > 0 ? H5Gopen2(group, at, H5P_DEFAULT) : make_group(group, at);
        H5Gclose(group);
        group = inner;
        *end = behind;
    }
    free(copy);
    return copy ? group : H5I_INVALID_HID;
}

static bool put_link(const maker *m, const motus_archive_link *l)
{
    const bool scale = l->column == MOTUS_ARCHIVE_SCALE;
    char *name = link_name(scale ? m->def->scale : m->def->columns[l->column].name), *path = strdup(l->path);
    char *slash = path ? strrchr(path, '/') : NULL;
    bool good = name && slash && slash > path;
    if (good) {
        *slash = 0;
        const hid_t group = group_at(m->file, path);
        good = group >= 0 && H5Lcreate_hard(m->group, name, group, slash + 1, H5P_DEFAULT, H5P_DEFAULT) >= 0;
        if (group >= 0) H5Gclose(group);
    }
    free(path);
    free(name);
    return good;
}

static bool put_attribute_of(const maker *m, const motus_archive_attribute *a)
{
    const hid_t group = group_at(m->file, a->group);
    const hsize_t count = a->count;
    const hid_t space = a->count <= 1 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &count, NULL);
    const bool good = group >= 0 && (a->text ? put_texts(group, a->name, a->text, space, a->count)
                                             : put_attribute(group, a->name, H5T_NATIVE_INT, space, a->numbers));
    H5Sclose(space);
    if (group >= 0) H5Gclose(group);
    return good;
}

static motus_status put_conventions(const maker *m)
{
    const motus_archive_def *d = m->def;
    for (size_t k = 0; k < d->link_count; k++)
        if (!put_link(m, d->links + k)) return refused(m, d->links[k].path);
    for (size_t k = 0; k < d->attribute_count; k++)
        if (!put_attribute_of(m, d->attributes + k)) return refused(m, d->attributes[k].name);
    return MOTUS_OK;
}

static motus_status put_notes(maker *m)
{
    if (!put_format(m->file, m->def->from ? 2 : 1)) return refused(m, "the version");
    for (size_t k = 0; k < m->def->note_count; k++) {
        const motus_archive_note *n = m->def->notes + k;
        const bool model = strcmp(n->name, "model") == 0;
        if (!model && strlen(n->text) > ATTRIBUTE_MOST)
            return fail(m->err, MOTUS_ARGUMENT, "%s: the %s is longer than the %d bytes that an archive has room for",
                        m->path, n->name, ATTRIBUTE_MOST);
        if (!(model ? put_model(m->file, n->text) : put_text(m->file, n->name, n->text))) return refused(m, n->name);
    }
    return MOTUS_OK;
}

static hid_t make_group(hid_t file, const char *name)
{
    const hid_t list = H5Pcreate(H5P_GROUP_CREATE);
    H5Pset_obj_track_times(list, false);
    H5Pset_link_creation_order(list, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED); /* readers keep the order */
    const hid_t group = H5Gcreate2(file, name, H5P_DEFAULT, list, H5P_DEFAULT);
    H5Pclose(list);
    return group;
}

/* Creates the file. aligned: large data begin at a page. */
static hid_t make_file(const char *path, size_t directory, bool aligned)
{
    const hid_t made = H5Pcreate(H5P_FILE_CREATE), access = H5Pcreate(H5P_FILE_ACCESS);
    H5Pset_userblock(made, directory);
    H5Pset_obj_track_times(made, false);
    H5Pset_libver_bounds(access, H5F_LIBVER_V18, H5F_LIBVER_V18);
    if (aligned) H5Pset_alignment(access, ALIGNED, ALIGNED);
    H5Pset_file_locking(access, true, true);
    const hid_t file = H5Fcreate(path, H5F_ACC_TRUNC, made, access);
    H5Pclose(access);
    H5Pclose(made);
    return file;
}

/* Writes the rows of the archive that is compressed, and where HDF5 puts them, /blocks/packed. */
static motus_status put_packed(maker *m)
{
    const motus_archive_def *d = m->def;
    const uint64_t count = (d->column_count + 1) * directory_blocks(d->rows, d->block);
    const size_t shape[] = {sizeof(directory_piece) / sizeof(uint64_t), 0};
    const uint64_t none = 0;
    if (!d->from) return MOTUS_OK;
    const hid_t set =
        make_set(m->blocks, "packed", H5T_STD_U64LE, count, shape, &none, 0, m->places + 3 + d->column_count);
    if (set < 0) return refused(m, "the places of the blocks");
    H5Dclose(set);
    m->pieces = calloc((size_t)count + 1, sizeof *m->pieces);
    if (!m->pieces) return fail(m->err, MOTUS_MEMORY, "no memory to compress %s", m->path);
    motus_status status = MOTUS_OK;
    for (size_t k = 0; !status && k <= d->column_count; k++) {
        char *link = link_name(k ? d->columns[k - 1].name : d->scale);
        const hid_t its = link ? H5Dopen2(m->group, link, H5P_DEFAULT) : H5I_INVALID_HID;
        free(link);
        if (its < 0) return refused(m, "to open what it made");
        status = pack_rows(its, d, k, m->pieces + k * directory_blocks(d->rows, d->block), m->path, m->err);
        H5Dclose(its);
    }
    return status;
}

static motus_status by_hdf5(maker *m, const char *path, size_t directory)
{
    H5dont_atexit(); /* at the exit it would crash where a file could not be closed, as on a full disk */
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
    m->group = m->blocks = m->scale = H5I_INVALID_HID;
    errno = 0;
    m->file = make_file(path, directory, !m->def->from);
    if (m->file < 0 && (errno == ENOSPC || errno == EDQUOT || errno == EFBIG)) { /* the file has been made, empty */
        const motus_status status = no_room(m, errno);
        unlink(path);
        return status;
    }
    if (m->file < 0) {
        fail(m->err, MOTUS_FILE, "cannot write %s: HDF5 cannot make the file beside it, %s", m->path, path);
        hint(m->err, "look whether the folder may be written, and whether another program makes this archive");
        return MOTUS_FILE;
    }
    m->group = make_group(m->file, m->def->group);
    m->blocks = make_group(m->file, "blocks");
    motus_status status = m->group < 0 || m->blocks < 0 ? refused(m, "a group") : put_notes(m);
    if (!status) status = put_sets(m);
    if (!status) status = put_slots(m);
    if (!status) status = put_conventions(m);
    if (!status) status = put_packed(m);
    if (m->scale >= 0) H5Dclose(m->scale);
    if (m->blocks >= 0) H5Gclose(m->blocks);
    if (m->group >= 0) H5Gclose(m->group);
    errno = 0;
    if (H5Fclose(m->file) < 0 && !status) status = errno ? no_room(m, errno) : refused(m, "to close it");
    return status;
}

/* ---- what we write ---- */

static motus_status put(const maker *m, int descriptor, const void *bytes, size_t count, uint64_t place)
{
    return bytes_put(descriptor, bytes, count, place) ? MOTUS_OK : no_room(m, errno);
}

static motus_status stopped(const maker *m)
{
    const bool stops = m->def->stop && m->def->stop(m->def->context);
    return stops ? fail(m->err, MOTUS_CANCELLED, "cancelled") : MOTUS_OK;
}

/* Puts `total` bytes of a repeated piece. */
static motus_status repeat(const maker *m, int descriptor, const char *piece, size_t size, uint64_t total,
                           uint64_t place)
{
    motus_status status = MOTUS_OK;
    for (uint64_t done = 0; !status && done < total; done += size) {
        status = stopped(m);
        if (!status)
            status = put(m, descriptor, piece, total - done < size ? (size_t)(total - done) : size, place + done);
    }
    return status;
}

static motus_status put_numbers(const maker *m, int descriptor, int64_t *room)
{
    const motus_archive_def *d = m->def;
    const uint64_t most = FILL / sizeof *room;
    uint64_t written = 0;
    motus_status status = MOTUS_OK;
    for (uint64_t row = 0; !status && row < d->rows; row += most) {
        const size_t count = (size_t)(d->rows - row < most ? d->rows - row : most);
        for (size_t i = 0; i < count; i++) room[i] = (int64_t)(d->number ? d->number(d->context, row + i) : row + i);
        status = stopped(m);
        if (!status) status = put(m, descriptor, room, count * sizeof *room, m->places[0] + row * sizeof *room);
        /* in pieces, since no signal ends the wait for the disk */
        written += count * sizeof *room;
        if (status || written < SYNCED) continue;
        if (!disk_sync(descriptor)) status = no_room(m, errno);
        written = 0;
    }
    return status;
}

/* Writes what is written only once: the numbers of the rows, and that no block is there. */
static motus_status put_rest(const maker *m, int descriptor)
{
    const motus_archive_def *d = m->def;
    char *room = calloc(1, FILL);
    if (!room) return fail(m->err, MOTUS_MEMORY, "no memory to fill %s", m->path);
    const uint64_t hashes = directory_blocks(d->rows, d->block) * sizeof(uint64_t);
    motus_status status = repeat(m, descriptor, room, FILL, hashes, m->places[1]);
    if (!status && d->slot) {
        memset(room, 0, FILL);
        status =
            repeat(m, descriptor, room, FILL, 2 * ((uint64_t)d->slot + DIRECTORY_SLOT), m->places[2 + d->column_count]);
    }
    if (!status) status = put_numbers(m, descriptor, (int64_t *)(void *)room);
    free(room);
    return status;
}

/* Gives every byte of the columns its value. */
static motus_status fill(const maker *m, int descriptor)
{
    const motus_archive_def *d = m->def;
    double *room = malloc(FILL);
    if (!room) return fail(m->err, MOTUS_MEMORY, "no memory to fill %s", m->path);
    motus_status status = MOTUS_OK;
    for (size_t i = 0; i < FILL / sizeof *room; i++) room[i] = NAN;
    for (size_t k = 0; !status && k < d->column_count; k++)
        if (d->columns[k].kind == MOTUS_ARCHIVE_NUMBER)
            status = repeat(m, descriptor, (const char *)room, FILL,
                            d->rows * motus_archive_width(d->columns + k) * sizeof *room, m->places[2 + k]);
    memset(room, MISSING[0], FILL);
    for (size_t k = 0; !status && k < d->column_count; k++)
        if (d->columns[k].kind == MOTUS_ARCHIVE_WORD)
            status = repeat(m, descriptor, (const char *)room, FILL, d->rows, m->places[2 + k]);
    free(room);
    return status;
}

/* Asks for all the room before a byte of it is written. A file system that cannot do so finds out by writing. */
static motus_status take_room(const maker *m, int descriptor)
{
    struct stat about;
    motus_status status = MOTUS_OK;
    int code = 0;
    if (fstat(descriptor, &about) != 0) return MOTUS_OK;
    for (off_t at = 0; !status && !code && at < about.st_size; at += TAKEN) {
        status = stopped(m);
        const off_t left = about.st_size - at;
        if (!status) code = posix_fallocate(descriptor, at, left < TAKEN ? left : TAKEN);
    }
    return code == ENOSPC || code == EDQUOT || code == EFBIG ? no_room(m, code) : status;
}

/* Writes an archive without a block. */
static motus_status put_missing(const maker *m, int descriptor)
{
    motus_status status = take_room(m, descriptor);
    if (!status) status = put_rest(m, descriptor);
    /* Not what fills the columns: blocks are soon written over it, and a disk would have both. */
    if (!status && !disk_sync(descriptor))
        status = fail(m->err, MOTUS_FILE, "cannot write %s: %s", m->path, strerror(errno));
    return status ? status : fill(m, descriptor);
}

/* Writes the hashes of the blocks of a compressed archive, its states, and where its pieces are. */
static motus_status put_hashes(const maker *m, int descriptor, size_t size)
{
    const motus_archive_def *d = m->def;
    const uint64_t blocks = directory_blocks(d->rows, d->block), *at = m->places + 2 + d->column_count;
    motus_status status = pack_check(d, m->pieces, descriptor, size, m->path, m->err);
    if (!status) status = put(m, descriptor, m->pieces, (d->column_count + 1) * blocks * sizeof *m->pieces, at[1]);
    if (!status) status = archive_copy(d->from, 0, descriptor, m->places[1], m->err);
    if (!status && d->slot) status = archive_copy(d->from, 1, descriptor, at[0], m->err);
    if (!status && !disk_sync(descriptor))
        status = fail(m->err, MOTUS_FILE, "cannot write %s: %s", m->path, strerror(errno));
    return status;
}

static motus_status by_us(const maker *m, const char *path, size_t size)
{
    size_t again;
    char *text = directory_write(m->def, m->places, &again);
    if (!text || again != size) {
        free(text);
        return fail(m->err, MOTUS_MEMORY, "no memory for the directory of %s", m->path);
    }
    const int descriptor = open(path, O_RDWR | O_CLOEXEC);
    motus_status status = descriptor < 0 ? fail(m->err, MOTUS_FILE, "cannot write %s: %s", m->path, strerror(errno))
                                         : put(m, descriptor, text, size, 0);
    if (!status) status = m->def->from ? put_hashes(m, descriptor, size) : put_missing(m, descriptor);
    if (descriptor >= 0 && close(descriptor) != 0 && !status)
        status = fail(m->err, MOTUS_FILE, "cannot write %s: %s", m->path, strerror(errno));
    free(text);
    return status;
}

/* Copies what HDF5 has written, all but holes, into our file. HDF5 takes a name only, and a named file would stay where
 * the program is killed while it is filled. */
static motus_status take_over(const maker *m, const char *from, int to)
{
    enum { PIECE = 1 << 20 };
    const int descriptor = open(from, O_RDONLY | O_CLOEXEC);
    struct stat about;
    char *room = malloc(PIECE);
    motus_status status = room ? MOTUS_OK : fail(m->err, MOTUS_MEMORY, "no memory to make %s", m->path);
    if (!status && (descriptor < 0 || fstat(descriptor, &about) != 0 || ftruncate(to, about.st_size) != 0))
        status = no_room(m, errno);
    for (off_t at = 0, end = 0; !status && at < about.st_size;) {
        if (at == end) {
            at = platform_written(descriptor, at, &end);
            if (at < 0 && errno == ENXIO) break; /* a hole up to the end */
        }
        if (at < 0 || end <= at) {
            status = no_room(m, errno);
            continue;
        }
        const size_t some = end - at < PIECE ? (size_t)(end - at) : PIECE;
        errno = EIO;
        status = stopped(m);
        if (!status && !bytes_get(descriptor, room, some, (uint64_t)at)) status = no_room(m, errno);
        if (!status) status = put(m, to, room, some, (uint64_t)at);
        at += (off_t)some;
    }
    if (descriptor >= 0) close(descriptor);
    free(room);
    return status;
}

motus_status make_hdf5_3(const char *path, const motus_archive_def *d, motus_error *err)
{
    size_t size = 0;
    motus_status status;
    maker m = {.def = d,
               .path = path,
               .err = err,
               .file = H5I_INVALID_HID,
               .places = calloc(4 + d->column_count, sizeof *m.places)};
    char *name = disk_real(path), *beside = name ? disk_beside(name, ".new") : NULL, place[PLATFORM_PLACE];
    char *text = directory_write(d, NULL, &size);
    const int nameless = d->descriptor || d->from || !name ? -1 : disk_nameless(name, 0666);
    const int own = d->descriptor ? d->descriptor - 1 : nameless;
    const char *at = own >= 0 ? platform_place(own, place) : beside;
    if (!m.places || !text || !beside) {
        status = fail(err, MOTUS_MEMORY, "no memory to make %s", path);
    } else {
        struct stat about; /* a file that is replaced leaves its permissions */
        const bool there = !d->descriptor && stat(name, &about) == 0;
        status = by_hdf5(&m, beside, size);
        if (!status && own >= 0) status = take_over(&m, beside, own);
        if (own >= 0 && m.file >= 0) unlink(beside);
        if (!status && there) (void)chmod(at, about.st_mode & 07777);
        if (!status) status = by_us(&m, at, size);
        if (!status && !d->descriptor && (own >= 0 ? !disk_name(own, name) : rename(beside, name) != 0))
            status = fail(err, MOTUS_FILE, "cannot write %s: %s", path, strerror(errno));
        if (status && own < 0 && m.file >= 0) unlink(beside);
    }
    if (nameless >= 0) close(nameless);
    free(beside);
    free(name);
    free(text);
    free(m.places);
    free(m.pieces);
    return status;
}
