/* The cache of compiled objects, kept between runs of the program. */
#ifndef MACHINE_CACHE_H
#define MACHINE_CACHE_H

#include "machine/compiler.h"

enum { CACHE_KEPT = 4 }; /* takes the object from the cache alone, and never compiles */
/* Loads the shared object of a C text, from the cache if it has a sound one, else by compiling the text. Returns a
 * handle for dlsym and dlclose; NULL: `why` gives the reason. how: COMPILER_FAST, COMPILER_LOOPS, CACHE_KEPT. */
void *cache_load(const char *text, size_t length, int how, char *why, size_t size);
typedef struct cache_job cache_job;
typedef enum { CACHE_READY, CACHE_WAIT, CACHE_FAILED } cache_state;
/* Begins what cache_load does, without waiting. WAIT: a compiler is at work; call cache_look until the answer is
 * another, or cache_stop. FAILED: `why` gives the reason. The text must stay where it is. */
cache_state cache_begin(const char *text, size_t length, int how, const motus_allocator *, cache_job **job,
                        void **handle, char *why, size_t size);
/* Looks how far a job is. After an answer other than WAIT the job is gone. */
cache_state cache_look(cache_job **job, void **handle, char *why, size_t size);
/* Ends a job: kills its compiler and removes its files. */
void cache_stop(cache_job *);
/* Removes every entry. Returns how many, or -1. */
int cache_clear(void);

#endif
