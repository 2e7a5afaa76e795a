/* The cache of compiled objects, kept between runs of the program. */
#ifndef MACHINE_CACHE_H
#define MACHINE_CACHE_H

#include "machine/compiler.h"

/* Loads the shared object of a C text: from the cache where it has a sound one, else compiled. Returns a handle for
 * dlsym and dlclose; NULL: `why` gives the reason. `how`: COMPILER_FAST, COMPILER_LOOPS; KEPT: from the cache alone. */
enum { CACHE_KEPT = 4 };
void *cache_load(const char *text, size_t length, int how, char *why, size_t size);
/* Removes every entry. Returns how many, or -1. */
int cache_clear(void);

#endif
