#include "untangle/quality/quality_pass.h"

#include "core/base/registry.h"
#include "untangle/quality/angles.h"
#include "untangle/quality/delaunay_upkeep.h"
#include "untangle/quality/vertex_sweeps.h"

namespace kinemesh {
namespace {

class NoQuality : public QualityPass {
 public:
  QualityCounts improve(Mesh&, const QualityInputs&) override { return {}; }
};

class SmoothQuality : public QualityPass {
 public:
  SmoothQuality(const Mesh& mesh, const VertexFreedom& freedom) : sweeps_(mesh, freedom.held) {}
  bool moves_vertices() const override { return true; }
  QualityCounts improve(Mesh& mesh, const QualityInputs& inputs) override {
    const SmoothingOptions options{.method = SmoothingMethod::Laplacian, .max_sweeps = 5};
    return {.moves = sweeps_.run(mesh, options, inputs.stays).moves};
  }
  std::span<const MovedVertex> moved_vertices() const override { return sweeps_.moved_vertices(); }

 private:
  VertexSweeps sweeps_;
};

std::unique_ptr<QualityPass> make_none(const Mesh&, const QualityOptions&) {
  return std::make_unique<NoQuality>();
}

std::unique_ptr<QualityPass> make_delaunay(const Mesh& mesh, const QualityOptions&) {
  return std::make_unique<DelaunayUpkeep>(mesh);
}

std::unique_ptr<QualityPass> make_smooth(const Mesh& mesh, const QualityOptions& options) {
  return std::make_unique<SmoothQuality>(mesh, options.freedom);
}

std::unique_ptr<QualityPass> make_angles(const Mesh& mesh, const QualityOptions& options) {
  return std::make_unique<AngleUpkeep>(mesh, AngleOptions{.angle = options.angle}, options.freedom);
}

const Registry<QualityInfo>& registry() {
  static const Registry<QualityInfo> all(
      "quality",
      {
          {"none", "leaves faces as the repair made them", make_none},
          {"delaunay", "flips edges until the mesh is the constrained Delaunay triangulation", make_delaunay},
          {"smooth", "moves free vertices towards the middle of their neighbours where angles gain",
           make_smooth},
          {"angles",
           "flips edges and moves vertices at faces with an angle below the wanted one, nowhere else",
           make_angles},
      });
  return all;
}

}  // namespace

std::vector<QualityInfo> qualities() {
  return registry().all();
}

std::unique_ptr<QualityPass> make_quality(std::string_view name, const Mesh& mesh,
                                          const QualityOptions& options) {
  return registry().find(name).make(mesh, options);
}

}  // namespace kinemesh
