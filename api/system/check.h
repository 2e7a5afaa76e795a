/* The checks that every public call makes first, the studies included: structs with a size, errors, and systems that
 * must not change. */
#ifndef API_SYSTEM_CHECK_H
#define API_SYSTEM_CHECK_H

#include "motus.h"

#include <stdbool.h>

/* set.c. Runs, ensembles and references hold the system, so that its numbers cannot be set, and release it. */
void motus_system_hold(motus_system *, bool on);
/* MOTUS_ARGUMENT, with a hint, where no version had its size, or a member that this library does not know is set. */
motus_status motus_struct_check(motus_def_kind, const void *made, motus_error *);
/* Copies what is given (NULL: nothing) over the defaults: `ours` has the layout of this library. MOTUS_ARGUMENT as
 * well where a count is above 0 and its array NULL, or a text of an array. */
motus_status motus_struct_read(motus_def_kind, const void *given, void *ours, motus_error *);
/* Copies ours into a checked struct of the caller's, up to its size. */
void motus_struct_write(motus_def_kind, const void *ours, void *to);
/* False: the error itself has no valid size. The call then returns MOTUS_ARGUMENT, and the error says why. */
bool motus_error_sound(motus_error *);

#endif
