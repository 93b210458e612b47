set(KINEMESH_GEOMETRY_TESTS
  compare_areas_test.cpp
  exact_oracle.cpp
  kinetic_predicates_test.cpp
  predicates_test.cpp
  contacts_test.cpp
  safe_step_test.cpp
  shapes_test.cpp)
