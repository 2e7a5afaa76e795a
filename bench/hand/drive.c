/* The drive of the oscillators at every step and half step, by the cosine that motus evaluates, so that bits can be
 * compared. */
#include "bench/hand/hand.h"

#include <math.h>
#include <stdint.h>
#include "step/functions/core.h"
#include "step/functions/circular.h"
#include "step/functions/end.h"

void hand_cosines(double step, int64_t steps, double *whole, double *half)
{
    for (int64_t n = 0; n <= steps; n++) {
        double t = (double)n * step;
        whole[n] = motus_cos(t);
        half[n] = motus_cos(t + 0.5 * step);
    }
}
