/* A STEP, by family. What it evaluates at the time of n is the caller's to count on: the loop owns n, and time is t0 + n h, never summed. */
#ifndef ADVANCE_STEP
#define ADVANCE_STEP static inline       /* a compiled model of families has it compiled once, and called */
#endif
ADVANCE_STEP int advance_step(work *w)
{
    switch (ROW(w, family)) {
    case SPLITTING: return splitting_step(w);
    case RUNGE_KUTTA: return runge_kutta_step(w);
    case TWO_STEP:
        return ROW(w, two_step) == VERLET ? verlet_step(w) : ROW(w, two_step) == BEEMAN ? beeman_step(w) : literal_step(w);
    case IMPLICIT: return implicit_step(w);
    default: return STEP_OK;                   /* EXACT: nothing is carried from step to step */
    }
}
