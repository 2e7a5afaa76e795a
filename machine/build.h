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
    bool again;       /* the compiler was lost once, and the build began again */
    const char *text; /* the caller's, for as long as the build lives */
    size_t length;
    int how;                       /* `how` of compiler_compile */
    char parent[BUILD_PARENT_MAX]; /* the parent of `folder`; "": the folder for temporary files */
    char folder[BUILD_FOLDER_MAX];
} build;

/* Starts the compiler; compiler, text, length, how and parent are given. False: `why` gives the reason, and no file is
 * left. */
bool build_begin(build *, char *why, size_t size);
typedef enum { BUILD_WAIT, BUILD_DONE, BUILD_FAILED } build_state;
/* Looks how far the build is. DONE: the library is at build_library. FAILED: `why` gives the reason. After both call
 * build_end. */
build_state build_look(build *, char *why, size_t size);
const char *build_library(const build *, char out[BUILD_FILE_MAX]);
/* Links in the other way a library that could not be loaded. False: there is no other way, or it failed. */
bool build_relink(build *, char *why, size_t size);
/* Kills the compiler or linker that is at work, and removes the folder. */
void build_end(build *);

/* Tells whether the process has the rights of another user, whose files it must not leave. */
bool build_privileged(void);

#endif
