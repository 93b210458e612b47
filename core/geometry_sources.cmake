set(KINEMESH_GEOMETRY_SOURCES
  exact.cpp
  predicates.cpp)
