/* The first text of a compiled model. It replaces C's headers by built-in names of the compiler, because reading the
 * headers takes longer than compiling a small model. GCC and clang have these names on every target.
 */
typedef __SIZE_TYPE__ size_t;
typedef __INT64_TYPE__ int64_t;
typedef __UINT64_TYPE__ uint64_t;
#define bool _Bool
#define true 1
#define false 0
#define NULL ((void *)0)
#define DBL_EPSILON __DBL_EPSILON__
#define INFINITY __builtin_inff()
#define NAN __builtin_nanf("")
#define fma __builtin_fma
#define sqrt __builtin_sqrt
#define fabs __builtin_fabs
#define floor __builtin_floor
#define fmod __builtin_fmod
#define copysign __builtin_copysign
#define signbit __builtin_signbit
/* Before a loop whose count is constant: the compiler unrolls it completely. */
#ifdef __clang__
#define WRITTEN_OUT _Pragma("clang loop unroll(full)")
#else
#define WRITTEN_OUT _Pragma("GCC unroll 20")
#endif
