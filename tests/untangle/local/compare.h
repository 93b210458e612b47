// Fast exploration against the oracle, and how often each rare path was taken.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "core/mesh_data.h"

namespace kinemesh::test {

struct Counts {
  int tangles = 0, tangled = 0, skipped = 0;  // meshes; with inverted faces; not in general position
  int seeds = 0, regions = 0;                 // inverted faces explored from; inverted components
  int minima = 0;                             // regions that were compared with the minimum over all subsets
  int extended = 0;                           // seeds whose region has more components than the seed's
  int gamma_2 = 0, grown = 0, grown_twice = 0;  // seeds
  int overstepped = 0;                          // seeds from which walking whole faces takes more
  int self_overlapping = 0;                     // seeds
  int largest = 0;                              // faces of a region
};
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
