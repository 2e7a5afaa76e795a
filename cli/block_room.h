/* Room for the columns of one block of an archive. */
#ifndef CLI_BLOCK_ROOM_H
#define CLI_BLOCK_ROOM_H

#include "motus.h"

typedef struct block_room {
    double **columns;     /* those of words hold bytes */
    const void **written; /* the same, as motus_archive_write takes them */
    size_t count;
} block_room;

/* For `count` columns of `rows` numbers; call block_room_free() also after a failure. */
motus_status block_room_make(block_room *, size_t count, size_t rows, motus_error *);
void block_room_free(block_room *);

#endif
