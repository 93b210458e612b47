# Shared by the tests and the sweep.
set(KINEMESH_TANGLE_SOURCES
  ../core/sample_meshes.cpp
  ../core/snapshot.cpp
  in_motion.cpp
  in_turn.cpp
  oracle.cpp
  properties.cpp
  random_tangles.cpp)
