#include "untangle/quality/quality_pass.h"

#include <algorithm>

#include "core/error.h"
#include "untangle/quality/delaunay_upkeep.h"
#include "untangle/quality/vertex_sweeps.h"

namespace kinemesh {
namespace {

class NoQuality : public QualityPass {
 public:
  explicit NoQuality(const Mesh&) {}
  int improve(Mesh&, std::span<const Point>, std::span<const RegionRecord>) override { return 0; }
};

class SmoothQuality : public QualityPass {
 public:
  explicit SmoothQuality(const Mesh& mesh) : sweeps_(mesh) {}
  bool moves_vertices() const override { return true; }
  int improve(Mesh& mesh, std::span<const Point>, std::span<const RegionRecord>) override {
    sweeps_.run(mesh, {.method = SmoothingMethod::Laplacian, .max_sweeps = 5});
    return 0;
  }

 private:
  VertexSweeps sweeps_;
};

template <class T>
QualityInfo info(const char* name, const char* description) {
  return {name, description, [](const Mesh& mesh) { return std::make_unique<T>(mesh); }};
}

}  // namespace

std::span<const QualityInfo> qualities() {
  static const std::vector<QualityInfo> all{
      info<NoQuality>("none", "leaves faces as the repair made them"),
      info<DelaunayUpkeep>("delaunay",
                           "flips edges until the mesh is the constrained Delaunay triangulation"),
      info<SmoothQuality>("smooth",
                          "moves free vertices towards the middle of their neighbours where angles gain"),
  };
  return all;
}

std::unique_ptr<QualityPass> make_quality(std::string_view name, const Mesh& mesh) {
  std::string known;
  for (const auto& quality : qualities()) {
    if (quality.name == name) return quality.make(mesh);
    known += (known.empty() ? "" : ", ") + quality.name;
  }
  throw InputError("no quality is named '" + std::string(name) + "'; known are: " + known);
}

}  // namespace kinemesh
