# What is installed. Other projects find it by motus.pc or find_package(motus); the prefix may be moved.
include(CMakePackageConfigHelpers)

install(TARGETS motus_static motus_shared EXPORT motus
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(TARGETS motus_archive ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
if(TARGET motus_hdf5)
  install(TARGETS motus_hdf5 LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
endif()
install(FILES include/motus.h include/motus-archive.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
if(TARGET motus_program)
  install(TARGETS motus_program DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/motus)
install(EXPORT motus NAMESPACE motus:: FILE motus-targets.cmake DESTINATION ${package_dir})
configure_package_config_file(cmake/motus-config.cmake.in ${PROJECT_BINARY_DIR}/motus-config.cmake
  INSTALL_DESTINATION ${package_dir} NO_SET_AND_CHECK_MACRO NO_CHECK_REQUIRED_COMPONENTS_MACRO)
# Before 1.0 a new minor version may change the interface.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/motus-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/motus-config.cmake ${PROJECT_BINARY_DIR}/motus-config-version.cmake
  DESTINATION ${package_dir})

# A folder may be given below the prefix or by its whole path.
foreach(dir LIBDIR INCLUDEDIR)
  set(pc_${dir} "\${prefix}/${CMAKE_INSTALL_${dir}}")
  if(IS_ABSOLUTE "${CMAKE_INSTALL_${dir}}")
    set(pc_${dir} "${CMAKE_INSTALL_${dir}}")
  endif()
endforeach()
file(RELATIVE_PATH pc_to_prefix ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
string(REGEX REPLACE "/$" "" pc_to_prefix "${pc_to_prefix}")
configure_file(cmake/motus.pc.in ${PROJECT_BINARY_DIR}/motus.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/motus.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)

install(FILES doc/motus.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(FILES README.md LICENSE doc/manual.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY models DESTINATION ${CMAKE_INSTALL_DATADIR}/motus FILES_MATCHING PATTERN "*.motus")
# Only if `make lab` has built it.
install(FILES ${PROJECT_BINARY_DIR}/lab/motus-lab.html DESTINATION ${CMAKE_INSTALL_DATADIR}/motus OPTIONAL)
install(FILES doc/completions/motus.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME motus)
install(FILES doc/completions/_motus DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions)
install(FILES doc/completions/motus.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)
