/* Located systems: their runs end a step wherever a switch of the force changes its side.
 *
 * A located system is read from the text of another, with modes for the sides of its switches. It has the motion, the
 * columns and their order of that system; x has the sides behind the positions, and its rules change them.
 */
#ifndef API_SYSTEM_LOCATED_H
#define API_SYSTEM_LOCATED_H

#include "api/system/system.h"

/* The switches of a system with more of them are not located unless asked for, since each costs time in every step. */
enum { LOCATED_MOST = 64 };
/* Returns whether the force, or what moves a boundary cell, is not smooth. */
bool located_kinks(const model *);
/* Finds the located system of a system, with its numbers, or makes it; the system owns it. NULL: it has no switches, or
 * `why`, else "", says why they are not located. asked: MOTUS_SWITCHES_LOCATE wherever that is possible;
 * MOTUS_SWITCHES_USUAL where the force is defined beyond every switch and there are at most LOCATED_MOST of them;
 * another choice: NULL. Use it only until the system's numbers are set again. */
motus_status located_of(motus_system *, motus_switches asked, motus_system **, const char **why, motus_error *);
/* Finds the located system for runs of a method, as located_of does. A row of fixed steps gets one only for
 * MOTUS_SWITCHES_LOCATE, and only where the force is defined beyond every switch, since its steps cannot become
 * shorter. */
motus_status located_for(motus_system *, const chosen *, motus_switches asked, motus_system **, const char **why,
                         motus_error *);
#endif
