/* Counter-based random numbers.
 *
 * Invariant: the key is the seed; the counter is the trajectory (64 bits), the stream, and the number of blocks that
 * were used before. So a value does not depend on batches, threads or --resume. Only integer arithmetic, comparisons
 * and exact operations are used, so a value has the same bits on every machine.
 */
#include "cli/model/draw.h"

#include <stdbool.h>

void draw_philox(const uint32_t counter[4], const uint32_t key[2], uint32_t out[4])
{
    uint32_t c0 = counter[0], c1 = counter[1], c2 = counter[2], c3 = counter[3], k0 = key[0], k1 = key[1];
    for (int round = 0; round < 10; round++) {
        uint64_t a = (uint64_t)0xD2511F53 * c0, b = (uint64_t)0xCD9E8D57 * c2;
        c0 = (uint32_t)(b >> 32) ^ c1 ^ k0;
        c1 = (uint32_t)b;
        c2 = (uint32_t)(a >> 32) ^ c3 ^ k1;
        c3 = (uint32_t)a;
        k0 += 0x9E3779B9;
        k1 += 0xBB67AE85;
    }
    out[0] = c0;
    out[1] = c1;
    out[2] = c2;
    out[3] = c3;
}

/* The random words of one trajectory in one stream, two uniform numbers at a time. */
typedef struct source {
    uint64_t seed, index;
    uint32_t stream, used;
    double ready[2];
} source;

static double uniform(source *s)
{
    if (s->used % 2 == 0) {
        uint32_t counter[4] = {(uint32_t)s->index, (uint32_t)(s->index >> 32), s->stream, s->used / 2};
        uint32_t key[2] = {(uint32_t)s->seed, (uint32_t)(s->seed >> 32)}, words[4];
        draw_philox(counter, key, words);
        for (int i = 0; i < 2; i++)
            s->ready[i] = (double)(((uint64_t)words[2 * i + 1] << 32 | words[2 * i]) >> 11) * 0x1p-53;
    }
    return s->ready[s->used++ % 2];
}

double draw_uniform(uint64_t seed, uint32_t stream, uint64_t index)
{
    source s = {.seed = seed, .index = index, .stream = stream};
    return uniform(&s);
}

/* Returns true with probability exp(-p), 0 ≤ p ≤ 1: p > u1 > u2 > … > un has the probability p^n/n!, so the length n of
 * the longest such sequence is even with probability exp(-p) [vonNeumann51]. */
static bool survives(source *s, double p)
{
    bool even = true;
    double last = p, u = uniform(s);
    while (u < last) {
        even = !even;
        last = u;
        u = uniform(s);
    }
    return even;
}

/* [Karney16, algorithm N]: the integer part k with weight exp(-k²/2), the fraction x in [0, 1) with
 * exp(-x (2 k + x)/2), by rejection. */
double draw_normal(uint64_t seed, uint32_t stream, uint64_t index)
{
    source s = {.seed = seed, .index = index, .stream = stream};
    for (;;) {
        int k = 0;
        while (survives(&s, 0.5)) k++;
        bool good = true;
        for (int i = k * (k - 1); good && i > 0; i--) good = survives(&s, 0.5);
        if (!good) continue;
        double x = uniform(&s), p = x * (2 * k + x) / (2 * k + 2);
        for (int i = 0; good && i <= k; i++) good = survives(&s, p);
        if (good) return uniform(&s) < 0.5 ? -(k + x) : k + x;
    }
}
