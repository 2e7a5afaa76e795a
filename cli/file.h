/* Files: read whole within a bound, written whole or not at all. */
#ifndef CLI_FILE_H
#define CLI_FILE_H

#include "motus.h"

#include <stdbool.h>
#include <stdio.h>

#define FILE_MODEL_MAX ((size_t)16 << 20) /* bytes of a model */
#define FILE_STATE_MAX ((size_t)1 << 30)  /* bytes of a restart state */

/* The bytes of a file ("-": standard input) with a 0 behind them; the caller frees *text. LIMIT beyond `most` bytes. */
motus_status file_read(const char *path, size_t most, char **text, size_t *length, motus_error *);
bool file_same(const char *a, const char *b); /* one and the same file, also through links */

/* Where PATH finds a program; false: nowhere. */
bool file_program(const char *name, char *path, size_t size);

/* A file being written. Until file_keep() it has a temporary name in the same folder. What is no regular file (a
 * device, a pipe, "-") is written directly. */
typedef struct file_out {
    FILE *stream;
    char *path, *temporary; /* temporary: NULL when written directly */
    int code;               /* errno of the first failure */
} file_out;

motus_status file_create(file_out *, const char *path, motus_error *);
motus_status file_write(file_out *, const char *bytes, size_t count, motus_error *);
motus_status file_text(file_out *, const char *, motus_error *);
/* Everything on the disk and closed; nothing has its name yet. */
motus_status file_finish(file_out *, motus_error *);
/* The name, in one step. */
motus_status file_keep(file_out *, motus_error *);
/* Removes what was begun and not kept, and frees; always to be called. */
void file_drop(file_out *);

/* Standard output to its end: a full disk shows here. */
motus_status file_flush_output(motus_error *);

#endif
