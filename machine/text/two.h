/* Two doubles in a vector, whose operations are those of each. */
typedef double two __attribute__((vector_size(16)));
#ifdef __SSE2__
static inline two two_roots(double a, double b) { return __builtin_ia32_sqrtpd((two){a, b}); }
#else
static inline two two_roots(double a, double b)
{
    const two of = {a, b};
    return (two){sqrt(of[0]), sqrt(of[1])};
}
#endif
