/* Switches that may be held at their jump: sliding.c. */
#ifndef LANG_MODEL_SLIDING_H
#define LANG_MODEL_SLIDING_H

#include "lang/model/switches.h"

/* Of a model that has modes for the sides of its switches: its equations read them from now on, and those that the
 * force can hold may be held. It leaves `located` NULL where they are not those switches. */
void sliding_locate(model *);

#endif
