/* The texts of step/ for a callback, with real = double. This file is compiled once per instruction set, each time
 * with its own -DISA=…, always with -O3 -ffp-contract=off (never -ffast-math):
 *
 *     -DISA=base                                    everywhere
 *     -DISA=avx2    -mavx2 -mfma                    x86-64
 *     -DISA=avx512  -mavx512f -mavx512vl -mavx512dq -mavx2 -mfma -mprefer-vector-width=512        x86-64
 *
 * Invariant: all of them give the same bits, because every operation is written out, fma included; they differ only in
 * speed. core/stepper.c chooses one.
 */
#include "core/stepper_body.h"

#ifndef ISA
#error "compile with -DISA=base, avx2 or avx512"
#endif

#include "core/stepper_host.h"

#define PASTE(a, b) a##b
#define NAMED(isa) PASTE(stepper_body_, isa)
#define TEXT(isa) #isa
#define TEXT_OF(isa) TEXT(isa)

const stepper_body NAMED(ISA) = STEPPER_BODY(TEXT_OF(ISA));
