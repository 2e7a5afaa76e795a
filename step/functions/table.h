/* Tables: the numbers of a list, found by a value or by their number.
 *
 * A table is passed as a number whose bits are an address, so that it goes through registers, lanes and programs as
 * every operand does; nothing computes with it. Its first number is how many follow. Each row of a table in which
 * values are found has TABLE_COLUMNS numbers; the second is a point, and the points rise from row 1 on. Row 0 and the
 * last one stand for what is before the first point and beyond the last.
 */
#ifndef TABLE_COLUMNS
#define TABLE_COLUMNS 4
#define TABLE_POINT 1
union motus_table {
    double is;
    uint64_t address;
    const double *at;
};
/* No other number is as near to 0, and 0 is no table. */
#define TABLE_IS(t) ((t).address && !((t).address >> 52))

static inline double motus_table_of(const double *numbers)
{
    union motus_table table = {0.0};
    table.at = numbers;
    return table.is;
}
#endif

/* Returns the row of the last point that is at most x: 0 before the first of n points, n beyond the last; at the last
 * one itself n - 1, since a table is closed there. Most tables are nearly uniform, so a proportion guesses first. */
INLINE double NAME(row_of)(double x, double table)
{
    const union motus_table of = {table};
    if (!TABLE_IS(of)) return (double)NAN;
    const double *const t = of.at, *const point = t + 1 + TABLE_POINT;
    const int n = (int)*t / TABLE_COLUMNS - 1;
    const double first = point[TABLE_COLUMNS], last = point[n * TABLE_COLUMNS];
    if (!(x >= first)) return x < first ? 0 : x;
    if (!(x < last)) return x > last ? n : n - 1;
    const double guess = (x - first) / (last - first) * (n - 1);
    int low = 1, high = n, at = 1 + (guess < n - 2 ? (int)guess : n - 2);
    while (high - low > 1) {
        if (x < point[at * TABLE_COLUMNS])
            high = at;
        else if (x >= point[(at + 1) * TABLE_COLUMNS])
            low = at + 1;
        else
            return at;
        at = low + (high - low) / 2;
    }
    return low;
}

INLINE double NAME(entry_of)(double k, double table)
{
    const union motus_table of = {table};
    if (!TABLE_IS(of)) return (double)NAN;
    const double *const t = of.at;
    const int at = k >= 0 && k < *t ? (int)k : 0;
    return at == k && k < *t ? t[1 + at] : (double)NAN;
}

INLINE reals NAME(find)(reals x, reals table)
{
    reals r = x;
    for (int i = 0; i < LANES; i++) LANE(r, i) = NAME(row_of)(LANE(x, i), LANE(table, i));
    return r;
}

/* Returns number k of the table, from 0 on; NaN if k is none. */
INLINE reals NAME(entry)(reals k, reals table)
{
    reals r = k;
    for (int i = 0; i < LANES; i++) LANE(r, i) = NAME(entry_of)(LANE(k, i), LANE(table, i));
    return r;
}
