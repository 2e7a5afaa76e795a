/* A state in the archive of a run: how many rows there are up to it, the library's restart state, and the rows of the
 * block that is not complete. */
#ifndef CLI_RUN_RUN_STATE_H
#define CLI_RUN_RUN_STATE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct run_state {
    uint64_t rows;
    int64_t samples;         /* how many times of a period rows were taken at */
    bool due;                /* the row that may be due where the run stands has not been taken */
    const char *text, *rest; /* the restart state, and behind it the rows */
    size_t length, rest_length;
} run_state;

/* The bytes of a state, to be freed: the `rest` is left to the caller, who writes *rest of these bytes. NULL: no
 * memory. */
char *run_state_write(const run_state *, size_t *length, char **rest);
/* False: these bytes, behind which a 0 stands, are no state. */
bool run_state_read(const char *bytes, size_t length, run_state *);
/* What a slot has room for beside a restart state of this length and rows of so many bytes: a quarter more. */
size_t run_state_slot(size_t length, size_t rest);
#endif
