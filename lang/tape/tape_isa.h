/* Declarations for files that are compiled once for each instruction set; ISA is its name. On x86-64 all three are
 * linked and one is chosen at the start; elsewhere only `base` is built, for whatever the machine has.
 *
 *     -DISA=base                            nothing is assumed; fma is the C library's
 *     -DISA=avx2     -mavx2 -mfma
 *     -DISA=avx512   -mavx512f -mavx512dq -mavx512vl -mavx2 -mfma -mprefer-vector-width=512
 *
 * and for all: -O3 -ffp-contract=off -fno-math-errno -fno-trapping-math. The last two allow vector code and change no
 * value.
 *
 * What is static here stays inside its object, so no instruction set leaks into another.
 */
#ifndef LANG_TAPE_TAPE_ISA_H
#define LANG_TAPE_TAPE_ISA_H

#include "lang/tape/tape_code.h"

#include <math.h>
#include <stdint.h>
#include "lang/base/functions.h"

#ifndef ISA
#define ISA base
#endif
#define JOIN_(a, b) a##b
#define JOIN(a, b) JOIN_(a, b)
#define TEXT_(a) #a
#define TEXT(a) TEXT_(a)
#define OF_ISA(name) JOIN(name, ISA)

/* The value of a row that is a call: the call itself or, where size counts more (-DONE_COPY), the one copy of all
 * functions in operation.c. The bits are equal. */
#ifdef ONE_COPY
#define CALLED(id, value) operation_value(OP_##id, a, b, 0)
#else
#define CALLED(id, value) (value)
#endif

#define EACH_TAPE_MACHINE(X) X(avx512) X(avx2) X(base)
#define X(isa)                                                     \
    extern const tape_machine tape_run_##isa;                      \
    extern block_kernel *const tape_kernels_##isa[OPERATIONS * 8]; \
    void tape_series_isa_##isa(tape_series *, const series_pass *);
EACH_TAPE_MACHINE(X)
#undef X

#endif
