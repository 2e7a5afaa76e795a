# libmotus-archive: the files of sweeps. Making one needs HDF5, in a module of its own (archive/make.h); without it the library reads
# and writes those that exist.
file(GLOB archive_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/archive/*.c)
list(REMOVE_ITEM archive_sources ${PROJECT_SOURCE_DIR}/archive/hdf5.c ${PROJECT_SOURCE_DIR}/archive/pack.c)
add_library(motus_archive STATIC ${archive_sources})
set_target_properties(motus_archive PROPERTIES OUTPUT_NAME motus-archive POSITION_INDEPENDENT_CODE ON)
target_include_directories(motus_archive PRIVATE ${PROJECT_SOURCE_DIR} PUBLIC
  $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
target_link_libraries(motus_archive PRIVATE motus_flags PUBLIC motus_static)
if(MOTUS_FUZZ)
  target_compile_options(motus_archive PRIVATE -fsanitize=fuzzer-no-link)
endif()

if(MOTUS_HDF5 AND NOT CMAKE_CROSSCOMPILING)
  find_package(PkgConfig QUIET)
  foreach(module hdf5-serial hdf5)
    if(PkgConfig_FOUND AND NOT hdf5_FOUND)
      pkg_check_modules(hdf5 QUIET ${module})
    endif()
  endforeach()
  if(hdf5_FOUND)
    find_library(hdf5_high hdf5_hl HINTS ${hdf5_LIBRARY_DIRS})
    find_package(ZLIB QUIET) # HDF5 compresses by it
  endif()
endif()
if(hdf5_FOUND AND hdf5_high AND ZLIB_FOUND)
  add_library(motus_hdf5 MODULE archive/hdf5.c archive/pack.c ${archive_sources} base/disk.c base/error.c
    base/platform.c base/utf8.c)
  set_target_properties(motus_hdf5 PROPERTIES PREFIX "" OUTPUT_NAME motus-hdf5 C_VISIBILITY_PRESET hidden
    LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR})
  target_include_directories(motus_hdf5 PRIVATE ${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/include)
  target_include_directories(motus_hdf5 SYSTEM PRIVATE ${hdf5_INCLUDE_DIRS})
  target_link_directories(motus_hdf5 PRIVATE ${hdf5_LIBRARY_DIRS})
  target_link_libraries(motus_hdf5 PRIVATE motus_flags ${hdf5_high} ${hdf5_LIBRARIES} ZLIB::ZLIB m)
  target_link_options(motus_hdf5 PRIVATE $<$<NOT:$<BOOL:${MOTUS_SANITIZE}>>:-Wl,--no-undefined>)
else()
  message(STATUS "without HDF5: sweeps cannot make archives (Debian: libhdf5-dev)")
endif()
