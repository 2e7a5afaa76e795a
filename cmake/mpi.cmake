# motus-mpi: the program in the processes of an MPI job. motus and libmotus know nothing of MPI. -DMPI_C_COMPILER=mpicc.mpich takes
# another MPI than the system's.
if(MOTUS_MPI)
  find_package(MPI REQUIRED COMPONENTS C)
  set(mpi_sources ${cli_sources})
  list(FILTER mpi_sources EXCLUDE REGEX "/cli/main\\.c$")
  add_executable(motus_mpi mpi/main.c ${mpi_sources})
  get_target_property(program_definitions motus_program COMPILE_DEFINITIONS)
  set_target_properties(motus_mpi PROPERTIES OUTPUT_NAME motus-mpi RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}
    BUILD_RPATH "$ORIGIN" INSTALL_RPATH "$ORIGIN/${to_libraries}")
  target_include_directories(motus_mpi PRIVATE ${PROJECT_SOURCE_DIR})
  target_include_directories(motus_mpi SYSTEM PRIVATE ${MPI_C_INCLUDE_DIRS})
  target_compile_definitions(motus_mpi PRIVATE ${program_definitions})
  target_link_libraries(motus_mpi PRIVATE motus_flags motus_archive motus_static MPI::MPI_C)
  if(TARGET motus_hdf5)
    add_dependencies(motus_mpi motus_hdf5)
  endif()
  install(TARGETS motus_mpi DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
