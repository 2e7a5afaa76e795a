/* See block_room.h. */
#include "cli/block_room.h"

#include "cli/complain.h"

#include <stdbool.h>
#include <stdlib.h>

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
