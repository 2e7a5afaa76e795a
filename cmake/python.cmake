# The Python module, build/python/motus: python/motus, and _motus.abi3.so, made from the public headers, with the library inside. It needs
# cffi and Python's headers to be built, and NumPy to be used. Python: Debian's, or the one in PATH.
set(MOTUS_PYTHON_PROGRAM "")
foreach(python IN ITEMS /usr/bin/python3 python3)
  execute_process(COMMAND ${python} -c "import cffi, sysconfig; print(sysconfig.get_path('include'))"
    OUTPUT_VARIABLE python_include OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE none)
  if(NOT none AND EXISTS ${python_include}/Python.h AND NOT MOTUS_PYTHON_PROGRAM)
    set(MOTUS_PYTHON_PROGRAM ${python})
    set(MOTUS_PYTHON_INCLUDE ${python_include})
  endif()
endforeach()
set(MOTUS_PYTHON_FOUND "${MOTUS_PYTHON_PROGRAM}" CACHE INTERNAL "Python with cffi")
if(NOT MOTUS_PYTHON_PROGRAM)
  message(FATAL_ERROR "the Python module needs cffi and Python.h: python3-cffi, python3-dev")
endif()

set(python_out ${PROJECT_BINARY_DIR}/python)
add_custom_command(OUTPUT ${python_out}/_motus.c
  COMMAND ${MOTUS_PYTHON_PROGRAM} -B ${PROJECT_SOURCE_DIR}/python/build.py ${PROJECT_SOURCE_DIR}/include ${python_out}/_motus.c ${CMAKE_C_COMPILER}
  DEPENDS python/build.py python/declarations.py include/motus.h VERBATIM)
add_library(motus_python MODULE EXCLUDE_FROM_ALL ${python_out}/_motus.c)
set_target_properties(motus_python PROPERTIES PREFIX "" OUTPUT_NAME _motus SUFFIX .abi3.so C_VISIBILITY_PRESET hidden
  LIBRARY_OUTPUT_DIRECTORY ${python_out}/motus)
target_include_directories(motus_python SYSTEM PRIVATE ${MOTUS_PYTHON_INCLUDE})
target_compile_options(motus_python PRIVATE -O1 -w) # what cffi writes
target_link_libraries(motus_python PRIVATE motus_static)
file(GLOB python_files CONFIGURE_DEPENDS python/motus/*.py python/motus/py.typed)
add_custom_command(TARGET motus_python POST_BUILD COMMAND ${CMAKE_COMMAND} -E copy ${python_files} ${python_out}/motus)
add_custom_target(motus_python_files COMMAND ${CMAKE_COMMAND} -E copy ${python_files} ${python_out}/motus)
add_dependencies(motus_python motus_python_files)
