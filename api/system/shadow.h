/* A copy of a system whose decimals are rounded to the other side, for bars of error. */
#ifndef API_SYSTEM_SHADOW_H
#define API_SYSTEM_SHADOW_H

#include "api/system/system.h"

/* A decimal of a text, 0.1, is read as the double next to it. In the shadow it is the next double on the decimal's
 * other side, and pi likewise, so that what was written lies between the two systems. A constant that was computed, 1/3
 * or 1000.7^2 - 1000.6^2, is the double on the other side of what its decimals say. Numbers that motus_system_set gave
 * are doubles, and stay. Where the shadow would be another system, since such a number decides a size, and of a
 * callback, it is a clone. affected: a byte for each place of the pool; the numbers where it is not 0 are left alone,
 * since a caller changes them; NULL: none. */
motus_status shadow_create(const motus_system *, const uint8_t *affected, motus_system **, motus_error *);

/* Gives a system of the same text the numbers that were set in another; what depends on them is computed from its own.
 */
motus_status shadow_numbers(const motus_system *from, motus_system *to, motus_error *);

#endif
