# Installs the program, the library kinemesh::kinemesh (kinemesh::c for those who call it from C) and its
# headers.
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)

set(KINEMESH_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/kinemesh)

install(TARGETS kinemesh_whole kinemesh_c EXPORT kinemesh-targets)
install(EXPORT kinemesh-targets NAMESPACE kinemesh:: DESTINATION ${KINEMESH_PACKAGE_DIR})
install(DIRECTORY include/ TYPE INCLUDE)
install(FILES LICENSE README.md CHANGELOG.md TYPE DOC)

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/kinemesh-config.cmake.in
  ${CMAKE_CURRENT_BINARY_DIR}/kinemesh-config.cmake
  INSTALL_DESTINATION ${KINEMESH_PACKAGE_DIR}
  NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/kinemesh-config-version.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES
  ${CMAKE_CURRENT_BINARY_DIR}/kinemesh-config.cmake
  ${CMAKE_CURRENT_BINARY_DIR}/kinemesh-config-version.cmake
  DESTINATION ${KINEMESH_PACKAGE_DIR})
if(NOT KINEMESH_SHARED)
  install(FILES ${CMAKE_CURRENT_LIST_DIR}/FindCHOLMOD.cmake DESTINATION ${KINEMESH_PACKAGE_DIR})
endif()
