/* The checks that every public call makes first, the studies included: structs with a size, errors, and systems that
 * must not change. */
#ifndef API_SYSTEM_CHECK_H
#define API_SYSTEM_CHECK_H

#include "motus.h"

#include <stdbool.h>

/* Counts a user of the system in or out (system.c): runs, ensembles and references, while which numbers cannot be set.
 * A system that was destroyed before ends with its last user, which calls this last. */
void motus_system_hold(motus_system *, bool on);
/* Checks the size. MOTUS_ARGUMENT, with a hint: no version had it, or it sets a member that is unknown here. */
motus_status motus_struct_check(motus_def_kind, const void *made, motus_error *);
/* Copies what is given (NULL: nothing) over the defaults, into the layout of this library. MOTUS_ARGUMENT also where a
 * count is above 0 and its array is NULL, or a text in an array. */
motus_status motus_struct_read(motus_def_kind, const void *given, void *ours, motus_error *);
/* Copies `ours` into a checked struct of the caller's, up to the caller's size. */
void motus_struct_write(motus_def_kind, const void *ours, void *to);
/* Returns false where the error itself has no valid size. The call then returns MOTUS_ARGUMENT; the error says why. */
bool motus_error_sound(motus_error *);

#endif
