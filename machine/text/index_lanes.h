/* Lanes along an index: a loop over the cells of a family, or over the terms of a sum, takes WIDTH values of its
 * index at a time.
 *
 * Invariant: lane l is the l-th of them and goes through the operations of the scalar loop, which also takes the
 * remaining values.
 */
typedef reals reals_anywhere __attribute__((aligned(8))); /* GCC and clang let a vector alias its elements */

/* Keeps a vector in a register. Compilers tend to load a value again for every use, and loads limit the speed here. */
#if (defined __AVX512F__ && WIDTH == 8)
#define INDEX_KEEP(x) __asm__("" : "+v"(x))
#elif (defined __AVX__ && WIDTH == 4) || (defined __SSE2__ && WIDTH == 2)
#define INDEX_KEEP(x) __asm__("" : "+x"(x))
#elif defined __aarch64__ && WIDTH == 2
#define INDEX_KEEP(x) __asm__("" : "+w"(x))
#else
#define INDEX_KEEP(x) ((void)0)
#endif

/* Keeps the compiler from vectorising the loop over the remaining values, which is too short. */
#define INDEX_REST __asm__ volatile("")

static inline reals index_load(const double *p)
{
    reals r = *(const reals_anywhere *)p;
    INDEX_KEEP(r);
    return r;
}

static inline void index_store(double *p, reals r) { *(reals_anywhere *)p = r; }

/* Returns j, j + 1, … as numbers. */
static inline reals index_count(int64_t j)
{
#if WIDTH == 8
    const reals lanes = {0, 1, 2, 3, 4, 5, 6, 7};
#elif WIDTH == 4
    const reals lanes = {0, 1, 2, 3};
#else
    const reals lanes = {0, 1};
#endif
    return lanes + MANY((double)j);
}

/* Puts the number of lane l into every lane; the lanes from number `lanes` on get that of the last lane before them. */
#define LANE_OF_INDEX(k, number)                     \
    __extension__({                                  \
        const int l = (k) < lanes ? (k) : lanes - 1; \
        (double)(number);                            \
    })
#define TWO_OF_INDEX(k, number) LANE_OF_INDEX(k, number), LANE_OF_INDEX((k) + 1, number)
#if WIDTH == 8
#define LANES_OF_INDEX(number) \
    ((reals){TWO_OF_INDEX(0, number), TWO_OF_INDEX(2, number), TWO_OF_INDEX(4, number), TWO_OF_INDEX(6, number)})
#elif WIDTH == 4
#define LANES_OF_INDEX(number) ((reals){TWO_OF_INDEX(0, number), TWO_OF_INDEX(2, number)})
#else
#define LANES_OF_INDEX(number) ((reals){TWO_OF_INDEX(0, number)})
#endif

#ifdef WRAPS
/* Returns the numbers from index k on of a ring of n numbers. */
static inline reals index_around(const double *ring, int64_t k, int64_t n)
{
    k = wrapped(k, n);
    if (k + WIDTH <= n) return index_load(ring + k);
    reals r;
    for (int l = 0; l < WIDTH; l++) LANE_OF(r, l) = ring[wrapped(k + l, n)];
    return r;
}
#endif
