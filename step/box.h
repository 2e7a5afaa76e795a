/* THE BOX of a step: no number is within the step farther than its half width from the middle of its ends. A position
 * leaves the line between them by h^2/8 times the largest acceleration at most, a velocity by h/2 times that.
 */
typedef struct box {
    real *x, *v, *dx, *dv; /* the middle, and the half widths */
} box;

/* The includer tells how many numbers there are, so that in a small system it is known. */
static inline void box_of(const box *to, size_t nx, size_t nv, clock span, const real *from_x, const real *from_v,
                          const real *to_x, const real *to_v, const real *most)
{
    const clock h = ABS(span);
    for (size_t k = 0; k < nv; k++) {
        to->v[k] = from_v[k] + (to_v[k] - from_v[k]) / 2;
        to->dv[k] = h / 2 * most[k];
    }
    for (size_t k = 0; k < nx; k++) {
        to->x[k] = from_x[k] + (to_x[k] - from_x[k]) / 2;
        to->dx[k] = ABS(to_x[k] - from_x[k]) / 2 + h * h / 8 * most[k];
    }
}
