/* Gragg's, Bulirsch's and Stoer's extrapolation of the midpoint rule, for exact motions; a text for several precisions:
 * the includer defines NUMBER, ABSOLUTE(x), POWER(x, y), MOST (positions and velocities) and COLUMNS.
 *
 * Invariant: it shares nothing with the methods that are judged by it.
 */
typedef void extrapolated(const NUMBER *x, const NUMBER *v, NUMBER t, NUMBER *a);

static void rates(extrapolated *f, int n, NUMBER t, const NUMBER *y, NUMBER *d)
{
    for (int k = 0; k < n; k++) d[k] = y[n + k];
    f(y, y + n, t, d + n);
}

/* `steps` steps over H. */
static void midpoint(extrapolated *f, int n, NUMBER t, const NUMBER *y, const NUMBER *d, NUMBER H, int steps,
                     NUMBER *out)
{
    NUMBER before[MOST], at[MOST], rate[MOST];
    const NUMBER h = H / steps;
    for (int k = 0; k < 2 * n; k++) before[k] = y[k], at[k] = y[k] + h * d[k];
    for (int s = 1; s <= steps; s++) {
        rates(f, n, t + s * h, at, rate);
        for (int k = 0; k < 2 * n; k++) {
            const NUMBER next = before[k] + 2 * h * rate[k];
            out[k] = (at[k] + before[k] + h * rate[k]) / 2;
            before[k] = at[k], at[k] = next;
        }
    }
}

/* One step by `columns` columns; the error of the last but one, relative to numbers above 1. */
static NUMBER extrapolate(extrapolated *f, int n, NUMBER t, NUMBER *y, NUMBER H, int columns)
{
    NUMBER table[COLUMNS][MOST], d[MOST], error = 0;
    rates(f, n, t, y, d);
    for (int j = 0; j < columns; j++) {
        NUMBER left[MOST], next[MOST];
        midpoint(f, n, t, y, d, H, 2 * (j + 1), next);
        for (int i = 0; i <= j; i++)
            for (int k = 0; k < 2 * n; k++) {
                const NUMBER ratio = (NUMBER)(j + 1) / (j + 1 - i);
                if (i) next[k] += (next[k] - left[k]) / (ratio * ratio - 1);
                if (i < j) left[k] = table[i][k];
                if (i == columns - 1) {
                    const NUMBER off = ABSOLUTE(next[k] - table[i - 1][k]) / (ABSOLUTE(next[k]) + 1);
                    error = off > error ? off : error;
                }
                table[i][k] = next[k];
            }
    }
    for (int k = 0; k < 2 * n; k++) y[k] = table[columns - 1][k];
    return error;
}

/* From t = 0 to `end`, H the first step. */
static void solve(extrapolated *f, int n, NUMBER end, NUMBER H, NUMBER *y, int columns, NUMBER tolerance)
{
    NUMBER t = 0, lost = 0;
    while (t < end) {
        NUMBER next[MOST];
        const int last = t + H >= end;
        if (last) H = end - t;
        for (int k = 0; k < 2 * n; k++) next[k] = y[k];
        const NUMBER error = extrapolate(f, n, t, next, H, columns) / tolerance;
        if (error <= 1) {
            const NUMBER way = H + lost, sum = t + way;
            lost = way - (sum - t), t = last ? end : sum;
            for (int k = 0; k < 2 * n; k++) y[k] = next[k];
        }
        const NUMBER least = (NUMBER)1e-9, power = POWER(error > least ? error : least, -(NUMBER)1 / (2 * columns - 1));
        H *= (NUMBER)0.9 * (power > 4 ? 4 : power > (NUMBER)0.1 ? power : (NUMBER)0.1);
    }
}
