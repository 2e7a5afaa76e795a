/* The words of solve.h for lanes of a method that solves no linear system. */
#define SOLVE_CONSTANT 0
#define solve_begin(host, job, group, factored) ((void)0)
#define SOLVE_NEAR(host, z, lost)
#define SOLVE_FAR(job, group, lost)
#define solve_coefficients(host) ((clock *)0)
const size_t motus_lanes_solving = 0;
#define solve_stop(w, where) (*(w)->host->lost = PICK(where, MANY((double)NAN), *(w)->host->lost))
static inline void solve_spoil(work *w, real *y)
{
    const real lost = *w->host->lost;
    if (SOME(lost != 0))
        EACHV(k) y[k] = PICK(lost == 0, y[k], lost);
}
