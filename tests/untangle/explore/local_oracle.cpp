#include "tests/untangle/explore/local_oracle.h"
#include "tests/core/mesh/edges.h"

#include <algorithm>
#include <numeric>
#include <set>
#include <stdexcept>

namespace kinemesh::test {
namespace {

void add(std::vector<bool>& to, const std::vector<bool>& what) {
  for (std::size_t i = 0; i < to.size(); ++i) to[i] = to[i] || what[i];
}

bool is_subset(const std::vector<bool>& a, const std::vector<bool>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i] && !b[i]) return false;
  }
  return true;
}

bool is_empty(const std::vector<bool>& a) {
  return std::ranges::find(a, true) == a.end();
}

void require(bool holds, const char* what) {
  if (!holds) throw std::logic_error(what);
}

}  // namespace

LocalOracle::LocalOracle(const Sheets& sheets) : sheets_(sheets) {
  shadow_of_.assign(sheets.n_components(), Cells(sheets.n_cells(), false));
  for (int i = 0; i < sheets.n_lifts(); ++i) {
    const auto [face, cell] = sheets.lift(i);
    if (sheets.is_inverted(face)) shadow_of_[sheets.component(face)][cell] = true;
  }
  is_crease_vertex_.assign(sheets.plane().n_vertices, false);
  const Mesh& mesh = sheets.mesh();
  for (const Side edge : all_edges(mesh)) {
    if (!sheets.is_crease(edge)) continue;
    for (const Vertex v : {mesh.from(edge), mesh.to(edge)})
      is_crease_vertex_[sheets.plane().place_of[v]] = true;
  }
}

// --- the algorithm ---

LocalRegion LocalOracle::region(int component) const {
  LocalRegion out;
  out.components = {component};
  const Lifts seed = lifts_of(out.components);
  Cells x = shadow(out.components);
  for (;;) {
    out.lifts = neighbourhood(seed, x);
    const auto extended = components_in(out.lifts);
    if (extended != out.components) {
      out.components = extended;
      add(x, shadow(extended));
      continue;
    }
    const auto value = constant_gamma(out.lifts);
    require(value.has_value() && *value > 0,
            "gamma of a stable region is not constant and positive: Lemma 2.5");
    if (out.growths == 0 && out.gamma_first_stable == 0) out.gamma_first_stable = *value;
    if (*value == 1) break;
    const Cells larger = grown(out.lifts, x);
    require(larger != x, "gamma > 1, but the shadow does not grow");
    x = larger;
    ++out.growths;
  }
  require(x == shadow(out.components), "in the end X is not f(J)");
  out.faces = faces_of(out.lifts);
  for (const Face face : out.faces) out.inverted += sheets_.is_inverted(face) ? 1 : 0;
  return out;
}

Lifts LocalOracle::neighbourhood(const Lifts& from, const Cells& x) const {
  Lifts reached(sheets_.n_lifts(), false);
  std::vector<int> pending;
  const auto reach = [&](int lift) {
    if (lift == none || reached[lift] || !x[sheets_.lift(lift).cell]) return;
    reached[lift] = true;
    pending.push_back(lift);
  };
  for (int lift = 0; lift < sheets_.n_lifts(); ++lift) {
    if (from[lift]) reach(lift);
  }
  while (!pending.empty()) {
    const int lift = pending.back();
    pending.pop_back();
    for (const auto& step : sheets_.steps(lift)) reach(step.lift);
  }
  return reached;
}

Cells LocalOracle::shadow(const std::vector<int>& components) const {
  Cells x(sheets_.n_cells(), false);
  for (const int c : components) add(x, shadow_of_[c]);
  return x;
}

Lifts LocalOracle::lifts_of(const std::vector<int>& components) const {
  Lifts all(sheets_.n_lifts(), false);
  for (int i = 0; i < sheets_.n_lifts(); ++i) {
    const int component = sheets_.component(sheets_.lift(i).face);
    all[i] = component != none && std::ranges::find(components, component) != components.end();
  }
  return all;
}

std::vector<int> LocalOracle::components_in(const Lifts& r) const {
  std::set<int> all;
  for (const Face face : faces_of(r)) all.insert(sheets_.component(face));
  all.erase(none);
  return {all.begin(), all.end()};
}

std::vector<Face> LocalOracle::faces_of(const Lifts& r) const {
  std::vector<Face> faces;
  for (const Face face : sheets_.mesh().faces()) {
    if (std::ranges::any_of(sheets_.lifts_of_face(face), [&](int lift) { return r[lift]; }))
      faces.push_back(face);
  }
  return faces;
}

std::vector<int> LocalOracle::gamma(const Lifts& r) const {
  std::vector<int> sum(sheets_.n_cells(), 0);
  for (int i = 0; i < sheets_.n_lifts(); ++i) {
    if (r[i]) sum[sheets_.lift(i).cell] += sheets_.sign(i);
  }
  return sum;
}

std::optional<int> LocalOracle::constant_gamma(const Lifts& r) const {
  const auto sum = gamma(r);
  std::optional<int> value;
  for (int i = 0; i < sheets_.n_lifts(); ++i) {
    if (!r[i]) continue;
    const int here = sum[sheets_.lift(i).cell];
    if (value.value_or(here) != here) return std::nullopt;
    value = here;
  }
  return value;
}

// --- growing ---

Cells LocalOracle::grown(const Lifts& r, const Cells& x) const {
  Cells out = x;
  auto pending = first_pairs(r, x);
  std::set<std::pair<int, int>> visited(pending.begin(), pending.end());
  while (!pending.empty()) {
    const auto [a, b] = pending.back();
    pending.pop_back();
    out[sheets_.lift(a).cell] = true;
    const auto steps_a = sheets_.steps(a), steps_b = sheets_.steps(b);
    for (std::size_t i = 0; i < steps_a.size(); ++i) {  // both around the same cell, in the same order
      const int c = steps_a[i].lift, d = steps_b[i].lift;
      if (c == none || d == none || sheets_.sign(c) < 0 || sheets_.sign(d) < 0) continue;
      if (visited.emplace(c, d).second) pending.emplace_back(c, d);
    }
  }
  return out;
}

// Two upright lifts of r over a cell inside the border of x that go on together beyond it: a point of the
// border and the beginning of a path whose preimage has these two components.
std::vector<std::pair<int, int>> LocalOracle::first_pairs(const Lifts& r, const Cells& x) const {
  std::vector<std::pair<int, int>> pairs;
  for (int i = 0; i < sheets_.n_lifts(); ++i) {
    if (!r[i] || sheets_.sign(i) < 0) continue;
    for (const int j : sheets_.lifts_of_cell(sheets_.lift(i).cell)) {
      if (j <= i || !r[j] || sheets_.sign(j) < 0) continue;
      const auto si = sheets_.steps(i), sj = sheets_.steps(j);
      for (std::size_t s = 0; s < si.size(); ++s) {
        const int c = si[s].lift, d = sj[s].lift;
        if (c == none || d == none || sheets_.sign(c) < 0 || sheets_.sign(d) < 0) continue;
        if (!x[sheets_.lift(c).cell]) pairs.emplace_back(c, d);
      }
    }
  }
  return pairs;
}

// --- the definition ---

std::vector<LocalOracle::Exit> LocalOracle::border(const Lifts& r) const {
  std::vector<Exit> exits;
  for (int lift = 0; lift < sheets_.n_lifts(); ++lift) {
    if (!r[lift]) continue;
    for (const auto& step : sheets_.steps(lift)) {
      if (step.lift == none || !r[step.lift]) exits.push_back({lift, step});
    }
  }
  return exits;
}

bool LocalOracle::is_locally_removable(const Lifts& r) const {
  if (is_empty(r)) return false;
  Lifts one(r.size(), false);
  one[std::ranges::find(r, true) - r.begin()] = true;
  Cells everywhere(sheets_.n_cells(), false);
  for (int i = 0; i < sheets_.n_lifts(); ++i) {
    if (r[i]) everywhere[sheets_.lift(i).cell] = true;
  }
  // r is a union of components of the preimage of f(r), so that a walk over f(r) does not leave r.
  if (neighbourhood(one, everywhere) != r) return false;
  for (const auto& [lift, step] : border(r)) {
    if (sheets_.sign(lift) < 0 || (step.edge != none && sheets_.is_crease(step.edge))) return false;
  }
  return constant_gamma(r) == 1;
}

Lifts LocalOracle::minimum(int component) const {
  const Lifts seed = lifts_of({component});
  Lifts out(sheets_.n_lifts(), true);
  const int n = sheets_.n_components();
  for (unsigned subset = 1; subset < 1u << n; ++subset) {
    std::vector<int> components;
    for (int c = 0; c < n; ++c) {
      if (subset >> c & 1u) components.push_back(c);
    }
    const Lifts r = neighbourhood(lifts_of(components), shadow(components));
    if (!is_subset(seed, r) || !is_locally_removable(r)) continue;
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = out[i] && r[i];
  }
  return out;
}

bool LocalOracle::is_border_bijective(const Lifts& r) const {
  Cells below(sheets_.n_cells(), false);
  for (int i = 0; i < sheets_.n_lifts(); ++i) {
    if (r[i]) below[sheets_.lift(i).cell] = true;
  }
  const auto& plane = sheets_.plane();
  std::vector<int> lifted(plane.segments.size(), 0), degree(plane.n_vertices, 0);
  for (const auto& exit : border(r)) ++lifted[exit.step.segment];
  for (std::size_t s = 0; s < plane.segments.size(); ++s) {
    const auto& segment = plane.segments[s];
    if (lifted[s] != (below[segment.left] != below[segment.right] ? 1 : 0)) return false;
    for (const int end : segment.ends) degree[end] += lifted[s];
  }
  for (int place = 0; place < plane.n_vertices; ++place) {
    if (!is_crease_vertex_[place] && degree[place] != 0 && degree[place] != 2) return false;
  }
  return true;
}

// --- whole faces ---

std::vector<Face> LocalOracle::sketch(int component) const {
  std::vector<int> components{component};
  std::vector<bool> visited(sheets_.mesh().n_faces(), false);
  for (;;) {
    const Cells x = shadow(components);
    std::vector<Face> pending;
    for (const Face face : sheets_.mesh().faces()) {
      const int own = sheets_.component(face);
      if (own != none && std::ranges::find(components, own) != components.end()) visited[face] = true;
      if (visited[face]) pending.push_back(face);
    }
    while (!pending.empty()) {
      const Face face = pending.back();
      pending.pop_back();
      for (const int lift : sheets_.lifts_of_face(face)) {
        for (const auto& step : sheets_.steps(lift)) {
          if (step.edge == none || step.lift == none) continue;
          const auto [beyond, cell] = sheets_.lift(step.lift);
          if (visited[beyond] || !(x[cell] || x[sheets_.lift(lift).cell])) continue;
          visited[beyond] = true;
          pending.push_back(beyond);
        }
      }
    }
    std::set<int> now;
    for (const Face face : sheets_.mesh().faces()) {
      if (visited[face]) now.insert(sheets_.component(face));
    }
    now.erase(none);
    const std::vector<int> extended(now.begin(), now.end());
    if (extended == components) break;
    components = extended;
  }
  std::vector<Face> faces;
  for (const Face face : sheets_.mesh().faces()) {
    if (visited[face]) faces.push_back(face);
  }
  return faces;
}

// Of the border of some faces around each cell: their signed cover.
std::vector<int> LocalOracle::windings(const std::vector<Face>& faces) const {
  Lifts all(sheets_.n_lifts(), false);
  for (const Face face : faces) {
    for (const int lift : sheets_.lifts_of_face(face)) all[lift] = true;
  }
  return gamma(all);
}

bool LocalOracle::overlaps_itself(const std::vector<Face>& faces) const {
  return std::ranges::any_of(windings(faces), [](int winding) { return winding != 0 && winding != 1; });
}

bool LocalOracle::overlaps_itself(const std::vector<Face>& faces, int component) const {
  const auto winding = windings(faces);
  for (int cell = 0; cell < sheets_.n_cells(); ++cell) {
    if (shadow_of_[component][cell] && winding[cell] != 1) return true;
  }
  return false;
}

}  // namespace kinemesh::test
