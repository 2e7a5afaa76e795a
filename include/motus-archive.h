/* motus-archive.h: archives, the files in which sweeps and runs keep their numbers (library libmotus-archive).
 *
 * An archive is an HDF5 file: h5py, h5dump, xarray and pandas read its columns by name. It has all its bytes from the
 * beginning on: each column is one contiguous piece of the file, filled with NaN, and nothing but blocks of rows, and
 * states, is written afterwards. So a process that is killed leaves a file that opens, and several processes, on
 * several machines, may write different blocks of one file at once. /blocks/done holds for each block a hash of its
 * bytes, which tells what is there.
 *
 * The first bytes of the file, which HDF5 leaves to its users, are a directory in plain text: the model, the command,
 * and where in the file each column begins. By it archives are read and written without HDF5; only
 * motus_archive_create() needs that library, and zlib what is compressed.
 *
 * An archive that is complete may be compressed: each block of a column is then a piece of its own (a chunk of HDF5,
 * shuffled and deflated), which is read as before and never written again.
 *
 * A call that fails returns a status other than MOTUS_OK and fills in the error, which may be NULL. */
#ifndef MOTUS_ARCHIVE_H
#define MOTUS_ARCHIVE_H

#include <motus.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The latest version of the format: this library reads it and all before. It writes version 1, and 2 where the rows are
 * compressed. */
#define MOTUS_ARCHIVE_FORMAT 2

typedef struct motus_archive motus_archive;

typedef enum motus_archive_kind {
    MOTUS_ARCHIVE_NUMBER, /* double; NaN in a block that is missing */
    MOTUS_ARCHIVE_WORD    /* unsigned char, the number of one of the column's words; 255 in a block that is missing */
} motus_archive_kind;

typedef struct motus_archive_column {
    const char *name; /* UTF-8, unique, one line */
    motus_archive_kind kind;
    const char *const *words; /* of a WORD: up to 255, each one line */
    size_t word_count;
    /* Of a NUMBER: how many there are in a row. {0, 0}: one; {n, 0}: n; {n, d}: n times d, the last index the
     * fastest. */
    size_t shape[2];
    const char *comment; /* of one line; NULL: none. The attribute `comment` of the column */
} motus_archive_column;

/* What is said of the file: the model, the command, the version … A text of UTF-8, whose name is unique. */
typedef struct motus_archive_note {
    const char *name, *text;
} motus_archive_note;

/* A second name of a column in the file, "/particles/r/position/value"; its groups are made. MOTUS_ARCHIVE_SCALE in
 * place of a column is the numbers of the rows. */
#define MOTUS_ARCHIVE_SCALE ((size_t)-1)
typedef struct motus_archive_link {
    const char *path;
    size_t column;
} motus_archive_link;

/* An attribute of a group, which is made where it is not there: `count` times the same text, or else `count` numbers;
 * of a count below 2 a scalar. */
typedef struct motus_archive_attribute {
    const char *group, *name, *text;
    const int *numbers;
    size_t count;
} motus_archive_attribute;

typedef struct motus_archive_def {
    uint32_t size;        /* by motus_archive_default() */
    const char *group;    /* of the columns: "sweep" */
    const char *scale;    /* the name of the rows' numbers, the dimension scale of all columns: "trajectory" */
    uint64_t rows, block; /* rows in all, and of each block but the last, > 0 */
    uint64_t (*number)(void *context, uint64_t row); /* the number of a row; NULL: rows are numbered from 0 */
    void *context;
    const motus_archive_column *columns;
    size_t column_count;
    /* The note named "model" is the dataset /model; others are attributes of the file. */
    const motus_archive_note *notes;
    size_t note_count;
    /* What other conventions than ours want; readers of archives need none of it. */
    const motus_archive_link *links;
    size_t link_count;
    const motus_archive_attribute *attributes;
    size_t attribute_count;
    size_t slot;                /* bytes that a state may have, motus_archive_save; 0: there are no slots for states */
    int (*stop)(void *context); /* asked while the file is made; NULL, or not 0 ends that with MOTUS_CANCELLED */
    /* NULL: no block is there. Else an archive of the same definition, all of whose blocks are there: the file that is
     * made has them, compressed, its states and its notes. It may replace that archive, which is not changed. */
    motus_archive *from;
    /* 0: the file gets its name when it is complete. Else 1 + the descriptor of an empty file, open to read and write,
     * in which the archive is made, for a time by way of a file beside `path`: it keeps the name that it has, or
     * none. */
    int descriptor;
} motus_archive_def;

MOTUS_API motus_archive_def motus_archive_default(void);

/* Whether this library can make archives: it was built with HDF5. */
MOTUS_API int motus_archive_makes(void);
/* Makes an archive without any block. It gets its name when it is complete, in place of a file that has it.
 * MOTUS_UNAVAILABLE: the library was built without HDF5. MOTUS_FILE: it cannot be written, or there is no room for
 * all its rows. MOTUS_ARGUMENT: a name or a text that HDF5 cannot hold. MOTUS_STATE: a block of `from` is missing. */
MOTUS_API motus_status motus_archive_create(const char *path, const motus_archive_def *, motus_error *);

/* Opens an archive, to read or (`write` 1) also to write blocks. MOTUS_STATE: the file is not an archive, or is
 * damaged. MOTUS_UNAVAILABLE: a later version of motus wrote it. */
MOTUS_API motus_status motus_archive_open(const char *path, int write, motus_archive **, motus_error *);
MOTUS_API void motus_archive_close(motus_archive *);           /* NULL: nothing */
MOTUS_API int motus_archive_compressed(const motus_archive *); /* 1: its blocks are not to be written */

MOTUS_API uint64_t motus_archive_rows(const motus_archive *);
MOTUS_API uint64_t motus_archive_blocks(const motus_archive *);
/* Rows of each block but the last. */
MOTUS_API uint64_t motus_archive_block_rows(const motus_archive *);
/* The rows of a block: the first, and how many. */
MOTUS_API void motus_archive_block(const motus_archive *, uint64_t block, uint64_t *first, size_t *count);
MOTUS_API size_t motus_archive_column_count(const motus_archive *);
/* The column lives as long as the archive. 0: there is none of this number. */
MOTUS_API int motus_archive_column_at(const motus_archive *, size_t column, motus_archive_column *);
/* The notes live as long as the archive. 0: there is none of this number. */
MOTUS_API int motus_archive_note_at(const motus_archive *, size_t note, motus_archive_note *);
/* The text of the note of this name; NULL: there is none. */
MOTUS_API const char *motus_archive_note_of(const motus_archive *, const char *name);

/* The numbers that a row has of a column. */
MOTUS_API size_t motus_archive_width(const motus_archive_column *);
/* Writes the rows of a block, and then that it is there: columns[k] are the double or unsigned char of column k, row
 * after row. MOTUS_STATE: the archive is compressed. */
MOTUS_API motus_status motus_archive_write(motus_archive *, uint64_t block, const void *const *columns, motus_error *);
/* Everything that was written is on the disk when it returns MOTUS_OK. */
MOTUS_API motus_status motus_archive_sync(motus_archive *, motus_error *);
/* Whether a block is there: *whole 1: its bytes have the hash that was written after them; 0: it is missing, in part or
 * in all. */
MOTUS_API motus_status motus_archive_whole(motus_archive *, uint64_t block, int *whole, motus_error *);
/* Whether a hash of the block is there, whatever its bytes are: all that others have written since it was opened. */
MOTUS_API motus_status motus_archive_written(motus_archive *, uint64_t block, int *written, motus_error *);
/* Reads `count` rows of a column from a row on: motus_archive_width() double, or an unsigned char, of each. */
MOTUS_API motus_status motus_archive_read(motus_archive *, size_t column, uint64_t row, size_t count, void *,
                                          motus_error *);
/* Reads the numbers of rows. */
MOTUS_API motus_status motus_archive_numbers(motus_archive *, uint64_t row, size_t count, int64_t *, motus_error *);

/* States, from which the work goes on: two slots are written in turn, each with a hash, so that whenever the process is
 * killed one of them is whole. */
MOTUS_API size_t motus_archive_slot(const motus_archive *); /* the bytes that a state may have; 0: there are no slots */
/* Writes a state to the slot that has not the latest, when everything before is on the disk. MOTUS_LIMIT: it is too
 * long for a slot. */
MOTUS_API motus_status motus_archive_save(motus_archive *, const void *bytes, size_t length, motus_error *);
/* Likewise the last state of all, which both slots then have: what they are afterwards depends on it alone. */
MOTUS_API motus_status motus_archive_settle(motus_archive *, const void *bytes, size_t length, motus_error *);
/* The latest state that is whole (`back` 0), or the one before (1); *bytes to be freed by free(), followed by a byte 0.
 * *bytes NULL: there is none. */
MOTUS_API motus_status motus_archive_saved(motus_archive *, int back, char **bytes, size_t *length, motus_error *);

#ifdef __cplusplus
}
#endif
#endif
