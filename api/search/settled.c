/* From when on a followed motion is where it ends. See draft.h.
 *
 * Invariant: neighbouring samples are at least a fiftieth of their time apart, so a thousand of them span eight powers
 * of ten.
 */
#include "api/search/draft.h"

#include <math.h>
#include <string.h>

#define APART 1.02
#define BAND 0.01     /* of a number's range */
#define FOLLOWED 3    /* times as long as the motion took to settle */
#define ROUNDING 1e-9 /* of a number's size: a smaller range counts as none */

void settled_note(settled *r, double time, const double *x, size_t nx, const double *s)
{
    if (r->count == r->room || (r->count && time < fmax(r->first, APART * r->times[r->count - 1]))) return;
    double *const to = r->values + r->count * r->numbers;
    if (nx) memcpy(to, x, nx * sizeof *x);
    if (r->numbers > nx) memcpy(to + nx, s, (r->numbers - nx) * sizeof *s);
    r->times[r->count++] = time;
}

/* Returns the time since which number k is where it ends. */
static double since(const settled *r, size_t k, double end)
{
    double low = end, high = end;
    for (size_t i = 0; i < r->count; i++) {
        low = fmin(low, r->values[i * r->numbers + k]);
        high = fmax(high, r->values[i * r->numbers + k]);
    }
    const double band = BAND * (high - low);
    if (!(high - low > ROUNDING * fmax(fabs(low), fabs(high)))) return 0;
    for (size_t i = r->count; i-- > 0;) {
        const double off = fabs(r->values[i * r->numbers + k] - end);
        if (off <= band) continue;
        if (i + 1 == r->count) return INFINITY;
        const double next = fabs(r->values[(i + 1) * r->numbers + k] - end), step = r->times[i + 1] - r->times[i];
        return r->times[i] + step * (off - band) / (off - next);
    }
    return 0;
}

double settled_since(const settled *r, double time, const double *x, size_t nx, const double *s)
{
    double last = 0;
    for (size_t k = 0; k < r->numbers; k++) last = fmax(last, since(r, k, k < nx ? x[k] : s[k - nx]));
    return FOLLOWED * last <= time ? last : 0;
}
