/* The vocabulary of the texts for lanes: `real` is a vector, one trajectory a lane; an element of an array is GROUPS of them, so that short chains
 * of operations have company. The includer has `reals`, MANY_FUSED, GROUPS, and time and step are the same for all.
 */
#define clock motus_clock
#define real reals
typedef double clock;
typedef int64_t whole;
#define FMA(a, b, c) MANY_FUSED(a, b, c)
#define EACH(k) for (size_t k = 0; k < FACT(w, nx); k++)
#define EACHV(k) for (size_t k = 0; k < FACT(w, nv); k++)
#define TRACE(w, i) ((void)(w), (void)(i))
