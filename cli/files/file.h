/* Files: read up to a bound, written completely or not at all. */
#ifndef CLI_FILES_FILE_H
#define CLI_FILES_FILE_H

#include "motus.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <sys/types.h>

#define FILE_MODEL_MAX ((size_t)16 << 20) /* bytes of a model */
#define FILE_STATE_MAX ((size_t)1 << 30)  /* bytes of a restart state */
#define FILE_VALUES_MAX 50000000          /* numbers of a file of values */
#define FILE_LINE_MAX ((size_t)16 << 20)  /* bytes of a line of a file of values */

/* Reads `count` bytes from `place`, or fewer at the end of the file. Returns how many, or -1 and errno. */
ssize_t file_read_at(int descriptor, void *out, size_t count, uint64_t place);
/* Opens a file, a pipe or a terminal for reading. */
motus_status file_open(const char *path, FILE **, motus_error *);
/* Reads a file ("-": standard input) of at most `most` bytes; a byte 0 follows them. The caller frees *text. */
motus_status file_read(const char *path, size_t most, char **text, size_t *length, motus_error *);
bool file_same(const char *a, const char *b); /* returns whether both name one file, also by links */

/* Makes the error "cannot `what` PATH: CODE", where `code` is an errno. */
motus_status file_cannot(const char *what, const char *path, int code, motus_error *);
/* Makes the error for a failed write. If the reader of standard output ("-") is gone, requests a stop. */
motus_status file_cannot_write(const char *path, int code, motus_error *);

/* Finds a program in PATH. */
bool file_program(const char *name, char *path, size_t size);

/* A file that is being written. It has no name until file_keep(), so that a killed program leaves nothing behind; if
 * the file system has no such files, it has a temporary name in its folder. A device, a pipe or "-" is written
 * directly. */
typedef struct file_out {
    FILE *stream;
    bool direct;
    int nameless;           /* 1 + the descriptor of a file without a name; 0: the file has a name */
    char *path, *temporary; /* temporary: NULL if the file is written directly, or has no name */
    int code;               /* errno of the first failure */
    void (*seen)(void *with, const char *bytes, size_t count); /* NULL, or called for all bytes that are written */
    void *with;                                                /* the first argument of `seen` */
} file_out;

motus_status file_create(file_out *, const char *path, motus_error *);
motus_status file_write(file_out *, const char *bytes, size_t count, motus_error *);
motus_status file_text(file_out *, const char *, motus_error *);
/* Writes everything to the disk and closes the file, which has no name yet. */
motus_status file_finish(file_out *, motus_error *);
/* Gives the file its name, atomically. */
motus_status file_keep(file_out *, motus_error *);
/* Removes a file that was not kept, and frees memory. Call it in any case. */
void file_drop(file_out *);

/* A text that is written to memory. */
typedef struct file_memory {
    file_out file;
    char *text; /* complete after file_memory_close(); the caller frees it, also after a failure */
    size_t length;
} file_memory;
motus_status file_memory_open(file_memory *, motus_error *);
/* Returns `status`, or a failure if memory has run out. */
motus_status file_memory_close(file_memory *, motus_status status, motus_error *);

/* An archive that replaces another one when it is complete. It has no name until then if the system has such files, so
 * that a killed program leaves nothing behind; else its name is that of the other one and an ending. */
typedef struct file_beside {
    char *name; /* of the archive that it replaces */
    char *path; /* opens it until it is kept */
    int descriptor;
} file_beside;
#define FILE_BESIDE    \
    {                  \
        NULL, NULL, -1 \
    }
motus_status file_beside_make(file_beside *, const char *name, const char *ending, motus_error *);
motus_status file_beside_keep(file_beside *, motus_error *);
/* Replaces the path in an error by the name that the user has given. */
void file_beside_complain(const file_beside *, const char *name, motus_error *);
/* Removes an archive that was not kept, and frees memory. Call it in any case. */
void file_beside_drop(file_beside *);

/* Takes the descriptors 0 to 2 that are closed, so that no file gets them. Reading or writing them still fails. */
void file_open_standard(void);
bool file_output_closed(void); /* returns whether standard output cannot be written */
/* Flushes standard output. The error also covers earlier failures to write. */
motus_status file_flush_output(motus_error *);

#endif
