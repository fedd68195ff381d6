# cmake --install: program, library, headers, parameter files, documents, an example, and the CMake package `taut` with
# the target taut::taut.
include(CMakePackageConfigHelpers)

# The installed program finds the installed library wherever the two are moved to together; the folders of the
# libraries below deal.II that the loader does not search by itself are added.
file(RELATIVE_PATH library_from_program ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_LIBDIR})
set_target_properties(taut PROPERTIES INSTALL_RPATH_USE_LINK_PATH TRUE)
set_target_properties(taut-program PROPERTIES
  INSTALL_RPATH "$ORIGIN/${library_from_program}" INSTALL_RPATH_USE_LINK_PATH TRUE)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/taut)
configure_package_config_file(${CMAKE_CURRENT_SOURCE_DIR}/source/cmake/tautConfig.cmake.in
  ${CMAKE_CURRENT_BINARY_DIR}/package/tautConfig.cmake INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/package/tautConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)

# A Debug build adds its library, libtaut.g, to what a Release build installed.
install(TARGETS taut-program taut_memory CONFIGURATIONS Release
  RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(TARGETS taut EXPORT taut)
install(EXPORT taut NAMESPACE taut:: FILE tautTargets.cmake DESTINATION ${package_folder})
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/package/tautConfig.cmake
  ${CMAKE_CURRENT_BINARY_DIR}/package/tautConfigVersion.cmake DESTINATION ${package_folder})
install(DIRECTORY include/taut DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h")
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/include/taut/base/version.h
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/taut/base)
install(PROGRAMS source/plot/taut-plot source/plot/show_in_paraview.py DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY source/plot/ DESTINATION ${CMAKE_INSTALL_BINDIR} FILES_MATCHING PATTERN "taut_plot_*.py")
install(DIRECTORY prm DESTINATION ${CMAKE_INSTALL_DATADIR}/taut FILES_MATCHING PATTERN "*.prm" PATTERN "*.csv")
install(FILES LICENSE README.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES prm/README.md DESTINATION ${CMAKE_INSTALL_DOCDIR}/prm)
install(DIRECTORY doc/ DESTINATION ${CMAKE_INSTALL_DOCDIR}/doc
  FILES_MATCHING PATTERN "*.md" PATTERN "*.png")
# Where the links of README.md find it.
install(DIRECTORY tests/install DESTINATION ${CMAKE_INSTALL_DOCDIR}/tests PATTERN "*.cmake" EXCLUDE)

# cpack -G DEB: a package of all this for the distribution that it is built on.
set(CPACK_PACKAGE_VENDOR "Taut")
set(CPACK_PACKAGE_CONTACT "Taut <taut@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY ${PROJECT_DESCRIPTION})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES TRUE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS TRUE)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "libdeal.ii-dev, python3-matplotlib")
include(CPack)
