/* Switches where the force may hold the motion at the jump: dry friction that sticks, relays. */
#ifndef LANG_MODEL_SLIDING_H
#define LANG_MODEL_SLIDING_H

#include "lang/model/switches.h"

/* Makes the equations read the sides of switches from the modes of the model, and lets the force hold the switches that
 * it can. It leaves `located` NULL if the modes do not fit the switches. */
void sliding_locate(model *);

#endif
