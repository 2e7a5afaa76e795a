/* The system's C compiler as a tool: found, described and run without a shell. */
#ifndef MACHINE_COMPILER_H
#define MACHINE_COMPILER_H

#include "core/system.h"

enum { COMPILER_PATH_MAX = 4096, COMPILER_SECONDS_MAX = 60 };
#define COMPILER_MEMORY_MAX ((size_t)4 << 30)

typedef struct compiler {
    char path[COMPILER_PATH_MAX];          /* absolute, links resolved */
    char identity[COMPILER_PATH_MAX + 96]; /* path, size and time of the file: what a cache key needs of it */
} compiler;

/* CC (a single program name or path), cc, gcc, clang: the first that is there. */
bool compiler_find(compiler *);
/* `source` to the shared object `object`; fast: with what --fast allows. On failure the first line of what the
 * compiler said is in `why`. */
bool compiler_run(const compiler *, const char *source, const char *object, bool fast, char *why, size_t size);
/* The options, as one text: part of a cache key. */
const char *compiler_options(bool fast);

#endif
