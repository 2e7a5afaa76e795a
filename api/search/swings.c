/* The swings of one number, from its changes of sign. A change lies on the straight line between the two values
 * about it, and what is negligible beside the largest value so far has no sign.
 */
#include "api/search/draft.h"

#include <math.h>

#define NEGLIGIBLE 1e-3 /* part of the largest value so far, below which a value has no sign */
#define SWINGS 3        /* how many are waited for */
#define CHATTER 5       /* steps between changes of sign: with fewer there is no swing */
#define IRREGULAR 1.2   /* least ratio of the longest swing to the shortest */

void swings_note(swings *s, double time, uint32_t taken, double value)
{
    const double size = fabs(value);
    if (size > s->largest) s->largest = size;
    if (!(size > NEGLIGIBLE * s->largest)) return;
    if (value * s->value < 0) {
        const double crossed = s->time + (time - s->time) * (s->value / (s->value - value));
        if (s->changes == 0) s->first = crossed, s->since = taken;
        s->steps = taken - s->since;
        if (s->changes > 1) { /* the start need not be a turning point */
            const double one = crossed - s->before;
            s->shortest = s->changes == 2 ? one : fmin(s->shortest, one);
            s->longest = fmax(s->longest, one);
        }
        s->changes++;
        s->before = s->last;
        s->last = crossed;
    }
    s->time = time;
    s->value = value;
}

double swings_length(const swings *s)
{
    return s->changes < 3 || s->steps < CHATTER * (s->changes - 1) ? 0 : 2 * (s->last - s->first) / (s->changes - 1);
}

bool swings_often(const swings *s) { return s->changes > 2 * SWINGS || s->largest == 0; }

bool swings_uneven(const swings *s) { return s->changes > 4 && s->longest > IRREGULAR * s->shortest; }
