# kinemesh_library(NAME SOURCES ... PUBLIC targets... PRIVATE targets...)
# One static library per folder, exported as kinemesh::NAME.
function(kinemesh_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  set(target kinemesh_${name})
  add_library(${target} STATIC ${ARG_SOURCES})
  add_library(kinemesh::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  target_include_directories(${target} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
    $<INSTALL_INTERFACE:include/kinemesh>)
  target_compile_features(${target} PUBLIC cxx_std_20)
  # A fused multiply-add rounds once where two products are compared, and orientation(a, b, c) then differs from
  # orientation(b, c, a): the static filters of core/predicates.h are proved for separate roundings.
  target_compile_options(${target} PUBLIC -ffp-contract=off)
  target_link_libraries(${target} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
endfunction()
