# SPDX-License-Identifier: BSD-3-Clause
# Where Debian expects things: bin, lib, include/sidestep, share/sidestep, man pages, the CMake package.
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/sidestep)

install(TARGETS sidestep EXPORT sidestepTargets LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
include(SidestepPublicHeaders)
foreach(header ${public_headers})
  get_filename_component(folder ${header} DIRECTORY)
  install(FILES libs/${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/sidestep/${folder})
endforeach()
install(DIRECTORY share/ DESTINATION ${CMAKE_INSTALL_DATADIR}/sidestep)
install(EXPORT sidestepTargets NAMESPACE sidestep:: DESTINATION ${package_dir})
configure_package_config_file(cmake/sidestepConfig.cmake.in ${PROJECT_BINARY_DIR}/sidestepConfig.cmake
  INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/sidestepConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/sidestepConfig.cmake ${PROJECT_BINARY_DIR}/sidestepConfigVersion.cmake
  DESTINATION ${package_dir})
file(GLOB man_pages CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/doc/man/*.1)
install(FILES ${man_pages} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
