#include "untangle/flips.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/compare_areas.h"
#include "core/predicates.h"
#include "core/stopwatch.h"
#include "untangle/quality/around.h"
#include "untangle/records.h"
#include "untangle/stuck.h"

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

Flip flip_of(const Mesh& mesh, int edge) {
  const int h = 2 * edge, o = Mesh::opposite(h);
  const Point &a = mesh.position(mesh.to(o)), &b = mesh.position(mesh.to(h));
  const Point &c = mesh.position(mesh.to(mesh.next(h))), &d = mesh.position(mesh.to(mesh.next(o)));
  return {{{{a, b, c}, {b, a, d}}}, {{{d, b, c}, {c, a, d}}}};
}

double inverted_area(const Pair& pair) {
  double sum = 0.0;
  for (const auto& [a, b, c] : pair.faces)
    sum += std::max(0.0, (b.y - a.y) * (c.x - a.x) - (b.x - a.x) * (c.y - a.y));
  return sum;
}

// Twice what a flip takes off the inverted area; rounded, and 0 where that overflows.
double gain_of(const Mesh& mesh, int edge) {
  const auto [before, after] = flip_of(mesh, edge);
  const double gain = inverted_area(before) - inverted_area(after);
  return std::isfinite(gain) ? gain : 0.0;
}

bool are_joined(const Mesh& mesh, int v, int w) {
  bool found = false;
  for_each_outgoing(mesh, v, [&](int h) { found |= mesh.to(h) == w; });
  return found;
}

bool would_double(const Mesh& mesh, int edge) {
  const int c = mesh.to(mesh.next(2 * edge)), d = mesh.to(mesh.next(2 * edge + 1));
  return c == d || are_joined(mesh, c, d);
}

}  // namespace

// The signed areas of both faces have a sum T that no flip changes. Neither inverted: the inverted area is 0.
// Neither upright: it is -T, and the least there can be. One of each: it is that of the inverted one, which
// is more than both of these.
bool flip_untangles(const Mesh& mesh, int edge) {
  const auto [before, after] = flip_of(mesh, edge);
  if (before.is_folded()) {
    return !after.is_folded() ||
           compare_areas(after.faces[after.inverted()], before.faces[before.inverted()]) > 0;
  }
  return after.is_upright() && !before.is_upright();  // one was flat
}

// Takes all flips back when it goes out of scope.
class EdgeFlips::Run {
 public:
  Run(EdgeFlips& scratch, Mesh& mesh) : mesh_(mesh), rewritten_(scratch.rewritten_), queue_(scratch.queue_) {
    rewritten_.reset(mesh.n_faces());
    queue_.clear();
  }
  ~Run() {
    std::reverse(before_.outgoing.begin(),
                 before_.outgoing.end());  // the first that was noted is the last set
    mesh_.splice(before_);
  }
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  void flip_all(const Tangles& tangles) {
    for (const int face : tangles.inverted) push_sides(face);
    for (const int face : tangles.flat) push_sides(face);
    int flips_before = none;
    while (!queue_.empty() && n_flips_ != flips_before) {
      flips_before = n_flips_;
      while (!queue_.empty()) visit(pop());
      for (const int edge : std::exchange(blocked_, {})) push(edge);
    }
  }

  // Of the faces that were tangled at first or have been rewritten: no other can be.
  Tangles left(const Tangles& tangles) const {
    std::vector<int> faces = before_.faces;
    faces.insert(faces.end(), tangles.inverted.begin(), tangles.inverted.end());
    faces.insert(faces.end(), tangles.flat.begin(), tangles.flat.end());
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    return tangles_among(mesh_, faces);
  }

  // What the flips have made of the mesh.
  Patch result() const { return mesh_.inverse_of(before_); }

 private:
  void push_sides(int face) {
    for (const int side : mesh_.sides(face)) push(Mesh::edge_of(side));
  }

  void push(int edge) {
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
    const int edge = candidate.edge;
    if (candidate.gain != gain_of(mesh_, edge) || !flip_untangles(mesh_, edge)) return;
    if (would_double(mesh_, edge)) {
      blocked_.push_back(edge);  // until the other edge goes
      return;
    }
    flip(edge);
    for (const int h : {2 * edge, 2 * edge + 1}) push_sides(mesh_.face_of(h));
  }

  void flip(int edge) {
    const int left = note(mesh_.face_of(2 * edge)), right = note(mesh_.face_of(2 * edge + 1));
    if (left != right) join(left, right);
    mesh_.flip(edge);
    ++n_flips_;
  }

  // Keeps what the face is before its first flip, the number of faces last: memory may run out on the way.
  int note(int face) {
    if (rewritten_.set_of(face) != none) return rewritten_.set_of(face);
    for (const int v : mesh_.triangles()[face]) before_.outgoing.push_back({v, mesh_.outgoing(v)});
    before_.triangles.push_back(mesh_.triangles()[face]);
    before_.labels.push_back(mesh_.label(face));
    before_.halfedges.push_back(mesh_.sides(face));
    before_.faces.push_back(face);
    rewritten_.add(face, rewritten_.open());
    return rewritten_.set_of(face);
  }

  void join(int s, int t) {
    const bool t_is_larger = rewritten_.faces(t).size() > rewritten_.faces(s).size();
    rewritten_.absorb(t_is_larger ? t : s, t_is_larger ? s : t);
  }

  Mesh& mesh_;
  FaceSets& rewritten_;
  std::vector<Candidate>& queue_;  // a heap
  std::vector<int> blocked_;       // edges whose flips would double others
  int n_flips_ = 0;
  Patch before_;  // the faces that have been rewritten, as they were
};

RepairOutcome EdgeFlips::repair(Mesh& mesh, const RepairOptions& options) {
  RepairOutcome outcome;
  auto& record = outcome.record;
  const Stopwatch detecting;
  const auto tangles = detect(mesh);
  record.inverted = static_cast<int>(tangles.inverted.size());
  record.degenerate = static_cast<int>(tangles.flat.size());
  record.components = inverted_components(mesh, tangles.inverted).count;
  record.detect_ms = detecting.milliseconds();

  const Stopwatch flipping;
  Patch patch;
  if (!tangles.empty()) {
    Run run(*this, mesh);
    run.flip_all(tangles);
    const auto left = run.left(tangles);
    if (left.empty())
      patch = run.result();
    else
      outcome.defect = stuck_defect(mesh, left, "edge flips");
  }
  record.triangulate_ms = flipping.milliseconds();
  if (outcome.defect) return outcome;

  const Stopwatch splicing;
  splice(mesh, patch, record);
  record.escaped = count_escaped(mesh, options);
  record.splice_ms = splicing.milliseconds();
  return outcome;
}

void EdgeFlips::splice(Mesh& mesh, const Patch& patch, RepairRecord& record) {
  record.replaced = static_cast<int>(patch.faces.size());
  for (int set = 0; record.replaced > 0 && set < rewritten_.count(); ++set) {
    if (rewritten_.faces(set).empty()) continue;  // joined another
    rewritten_.sort(set);
    record.regions.push_back(describe_region(mesh, rewritten_, set));
  }
  std::sort(record.regions.begin(), record.regions.end(), seeded_before);
  mesh.splice(patch);
}

}  // namespace kinemesh
