# The part of the library untangle that improves meshes.
set(KINEMESH_QUALITY_SOURCES
  quality/delaunay_flipping.cpp
  quality/optimal_point.cpp
  quality/smoothing.cpp)
