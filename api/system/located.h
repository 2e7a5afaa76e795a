/* Located systems: those whose runs end a step wherever a switch of the force changes its side.
 *
 * A located system is read from the text of another, with modes for the sides of its switches. The motion, the columns
 * and their order are the same; x has the sides besides, behind the positions, and its rules change them.
 */
#ifndef API_SYSTEM_LOCATED_H
#define API_SYSTEM_LOCATED_H

#include "api/system/system.h"

/* The located system of a system, with its numbers, which the system keeps; NULL: it has no switches, or `why` says
 * why they are not located, which is "" else. asked: MOTUS_SWITCHES_LOCATE: wherever there can be one;
 * MOTUS_SWITCHES_USUAL: as runs by methods that adapt their steps do by themselves, where the force goes on smoothly
 * beyond every switch, and there are at most LOCATED_MOST of them, each of which costs time in every step; another
 * choice: none. No run may use it where its numbers have been set since. */
enum { LOCATED_MOST = 64 };
/* Whether the force, or what moves a boundary cell, is not smooth. */
bool located_kinks(const model *);
motus_status located_of(motus_system *, motus_switches asked, motus_system **, const char **why, motus_error *);
/* The same for runs of a method. Rows of fixed steps locate switches where that is asked for (MOTUS_SWITCHES_LOCATE),
 * but for those beyond which the force may be undefined, since a step of theirs cannot become shorter: NULL. */
motus_status located_for(motus_system *, const chosen *, motus_switches asked, motus_system **, const char **why,
                         motus_error *);
#endif
