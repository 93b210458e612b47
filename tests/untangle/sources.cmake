# Shared by the tests and the sweep.
set(KINEMESH_TANGLE_SOURCES
  ../core/mesh/sample_meshes.cpp
  ../core/mesh/snapshot.cpp
  in_motion.cpp
  strategies/in_turn.cpp
  oracle.cpp
  properties.cpp
  random_tangles.cpp)
