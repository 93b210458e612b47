#include "untangle/quality/angles.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <numbers>
#include <tuple>
#include <utility>

#include "core/base/parallel.h"
#include "core/mesh/around.h"
#include "kinemesh/error.h"
#include "kinemesh/measure.h"
#include "untangle/places/joint_star.h"

namespace kinemesh {
namespace {

constexpr std::array rings{1, 2, 4, 8};  // of faces around a bad one, whose vertices move together
constexpr double least_gain = 1e-4;      // of the angle
constexpr double rounding = 0x1p-44;     // of tangents up to that of 60 degrees, whichever corner comes first

double tangent_of(double degrees) {
  return std::tan(degrees * std::numbers::pi / 180.0);
}

// Tangents of angles: as tan'' > 0 and tan x - x >= x^3 / 3, what is above the right one is the angle and its
// least gain, at least.
bool is_better(double after, double before) {
  return after > before + least_gain * before * (1.0 + before * before);
}

template <class F>
void for_all(int n, int n_a_task, const F& f) {
  parallel_parts(n, n_a_task, [&](int, int begin, int end) {
    for (int i = begin; i != end; ++i) f(i);
  });
}

// At most this much is in the list already; taking no memory for each by itself.
template <class T>
void make_room(std::vector<T>& list, std::size_t for_more) {
  if (list.capacity() < list.size() + for_more)
    list.reserve(std::max(2 * list.capacity(), list.size() + for_more));
}

const AngleOptions& checked(const AngleOptions& options) {
  if (!(options.angle > 0.0 && options.angle < 60.0))
    throw InputError("angle: degrees above 0 and below 60 expected");
  if (options.max_rounds < 0) throw InputError("max_rounds must be 0 or more");
  return options;
}

// Calls visit(face) for those that a flip of the edge rewrites, or a move of the vertex changes.
template <class Visit>
void for_each_beside(const Mesh& mesh, Side edge, const Visit& visit) {
  visit(Mesh::face_of(edge));
  visit(mesh.face_across(edge));
}

template <class Visit>
void for_each_around(const Mesh& mesh, Vertex vertex, const Visit& visit) {
  for_each_side_from(mesh, vertex, [&](Side side) { visit(Mesh::face_of(side)); });
}

// Of the edge's ends, ascending.
std::pair<UserVertex, UserVertex> users_of(const Mesh& mesh, Side side) {
  return std::minmax({mesh.user_vertex(mesh.from(side)), mesh.user_vertex(mesh.to(side))});
}

// The smallest angles of the two faces beside an edge, and of those that its flip would make; the latter 0 if
// one of them would not be upright, exactly.
struct FlipTangents {
  double before, after;
};

FlipTangents tangents_of_flip(const Mesh& mesh, Side edge) {
  const Point &p = mesh.position(mesh.from(edge)), &q = mesh.position(mesh.to(edge));
  const Point &left = mesh.position(mesh.apex(edge)), &right = mesh.position(mesh.apex(mesh.opposite(edge)));
  const auto smaller = [](const std::array<Point, 3>& a, const std::array<Point, 3>& b) {
    return std::min(tangent_from_any_corner(a), tangent_from_any_corner(b));
  };
  FlipTangents tangents{smaller({p, q, left}, {q, p, right}), smaller({left, p, right}, {right, q, left})};
  const bool is_convex = orientation(left, p, right) == Orientation::CounterClockwise &&
                         orientation(right, q, left) == Orientation::CounterClockwise;
  if (!is_convex) tangents.after = 0.0;
  return tangents;
}

}  // namespace

AngleUpkeep::AngleUpkeep(const Mesh& mesh, const AngleOptions& options, VertexFreedom freedom)
    : options_(checked(options)),
      freedom_(std::move(freedom)),
      wanted_(tangent_of(options.angle)),
      round_(mesh.n_faces(), 0),
      place_of_(mesh.n_vertices(), none),
      is_flipped_(mesh.n_faces(), false),
      is_moved_(mesh.n_vertices(), false) {
  if (!freedom_.held.empty() && static_cast<int>(freedom_.held.size()) != mesh.n_vertices())
    throw InputError("held: one per vertex of the mesh expected, or none");
  const int n_curves = static_cast<int>(freedom_.curves.size());
  for (const auto& [vertex, curve] : freedom_.curve_of)
    if (curve < 0 || curve >= n_curves) throw InputError("curve_of: numbers of curves expected");
}

QualityCounts AngleUpkeep::improve(Mesh& mesh, const QualityInputs& inputs) {
  stays_ = inputs.stays;
  const AngleCounts counts = run(mesh, inputs.minima);
  stays_ = {};
  return {counts.flips, counts.moves};
}

// Memory runs out while thinking only, between what is done, and what is done is noted.
AngleCounts AngleUpkeep::run(Mesh& mesh, FaceMinima* minima) noexcept {
  AngleCounts counts;
  forget();
  try {
    if (!minima) own_minima_.reset(mesh.n_faces());
    find_bad(mesh, minima ? *minima : own_minima_);
    while (!bad_.empty() && counts.rounds < options_.max_rounds && do_round(mesh, counts)) ++counts.rounds;
  } catch (const std::bad_alloc&) {
    counts.is_cut = true;
  }
  counts.left = static_cast<int>(bad_.size());
  return counts;
}

void AngleUpkeep::forget() {
  for (const Face face : flipped_) is_flipped_[face] = false;
  for (const auto& moved : moved_) is_moved_[moved.vertex] = false;
  for (const Place& place : places_) place_of_[place.vertex] = none;
  bad_.clear();
  flipped_.clear();
  moved_.clear();
  places_.clear();
  n_found_ = 0;
  joints_.clear();
}

bool AngleUpkeep::is_bad(const Mesh& mesh, Face face) const {
  return !mesh.is_padding(face) && tangent_from_any_corner(mesh.corners(face)) < wanted_;
}

void AngleUpkeep::find_bad(const Mesh& mesh, FaceMinima& minima) {
  if (!(minima.update(mesh).tangent < wanted_ + rounding)) return;
  for (int begin = 0, n = mesh.n_faces(); begin < n; begin += stretch_faces) {
    if (!(minima.of_stretch(begin / stretch_faces).tangent < wanted_ + rounding)) continue;
    for (Face face(begin); face < std::min(begin + stretch_faces, n); ++face)
      if (is_bad(mesh, face)) bad_.push_back(face);
  }
}

// False if there was nothing to do.
bool AngleUpkeep::do_round(Mesh& mesh, AngleCounts& counts) {
  propose(mesh);
  if (proposals_.empty()) propose_jointly(mesh);
  if (proposals_.empty()) return false;
  choose(mesh);
  carry_out(mesh, counts);
  find_still_bad(mesh);
  return true;
}

void AngleUpkeep::propose(const Mesh& mesh) {
  for (const Face face : bad_)
    for (const Vertex v : mesh.triangles()[face]) ask_for_place(mesh, v);
  find_places(mesh);
  proposals_.resize(bad_.size());
  for_all(static_cast<int>(bad_.size()), grain::places,
          [&](int i) { proposals_[i] = best_at(mesh, bad_[i]); });
  std::erase_if(proposals_, [](const auto& proposal) { return proposal.is_none(); });
}

// What was found before is still right where nothing has changed.
void AngleUpkeep::propose_jointly(const Mesh& mesh) {
  std::erase_if(joints_, [&](const auto& entry) { return is_outdated(entry.second); });
  std::vector<Joint*> asked;
  for (const Face face : bad_)
    if (const auto [at, is_new] = joints_.try_emplace(face, Joint{.face = face}); is_new)
      asked.push_back(&at->second);
  for_all(static_cast<int>(asked.size()), 1, [&](int i) { find_joint(mesh, *asked[i]); });
  for (const Face face : bad_)
    if (const Joint& joint = joints_.at(face); joint.after != 0.0)
      proposals_.push_back(proposal_of(mesh, joint));
}

bool AngleUpkeep::is_outdated(const Joint& joint) const {
  const auto has_changed = [&](Face face) { return round_[face] > joint.round; };
  return has_changed(joint.face) || std::ranges::any_of(joint.faces, has_changed);
}

// As far around the face as it takes, but not beyond a worse one, which looks around itself. If nothing
// helps, with a side flipped.
void AngleUpkeep::find_joint(const Mesh& mesh, Joint& joint) const {
  const double own = tangent_from_any_corner(mesh.corners(joint.face));
  joint.round = n_rounds_;
  for (const int n_rings : rings) {
    if (try_joint(mesh, free_vertices_around(mesh, joint.face, n_rings), none, joint)) return;
    if (joint.before < own) break;
  }
  const auto free = free_vertices_around(mesh, joint.face, rings.front());
  auto sides = Mesh::sides(joint.face);
  std::ranges::sort(sides, {}, [&](Side side) { return users_of(mesh, side); });
  for (const Side side : sides) {
    const Side edge = mesh.lower(side);
    const bool may_flip = mesh.is_flippable(edge) && tangents_of_flip(mesh, edge).after > 0.0;
    if (may_flip && try_joint(mesh, free, edge, joint)) return;
  }
}

// True if it helps.
bool AngleUpkeep::try_joint(const Mesh& mesh, std::span<const FreeVertex> free, Side edge,
                            Joint& joint) const {
  const JointStar star(mesh, free, edge);
  joint.faces.assign(star.faces().begin(), star.faces().end());
  joint.before = star.tangent();
  const std::vector<Point> places = star.best_places();
  const double after = star.tangent_at(places);
  if (!is_better(after, joint.before) || !star.is_upright_at(places)) return false;
  joint.after = after;
  joint.edge = edge;
  for (std::size_t i = 0; i < free.size(); ++i)
    joint.moves.push_back({.vertex = free[i].vertex, .where = places[i]});
  return true;
}

// Ascending by users' numbers.
std::vector<FreeVertex> AngleUpkeep::free_vertices_around(const Mesh& mesh, Face face, int n_rings) const {
  const auto user = [&](Vertex v) { return mesh.user_vertex(v); };
  std::vector<Vertex> vertices(mesh.triangles()[face].begin(), mesh.triangles()[face].end());
  for (int ring = 0; ring < n_rings; ++ring) {
    for (std::size_t i = 0, n = vertices.size(); i < n; ++i)
      for_each_around(mesh, vertices[i], [&](Face f) {
        if (!mesh.is_padding(f))
          vertices.insert(vertices.end(), mesh.triangles()[f].begin(), mesh.triangles()[f].end());
      });
    std::ranges::sort(vertices, {}, user);
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  }
  std::vector<FreeVertex> free;
  for (const Vertex v : vertices) {
    const Freedom freedom = freedom_of(mesh, v);
    if (freedom == Freedom::Plane) free.push_back({v});
    if (freedom == Freedom::Line && Star(mesh, v).may_move_along(freedom_.tangents.at(v)))
      free.push_back({v, freedom_.tangents.at(v)});
  }
  return free;
}

// Once for each vertex, until something around it changes.
void AngleUpkeep::ask_for_place(const Mesh& mesh, Vertex vertex) {
  if (place_of_[vertex] != none || freedom_of(mesh, vertex) == Freedom::None) return;
  places_.push_back({.vertex = vertex});
  place_of_[vertex] = static_cast<int>(places_.size()) - 1;
}

void AngleUpkeep::find_places(const Mesh& mesh) {
  const std::span<Place> asked = std::span(places_).subspan(n_found_);
  for_all(static_cast<int>(asked.size()), grain::places, [&](int i) { find_place(mesh, asked[i]); });
  n_found_ = places_.size();
}

AngleUpkeep::Freedom AngleUpkeep::freedom_of(const Mesh& mesh, Vertex v) const {
  if (mesh.is_fixed(v) || mesh.user_vertex(v) == none) return Freedom::None;
  if (!freedom_.held.empty() && freedom_.held[v]) return Freedom::None;
  if (!stays_.empty() && stays_[v]) return Freedom::None;
  if (freedom_.tangents.contains(v)) return Freedom::Line;
  if (freedom_.curve_of.contains(v)) return Freedom::Curve;
  return is_movable(mesh, v) ? Freedom::Plane : Freedom::None;
}

std::optional<Point> AngleUpkeep::best_place(const Mesh& mesh, Vertex v, const Star& star) const {
  switch (freedom_of(mesh, v)) {
    case Freedom::None:
      return std::nullopt;
    case Freedom::Line:
      return star.best_place_along(freedom_.tangents.at(v));
    case Freedom::Curve:
      return star.best_place_on(freedom_.curves[freedom_.curve_of.at(v)]);
    case Freedom::Plane:
      break;
  }
  return star.best_place();
}

void AngleUpkeep::find_place(const Mesh& mesh, Place& place) const {
  const Vertex v = place.vertex;
  const Star star(mesh, v);
  place.before = star.tangent_at(mesh.position(v));
  const std::optional<Point> where = best_place(mesh, v, star);
  if (!where) return;
  const double after = star.tangent_at(*where);
  if (!is_better(after, place.before) || !star.is_upright_at(*where)) return;
  place.where = *where;
  place.after = after;
}

bool AngleUpkeep::Proposal::comes_before(const Proposal& other) const {
  return std::tie(before, users) < std::tie(other.before, other.users);
}

// It leaves the larger angle.
bool AngleUpkeep::Proposal::is_preferred_to(const Proposal& other) const {
  return after > other.after || (after == other.after && users < other.users);
}

AngleUpkeep::Proposal AngleUpkeep::better(const Proposal& a, const Proposal& b) {
  return a.is_none() || (!b.is_none() && b.is_preferred_to(a)) ? b : a;
}

AngleUpkeep::Proposal AngleUpkeep::move_of(const Mesh& mesh, Vertex vertex) const {
  const int number = place_of_[vertex];
  if (number == none || places_[number].after == 0.0) return {};
  const Place& place = places_[number];
  return {.before = place.before,
          .after = place.after,
          .users = {none, none, mesh.user_vertex(vertex)},
          .place = number};
}

AngleUpkeep::Proposal AngleUpkeep::best_at(const Mesh& mesh, Face face) const {
  Proposal best;
  for (const Vertex v : mesh.triangles()[face]) best = better(best, move_of(mesh, v));
  for (const Side side : Mesh::sides(face)) best = better(best, flip_of(mesh, side));
  return best;
}

AngleUpkeep::Proposal AngleUpkeep::flip_of(const Mesh& mesh, Side side) const {
  const Side edge = mesh.lower(side);
  if (!mesh.is_flippable(edge)) return {};
  const auto [before, after] = tangents_of_flip(mesh, edge);
  if (!is_better(after, before)) return {};
  const auto [low, high] = users_of(mesh, edge);
  return {.before = before, .after = after, .users = {none, low, high}, .edge = edge};
}

AngleUpkeep::Proposal AngleUpkeep::proposal_of(const Mesh& mesh, const Joint& joint) const {
  const auto& [a, b, c] = mesh.triangles()[joint.face];
  std::array users{mesh.user_vertex(a), mesh.user_vertex(b), mesh.user_vertex(c)};
  std::ranges::sort(users);
  return {.before = joint.before, .after = joint.after, .users = users, .edge = joint.edge, .joint = &joint};
}

void AngleUpkeep::choose(const Mesh& mesh) {
  std::ranges::sort(proposals_, [](const auto& a, const auto& b) { return a.comes_before(b); });
  winners_.clear();
  touched_.clear();
  ++n_rounds_;
  for (const Proposal& proposal : proposals_)
    if (take(mesh, proposal)) winners_.push_back(proposal);
}

// False if a winner has touched one of its faces.
bool AngleUpkeep::take(const Mesh& mesh, const Proposal& proposal) {
  const auto for_each_touched = [&](const auto& visit) {
    if (proposal.joint)
      std::ranges::for_each(proposal.joint->faces, visit);
    else if (proposal.edge != none)
      for_each_beside(mesh, proposal.edge, visit);
    else
      for_each_around(mesh, places_[proposal.place].vertex, visit);
  };
  bool is_free = true;
  for_each_touched([&](Face face) { is_free &= round_[face] != n_rounds_; });
  if (!is_free) return false;
  for_each_touched([&](Face face) {
    round_[face] = n_rounds_;
    touched_.push_back(face);
  });
  return true;
}

// They share no face, so that each finds its own as it saw them.
void AngleUpkeep::carry_out(Mesh& mesh, AngleCounts& counts) {
  std::size_t n_moves = 0;
  for (const Proposal& winner : winners_) n_moves += moves_of(winner).size();
  make_room(moved_, n_moves);
  make_room(flipped_, 2 * winners_.size());
  for (const Proposal& winner : winners_) {
    if (winner.edge != none) {
      flip(mesh, winner.edge);
      ++counts.flips;
    }
    for (const Place& place : moves_of(winner)) {
      move(mesh, place);
      ++counts.moves;
    }
  }
}

std::span<const AngleUpkeep::Place> AngleUpkeep::moves_of(const Proposal& proposal) const {
  if (proposal.place != none) return {&places_[proposal.place], 1};
  if (proposal.joint) return proposal.joint->moves;
  return {};
}

void AngleUpkeep::move(Mesh& mesh, const Place& place) noexcept {
  Point& position = mesh.positions()[place.vertex];
  if (!std::exchange(is_moved_[place.vertex], true)) moved_.push_back({place.vertex, position});
  position = place.where;
}

void AngleUpkeep::flip(Mesh& mesh, Side edge) noexcept {
  for_each_beside(mesh, edge, [&](Face face) {
    if (!std::exchange(is_flipped_[face], true)) flipped_.push_back(face);
  });
  mesh.flip(edge);
}

// The corners of the faces touched are all whose faces have changed.
void AngleUpkeep::find_still_bad(const Mesh& mesh) {
  for (const Face face : touched_)
    for (const Vertex v : mesh.triangles()[face]) place_of_[v] = none;
  std::erase_if(bad_, [&](Face face) { return round_[face] == n_rounds_; });
  for (const Face face : touched_)
    if (is_bad(mesh, face)) bad_.push_back(face);
}

AngleOutcome improve_angles(Mesh& mesh, const AngleOptions& options, const VertexFreedom& freedom) {
  AngleUpkeep upkeep(mesh, options, freedom);
  for (const Face face : mesh.faces())
    if (!is_upright(mesh, face))
      throw InputError("face " + std::to_string(mesh.user_face(face)) + " is not upright");
  AngleOutcome outcome;
  outcome.min_angle_before_deg = measure(mesh).min_angle_deg;
  outcome.counts = upkeep.run(mesh);
  outcome.min_angle_after_deg = measure(mesh).min_angle_deg;
  return outcome;
}

}  // namespace kinemesh
