/* Compiled objects kept between runs, as far as they can be trusted. */
#ifndef MACHINE_CACHE_H
#define MACHINE_CACHE_H

#include "machine/compiler.h"

/* A shared object for the C text, loaded: from the cache if a sound one is there, else compiled. NULL: `why` says
 * why. The handle is for dlsym and dlclose. FAST: compiled with what --fast allows; KEPT: never compiled. */
enum { CACHE_FAST = 1, CACHE_KEPT = 2 };
void *cache_load(const char *text, size_t length, int how, char *why, size_t size);
/* Removes every entry. How many, or -1. */
int cache_clear(void);

#endif
