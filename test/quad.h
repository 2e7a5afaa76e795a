/* Numbers of 113 bits. */
#ifndef TEST_QUAD_H
#define TEST_QUAD_H

#include <float.h>

/* The compiler's type of 113 bits; the laws compile the rows and the texts of step/ with it. */
#if LDBL_MANT_DIG == 113
typedef long double quad;
#define Q(x) x##L
#else
__extension__ typedef __float128 quad;
#define Q(x) __extension__ x##q
#endif
#define QUAD_EPSILON Q(0x1p-112)

#endif
