// Fast exploration against the oracle, and how often each rare path was taken.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "kinemesh/mesh_data.h"

namespace kinemesh::test {

// By components, of which each was compared from all its faces.
struct Counts {
  int tangled = 0, valid = 0, degenerate = 0;  // meshes; degenerate ones are left out
  int seeds = 0;                               // inverted faces explored from
  int regions = 0;                             // inverted components
  int minima = 0;                              // compared with the minimum over all subsets
  int extended = 0;                            // further components in the region
  int gamma_2 = 0;                             // gamma >= 2 when extending first came to rest: shadows grow
  int grown_twice = 0;
  int overstepped = 0;            // walking whole faces takes more; not counted where shadows grow
  int self_overlapping = 0;       // border of R* not simple
  int self_overlapping_here = 0;  // over the component's own shadow: gamma counts lifts, not faces
  int largest = 0;                // faces of a region
};
// One "number what" a line.
std::ostream& operator<<(std::ostream& out, const Counts& counts);

struct CompareOptions {
  int subsets = 8;         // components up to which all their sets are tried
  int lifts = 4000;        // and lifts
  bool every_seed = true;  // or one of each component only
};

// Explores from every inverted face of the mesh and compares with the oracle's region. Failures name the
// face, and `name`. The mesh of a failure is written as NAME.off to the tests' temporary folder.
void compare(const MeshData& tangle, const std::string& name, Counts& counts,
             const CompareOptions& options = {});

}  // namespace kinemesh::test
