// What is done for the shape of the faces after each step's repair, chosen by name.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/mesh.h"
#include "untangle/strategy.h"

namespace kinemesh {

class QualityPass {
 public:
  virtual ~QualityPass() = default;

  // What has changed since the last call: `before`, the positions of all vertices at that time, or nothing if
  // this is the first and anything may be as it likes; and the regions replaced since. Returns the number of
  // edges flipped. Pre: the mesh is valid; it stays so, its labels and constrained edges with it. Memory is
  // taken when the pass is made: this does not throw, and there is nothing in it that could fail.
  // Deterministic, whatever the number of threads.
  virtual int improve(Mesh& mesh, std::span<const Point> before, std::span<const RegionRecord> replaced) = 0;

  // True if improve() may write positions.
  virtual bool moves_vertices() const { return false; }

  // Faces that flips of the last call have rewritten, each once; the mesh's numbers, padding included.
  virtual std::span<const int> flipped_faces() const { return {}; }
};

struct QualityInfo {
  std::string name;
  std::string description;                                        // one line for `kinemesh list`
  std::function<std::unique_ptr<QualityPass>(const Mesh&)> make;  // for meshes of this one's size
};

// none, delaunay and smooth. An unknown name is an InputError.
std::span<const QualityInfo> qualities();
std::unique_ptr<QualityPass> make_quality(std::string_view name, const Mesh& mesh);

}  // namespace kinemesh
