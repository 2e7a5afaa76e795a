/* The parameter or initial value that a name stands for, with all of its numbers. */
#ifndef API_SYSTEM_PARAMETERS_H
#define API_SYSTEM_PARAMETERS_H

#include "api/system/system.h"

typedef struct parameters_target {
    const model_definition *definition; /* of a parameter, or */
    const model_state *state;           /*   the state of an initial value, */
    bool velocity;                      /*   and whether it is that of its velocity */
    size_t count;                       /* numbers in the outside order */
    size_t first, span;                 /* of a model: its places in the pool, boundary cells included */
} parameters_target;

/* MOTUS_NAME, with a hint: there is none of this name. */
motus_status parameters_find(const motus_system *, const char *name, parameters_target *, motus_error *);
parameters_target parameters_of(const motus_system *, const model_definition *);
/* The place in the pool of number k, in the outside order. */
size_t parameters_place(const parameters_target *, size_t k);
/* "x'(0)" → "x'" and *start, the number in the bracket; false: the name has no such bracket. */
bool parameters_bracket(const char *name, char *bare, size_t size, double *start);

#endif
