#include "kinemesh/strategy.h"

#include <algorithm>
#include <functional>
#include <numeric>

namespace kinemesh {
namespace {

template <class Member>
int total(const std::vector<RegionRecord>& regions, const Member& member) {
  return std::transform_reduce(regions.begin(), regions.end(), 0, std::plus<>(), member);
}

}  // namespace

int RepairRecord::region_faces() const {
  return total(regions, [](const RegionRecord& r) { return static_cast<int>(r.faces.size()); });
}

int RepairRecord::region_faces_max() const {
  int largest = 0;
  for (const auto& region : regions) largest = std::max(largest, static_cast<int>(region.faces.size()));
  return largest;
}

int RepairRecord::explored() const {
  return total(regions, [](const RegionRecord& r) { return r.explored; });
}

int RepairRecord::crease_edges() const {
  return total(regions, [](const RegionRecord& r) { return r.crease_edges; });
}

int RepairRecord::retries() const {
  return total(regions, [](const RegionRecord& r) { return r.retries; });
}

}  // namespace kinemesh
