/* Runs the laws over every row of the catalogue: theorems, with bounds that are computed. Prints one line each
 * and "N passed, N failed".
 *
 *     laws              all of them
 *     laws --quiet      failures only
 */
#include "test/laws_proof.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static int passed, failed;
static bool quiet;

void judge(bool ok, const char *subject, const char *law, const char *format, ...)
{
    if (ok)
        passed++;
    else
        failed++;
    if (ok && quiet) return;
    printf("%-4s %-24s %-30s ", ok ? "ok" : "FAIL", subject, law);
    va_list arguments;
    va_start(arguments, format);
    vprintf(format, arguments);
    va_end(arguments);
    putchar('\n');
}

quad quad_abs(quad x) { return x < 0 ? -x : x; }

double quad_log2(quad x)
{
    int shift = 0;
    for (; x < Q(1e-100); shift++) x *= Q(0x1p+64); /* has more digits than a double */
    return log2((double)x) - 64.0 * shift;
}

int main(int count, char **arguments)
{
    quiet = count > 1 && !strcmp(arguments[1], "--quiet");
    laws_of_proof();
    laws_of_steps();
    laws_of_order();
    laws_of_series();
    laws_of_structure();
    laws_of_stability();
    laws_of_verlet();
    laws_of_dense();
    laws_of_density();
    laws_of_events();
    printf("%d passed, %d failed\n", passed, failed);
    return failed != 0;
}
