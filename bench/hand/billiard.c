/* A ball on a round table by velocity Verlet: the event loop that one writes by hand. After every step the sign of
 * |r|^2 - 1 tells whether the rim was passed; Newton's method then finds the length of the step that ends on it, with a
 * true step of that length in every turn; the rest of the step follows, so the grid stays.
 *
 * It sees no event that comes and goes within a step, and no second one: the step is short enough for this table.
 */
#include "bench/hand/hand.h"

#include <math.h>

typedef struct ball {
    double x[2], v[2];
} ball;

static inline void force(const double *x, double *a)
{
    (void)x;
    a[0] = 0, a[1] = 0;
}

static inline ball step(ball b, double h)
{
    double a[2];
    force(b.x, a);
    for (int k = 0; k < 2; k++) b.v[k] += h / 2 * a[k], b.x[k] += h * b.v[k];
    force(b.x, a);
    for (int k = 0; k < 2; k++) b.v[k] += h / 2 * a[k];
    return b;
}

static inline double outside(const ball *b) { return b->x[0] * b->x[0] + b->x[1] * b->x[1] - 1; }

/* The length of the step from b, at most h, that ends on the rim; to *end what it leads to. */
static double reach(ball b, double h, ball *end)
{
    double length = h, value, least = INFINITY;
    *end = step(b, h);
    while (fabs(value = outside(end)) < least && value != 0) {
        least = fabs(value);
        length -= value / (2 * (end->x[0] * end->v[0] + end->x[1] * end->v[1]));
        *end = step(b, length);
    }
    return length;
}

static void reflect(ball *b)
{
    const double rr = b->x[0] * b->x[0] + b->x[1] * b->x[1], out = (b->v[0] * b->x[0] + b->v[1] * b->x[1]) / rr,
                 along = (b->v[1] * b->x[0] - b->v[0] * b->x[1]) / rr;
    b->v[0] = -along * b->x[1] - out * b->x[0];
    b->v[1] = along * b->x[0] - out * b->x[1];
}

int64_t hand_billiard(double h, double until, int64_t most, double (*hits)[3])
{
    ball b = {{0.5, 0}, {0.6, 0.8}};
    int64_t found = 0;
    for (int64_t n = 0; (double)n * h < until; n++) {
        double gone = 0;
        ball next = step(b, h);
        while (outside(&next) > 0 && found < most) {
            gone += reach(b, h - gone, &next);
            hits[found][0] = (double)n * h + gone, hits[found][1] = next.x[0], hits[found++][2] = next.x[1];
            reflect(&next);
            b = next;
            next = step(b, h - gone);
        }
        b = next;
    }
    return found;
}
