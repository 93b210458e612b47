# For all of our targets, and nobody who links them: Boost 1.74 warns of headers of its own that it includes.
add_compile_definitions(BOOST_ALLOW_DEPRECATED_HEADERS)

# kinemesh_room(FOLDER SOURCES names... HEADERS names... KNOWS rooms... USES targets...)
# A room: the sources FOLDER/NAME.cpp, whose public headers are include/kinemesh/NAME.h. It may include from
# itself and from the rooms it KNOWS, which come before it; tests/project reads every #include against these
# lines. It is compiled with what it USES of others.
function(kinemesh_room folder)
  cmake_parse_arguments(ARG "" "" "SOURCES;HEADERS;KNOWS;USES" ${ARGN})
  foreach(known ${ARG_KNOWS})
    string(REPLACE "/" "_" known room_${known})
    if(NOT TARGET ${known})
      message(FATAL_ERROR "${folder} knows ${known}, which is no room before it")
    endif()
  endforeach()
  list(TRANSFORM ARG_SOURCES PREPEND ${PROJECT_SOURCE_DIR}/${folder}/)
  list(TRANSFORM ARG_SOURCES APPEND .cpp)
  string(REPLACE "/" "_" room room_${folder})
  add_library(${room} OBJECT ${ARG_SOURCES})
  set_target_properties(${room} PROPERTIES
    POSITION_INDEPENDENT_CODE ON
    CXX_VISIBILITY_PRESET hidden  # but for what include/ declares
    VISIBILITY_INLINES_HIDDEN ON)
  target_include_directories(${room} PRIVATE ${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/include)
  # The same bits on all processors; and the filters of core/exact are proved for separate roundings.
  target_compile_options(${room} PRIVATE -ffp-contract=off)
  target_link_libraries(${room} PRIVATE glm::glm ${ARG_USES})
  set_property(GLOBAL APPEND PROPERTY KINEMESH_ROOMS ${room})
  set_property(GLOBAL APPEND PROPERTY KINEMESH_USES_OF_${room} ${ARG_USES})
endfunction()

# kinemesh_library(NAME FOLDERS...): the rooms since the last one as a static library kinemesh_NAME, on top of
# FOLDERS; for our own programs and tests. Others link kinemesh::kinemesh (c/CMakeLists.txt).
function(kinemesh_library name)
  set(target kinemesh_${name})
  get_property(rooms GLOBAL PROPERTY KINEMESH_ROOMS)
  set_property(GLOBAL PROPERTY KINEMESH_ROOMS "")
  if(name MATCHES "^(core|motion|untangle|sim)$")
    set_property(GLOBAL APPEND PROPERTY KINEMESH_LIBRARY_ROOMS ${rooms})
  endif()
  add_library(${target} STATIC)
  add_library(kinemesh::${name} ALIAS ${target})
  foreach(room ${rooms})
    get_property(uses GLOBAL PROPERTY KINEMESH_USES_OF_${room})
    target_sources(${target} PRIVATE $<TARGET_OBJECTS:${room}>)
    target_link_libraries(${target} PRIVATE ${uses})
  endforeach()
  set_target_properties(${target} PROPERTIES LINKER_LANGUAGE CXX)
  target_include_directories(${target} PUBLIC
    ${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/include)
  target_compile_features(${target} PUBLIC cxx_std_20)
  list(TRANSFORM ARGN PREPEND kinemesh_)
  target_link_libraries(${target} PUBLIC glm::glm ${ARGN})
endfunction()
