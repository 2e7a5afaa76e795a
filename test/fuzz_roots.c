/* Any bytes as values of a function at Chebyshev points, or as coefficients, with any noise and slack: the roots of it.
 *
 * Invariant: whatever comes, the call returns; places lie in order in [0, 1], each with its tau in its interval, signs
 * before them follow from the kinds of those before.
 */
#include "core/roots.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define CHECK(condition)                                                    \
    do {                                                                    \
        if (!(condition)) {                                                 \
            fprintf(stderr, "%s:%d: %s\n", __FILE__, __LINE__, #condition); \
            abort();                                                        \
        }                                                                   \
    } while (0)

enum { ROOM = 40 };

static void check(const roots_root *root, const roots_found *found, roots_status status, int before)
{
    CHECK(found->count <= ROOM && found->reach >= 0 && found->reach <= 1);
    CHECK(found->leaves >= 0 && found->leaves <= 1);
    if (status == ROOTS_NOT_FINITE) CHECK(found->count == 0);
    int side = before ? before : found->after;
    for (size_t i = 0; i < found->count; i++) {
        const roots_root *r = &root[i];
        CHECK(r->tau >= 0 && r->tau <= 1 && r->from >= 0 && r->from <= r->tau && r->to >= r->tau && r->to <= 1);
        if (i > 0) CHECK(r->tau >= root[i - 1].tau);
        if (i + 1 < found->count) CHECK(!r->open);
        if (r->kind == ROOTS_NEAR) continue;
        CHECK(side == 0 || r->side == side);
        if (r->kind != ROOTS_TOUCH) side = r->kind;
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static double numbers[ROOTS_DEGREE_MOST + 3], c[ROOTS_DEGREE_MOST + 1];
    if (size < 2 + 3 * sizeof *numbers) return 0;
    const int before = data[0] % 3 - 1;
    const unsigned how = data[1];
    size_t count = (size - 2) / sizeof *numbers;
    if (count > ROOTS_DEGREE_MOST + 3) count = ROOTS_DEGREE_MOST + 3;
    memset(numbers, 0, sizeof numbers);
    if (how & 1) { /* bytes as small integers: exact roots, ends and multiple roots are likely */
        for (size_t i = 0; i < count; i++) numbers[i] = (int8_t)data[2 + i] / 16.0;
    } else
        memcpy(numbers, data + 2, count * sizeof *numbers);
    const double noise = how & 2 ? 0 : fabs(numbers[0]), slack = how & 4 ? 0 : numbers[1];
    int degree = ROOTS_DEGREE_LEAST << (how >> 3) % 6;
    roots_fitted fitted = {degree, noise, 0};
    if (how >> 7) {
        if (roots_fit(numbers + 2, 1, degree, noise, c, &fitted) == ROOTS_FIT_NOT_FINITE) return 0;
        CHECK(fitted.degree >= 0 && fitted.degree <= degree && !(fitted.noise < 0));
    } else {
        fitted.degree = (int)count - 3;
        memcpy(c, numbers + 2, (count - 2) * sizeof *c);
    }
    roots_root root[ROOM];
    roots_found found;
    const roots_status status =
        roots_find(c, fitted.degree, before, fitted.noise + fitted.unseen, slack, root, ROOM, &found);
    check(root, &found, status, before);
    if (status == ROOTS_COMPLETE && before && found.count == 0 && roots_none(c, fitted.degree, found.noise))
        CHECK(found.last != 0);
    return 0;
}
