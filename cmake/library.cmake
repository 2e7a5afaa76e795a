# libmotus, static and shared.
#
# A kernel is compiled once for each instruction set, named by the macro ISA; so it is removed from the plain list of sources.
set(kernels core/stepper_body.c core/solver_band.c lang/tape/tape_kernels.c lang/tape/tape_run.c lang/tape/tape_series_isa.c)

file(GLOB library_sources CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR}
  base/*.c core/*.c lang/*/*.c machine/*.c api/*/*.c study/*.c)
# machine/nowhere.c replaces the compiled machine in the page's module (lab/core/CMakeLists.txt).
list(REMOVE_ITEM library_sources ${kernels} machine/nowhere.c)

# The library contains the texts of step/ and machine/text/, because the compiled machine compiles them with a model.
file(GLOB step_texts CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/step/*.h ${PROJECT_SOURCE_DIR}/step/*.def
  ${PROJECT_SOURCE_DIR}/step/functions/*.h ${PROJECT_SOURCE_DIR}/machine/text/*.h)
list(APPEND step_texts ${PROJECT_SOURCE_DIR}/core/scalar.h)
set(texts ${PROJECT_BINARY_DIR}/texts.c)
add_custom_command(OUTPUT ${texts} DEPENDS ${step_texts} ${PROJECT_SOURCE_DIR}/cmake/embed.cmake
  COMMAND ${CMAKE_COMMAND} -DOUT=${texts} -DROOT=${PROJECT_SOURCE_DIR} -P ${PROJECT_SOURCE_DIR}/cmake/embed.cmake
  COMMENT "Embedding the texts of step/")

function(motus_objects target)
  add_library(${target} OBJECT ${ARGN})
  target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/include)
  target_compile_definitions(${target} PRIVATE MOTUS_BUILDING)
  set_target_properties(${target} PROPERTIES
    POSITION_INDEPENDENT_CODE ON C_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  target_link_libraries(${target} PRIVATE motus_flags)
endfunction()

motus_objects(motus_objects ${library_sources} ${texts})
set(objects $<TARGET_OBJECTS:motus_objects>)

foreach(kernel IN LISTS kernels)
  if(EXISTS ${PROJECT_SOURCE_DIR}/${kernel})
    get_filename_component(stem ${kernel} NAME_WE)
    foreach(isa IN LISTS isas)
      motus_objects(${stem}_${isa} ${kernel})
      target_compile_definitions(${stem}_${isa} PRIVATE ISA=${isa})
      target_compile_options(${stem}_${isa} PRIVATE ${hot} ${isa_flags_${isa}})
      list(APPEND objects $<TARGET_OBJECTS:${stem}_${isa}>)
    endforeach()
  endif()
endforeach()

# Other files with loops over the state, and the roots on each step. (The stepper's loops are in its kernel.)
foreach(source IN LISTS library_sources)
  if(source MATCHES "^(core/solver|core/roots|lang/tape/|machine/)")
    set_property(SOURCE ${source} APPEND PROPERTY COMPILE_OPTIONS ${hot})
  endif()
  # What the fuzzers feed tells them where it has been.
  if(MOTUS_FUZZ AND source MATCHES "^(lang/|core/roots)")
    set_property(SOURCE ${source} APPEND PROPERTY COMPILE_OPTIONS -fsanitize=fuzzer-no-link)
  endif()
endforeach()

# The step of the trace runs once per call, so it is compiled for size.
set_property(SOURCE core/trace_body.c APPEND PROPERTY COMPILE_OPTIONS $<$<CONFIG:Release>:-Os>)

add_library(motus_static STATIC ${objects})
add_library(motus_shared SHARED ${objects})
foreach(library motus_static motus_shared)
  set_target_properties(${library} PROPERTIES OUTPUT_NAME motus LINKER_LANGUAGE C)
  target_include_directories(${library} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
endforeach()
find_package(Threads REQUIRED)
target_link_libraries(motus_static PUBLIC m ${CMAKE_DL_LIBS} Threads::Threads)
target_link_libraries(motus_shared PRIVATE m ${CMAKE_DL_LIBS} Threads::Threads $<BUILD_INTERFACE:motus_flags>)
set_target_properties(motus_shared PROPERTIES VERSION ${PROJECT_VERSION} SOVERSION 0.${PROJECT_VERSION_MINOR})
set_target_properties(motus_static PROPERTIES EXPORT_NAME static)
set_target_properties(motus_shared PROPERTIES EXPORT_NAME shared)
if(NOT MOTUS_SANITIZE)
  # Reports a missing symbol when the library is linked, not in the program that uses it.
  target_link_options(motus_shared PRIVATE LINKER:--no-undefined)
endif()
