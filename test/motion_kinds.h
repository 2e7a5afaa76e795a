/* Random motions by kind: what is hard for an integrator, and what people write. */
#ifndef TEST_MOTION_KINDS_H
#define TEST_MOTION_KINDS_H

#include "test/motion.h"

/* Each kind: its enumerator, its name, the function that makes one. */
#define MOTION_KINDS(X)                     \
    X(SMOOTH, "smooth", smooth)             \
    X(COUPLED, "coupled", coupled)          \
    X(VECTOR, "vector", vector)             \
    X(FAMILY, "family", family)             \
    X(FRICTION, "friction", belt)           \
    X(KINKED, "kinked", kinked)             \
    X(SEVERAL, "several", several)          \
    X(NEAR, "near-singular", close_by)      \
    X(STIFF, "stiff", stiff)                \
    X(CHAOS, "chaos", chaos)                \
    X(LONG, "long", lasting)                \
    X(BACKWARD, "backward", backward)       \
    X(OFFSET, "offset", offset)             \
    X(SCALE, "scale", scale)                \
    X(CANCEL, "cancel", cancel)             \
    X(VANISH, "vanish", vanish)             \
    X(BUMP, "bump", bump)                   \
    X(PULSE, "pulse", pulse)                \
    X(WALL, "wall", wall)                   \
    X(FLIGHT, "flight", flight)             \
    X(REST, "rest", at_rest)                \
    X(TWICE, "twice", twice)                \
    X(BLOCKS, "blocks", blocks)             \
    X(PLANE, "plane", plane)                \
    X(BOUNCE, "bounce", bounce)             \
    X(PENALTY, "penalty", penalty)          \
    X(GATHER, "gather", gather)             \
    X(THERMOSTAT, "thermostat", thermostat) \
    X(BALLS, "balls", balls)                \
    X(FIRE, "fire", fire)                   \
    X(ROOT, "root", root)

#define MOTION_KINDS_ENUMERATOR(name, word, make) MOTION_##name##_KIND,
enum { MOTION_KINDS(MOTION_KINDS_ENUMERATOR) MOTION_KIND_COUNT };
#undef MOTION_KINDS_ENUMERATOR

const char *motion_kinds_name(int kind);
/* Motion k of a kind. */
void motion_kinds_make(motion *, int kind, uint64_t k);

/* The four kinds whose reference solutions are judged; the kind of motion k follows from k. */
enum { MOTION_CLAIM_SMOOTH, MOTION_CLAIM_KINKED, MOTION_CLAIM_KICKED, MOTION_CLAIM_SINGULAR, MOTION_CLAIMS };
void motion_kinds_claim(motion *, int k);

/* Random numbers, of one sequence that each motion begins: in [0, 1); in 0 … n - 1; of three decimals. */
double motion_kinds_uniform(void);
int motion_kinds_below(int n);
double motion_kinds_between(double a, double b);

#endif
