#include "untangle/walk/detect.h"

#include <algorithm>
#include <bit>

#include "core/base/parallel.h"
#include "core/sweep/face_sweep.h"
#include "kinemesh/predicates.h"

namespace kinemesh {
namespace {

void judge(const Mesh& mesh, Face f, Tangles& found) {
  const auto [a, b, c] = mesh.corners(f);
  const auto turn = orientation(a, b, c);
  if (turn == Orientation::CounterClockwise) return;
  (turn == Orientation::Clockwise ? found.inverted : found.flat).push_back(f);
}

std::uint64_t look(const Mesh& mesh, int stretch, FaceMinima* minima) {
  if (!minima) return doubtful_in_stretch(mesh, stretch);
  if (minima->is_upright(stretch)) return 0;
  const Sight sight = look_at_stretch(mesh, stretch);
  minima->set(stretch, sight, mesh);
  return sight.doubtful;
}

void sweep(const Mesh& mesh, int stretch, Tangles& found, FaceMinima* minima) {
  for (auto doubtful = look(mesh, stretch, minima); doubtful != 0; doubtful &= doubtful - 1)
    judge(mesh, Face(stretch * stretch_faces + std::countr_zero(doubtful)), found);
}

void append(std::vector<Face>& all, const std::vector<Face>& some) {
  all.insert(all.end(), some.begin(), some.end());
}

// Where a face is among `faces`, which ascend: by a table of all faces where that pays.
class Ranks {
 public:
  Ranks(const Mesh& mesh, std::span<const Face> faces) : faces_(faces) {
    if (static_cast<int>(faces.size()) < mesh.n_faces() / 64) return;
    table_.assign(mesh.n_faces(), none);
    for (std::size_t i = 0; i < faces.size(); ++i) table_[faces[i]] = static_cast<int>(i);
  }
  int of(Face face) const {  // or none
    if (!table_.empty()) return table_[face];
    const auto found = std::lower_bound(faces_.begin(), faces_.end(), face);
    return found != faces_.end() && *found == face ? static_cast<int>(found - faces_.begin()) : none;
  }

 private:
  std::span<const Face> faces_;
  std::vector<int> table_;
};

}  // namespace

Tangles detect(const Mesh& mesh, FaceMinima* minima, const MovedBlocks* moved) {
  if (minima) minima->outdate_moved(mesh, moved);
  const int n = n_stretches(mesh.n_faces());
  std::vector<Tangles> found(n_parts(n, grain::stretches));
  parallel_parts(n, grain::stretches, [&](int part, int begin, int end) {
    for (int stretch = begin; stretch < end; ++stretch) sweep(mesh, stretch, found[part], minima);
  });
  Tangles all;
  for (const auto& part : found) {
    append(all.inverted, part.inverted);
    append(all.flat, part.flat);
  }
  return all;
}

Tangles tangles_among(const Mesh& mesh, std::span<const Face> faces) {
  Tangles found;
  for (const Face face : faces) judge(mesh, face, found);
  return found;
}

Components inverted_components(const Mesh& mesh, std::span<const Face> inverted) {
  const Ranks ranks(mesh, inverted);
  Components components{std::vector<int>(inverted.size(), none), 0};
  std::vector<int> pending;
  for (std::size_t first = 0; first < inverted.size(); ++first) {
    if (components.of[first] != none) continue;
    components.of[first] = components.count;
    pending.push_back(static_cast<int>(first));
    while (!pending.empty()) {
      const Face face = inverted[pending.back()];
      pending.pop_back();
      for (const Side side : Mesh::sides(face)) {
        const Face neighbour = mesh.face_across(side);
        const int rank = neighbour == none ? none : ranks.of(neighbour);
        if (rank == none || components.of[rank] != none) continue;
        components.of[rank] = components.count;
        pending.push_back(rank);
      }
    }
    ++components.count;
  }
  return components;
}

}  // namespace kinemesh
