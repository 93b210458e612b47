# The part of the library untangle that improves meshes.
set(KINEMESH_QUALITY_SOURCES
  quality/angles.cpp
  quality/delaunay_flipping.cpp
  quality/delaunay_upkeep.cpp
  quality/joint_star.cpp
  quality/max_min_area.cpp
  quality/optimal_point.cpp
  quality/quality_pass.cpp
  quality/smoothing.cpp
  quality/star.cpp
  quality/vertex_sweeps.cpp)
