# motus-mpi: the program in the processes of an MPI job. motus and libmotus know nothing of MPI. -DMPI_C_COMPILER=mpicc.mpich takes
# another MPI than the system's.
if(MOTUS_MPI)
  find_package(MPI REQUIRED COMPONENTS C)
  add_program(motus_mpi motus-mpi mpi/main.c)
  target_sources(motus_mpi PRIVATE mpi/bits.c)
  target_include_directories(motus_mpi SYSTEM PRIVATE ${MPI_C_INCLUDE_DIRS})
  target_link_libraries(motus_mpi PRIVATE MPI::MPI_C)
  install(TARGETS motus_mpi DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
