// What every repair must hold, as functions from a seed to a sentence: empty where it holds. Tests run
// thousands of seeds, scripts/sweep.sh as many as one likes.
#pragma once

#include <cstdint>
#include <string>

#include "kinemesh/mesh.h"
#include "kinemesh/strategy.h"

namespace kinemesh::test {

// Only the faces of the record's regions, and what lies between them, may change.
std::string outside_changed(const Mesh& before, const Mesh& after, const RepairRecord& record);

// Between a mesh before its repair and after it: valid; positions, everything outside the regions, the border
// and the user's numbering untouched; regions disjoint; a second repair finds nothing to do.
std::string contract_broken(const Mesh& before, const Mesh& after, const RepairOutcome& outcome);

// Regions are the pieces of phi(I)* with the right counts, in the order of their seeds. Pre: general
// position.
std::string regions_wrong(const Mesh& before, const RepairRecord& record);

// Repairs the mesh where a valid one exists, without retries; elsewhere the failure is the true one and
// leaves everything as it was. `rigid`: constrained edges have moved without changing shape, so that vertices
// which coincide or touch them are all that can go wrong.
std::string check_step(Mesh& mesh, bool rigid);

// Repairs, and checks the contract and the regions; `remesh` must agree that a valid mesh exists.
std::string check_random_tangle(std::uint64_t seed);

// Three steps in a row. A polyomino's borders and interfaces change their shape, and may turn over without
// touching anything.
std::string check_lattice_tangle(std::uint64_t seed);
std::string check_polyomino_tangle(std::uint64_t seed);

}  // namespace kinemesh::test
