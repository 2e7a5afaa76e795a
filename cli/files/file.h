/* Files: read up to a bound, written completely or not at all. */
#ifndef CLI_FILES_FILE_H
#define CLI_FILES_FILE_H

#include "motus.h"

#include <stdbool.h>
#include <stdio.h>

#define FILE_MODEL_MAX ((size_t)16 << 20) /* bytes of a model */
#define FILE_STATE_MAX ((size_t)1 << 30)  /* bytes of a restart state */
#define FILE_VALUES_MAX 50000000          /* numbers of a file of values */
#define FILE_LINE_MAX ((size_t)16 << 20)  /* bytes of a line of one */

/* Opens a file, a pipe or a terminal to be read; the caller closes it. */
motus_status file_open(const char *path, FILE **, motus_error *);
/* The bytes of a file ("-": standard input) followed by a 0; the caller frees *text. LIMIT beyond `most` bytes. */
motus_status file_read(const char *path, size_t most, char **text, size_t *length, motus_error *);
bool file_same(const char *a, const char *b); /* whether both name one file, also through links */

/* Finds a program in PATH. */
bool file_program(const char *name, char *path, size_t size);

/* A file being written. Until file_keep() it has no name, so that a killed program leaves nothing behind; where the
 * file system knows no such files, it has a temporary name in the same folder. A device, a pipe or "-" is written
 * directly. */
typedef struct file_out {
    FILE *stream;
    bool direct;
    int nameless;           /* 1 + the descriptor of a file without a name; 0: there is none */
    char *path, *temporary; /* temporary: NULL when written directly, or without a name */
    int code;               /* errno of the first failure */
    void (*seen)(void *with, const char *bytes, size_t count); /* NULL, or is told all that is written, */
    void *with;                                                /*   with this */
} file_out;

motus_status file_create(file_out *, const char *path, motus_error *);
motus_status file_write(file_out *, const char *bytes, size_t count, motus_error *);
motus_status file_text(file_out *, const char *, motus_error *);
/* Writes everything to the disk and closes; the file does not have its name yet. */
motus_status file_finish(file_out *, motus_error *);
/* Gives the file its name, atomically. */
motus_status file_keep(file_out *, motus_error *);
/* Removes a file that was not kept, and frees. Call in any case. */
void file_drop(file_out *);

/* An archive beside the one in whose place it comes when it is complete; where the system has files without a name, it
 * has none until then, so that a killed program leaves nothing behind. */
typedef struct file_beside {
    char *name; /* of the file in whose place it comes */
    char *path; /* by which it is opened until it is kept */
    int descriptor;
} file_beside;
#define FILE_BESIDE    \
    {                  \
        NULL, NULL, -1 \
    }
motus_status file_beside_make(file_beside *, const char *name, const char *ending, motus_error *);
motus_status file_beside_keep(file_beside *, motus_error *);
/* In a message the name that the user has given takes the place of the path. */
void file_beside_complain(const file_beside *, const char *name, motus_error *);
/* Removes a file that was not kept, and frees. Call in any case. */
void file_beside_drop(file_beside *);

/* Opens the descriptors 0 to 2 where they are closed: what reads or writes them then fails, as if they were closed. */
void file_open_standard(void);
bool file_output_closed(void); /* standard output was closed when the program began, or cannot be written */
/* Flushes standard output and reports what could not be written. */
motus_status file_flush_output(motus_error *);

#endif
