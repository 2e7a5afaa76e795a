/* The directory of an archive: a text at the beginning of the file that says what is where.
 *
 *     motus archive 1
 *     directory 4096 0123456789abcdef
 *     rows 00000000000000100000
 *     block 00000000000000004096
 *     number 00000000000000008192 trajectory
 *     done 00000000000000016384
 *     slots 00000000000000204800 65536
 *     column number 00000000000000020480 x
 *     comment m
 *     column number[100x3] 00000000000000028672 r
 *     column word 00000000000000126976 stopped_by
 *     word singular
 *     note 37 command
 *     motus sweep model.motus --vary k=1:2:9
 *     end
 *
 * The first number is the size of the directory, zeros after its text included, the second a hash of all that follows
 * its line. Places are counted in bytes from the beginning of the file and have a fixed width, so that the length of
 * the text is known before they are. Where a row has several numbers of a column, their shape stands after its kind.
 * `slots` is there if states are: where the first slot begins, and the bytes of each. Behind `note` stand the length of
 * the text and its name; the text follows, and a newline.
 *
 * Where the rows are compressed the first line says `motus archive 2`, and after `done` follows
 *
 *     packed 00000000000000020480
 *
 * the place of a table with a directory_piece of the rows' numbers in each block, then of the first column in each, and
 * so on; the places of numbers and columns are 0.
 */
#ifndef ARCHIVE_DIRECTORY_H
#define ARCHIVE_DIRECTORY_H

#include "motus-archive.h"

typedef struct directory_column {
    const char *name, *comment; /* comment: NULL, there is none */
    uint64_t place;
    const char **words;
    size_t word_count;
    motus_archive_kind kind;
    size_t shape[2];
    uint64_t width; /* bytes of a row in the file */
} directory_column;

/* Where the bytes of a compressed block of a column are, and which filters of HDF5 were left out: bit 0 for shuffling,
 * bit 1 for deflating. */
typedef struct directory_piece {
    uint64_t place, size, left_out;
} directory_piece;

typedef struct directory {
    char *text;                                                        /* names and notes point into it */
    size_t size;                                                       /* of the directory in the file */
    uint64_t rows, block, number_place, done_place, slots_place, slot; /* slot: 0, there are none */
    uint64_t packed_place;                                             /* 0: the rows are not compressed */
    directory_column *columns;
    size_t column_count;
    motus_archive_note *notes;
    size_t note_count;
    const char **words; /* of all columns */
} directory;

enum {
    DIRECTORY_LEAST = 4096, /* bytes; a multiple of what the columns are aligned to */
    DIRECTORY_MOST = 1 << 28,
    DIRECTORY_HEAD = 80, /* most bytes of the first two lines */
    DIRECTORY_SLOT = 32  /* bytes before the state in a slot */
};
extern const char *const directory_kinds[]; /* the words of motus_archive_kind */

/* Returns the bytes that a number of this kind takes in the file. */
static inline size_t directory_width(motus_archive_kind kind)
{
    return kind == MOTUS_ARCHIVE_WORD ? 1 : sizeof(double);
}

static inline uint64_t directory_blocks(uint64_t rows, uint64_t block) { return rows / block + (rows % block > 0); }

/* Writes the text for a definition, which the caller frees; *size: of the directory, a power of 2. places: those of the
 * rows' numbers, of /blocks/done, of each column, of the slots and of the pieces, 0 where there are none; NULL: not yet
 * known. Returns NULL where there is no memory. */
char *directory_write(const motus_archive_def *, const uint64_t *places, size_t *size);
/* Reads a directory from the first `count` bytes of the file. MOTUS_LIMIT: the directory has *size bytes, more than
 * `count`; read them and call again. Call directory_free() in any case. */
motus_status directory_read(directory *, const char *bytes, size_t count, uint64_t file_size, const char *path,
                            size_t *size, motus_error *);
void directory_free(directory *);

/* Computes a hash of 64 bits, which detects damage, not attacks. */
uint64_t directory_hash(uint64_t before, const void *bytes, size_t count);
#define DIRECTORY_HASH UINT64_C(0x6d6f747573313031)

#endif
