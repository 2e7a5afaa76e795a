# The benchmarks, build/bench/bench (bench/bench.c). Not in `all`.
#
# The hand-written files get the flags of the compiled machine; the other libraries get the flags that their users would give. Where
# one is not installed, its lines read "not measured".

file(GLOB bench_sources CONFIGURE_DEPENDS bench/*.c bench/hand/*.c bench/peers/*.c)
list(REMOVE_ITEM bench_sources ${PROJECT_SOURCE_DIR}/bench/functions.c ${PROJECT_SOURCE_DIR}/bench/truth.c)
file(GLOB bench_hand bench/hand/*.c)
set_source_files_properties(${bench_hand} PROPERTIES COMPILE_OPTIONS "${hot};-march=native")
set_source_files_properties(bench/hand/single.c PROPERTIES COMPILE_OPTIONS -O2) # what a physicist types

add_executable(motus_bench EXCLUDE_FROM_ALL ${bench_sources})
set_target_properties(motus_bench PROPERTIES OUTPUT_NAME bench RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bench)
target_include_directories(motus_bench PRIVATE ${PROJECT_SOURCE_DIR})
target_compile_definitions(motus_bench PRIVATE _GNU_SOURCE)
target_link_libraries(motus_bench PRIVATE motus_flags motus_static)

find_package(OpenMP COMPONENTS C)        # without it the chain by hand runs on one thread
if(OpenMP_C_FOUND)
  target_link_libraries(motus_bench PRIVATE OpenMP::OpenMP_C)
else()
  target_compile_options(motus_bench PRIVATE -Wno-unknown-pragmas)
endif()

# name, header, libraries: defines BENCH_name if all of them are found
function(bench_peer name header)
  find_path(BENCH_${name}_INCLUDE ${header})
  set(libraries "")
  foreach(library IN LISTS ARGN)
    find_library(BENCH_${library} ${library})
    list(APPEND libraries ${BENCH_${library}})
  endforeach()
  if(BENCH_${name}_INCLUDE AND NOT "${libraries}" MATCHES "NOTFOUND")
    target_compile_definitions(motus_bench PRIVATE BENCH_${name})
    target_include_directories(motus_bench SYSTEM PRIVATE ${BENCH_${name}_INCLUDE})
    target_link_libraries(motus_bench PRIVATE ${libraries})
  endif()
endfunction()
bench_peer(GSL gsl/gsl_odeiv2.h gsl gslcblas)
bench_peer(SUNDIALS arkode/arkode_erkstep.h sundials_arkode sundials_cvode sundials_sunnonlinsolfixedpoint
           sundials_sunlinsoldense sundials_sunmatrixdense sundials_nvecserial)

# The C library's vector functions, x86-64 only.
find_library(BENCH_mvec mvec)
if(BENCH_mvec AND CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|amd64|AMD64)$")
  target_compile_definitions(motus_bench PRIVATE BENCH_LIBMVEC)
  target_link_libraries(motus_bench PRIVATE ${BENCH_mvec} m)
endif()

enable_language(CXX)
add_library(motus_bench_odeint OBJECT EXCLUDE_FROM_ALL bench/peers/odeint.cpp
            bench/peers/adaptive_odeint.cpp)
target_include_directories(motus_bench_odeint PRIVATE ${PROJECT_SOURCE_DIR})
target_compile_options(motus_bench_odeint PRIVATE -O3 -march=native)
target_compile_features(motus_bench_odeint PRIVATE cxx_std_14)
find_path(BENCH_ODEINT_INCLUDE boost/numeric/odeint.hpp)
if(BENCH_ODEINT_INCLUDE)
  target_compile_definitions(motus_bench_odeint PRIVATE BENCH_ODEINT)
  target_include_directories(motus_bench_odeint SYSTEM PRIVATE ${BENCH_ODEINT_INCLUDE})
endif()
target_sources(motus_bench PRIVATE $<TARGET_OBJECTS:motus_bench_odeint>)
set_target_properties(motus_bench PROPERTIES LINKER_LANGUAGE CXX)
