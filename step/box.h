/* THE BOX of a step: around the mean of the numbers at both ends of the step, with half widths that no number exceeds
 * within it. With |x''| <= a, a position departs from the line between its ends by h^2/8 a at most, and a velocity from
 * the mean of its ends by h/2 a.
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
