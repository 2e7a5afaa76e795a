/* A copy of a system whose decimals are rounded to the other side, for bars of error. */
#ifndef API_SYSTEM_SHADOW_H
#define API_SYSTEM_SHADOW_H

#include "api/system/system.h"

/* Makes the shadow of a system. A decimal of a text, 0.1, is read as the double next to it; the shadow has the next
 * double on the decimal's other side, and likewise for pi, so that what was written lies between the two systems. A
 * constant that was computed, 1/3 or 1000.7^2 - 1000.6^2, becomes the double on the other side of what its decimals
 * say. Numbers that motus_system_set gave are doubles and stay. The shadow is a clone of a callback, and where a moved
 * number would decide a size. affected: a byte for each place of the pool, not 0 where a caller changes the number,
 * which then stays; NULL: all 0. */
motus_status shadow_create(const motus_system *, const uint8_t *affected, motus_system **, motus_error *);

/* Sets in `to` every number that was set in `from`, a system of the same text; `to` computes what depends on them. */
motus_status shadow_numbers(const motus_system *from, motus_system *to, motus_error *);

#endif
