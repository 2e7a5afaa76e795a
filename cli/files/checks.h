/* The checks of a table that is written row after row: the rows of a sweep as CSV or .npy, and its events.
 *
 * They are in a file of their own, FILE.check, so that every program can read the table FILE. After its first line,
 * each line of FILE.check has a number of bytes of FILE, and a hash of those since the last multiple of
 * CHECKS_PIECE, a piece. A line is appended at the end of each piece and of each batch of rows. A complete table
 * keeps only the lines of the pieces and the last line, so that its checks do not depend on interruptions.
 *
 * Invariant: a line is written after its bytes. So whenever a program is killed, the rows with a line are whole, and
 * a byte that is changed, added or removed later does not match the hash of its line. */
#ifndef CLI_FILES_CHECKS_H
#define CLI_FILES_CHECKS_H

#include "cli/files/file.h"

#include <stdint.h>

enum { CHECKS_PIECE = 1 << 14 };

typedef struct checks {
    char *path;         /* FILE.check; NULL: the table has no checks */
    int descriptor;     /* of FILE.check */
    file_out out;       /* FILE.check, if it gets its name when it is complete */
    uint64_t from, end; /* the bytes of FILE that were passed to checks_add() */
    uint64_t lines;
    uint64_t said; /* where the bytes of the last line end */
    int code;      /* errno of the first failure to write */
    bool missing;  /* checks_find() found no FILE.check */
    bool broken;   /* checks_find() found bytes that do not match the hash of their line */
    unsigned char piece[CHECKS_PIECE];
} checks;

/* Begins the checks of the bytes of `file` from `from` on. With `at_once`, FILE.check has no name until
 * checks_finish(). Call checks_close() in any case. */
motus_status checks_begin(checks *, const char *file, uint64_t from, bool at_once, motus_error *);
/* Takes in bytes that have been written to FILE. */
void checks_add(checks *, const void *bytes, size_t count);
/* Writes a line for the last bytes that were added. */
motus_status checks_mark(checks *, motus_error *);
/* Calls checks_add(); file_out.seen has this type. */
void checks_seen(void *checks, const char *bytes, size_t count);
bool checks_sync(const checks *); /* false: errno */
/* Completes the checks of a complete table. */
motus_status checks_finish(checks *, motus_error *);

/* Compares a table, which `descriptor` reads, with its checks: the bytes up to c->end match them. */
motus_status checks_find(checks *, const char *file, int descriptor, uint64_t from, motus_error *);
/* Continues the checks behind the byte `end`, at most the c->end of checks_find(). */
motus_status checks_go_on(checks *, int descriptor, uint64_t end, motus_error *);
/* Makes the error for a table that has rows but no checks. */
motus_status checks_refuse(const checks *, const char *file, motus_error *);
void checks_close(checks *);

#endif
