# The compiler flags of every object, as an interface target, and the additional ones of files with hot loops.
#
# -ffp-contract=off: fused multiply-adds are written in the source, where they are part of the result; the compiler adds none.
# -fno-math-errno: sqrt and friends are instructions, not calls. Neither flag changes the value of any operation.
add_library(motus_flags INTERFACE)
target_compile_options(motus_flags INTERFACE
  -std=c17 -ffp-contract=off -fno-math-errno -Wall -Wextra -Wpedantic)
# POSIX, and nothing that Linux alone declares: base/platform.c asks for that.
target_compile_definitions(motus_flags INTERFACE _XOPEN_SOURCE=700)
if(CMAKE_C_COMPILER_ID MATCHES "Clang")
  # A loop that clang cannot vectorise as asked is no error.
  target_compile_options(motus_flags INTERFACE -Wno-pass-failed)
endif()
if(MOTUS_WERROR)
  target_compile_options(motus_flags INTERFACE -Werror)
endif()

# -fno-trapping-math: the code reads no exception flags, so a loop may compute both sides of a choice; no value changes.
set(hot -O3 -fno-trapping-math)
# Where gcc optimises little it sees less, and warns of what cannot be.
set(seen_less $<$<C_COMPILER_ID:GNU>:-Wno-format-truncation> $<$<C_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
if(MOTUS_QUICK)
  set(hot -fno-trapping-math)
  target_compile_options(motus_flags INTERFACE ${seen_less})
endif()
if(MOTUS_SANITIZE)
  # -O3 would make compiling slow, and a sanitized build need not be fast.
  set(hot "")
  target_compile_options(motus_flags INTERFACE
    -g1 -fno-omit-frame-pointer -fsanitize=address,undefined -fno-sanitize-recover=all)
  target_link_options(motus_flags INTERFACE -fsanitize=address,undefined)
endif()

# Instruction sets for which the kernels are built; the library chooses one when it starts. The FMA instruction changes no bits: the
# sources call fma() explicitly, and without the instruction the C library computes the same value.
set(isas base)
set(isa_flags_base "")
if(MOTUS_QUICK)
  target_compile_definitions(motus_flags INTERFACE ONE_ISA)
elseif(CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|amd64|AMD64)$" AND CMAKE_SIZEOF_VOID_P EQUAL 8)
  list(APPEND isas avx2 avx512)
  set(isa_flags_avx2 -mavx2 -mfma)
  set(isa_flags_avx512 -mavx2 -mavx512f -mavx512dq -mavx512vl -mfma -mprefer-vector-width=512)
endif()
