/* The cache of compiled objects, kept between runs of the program. */
#ifndef MACHINE_CACHE_H
#define MACHINE_CACHE_H

#include "machine/compiler.h"

/* Loads the shared object of a C text: from the cache where it has a sound one, else compiled. Returns a handle for
 * dlsym and dlclose; NULL: `why` gives the reason. `how`: COMPILER_FAST, COMPILER_LOOPS; KEPT: from the cache alone. */
enum { CACHE_KEPT = 4 };
void *cache_load(const char *text, size_t length, int how, char *why, size_t size);
/* The same without waiting. WAIT: a compiler is at work; *job is to be asked again until the answer is another, when
 * it is gone, or to be stopped, which kills the compiler and removes its files. FAILED: `why` gives the reason.
 * `text` must stay where it is. */
typedef struct cache_job cache_job;
typedef enum { CACHE_READY, CACHE_WAIT, CACHE_FAILED } cache_state;
cache_state cache_begin(const char *text, size_t length, int how, const motus_allocator *, cache_job **job,
                        void **handle, char *why, size_t size);
cache_state cache_look(cache_job **job, void **handle, char *why, size_t size);
void cache_stop(cache_job *);
/* Removes every entry. Returns how many, or -1. */
int cache_clear(void);

#endif
