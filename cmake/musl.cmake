# Builds with the C library musl, whose programs run here. Debian: cmake/need.sh musl. Nobody packages cmocka for it: test/musl/cmocka.h.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR ${CMAKE_HOST_SYSTEM_PROCESSOR})
set(CMAKE_C_COMPILER musl-gcc)
set(CMOCKA_INCLUDE ${CMAKE_CURRENT_LIST_DIR}/../test/musl CACHE PATH "")
set(CMOCKA_LIBRARY c CACHE STRING "")
# Nor MPFR: the tests of the elementary functions are not built.
foreach(name MPFR_INCLUDE MPFR_LIBRARY GMP_LIBRARY)
  set(${name} none CACHE STRING "")
endforeach()
