/* Switches that may be held at their jump: sliding.c. */
#ifndef LANG_MODEL_SLIDING_H
#define LANG_MODEL_SLIDING_H

#include "lang/model/switches.h"

/* Of a model that has modes for the sides of its switches. Those that the force can hold may be held from now on: the
 * equations of the switches know that side, too. False: no memory. */
bool sliding_prepare(model *, switches *);

#endif
