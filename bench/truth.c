/* The exact motions of bench/problems.def at their ends, for bench/truths.h: make bench does not build this.
 *
 *     gcc -O2 -I. bench/truth.c -lm -o truth && ./truth > bench/truths.h
 *
 * Extrapolation in 113 bits, from the same doubles that every library is given. It is
 * done twice, by 16 and by 14 columns with another tolerance; what they differ by stands beside each problem.
 */
#define _GNU_SOURCE
#define __STDC_WANT_IEC_60559_TYPES_EXT__ 1
#include <math.h>
#include <stdio.h>
#include <string.h>

#define NUMBER _Float128
#define ROOT sqrtf128
#define FORCE(name) force_##name
#include "bench/forces.h"

#define ABSOLUTE fabsf128
#define POWER powf128
enum { MOST = 36, COLUMNS = 16 };
#include "bench/extrapolation.h"

static void print(const NUMBER *y, int count)
{
    char text[64];
    for (int k = 0; k < count; k++) {
        strfromf128(text, sizeof text, "%.25g", y[k]);
        printf("%s%s%s", k % 4 ? ", " : "    ", strpbrk(text, ".e") ? text : strcat(text, "."),
               k % 4 == 3 ? ",\n" : "");
    }
    printf(count % 4 ? "};\n" : "};\n");
}

int main(int words, char **word)
{
#define PROBLEM(name, positions, end, ...)                                                    \
    if (words < 2 || !strcmp(word[1], #name)) {                                               \
        static const double start[] = {__VA_ARGS__};                                          \
        NUMBER y[MOST], z[MOST], off = 0;                                                     \
        for (int k = 0; k < 2 * (positions); k++) y[k] = z[k] = start[k];                     \
        solve(force_##name, positions, (double)(end), (end)*1e-5Q, y, 16, 1e-29Q);            \
        solve(force_##name, positions, (double)(end), (end)*1e-5Q, z, 14, 1e-27Q);            \
        for (int k = 0; k < 2 * (positions); k++) off = fmaxf128(off, fabsf128(y[k] - z[k])); \
        printf("/* to %.0e */\nstatic const double truth_" #name "[] = {\n", (double)off);    \
        print(y, 2 * (positions));                                                            \
        fflush(stdout);                                                                       \
    }
#include "bench/problems.def"
    return 0;
}
