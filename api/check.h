/* What every public call does first, and the studies, which are public calls too: structs with a size, errors, and a
 * system that must not change. */
#ifndef API_CHECK_H
#define API_CHECK_H

#include "motus.h"

#include <stdbool.h>

/* set.c. Who needs the system's numbers to stay as they are holds it, and lets it go: runs, ensembles, references. */
void motus_system_hold(motus_system *, bool on);
/* MOTUS_ARGUMENT with the remedy, where its size is of no version or it asks for what this library does not have. */
motus_status motus_struct_check(motus_def_kind, const void *made, motus_error *);
/* Defaults, and over them what is given (NULL: nothing): `ours` is a struct as this library knows it. */
motus_status motus_struct_read(motus_def_kind, const void *given, void *ours, motus_error *);
/* Ours into one of the caller's that was checked, as far as its size goes. */
void motus_struct_write(motus_def_kind, const void *ours, void *to);
/* What every call asks first. False: it returns MOTUS_ARGUMENT, and the error says why. */
bool motus_error_sound(motus_error *);

#endif
