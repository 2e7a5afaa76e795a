/* The checks of a table that is written row after row: the rows of a sweep as CSV or .npy, and its events.
 *
 * They stand beside it, in FILE.check, so that the table stays one that every program reads. Behind its first line each
 * line says how many bytes of FILE there are, and has a hash of those since the last multiple of CHECKS_PIECE. A line
 * is appended when its bytes have been written, at the end of each piece and of each batch of rows; a table that is
 * complete has the lines of the pieces and the last one alone, so that the bytes do not depend on interruptions.
 *
 * Invariant: what has a line has been written before. So whenever a program is killed, the rows with a line are whole,
 * and a byte that was changed, put in or taken out later does not have the hash of its line. */
#ifndef CLI_FILES_CHECKS_H
#define CLI_FILES_CHECKS_H

#include "cli/files/file.h"

#include <stdint.h>

enum { CHECKS_PIECE = 1 << 14 };

typedef struct checks {
    char *path;         /* FILE.check; NULL: there are none */
    int descriptor;     /* of the lines */
    file_out out;       /* of a table that gets its name when it is complete */
    uint64_t from, end; /* the bytes of FILE that have been told, */
    uint64_t lines;     /*   and how many lines there are */
    uint64_t said;      /* up to where the last one goes */
    int code;           /* errno of the first failure to write */
    bool missing;       /* of what checks_find() looked for: there is no FILE.check, */
    bool broken;        /*   or bytes of FILE do not have the hash of their line */
    unsigned char piece[CHECKS_PIECE];
} checks;

/* New ones, of the bytes of `file` from `from` on. `at_once`: they get their name by checks_finish(), and not before.
 * MOTUS_ARGUMENT: another file has the name. Call checks_close() in any case. */
motus_status checks_begin(checks *, const char *file, uint64_t from, bool at_once, motus_error *);
/* Tells bytes that have been written to FILE, and at their end writes a line. */
void checks_add(checks *, const void *bytes, size_t count);
motus_status checks_mark(checks *, motus_error *);
/* checks_add() for file_out. */
void checks_seen(void *checks, const char *bytes, size_t count);
bool checks_sync(const checks *); /* false: errno */
/* The table is complete. */
motus_status checks_finish(checks *, motus_error *);

/* Holds the table against its checks: the bytes up to c->end have them. It is open for reading at `descriptor`. */
motus_status checks_find(checks *, const char *file, int descriptor, uint64_t from, motus_error *);
/* Goes on behind the byte `end`, at most that which checks_find() has found. */
motus_status checks_go_on(checks *, int descriptor, uint64_t end, motus_error *);
/* The error: the table has rows, but no checks. */
motus_status checks_refuse(const checks *, const char *file, motus_error *);
void checks_close(checks *);

#endif
