/* The parameter or initial value that a name stands for, with all of its numbers. */
#ifndef API_SYSTEM_PARAMETERS_H
#define API_SYSTEM_PARAMETERS_H

#include "api/system/system.h"

typedef struct parameters_target {
    const model_definition *definition; /* of a parameter, else NULL */
    const model_state *state;           /* of an initial value, else NULL */
    bool velocity;                      /* it is the initial value of a velocity */
    size_t count;                       /* how many numbers it has, in the outside order */
    size_t first, span;                 /* the places in the pool of a model, boundary cells included */
} parameters_target;

/* Finds the target of a name. MOTUS_NAME, with a hint: nothing has this name. */
motus_status parameters_find(const motus_system *, const char *name, parameters_target *, motus_error *);
parameters_target parameters_of(const motus_system *, const model_definition *);
/* Returns the place in the pool of number k, in the outside order. */
size_t parameters_place(const parameters_target *, size_t k);
/* Splits "x'(0)" into "x'" and *start, the number in the bracket. False: the name has no such bracket. */
bool parameters_bracket(const char *name, char *bare, size_t size, double *start);

#endif
