// What every repair must hold, as functions from a seed to a sentence: empty where it holds. Tests run
// thousands of seeds, scripts/sweep.sh as many as one likes.
#pragma once

#include <cstdint>
#include <string>

#include "core/mesh.h"
#include "untangle/strategy.h"

namespace kinemesh::test {

// Between a mesh before its repair and after it: valid; positions, everything outside the regions, the border
// and the user's numbering untouched; regions disjoint; a second repair finds nothing to do.
std::string contract_broken(const Mesh& before, const Mesh& after, const RepairOutcome& outcome);

// Regions are the pieces of phi(I)* with the right counts, in the order of their seeds. Pre: general
// position.
std::string regions_wrong(const Mesh& before, const RepairRecord& record);

// Repairs, and checks all of the above; `remesh` must agree that a valid mesh exists.
std::string check_random_tangle(std::uint64_t seed);

// The same without retries, three steps in a row, wherever no vertices coincide and no constraint is touched;
// elsewhere the failure is the true one and leaves everything as it was.
std::string check_lattice_tangle(std::uint64_t seed);

}  // namespace kinemesh::test
