# What `make install` puts below the prefix: headers, library, argand(1), and how others
# find them: pkg-config, CMake, the manual, completion for bash.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# Nothing installed knows the prefix, so the tree may be moved.
file(RELATIVE_PATH from_pkgconfig /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
string(REGEX REPLACE "/$" "" from_pkgconfig "${from_pkgconfig}")
configure_file(cmake/argand.pc.in ${PROJECT_BINARY_DIR}/argand.pc @ONLY)

file(RELATIVE_PATH from_bin /${CMAKE_INSTALL_BINDIR} /${CMAKE_INSTALL_LIBDIR})
set_target_properties(argand_cli PROPERTIES INSTALL_RPATH "$ORIGIN/${from_bin}")

install(TARGETS argand EXPORT argand_targets LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(TARGETS argand_cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY include/argand DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN *.h)
install(FILES ${PROJECT_BINARY_DIR}/argand.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
install(FILES docs/argand.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(FILES scripts/argand.bash RENAME argand
        DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)

# find_package(argand) gives argand::argand.
set(package ${CMAKE_INSTALL_LIBDIR}/cmake/argand)
install(EXPORT argand_targets FILE argand-config.cmake NAMESPACE argand:: DESTINATION ${package})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/argand-config-version.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/argand-config-version.cmake DESTINATION ${package})
