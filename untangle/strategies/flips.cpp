#include "untangle/strategies/flips.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/stopwatch.h"
#include "core/exact/compare_areas.h"
#include "core/mesh/around.h"
#include "core/mesh/undo.h"
#include "kinemesh/predicates.h"
#include "untangle/fill/hole.h"
#include "untangle/fill/records.h"
#include "untangle/walk/stuck.h"

namespace kinemesh {
namespace {

using Corners3 = std::array<Point, 3>;

// The two faces beside an edge, or those that a flip would leave.
struct Pair {
  Corners3 faces[2];

  Orientation turn(int i) const { return orientation(faces[i][0], faces[i][1], faces[i][2]); }
  int inverted() const {  // one of them, or none
    return turn(0) == Orientation::Clockwise ? 0 : turn(1) == Orientation::Clockwise ? 1 : none;
  }
  bool has(Orientation o) const { return turn(0) == o || turn(1) == o; }
  // One is inverted and the other upright.
  bool is_folded() const { return has(Orientation::Clockwise) && has(Orientation::CounterClockwise); }
  bool is_upright() const { return !has(Orientation::Clockwise) && !has(Orientation::Collinear); }
};

// As Mesh::flip has it: faces abc and bad become dbc and cad.
struct Flip {
  Pair before, after;
};

Flip flip_of(const Mesh& mesh, Side edge) {
  const Point &a = mesh.position(mesh.from(edge)), &b = mesh.position(mesh.to(edge));
  const Point &c = mesh.position(mesh.apex(edge)), &d = mesh.position(mesh.apex(mesh.opposite(edge)));
  return {{{{a, b, c}, {b, a, d}}}, {{{d, b, c}, {c, a, d}}}};
}

double inverted_area(const Pair& pair) {
  double sum = 0.0;
  for (const auto& [a, b, c] : pair.faces)
    sum += std::max(0.0, (b.y - a.y) * (c.x - a.x) - (b.x - a.x) * (c.y - a.y));
  return sum;
}

// Twice what a flip takes off the inverted area; rounded, and 0 where that overflows.
double gain_of(const Mesh& mesh, Side edge) {
  const auto [before, after] = flip_of(mesh, edge);
  const double gain = inverted_area(before) - inverted_area(after);
  return std::isfinite(gain) ? gain : 0.0;
}

bool would_double(const Mesh& mesh, Side edge) {
  const Vertex c = mesh.apex(edge), d = mesh.apex(mesh.opposite(edge));
  return c == d || are_joined(mesh, c, d);
}

// Of the faces that were tangled at first or have been rewritten: no other can be.
Tangles tangles_left(const Mesh& mesh, const Tangles& first, std::vector<Face> rewritten) {
  rewritten.insert(rewritten.end(), first.inverted.begin(), first.inverted.end());
  rewritten.insert(rewritten.end(), first.flat.begin(), first.flat.end());
  std::sort(rewritten.begin(), rewritten.end());
  rewritten.erase(std::unique(rewritten.begin(), rewritten.end()), rewritten.end());
  return tangles_among(mesh, rewritten);
}

}  // namespace

// The signed areas of both faces have a sum T that no flip changes. Neither inverted: the inverted area is 0.
// Neither upright: it is -T, and the least there can be. One of each: it is that of the inverted one, which
// is more than both of these.
bool flip_untangles(const Mesh& mesh, Side edge) {
  const auto [before, after] = flip_of(mesh, edge);
  if (before.is_folded()) {
    return !after.is_folded() ||
           compare_areas(after.faces[after.inverted()], before.faces[before.inverted()]) > 0;
  }
  return after.is_upright() && !before.is_upright();  // one was flat
}

class EdgeFlips::Run {
 public:
  Run(EdgeFlips& scratch, Undo& undo)
      : undo_(undo), mesh_(undo.mesh()), rewritten_(scratch.rewritten_), queue_(scratch.queue_) {
    rewritten_.reset(mesh_.n_faces());
    queue_.clear();
  }

  void flip_all(const Tangles& tangles) {
    for (const Face face : tangles.inverted) push_sides(face);
    for (const Face face : tangles.flat) push_sides(face);
    int flips_before = none;
    while (!queue_.empty() && n_flips_ != flips_before) {
      flips_before = n_flips_;
      while (!queue_.empty()) visit(pop());
      for (const Side side : std::exchange(blocked_, {})) push(side);
    }
  }

 private:
  void push_sides(Face face) {
    for (const Side side : Mesh::sides(face)) push(side);
  }

  void push(Side side) {
    const Side edge = mesh_.lower(side);
    if (!mesh_.is_flippable(edge) || !flip_untangles(mesh_, edge)) return;
    queue_.push_back({gain_of(mesh_, edge), edge});
    std::push_heap(queue_.begin(), queue_.end());
  }

  Candidate pop() {
    std::pop_heap(queue_.begin(), queue_.end());
    const auto last = queue_.back();
    queue_.pop_back();
    return last;
  }

  // Flips beside an edge have put it into the queue again, and what was in there before means nothing.
  void visit(const Candidate& candidate) {
    const Side edge = mesh_.lower(candidate.side);
    if (!mesh_.is_flippable(edge) || candidate.gain != gain_of(mesh_, edge) || !flip_untangles(mesh_, edge))
      return;
    if (would_double(mesh_, edge)) {
      blocked_.push_back(candidate.side);  // until the other edge goes
      return;
    }
    const Face left = Mesh::face_of(edge), right = mesh_.face_across(edge);
    flip(edge);
    push_sides(left);
    push_sides(right);
  }

  void flip(Side edge) {
    const int left = set_of(Mesh::face_of(edge)), right = set_of(mesh_.face_across(edge));
    if (left != right) join(left, right);
    undo_.flip(edge);
    ++n_flips_;
  }

  int set_of(Face face) {
    if (rewritten_.set_of(face) == none) rewritten_.add(face, rewritten_.open());
    return rewritten_.set_of(face);
  }

  void join(int s, int t) {
    const bool t_is_larger = rewritten_.faces(t).size() > rewritten_.faces(s).size();
    rewritten_.absorb(t_is_larger ? t : s, t_is_larger ? s : t);
  }

  Undo& undo_;
  const Mesh& mesh_;
  FaceSets& rewritten_;
  std::vector<Candidate>& queue_;  // a heap
  std::vector<Side> blocked_;      // sides of edges whose flips would double others
  int n_flips_ = 0;
};

RepairOutcome EdgeFlips::repair(Mesh& mesh, const Move& move) {
  RepairOutcome outcome;
  auto& record = outcome.record;
  const auto tangles = detect(mesh, move, record);
  record.components = inverted_components(mesh, tangles.inverted).count;

  const Stopwatch flipping;
  Undo undo(mesh);
  Run(*this, undo).flip_all(tangles);
  const auto faces = rewritten_faces();
  const auto left = tangles_left(mesh, tangles, faces);
  record.triangulate_ms = flipping.milliseconds();
  if (!left.empty()) {
    outcome.defect = stuck_defect(mesh, left, "edge flips");
    return outcome;
  }

  // Regions are described as they were.
  const Stopwatch describing;
  record.escaped = count_escaped(mesh, move.options());
  undo.look_back(faces, [&] { record.regions = describe_regions(mesh); });
  record.replaced = static_cast<int>(faces.size());
  record.splice_ms = describing.milliseconds();
  return outcome;
}

// Ascending; sorts the sets.
std::vector<Face> EdgeFlips::rewritten_faces() {
  std::vector<Face> faces;
  for (int set = 0; set < rewritten_.count(); ++set) {
    rewritten_.sort(set);
    faces.insert(faces.end(), rewritten_.faces(set).begin(), rewritten_.faces(set).end());
  }
  std::sort(faces.begin(), faces.end());
  return faces;
}

std::vector<RegionRecord> EdgeFlips::describe_regions(const Mesh& mesh) const {
  std::vector<RegionRecord> records;
  Hole hole;
  for (int set = 0; set < rewritten_.count(); ++set) {
    if (rewritten_.faces(set).empty()) continue;  // joined another
    hole.dig(mesh, rewritten_, set);
    records.push_back(describe_region(mesh, hole));
  }
  std::sort(records.begin(), records.end(), is_seeded_before);
  return records;
}

}  // namespace kinemesh
