/* A shared library in the making: the folder of a compilation, its compiler and its linker. Nothing here waits. */
#ifndef MACHINE_BUILD_H
#define MACHINE_BUILD_H

#include "machine/compiler.h"

#include <limits.h>

enum { BUILD_PARENT_MAX = PATH_MAX + 64, BUILD_FOLDER_MAX = PATH_MAX + 80, BUILD_FILE_MAX = PATH_MAX + 96 };

typedef struct build {
    compiler compiler;
    compiler_work work;
    enum { BUILD_COMPILES, BUILD_LINKS_ALONE, BUILD_LINKS } stage;
    bool again;       /* its compiler was lost, and began again */
    const char *text; /* stays where it is */
    size_t length;
    int how;                       /* as of compiler_compile */
    char parent[BUILD_PARENT_MAX]; /* of the folder; "": that for temporary files */
    char folder[BUILD_FOLDER_MAX];
} build;

/* Starts it, with compiler, text, how and parent given. False: `why` gives the reason, and nothing is left. */
bool build_begin(build *, char *why, size_t size);
/* DONE: the library is at build_library. FAILED: `why` gives the reason. Both: build_end is to follow. */
typedef enum { BUILD_WAIT, BUILD_DONE, BUILD_FAILED } build_state;
build_state build_look(build *, char *why, size_t size);
const char *build_library(const build *, char out[BUILD_FILE_MAX]);
/* The library could not be loaded: links it in the other way, if there is one. */
bool build_relink(build *, char *why, size_t size);
/* Kills what is at work, and removes the folder. */
void build_end(build *);

/* Whether the process has the rights of another user, whose files it must not leave. */
bool build_privileged(void);

#endif
