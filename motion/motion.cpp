#include "kinemesh/motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/base/parallel.h"
#include "kinemesh/measure.h"
#include "motion/body.h"
#include "motion/border.h"
#include "motion/integrator.h"
#include "motion/interior/interior.h"
#include "motion/noise_cut.h"
#include "motion/restriction.h"

namespace kinemesh {
namespace {

// Adding 0 would turn -0 into +0.
double moved(double x, double way) {
  return way == 0.0 ? x : x + way;
}
Point moved(const Point& x, const Point& way) {
  return {moved(x.x, way.x), moved(x.y, way.y)};
}

std::string text(const Point& p) {
  return fmt::format("({}, {})", p.x, p.y);
}

// Names of the markers that a term names, in its order.
std::vector<std::string> markers_of(const MotionTerm& term) {
  std::vector<std::string> names;
  const auto add = [&](const Restriction& part) {
    if (const auto* on = std::get_if<OnMarker>(&part.on)) names.push_back(on->name);
  };
  add(term.where);
  for (const Restriction& part : term.also) add(part);
  return names;
}

// A marker that a term or a body names is moving unless `border` says otherwise. Names that are not in the
// mesh are refused elsewhere, with the term's or the body's number.
BorderConditions completed(const Mesh& mesh, BorderConditions border, const std::vector<MotionTerm>& terms,
                           const std::vector<BodySpec>& bodies) {
  const auto& names = mesh.marker_names();
  const auto add = [&](const std::string& name) {
    if (std::ranges::find(names, name) != names.end())
      border.by_marker.emplace(name, BorderCondition::Moving);
  };
  for (const MotionTerm& term : terms) std::ranges::for_each(markers_of(term), add);
  for (const BodySpec& body : bodies)
    for (const std::string& part : body.on)
      if (const std::string_view text = part; text.starts_with("marker:")) add(std::string(text.substr(7)));
  return border;
}

// Of the term and all its further parts: at each vertex the largest.
std::vector<double> weights_of_term(const Mesh& mesh, const std::vector<MotionTerm>& terms, std::size_t i) {
  try {
    std::vector<double> all = weights(mesh, terms[i].where);
    for (const Restriction& part : terms[i].also) {
      if (all.empty()) return all;
      const auto more = weights(mesh, part);
      if (more.empty()) return more;
      std::ranges::transform(all, more, all.begin(), [](double a, double b) { return std::max(a, b); });
    }
    return all;
  } catch (const ParameterError& error) {
    throw ParameterError(fmt::format("motion.{}.{}", i, error.key()), error.what());
  }
}

bool is_same_part(const std::string& a, const std::string& b) {
  const auto part = parse_restriction(a).on, other = parse_restriction(b).on;
  const auto *label = std::get_if<OnLabel>(&part), *other_label = std::get_if<OnLabel>(&other);
  return label && other_label ? label->label == other_label->label : a == b;
}

// No part is of the last of these and of another one, too.
void require_distinct(const std::vector<BodySpec>& specs, const std::vector<Body>& bodies) {
  const std::size_t last = bodies.size() - 1;
  for (std::size_t i = 0; i < last; ++i)
    for (const std::string& part : specs[last].on)
      for (const std::string& other : specs[i].on)
        if (is_same_part(part, other))
          throw ParameterError("on", fmt::format("{} is of two bodies, the other is {}; of one only expected",
                                                 part, bodies[i].name()));
}

std::vector<Body> bodies_of(const Mesh& mesh, const std::vector<BodySpec>& specs) {
  std::vector<Body> bodies;
  for (std::size_t i = 0; i < specs.size(); ++i) {
    try {
      bodies.emplace_back(mesh, specs[i]);
      require_distinct(specs, bodies);
    } catch (const ParameterError& error) {
      throw ParameterError(fmt::format("body.{}.{}", i, error.key()), error.what());
    }
  }
  return bodies;
}

// Ends of edges of the domain's border.
std::vector<char> border_vertices(const Mesh& mesh) {
  std::vector<char> is_on_border(mesh.n_vertices(), 0);
  for (const Constraint& c : mesh.constraints())
    if (c.is_border()) is_on_border[c.from] = is_on_border[c.to] = 1;
  return is_on_border;
}

// Vertices of each marker, by name.
template <class Visit>
void for_each_end(const Mesh& mesh, const std::string& marker, const Visit& visit) {
  for (const Marker& m : mesh.markers())
    if (m.name == marker)
      for (const Edge& edge : m.edges)
        for (const int user : edge) visit(mesh.vertex_of_user(UserVertex(user)));
}

double diagonal_of(std::span<const Point> positions) {
  Point low = positions.front(), high = low;
  for (const Point& p : positions) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  return glm::distance(low, high);
}

// How far two accounts of one place may lie apart that say the same but for rounding.
constexpr double same_within = 1e-9;  // of the mesh's diagonal

}  // namespace

class Motion::Parts {
 public:
  Parts(const Mesh& mesh, std::vector<MotionTerm> terms, BorderConditions border, Integrator integrator,
        const std::vector<BodySpec>& bodies, InteriorOptions interior);

  // As Motion's.
  void advance(std::span<const Point> x0, const TimeStep& step, std::span<Point> x1) const;
  bool ways_inside(std::span<const Point> x0, const TimeStep& step, std::span<Point> ways) const;
  std::string describe_non_finite(Vertex vertex, std::span<const Point> x0, const TimeStep& step) const;
  std::span<const Role> roles() const { return roles_; }
  const Freedom& freedom() const { return freedom_; }
  const InteriorOptions& interior() const { return interior_; }
  double spacing() const { return spacing_; }
  std::span<const Point> initial_positions() const { return initial_; }
  std::span<const Body> bodies() const { return bodies_; }
  int body_of(Vertex vertex) const { return owner_.empty() ? none : owner_[vertex]; }
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  template <class Field>
  struct Weighted {
    std::shared_ptr<const Field> field;
    std::vector<double> weights;  // empty: 1 everywhere
    std::vector<double> raw;      // as if it owned all it reaches; empty: as `weights`
    bool is_inside = false;       // acts on the interior
    double weight(Vertex vertex) const { return weights.empty() ? 1.0 : weights[vertex]; }
    double raw_weight(Vertex vertex) const { return raw.empty() ? weight(vertex) : raw[vertex]; }
  };

  template <class Field>
  static bool acts(const std::vector<Weighted<Field>>& terms, Vertex vertex) {
    return std::any_of(terms.begin(), terms.end(),
                       [&](const auto& term) { return term.weight(vertex) != 0.0; });
  }
  void add_terms(const Mesh& mesh, const std::vector<MotionTerm>& terms);
  void own_vertices(const Mesh& mesh);
  void claim_borders(const Mesh& mesh, const std::vector<MotionTerm>& terms);
  void give_roles(const Mesh& mesh, const std::vector<MotionTerm>& terms);
  void put_on(const SlideLine& line, std::span<const Point> x0, std::span<Point> x1) const;
  void move_bodies(std::span<const Point> x0, const TimeStep& step, std::span<Point> x1) const;
  Point velocity(Vertex vertex, const Point& x, double t) const;
  Point displacement(Vertex vertex, double t, double dt) const;
  Point noise(Vertex vertex, std::uint64_t step, double dt) const;
  Point smooth_way(Vertex vertex, const Point& x0, double t, double dt) const;
  Point way_inside(Vertex vertex, const Point& x0, double t, double dt) const;
  double fill_noise(double dt, std::uint64_t step, std::span<Point> noises) const;  // returns the longest

  std::vector<Weighted<VelocityField>> velocities_;
  std::vector<Weighted<DisplacementField>> displacements_;
  std::vector<Weighted<NoiseField>> noises_;
  Freedom freedom_;
  Integrator integrator_;
  std::vector<Point> initial_;
  std::vector<UserVertex> user_vertex_;
  std::vector<char> constrained_vertex_;
  std::vector<Edge> constrained_;  // ends never change, whatever is repaired
  double spacing_, diagonal_;
  std::vector<Body> bodies_;
  std::vector<int> owner_;                        // per vertex: its body, or none; empty without bodies
  std::vector<std::pair<Vertex, int>> shared_;    // a vertex, and a body that has it, too, after its owner
  std::vector<std::pair<Vertex, int>> cornered_;  // a corner of a sliding border, and a body that has it
  std::vector<int> claim_;            // per vertex of the border: number in claimed_, or none; empty without
  std::vector<std::string> claimed_;  // markers that terms name
  InteriorOptions interior_;
  std::vector<Role> roles_;  // empty where nothing follows
  std::vector<std::string> notes_;
};

Motion::Parts::Parts(const Mesh& mesh, std::vector<MotionTerm> terms, BorderConditions border,
                     Integrator integrator, const std::vector<BodySpec>& bodies, InteriorOptions interior)
    : freedom_(mesh, completed(mesh, std::move(border), terms, bodies)),
      integrator_(integrator),
      initial_(mesh.positions().begin(), mesh.positions().end()),
      user_vertex_(mesh.n_vertices()),
      constrained_vertex_(mesh.n_vertices()),
      spacing_(mean_spacing(mesh)),
      diagonal_(diagonal_of(initial_)),
      bodies_(bodies_of(mesh, bodies)),
      interior_(std::move(interior)) {
  for (const Constraint& c : mesh.constraints()) constrained_.push_back({c.from, c.to});
  for (const Vertex v : mesh.vertices()) {
    user_vertex_[v] = mesh.user_vertex(v);
    constrained_vertex_[v] = mesh.is_constrained(v);
  }
  own_vertices(mesh);
  claim_borders(mesh, terms);
  give_roles(mesh, terms);
  add_terms(mesh, terms);
}

// Of two bodies the first one moves a vertex; whether they agree is looked at in every step.
void Motion::Parts::own_vertices(const Mesh& mesh) {
  if (bodies_.empty()) return;
  owner_.assign(mesh.n_vertices(), none);
  for (int b = 0; b < static_cast<int>(bodies_.size()); ++b) {
    int n_fixed = 0;
    for (const Vertex v : bodies_[b].vertices()) {
      if (freedom_.is_corner(v))
        cornered_.push_back({v, b});
      else if (freedom_.of(v) == BorderCondition::Fixed)
        ++n_fixed;
      else if (owner_[v] == none)
        owner_[v] = b;
      else if (owner_[v] != b)
        shared_.push_back({v, b});
    }
    if (n_fixed > 0)
      notes_.push_back(fmt::format("body {}: {} of its {} vertices {} on a fixed border and {}",
                                   bodies_[b].name(), n_fixed, bodies_[b].vertices().size(),
                                   n_fixed == 1 ? "is" : "are", n_fixed == 1 ? "stays" : "stay"));
  }
}

// The markers that each vertex of the border goes by: of all that terms name, the first one.
void Motion::Parts::claim_borders(const Mesh& mesh, const std::vector<MotionTerm>& terms) {
  const auto is_on_border = border_vertices(mesh);
  for (const MotionTerm& term : terms)
    for (const std::string& marker : markers_of(term)) {
      if (std::ranges::find(claimed_, marker) != claimed_.end()) continue;
      if (claim_.empty()) claim_.assign(mesh.n_vertices(), none);
      const int number = static_cast<int>(claimed_.size());
      claimed_.push_back(marker);
      for_each_end(mesh, marker, [&](Vertex v) {
        if (is_on_border[v] && claim_[v] == none) claim_[v] = number;
      });
    }
}

// Known is what a body owns, the border, what is fixed, and inner lines that are named.
void Motion::Parts::give_roles(const Mesh& mesh, const std::vector<MotionTerm>& terms) {
  if (interior_.follow == Follow::None) return;
  for (std::size_t i = 0; i < terms.size(); ++i)
    if (terms[i].where.blend)
      throw ParameterError(fmt::format("motion.{}.blend", i),
                           "blend makes a layer, and there are none where the interior follows the border; "
                           "interior.follow = \"none\" brings them back");
  const auto is_on_border = border_vertices(mesh);
  roles_.assign(mesh.n_vertices(), Role::Free);
  for (const Vertex v : mesh.vertices()) {
    const auto condition = freedom_.of(v);
    if (body_of(v) != none || is_on_border[v] || condition == BorderCondition::Fixed) roles_[v] = Role::Known;
    if (body_of(v) == none && condition == BorderCondition::Slide) roles_[v] = Role::Slide;
  }
  for (const MotionTerm& term : terms)
    for (const std::string& marker : markers_of(term))
      for_each_end(mesh, marker, [&](Vertex v) {
        if (roles_[v] == Role::Free) roles_[v] = Role::Known;
      });
}

// Where a term has no say its weight is 0.
void Motion::Parts::add_terms(const Mesh& mesh, const std::vector<MotionTerm>& terms) {
  for (std::size_t i = 0; i < terms.size(); ++i) {
    auto raw = weights_of_term(mesh, terms, i);
    const auto markers = markers_of(terms[i]);
    const auto has_say = [&](Vertex v) {
      if (body_of(v) != none) return false;
      const int claim = claim_.empty() ? none : claim_[v];
      return claim == none || std::ranges::find(markers, claimed_[claim]) != markers.end();
    };
    auto own = raw;
    bool is_inside = false;
    for (const Vertex v : mesh.vertices()) {
      if (!has_say(v)) {
        own.resize(mesh.n_vertices(), 1.0);
        own[v] = 0.0;
      }
      is_inside |= !roles_.empty() && roles_[v] == Role::Free && (raw.empty() || raw[v] != 0.0);
    }
    if (is_inside && raw.empty()) raw.assign(mesh.n_vertices(), 1.0);
    if (!is_inside) raw.clear();
    const auto add = [&](auto& all, const auto& field) { all.push_back({field, own, raw, is_inside}); };
    if (const auto* v = std::get_if<0>(&terms[i].field)) add(velocities_, *v);
    if (const auto* d = std::get_if<1>(&terms[i].field)) add(displacements_, *d);
    if (const auto* n = std::get_if<2>(&terms[i].field)) add(noises_, *n);
  }
}

void Motion::Parts::advance(std::span<const Point> x0, const TimeStep& step, std::span<Point> x1) const {
  const int n = static_cast<int>(x0.size());
  if (noises_.empty()) {
    parallel_parts(n, grain::moves, [&](int, int begin, int end) {
      for (Vertex v(begin); v < end; ++v) x1[v] = moved(x0[v], smooth_way(v, x0[v], step.t0, step.dt));
    });
  } else {
    const NoiseCut cut(x0, constrained_, fill_noise(step.dt, step.number, x1), 1e-3 * spacing_);
    parallel_parts(n, grain::moves, [&](int, int begin, int end) {
      for (Vertex v(begin); v < end; ++v)
        x1[v] = moved(x0[v], smooth_way(v, x0[v], step.t0, step.dt) + cut(x0[v], x1[v]));
    });
  }
  for (const SlideLine& line : freedom_.lines())
    if (!line.is_straight()) put_on(line, x0, x1);
  move_bodies(x0, step, x1);
}

void Motion::Parts::put_on(const SlideLine& line, std::span<const Point> x0, std::span<Point> x1) const {
  for (const Vertex v : line.vertices())
    if (freedom_.of(v) == BorderCondition::Slide && x1[v] != x0[v]) x1[v] = line.moved(x0[v], x1[v]);
}

void Motion::Parts::move_bodies(std::span<const Point> x0, const TimeStep& step, std::span<Point> x1) const {
  const auto name = [&](Vertex v) { return "vertex " + std::to_string(user_vertex_[v]); };
  std::vector<Point> place(bodies_.empty() ? 0 : x1.size());
  for (int b = 0; b < static_cast<int>(bodies_.size()); ++b) {
    bodies_[b].move(initial_, x0, step.t0, step.t1, step.dt, integrator_, place);
    for (const Vertex v : bodies_[b].vertices()) {
      if (owner_[v] != b) continue;
      x1[v] = place[v];
      if (freedom_.of(v) != BorderCondition::Slide) continue;
      if (freedom_.distance_from_line(v, x1[v]) > same_within * diagonal_)
        throw InputError(fmt::format("body {} would take {} off the line on which {} slides, at time {}",
                                     bodies_[b].name(), name(v), freedom_.border_of(v), step.t1));
    }
    for (const auto& [v, other] : cornered_)
      if (other == b && glm::distance(place[v], initial_[v]) > same_within * diagonal_)
        throw InputError(fmt::format("body {} would take {} off a corner where {} slides, at time {}",
                                     bodies_[b].name(), name(v), freedom_.border_of(v), step.t1));
    for (const auto& [v, other] : shared_)
      if (other == b && glm::distance(place[v], x1[v]) > same_within * diagonal_)
        throw InputError(
            fmt::format("bodies {} and {} share {} and move it to ({}, {}) and ({}, {}), at time {}",
                        bodies_[owner_[v]].name(), bodies_[b].name(), name(v), x1[v].x, x1[v].y, place[v].x,
                        place[v].y, step.t1));
  }
}

bool Motion::Parts::ways_inside(std::span<const Point> x0, const TimeStep& step,
                                std::span<Point> ways) const {
  const auto is_inside = [](const auto& term) { return term.is_inside; };
  if (std::ranges::none_of(velocities_, is_inside) && std::ranges::none_of(displacements_, is_inside))
    return false;
  parallel_parts(static_cast<int>(x0.size()), grain::moves, [&](int, int begin, int end) {
    for (Vertex v(begin); v < end; ++v) ways[v] = way_inside(v, x0[v], step.t0, step.dt);
  });
  return true;
}

Point Motion::Parts::way_inside(Vertex vertex, const Point& x0, double t, double dt) const {
  Point way(0.0, 0.0);
  for (const auto& term : displacements_)
    if (const double w = term.raw_weight(vertex); term.is_inside && w != 0.0)
      way += w * (term.field->displacement(initial_[vertex], t + dt) -
                  term.field->displacement(initial_[vertex], t));
  const auto velocity = [&](const Point& x, double s) {
    Point sum(0.0, 0.0);
    for (const auto& term : velocities_)
      if (const double w = term.raw_weight(vertex); term.is_inside && w != 0.0)
        sum += w * term.field->velocity(x, s);
    return sum;
  };
  way += integrate(integrator_, velocity, x0, t, dt);
  return roles_[vertex] == Role::Slide ? freedom_.allowed(vertex, x0, way) : way;
}

Point Motion::Parts::smooth_way(Vertex vertex, const Point& x0, double t, double dt) const {
  if (freedom_.of(vertex) == BorderCondition::Fixed) return {0.0, 0.0};
  Point way = freedom_.allowed(vertex, x0, displacement(vertex, t, dt));
  if (acts(velocities_, vertex))
    way += integrate(
        integrator_, [&](const Point& x, double s) { return velocity(vertex, x, s); }, x0, t, dt);
  return way;
}

Point Motion::Parts::velocity(Vertex vertex, const Point& x, double t) const {
  Point sum(0.0, 0.0);
  for (const auto& term : velocities_)
    if (const double w = term.weight(vertex); w != 0.0) sum += w * term.field->velocity(x, t);
  return freedom_.allowed(vertex, x, sum);
}

Point Motion::Parts::displacement(Vertex vertex, double t, double dt) const {
  const Point& initial = initial_[vertex];
  Point sum(0.0, 0.0);
  for (const auto& term : displacements_)
    if (const double w = term.weight(vertex); w != 0.0)
      sum += w * (term.field->displacement(initial, t + dt) - term.field->displacement(initial, t));
  return sum;
}

Point Motion::Parts::noise(Vertex vertex, std::uint64_t step, double dt) const {
  Point sum(0.0, 0.0);
  if (constrained_vertex_[vertex] || freedom_.of(vertex) != BorderCondition::Moving) return sum;
  for (const auto& term : noises_)
    if (const double w = term.weight(vertex); w != 0.0)
      sum += w * term.field->kick(static_cast<std::uint64_t>(user_vertex_[vertex]), step, dt, spacing_);
  return sum;
}

double Motion::Parts::fill_noise(double dt, std::uint64_t step, std::span<Point> noises) const {
  std::array<double, most_parts> longest{};
  parallel_parts(static_cast<int>(noises.size()), grain::moves, [&](int part, int begin, int end) {
    for (Vertex v(begin); v < end; ++v) {
      noises[v] = noise(v, step, dt);
      longest[part] = std::max(longest[part], glm::length(noises[v]));
    }
  });
  return *std::max_element(longest.begin(), longest.end());
}

std::string Motion::Parts::describe_non_finite(Vertex vertex, std::span<const Point> x0,
                                               const TimeStep& step) const {
  const auto& [t, t1, dt, number] = step;
  if (const int b = body_of(vertex); b != none)
    return fmt::format("body {}: {} gives no finite place for it at time {}", bodies_[b].name(),
                       bodies_[b].culprit(initial_[vertex], x0[vertex], t, t1, dt, integrator_), t1);
  const std::string place = fmt::format("at {}, time {}", text(x0[vertex]), t);
  const auto blame = [&](const auto& field, const Point& value) {
    return fmt::format("field \"{}\" gives {} {}", field->name(), text(value), place);
  };
  for (const auto& term : velocities_) {
    if (term.weight(vertex) == 0.0) continue;
    const auto v = [&](const Point& x, double s) { return term.field->velocity(x, s); };
    for (const Point& value : {v(x0[vertex], t), integrate(integrator_, v, x0[vertex], t, dt)})
      if (!is_finite(value)) return blame(term.field, value);
  }
  for (const auto& term : displacements_)
    for (const double s : {t, t + dt})
      if (const Point d = term.field->displacement(initial_[vertex], s);
          term.weight(vertex) != 0.0 && !is_finite(d))
        return blame(term.field, d);
  for (const auto& term : noises_)
    if (const Point kick = term.field->kick(user_vertex_[vertex], number, dt, spacing_);
        term.weight(vertex) != 0.0 && !is_finite(kick))
      return blame(term.field, kick);
  return "the motions add up to it " + place;
}

// --- the whole ---

Motion::Motion(const Mesh& mesh, std::vector<MotionTerm> terms, BorderConditions border,
               Integrator integrator, const std::vector<BodySpec>& bodies, InteriorOptions interior)
    : parts_(std::make_shared<const Parts>(mesh, std::move(terms), std::move(border), integrator, bodies,
                                           std::move(interior))) {}

void Motion::advance(std::span<const Point> x0, const TimeStep& step, std::span<Point> x1) const {
  parts_->advance(x0, step, x1);
}

bool Motion::ways_inside(std::span<const Point> x0, const TimeStep& step, std::span<Point> ways) const {
  return parts_->ways_inside(x0, step, ways);
}

std::string Motion::describe_non_finite(Vertex vertex, std::span<const Point> x0,
                                        const TimeStep& step) const {
  return parts_->describe_non_finite(vertex, x0, step);
}

std::span<const Role> Motion::roles() const {
  return parts_->roles();
}

const Freedom& Motion::freedom() const {
  return parts_->freedom();
}

const InteriorOptions& Motion::interior() const {
  return parts_->interior();
}

double Motion::spacing() const {
  return parts_->spacing();
}

std::span<const Point> Motion::initial_positions() const {
  return parts_->initial_positions();
}

std::span<const Body> Motion::bodies() const {
  return parts_->bodies();
}

int Motion::body_of(Vertex vertex) const {
  return parts_->body_of(vertex);
}

const std::vector<std::string>& Motion::notes() const {
  return parts_->notes();
}

}  // namespace kinemesh
