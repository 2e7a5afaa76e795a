/* Finds and runs the system's C compiler, without a shell. */
#ifndef MACHINE_COMPILER_H
#define MACHINE_COMPILER_H

#include "core/system.h"

enum { COMPILER_PATH_MAX = 4096, COMPILER_SECONDS_MAX = 60 };
#define COMPILER_MEMORY_MAX ((size_t)4 << 30)

typedef struct compiler {
    char path[COMPILER_PATH_MAX];          /* absolute, links resolved */
    char identity[COMPILER_PATH_MAX + 96]; /* path, size and time of the file, for the cache key */
} compiler;

/* Finds the compiler that CC names (one program or path, without options); where CC is not set, the first that exists
 * of cc, gcc, clang. False: `why` gives the reason. */
bool compiler_find(compiler *, char *why, size_t size);
/* FAST: with the options of --fast. LOOPS: the text has long loops over arrays. */
enum { COMPILER_FAST = 1, COMPILER_LOOPS = 2 };
/* A compiler, or linker, at work. */
typedef struct compiler_work {
    int child;    /* its process; 0: it has ended */
    int owner;    /* the process that started it */
    int log;      /* a file with what it writes */
    int tie;      /* a pipe: the compiler ends when it is closed; -1: the system has no such means */
    double began; /* in seconds, monotonic */
} compiler_work;
/* Starts compiling `source` to `object`. False: it could not be started; `why` gives the reason. */
bool compiler_compile(const compiler *, const char *source, const char *object, int how, compiler_work *, char *why,
                      size_t size);
/* Starts linking `object` to the shared library `library`, by the compiler; alone: by the linker itself and without any
 * library, which may fail, or leave functions undefined that this process does not have. */
bool compiler_link(const compiler *, const char *object, const char *library, bool alone, compiler_work *, char *why,
                   size_t size);
typedef enum { COMPILER_AT_WORK, COMPILER_DONE, COMPILER_FAILED, COMPILER_LOST } compiler_state;
/* Tells, without waiting, whether the compiler has written `out`. FAILED: `why` holds the first line of its messages.
 * LOST: it was killed, or it belongs to the process of which this one is a copy. It has ended unless AT_WORK. */
compiler_state compiler_look(compiler_work *, const char *out, char *why, size_t size);
/* Kills the compiler, with all processes that it has started, if it is at work for this process. */
void compiler_stop(compiler_work *);
bool compiler_owned(const compiler_work *); /* whether this process started it */
/* Returns a text that names the options, for the cache key. */
const char *compiler_options(int how);

#endif
