// What a step does after its move, to a fresh mesh, against CGAL's triangulation of the same points.
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <stdexcept>
#include <string>

#include "aims.h"
#include "core/base/stopwatch.h"
#include "kinemesh/measure.h"
#include "sim/step/threads.h"
#include "untangle/quality/quality_pass.h"

namespace kinemesh::aims {
namespace {

constexpr int repeats = 5;

struct Regime {
  std::string what;
  std::function<Move(int n)> move;
  std::string strategy = "global";
  std::string quality = "none";
  Aim::Kind kind = Aim::Kind::AtLeast;
  double aim;  // times as fast; at most: times as long
};

auto jitter(double amplitude) {
  return [amplitude](int n) { return jitter_of(n, amplitude); };
}

const Regime regimes[] = {
    {.what = "rotor", .move = rotor_of, .aim = 100.0},
    {.what = "jitter 0.01", .move = jitter(0.01), .aim = 120.0},
    {.what = "jitter 0.05", .move = jitter(0.05), .aim = 40.0},
    {.what = "jitter 0.2", .move = jitter(0.2), .aim = 6.0},
    {.what = "jitter 1.0 with auto",
     .move = jitter(1.0),
     .strategy = "auto",
     .kind = Aim::Kind::AtMost,
     .aim = 1.1},
    {.what = "jitter 0.01 kept Delaunay", .move = jitter(0.01), .quality = "delaunay", .aim = 12.0},
};

// From the smallest number on, and then ascending.
std::vector<Triangle> sorted_triangles(const Mesh& mesh) {
  auto triangles = mesh.domain().triangles;
  for (auto& t : triangles) std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

// Repairs the same tangles again and again, and does for the mesh what Stepper does afterwards.
class Contestant {
 public:
  Contestant(const std::string& strategy, const std::string& quality, const Move& move)
      : move_(move), strategy_(make_strategy(strategy)), quality_(make_quality(quality, move.mesh)) {
    minima_before_.reset(move.mesh.n_faces());
    minima_before_.update(move.mesh);
    moved_.find(move.mesh.positions(), move.mesh.positions());
    minima_before_.outdate_moved(move.mesh, &moved_);  // a step in which nothing moves
    moved_.find(move.mesh.positions(), move.positions);
  }

  void step() {
    Mesh mesh = moved(move_);
    minima_ = minima_before_;
    const Stopwatch stepping;
    kinemesh::Move move({}, move_.mesh.positions());
    move.know(&minima_, &moved_);
    const auto outcome = strategy_->repair(mesh, move);
    require_valid(outcome);
    quality_->improve(mesh, {.before = move_.mesh.positions(), .replaced = outcome.record.regions});
    const Stopwatch measuring;
    for (const auto& region : outcome.record.regions)
      minima_.outdate({region.faces.data(), region.faces.size()});
    minima_.outdate(quality_->flipped_faces());
    min_angle_deg_ = degrees(minima_.update(mesh).tangent);
    measuring_.push_back(measuring.milliseconds());
    step_.push_back(stepping.milliseconds());
    replaced_ = 100.0 * outcome.record.replaced / mesh.n_faces();
    triangulating_.push_back(outcome.record.triangulate_ms);
    require_valid(mesh);
    if (!(min_angle_deg_ > 0.0)) throw std::logic_error("a valid mesh without angles");
    triangles_ = sorted_triangles(mesh);
  }

  double step_ms() const { return median(step_); }
  double measuring_ms() const { return median(measuring_); }
  double triangulating_ms() const { return median(triangulating_); }
  double replaced() const { return replaced_; }  // per cent
  const std::vector<Triangle>& triangles() const { return triangles_; }

 private:
  const Move& move_;
  std::unique_ptr<Strategy> strategy_;
  std::unique_ptr<QualityPass> quality_;
  FaceMinima minima_before_, minima_;  // of the mesh before the move, which is where each step starts
  MovedBlocks moved_;
  std::vector<double> step_, measuring_, triangulating_;  // ms
  double replaced_ = 0.0, min_angle_deg_ = 0.0;
  std::vector<Triangle> triangles_;  // after the last step
};

void measure(const Regime& regime, int n) {
  const Move move = regime.move(n);
  Contestant ours(regime.strategy, regime.quality, move), rebuild("remesh", "none", move);
  for (int i = 0; i < repeats; ++i) {
    ours.step();
    rebuild.step();
  }
  const bool has_to_be_equal = regime.quality == "delaunay";
  if (has_to_be_equal && ours.triangles() != rebuild.triangles())
    throw std::logic_error("another triangulation than the rebuild's");
  const double step = ours.step_ms(), cgal = rebuild.triangulating_ms(), whole = rebuild.step_ms();
  const auto detail = fmt::format(
      "{:.3g} % replaced; step {:.4g} ms; of it {:.4g} to measure angles and areas; CGAL alone {:.4g} ms; "
      "whole "
      "re-mesh step {:.4g} ms{}",
      ours.replaced(), step, ours.measuring_ms(), cgal, whole, has_to_be_equal ? "; the same triangles" : "");
  if (regime.kind == Aim::Kind::AtLeast)
    return report({regime.what + ": CGAL's rebuild / step", regime.kind, regime.aim, cgal / step, detail});
  report({regime.what + ": step / CGAL's rebuild", regime.kind, regime.aim, step / cgal, detail});
  report({regime.what + ": step / whole step of `remesh`", regime.kind, regime.aim, step / whole, detail});
}

}  // namespace

void whole_steps(int n) {
  const ThreadLimit one(1);
  for (const auto& regime : regimes) measure(regime, n);
}

}  // namespace kinemesh::aims
