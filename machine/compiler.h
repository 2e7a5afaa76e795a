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

/* The one that CC names (one program or path, without options); where CC is not set, the first that exists of cc, gcc,
 * clang. False: `why` gives the reason. */
bool compiler_find(compiler *, char *why, size_t size);
/* FAST: with the options of --fast; LOOPS: the text has long loops over arrays. */
enum { COMPILER_FAST = 1, COMPILER_LOOPS = 2 };
/* Compiles `source` to `object`. On failure `why` holds the first line of the compiler's messages. */
bool compiler_run(const compiler *, const char *source, const char *object, int how, char *why, size_t size);
/* Links `object` to the shared library `library`; alone: by the linker itself and without any library, which may fail,
 * and may leave functions that this process does not have; else by the compiler. */
bool compiler_link(const compiler *, const char *object, const char *library, bool alone, char *why, size_t size);
/* A text that names the options, for the cache key. */
const char *compiler_options(int how);

#endif
