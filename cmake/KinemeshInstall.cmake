# Installs the program, the libraries and their headers, and exports the libraries as kinemesh::core,
# kinemesh::motion, kinemesh::untangle, kinemesh::sim, kinemesh::kinemesh for all of them, and kinemesh::c,
# the C interface.
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)

set(KINEMESH_FOLDERS core motion untangle sim)
set(KINEMESH_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/kinemesh)

add_library(kinemesh_all INTERFACE)
add_library(kinemesh::kinemesh ALIAS kinemesh_all)
set_target_properties(kinemesh_all PROPERTIES EXPORT_NAME kinemesh)
list(TRANSFORM KINEMESH_FOLDERS PREPEND kinemesh_ OUTPUT_VARIABLE KINEMESH_LIBRARIES)
target_link_libraries(kinemesh_all INTERFACE ${KINEMESH_LIBRARIES})

install(TARGETS ${KINEMESH_LIBRARIES} kinemesh_all kinemesh_c EXPORT kinemesh-targets)
install(EXPORT kinemesh-targets NAMESPACE kinemesh:: DESTINATION ${KINEMESH_PACKAGE_DIR})
install(DIRECTORY include/ TYPE INCLUDE)
# Details that public headers still show; what includes CGAL is for our own sources.
install(DIRECTORY ${KINEMESH_FOLDERS} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/kinemesh/internal
  FILES_MATCHING PATTERN "*.h"
  PATTERN "cli" EXCLUDE PATTERN "report" EXCLUDE PATTERN "draw" EXCLUDE
  REGEX "/(cgal_triangulation|outline_mesher|shadow_border|surface)\\.h$" EXCLUDE)
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
  ${CMAKE_CURRENT_LIST_DIR}/FindCHOLMOD.cmake
  DESTINATION ${KINEMESH_PACKAGE_DIR})
