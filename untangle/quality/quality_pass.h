// What is done for the shape of the faces after each step's repair, chosen by name.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/sweep/face_minima.h"
#include "kinemesh/detail/vertex_freedom.h"
#include "kinemesh/mesh.h"
#include "kinemesh/strategy.h"

namespace kinemesh {

// What has changed since the last call, or the start.
struct QualityInputs {
  // The positions of all vertices at that time, or nothing if this is the first call and anything may be as
  // it likes.
  std::span<const Point> before{};
  std::span<const RegionRecord> replaced{};
  // Of the mesh as it is, all that is outdated marked so, or null. What is outdated may be measured; what the
  // pass changes is not marked: flipped_faces() and the faces around moved_vertices().
  FaceMinima* minima = nullptr;
  std::span<const char>
      stays{};  // per vertex: is not moved by this call, besides those never moved; empty: none
};

struct QualityCounts {
  int flips = 0;  // edges, each as often as it was flipped
  int moves = 0;  // vertices, likewise
};

struct MovedVertex {
  Vertex vertex;
  Point before{0.0, 0.0};
};

class QualityPass {
 public:
  virtual ~QualityPass() = default;

  // Pre: the mesh is valid; it stays so, its labels and constrained edges with it. This does not throw, and
  // there is nothing in it that could fail: memory is taken when the pass is made, or the pass ends early
  // without it. Deterministic, whatever the number of threads.
  virtual QualityCounts improve(Mesh& mesh, const QualityInputs& inputs) = 0;

  // True if improve() may write positions.
  virtual bool moves_vertices() const { return false; }

  // Faces that flips of the last call have rewritten, each once; the mesh's numbers, padding included.
  virtual std::span<const Face> flipped_faces() const { return {}; }

  // Vertices that the last call has moved, each once, and where they were before it; the mesh's numbers.
  virtual std::span<const MovedVertex> moved_vertices() const { return {}; }
};

// What passes that want to know it are told.
struct QualityOptions {
  double angle = 25.0;         // see AngleOptions; for angles
  VertexFreedom freedom = {};  // likewise
};

struct QualityInfo {
  std::string name;
  std::string description;  // one line for `kinemesh list`
  std::function<std::unique_ptr<QualityPass>(const Mesh&, const QualityOptions&)>
      make;  // for meshes of this one's size
};

// none, delaunay, smooth and angles. An unknown name is an InputError, and so are options that the pass
// refuses.
std::vector<QualityInfo> qualities();
std::unique_ptr<QualityPass> make_quality(std::string_view name, const Mesh& mesh,
                                          const QualityOptions& options = {});

}  // namespace kinemesh
