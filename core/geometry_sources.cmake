set(KINEMESH_GEOMETRY_SOURCES
  exact.cpp
  predicates.cpp
  refine.cpp
  shapes.cpp
  shapes_graded.cpp
  shapes_random.cpp
  shapes_umbilic.cpp)
