// How much memory is taken at most, counted at each allocation: by the sanitizer's hooks where there is one,
// else by operator new and delete, which then are this program's own.
#pragma once

#include <cstddef>

namespace kinemesh::memory_meter {

void start();        // of a measurement
std::size_t peak();  // bytes more than at the start, at any moment since

}  // namespace kinemesh::memory_meter
