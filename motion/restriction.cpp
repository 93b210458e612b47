#include "motion/restriction.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/base/parallel.h"
#include "motion/segment_index.h"

namespace kinemesh {
namespace {

constexpr const char* expected_on = "expected all, marker:NAME, label:N or disc:[x,y,r]";

[[noreturn]] void refuse_on(std::string_view on, const std::string& why) {
  throw ParameterError("on", "on = \"" + std::string(on) + "\": " + why);
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

template <class Number>
std::optional<Number> parse_number(std::string_view text) {
  text = trimmed(text);
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return number;
}

OnLabel parse_label(std::string_view on, std::string_view text) {
  const auto label = parse_number<int>(text);
  if (!label || *label == padding_label) refuse_on(on, "label:N needs an integer");
  return {*label};
}

OnDisc parse_disc(std::string_view on, std::string_view text) {
  std::array<double, 3> values{};
  text = trimmed(text);
  if (!text.starts_with('[') || !text.ends_with(']')) refuse_on(on, "expected disc:[x,y,r]");
  text = text.substr(1, text.size() - 2);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto comma = i < 2 ? text.find(',') : text.size();
    const auto value =
        comma == std::string_view::npos ? std::nullopt : parse_number<double>(text.substr(0, comma));
    if (!value || !std::isfinite(*value)) refuse_on(on, "disc:[x,y,r] needs three numbers");
    values[i] = *value;
    text.remove_prefix(std::min(comma + 1, text.size()));
  }
  if (!(values[2] > 0.0)) refuse_on(on, "the radius of the disc has to be greater than 0");
  return {{values[0], values[1]}, values[2]};
}

Blend parse_blend(const std::array<double, 2>& distances) {
  if (!(distances[0] >= 0.0 && distances[1] > distances[0] && std::isfinite(distances[1])))
    throw ParameterError("blend", "blend needs two distances [r0, r1] with 0 <= r0 < r1");
  return {distances[0], distances[1]};
}

double faded(const Blend& blend, double distance) {
  if (distance <= blend.full) return 1.0;
  if (distance >= blend.zero) return 0.0;
  const double s = (distance - blend.full) / (blend.zero - blend.full);
  return 1.0 - s * s * (3.0 - 2.0 * s);
}

// Sets every weight from the vertex's number and position, in parallel.
template <class Weight>
std::vector<double> each_vertex(const Mesh& mesh, const Weight& weight) {
  std::vector<double> all(mesh.n_vertices());
  const auto x = mesh.positions();
  parallel_parts(mesh.n_vertices(), 4096, [&](int, int begin, int end) {
    for (Vertex v(begin); v < end; ++v) all[v] = weight(v, x[v]);
  });
  return all;
}

// What `on` names: vertices that are inside, and the edges distances are measured to.
struct Named {
  std::vector<char> inside;  // per vertex
  std::vector<Edge> edges;
};

Named named_by(const Mesh& mesh, const OnMarker& on) {
  const auto& names = mesh.marker_names();
  if (std::find(names.begin(), names.end(), on.name) == names.end())
    refuse_on("marker:" + on.name, "the mesh has no marker of that name");
  Named named{std::vector<char>(mesh.n_vertices(), 0), {}};
  for (const Marker& marker : mesh.markers()) {
    if (marker.name != on.name) continue;
    for (const auto& [from, to] : marker.edges) {
      const Vertex a = mesh.vertex_of_user(UserVertex(from)), b = mesh.vertex_of_user(UserVertex(to));
      named.edges.push_back({a, b});
      named.inside[a] = named.inside[b] = 1;
    }
  }
  return named;
}

Named named_by(const Mesh& mesh, const OnLabel& on) {
  Named named{std::vector<char>(mesh.n_vertices(), 0), {}};
  bool found = false;
  for (const Face face : mesh.faces()) {
    if (mesh.label(face) != on.label) continue;
    found = true;
    for (const Vertex v : mesh.triangles()[face]) named.inside[v] = 1;
    for (const Side h : mesh.sides(face)) {
      const Face across = mesh.face_across(h);
      if (across == none || mesh.label(across) != on.label) named.edges.push_back({mesh.from(h), mesh.to(h)});
    }
  }
  if (!found) refuse_on("label:" + std::to_string(on.label), "the mesh has no face with that label");
  return named;
}

std::vector<double> weights_of(const Mesh&, const OnAll&, const std::optional<Blend>& blend) {
  if (blend) throw ParameterError("blend", "blend needs an `on` that names a part of the mesh");
  return {};
}

std::vector<double> weights_of(const Mesh& mesh, const OnDisc& on, const std::optional<Blend>& blend) {
  return each_vertex(mesh, [&](Vertex, const Point& x) {
    const double outside = glm::distance(x, on.center) - on.radius;
    if (outside <= 0.0) return 1.0;
    return blend ? faded(*blend, outside) : 0.0;
  });
}

template <class On>
std::vector<double> weights_of(const Mesh& mesh, const On& on, const std::optional<Blend>& blend) {
  const Named named = named_by(mesh, on);
  if (!blend) return {named.inside.begin(), named.inside.end()};
  const SegmentIndex edges(mesh.positions(), named.edges);
  return each_vertex(mesh, [&](Vertex v, const Point& x) {
    if (named.inside[v]) return 1.0;
    return edges.maybe_within(x, blend->zero) ? faded(*blend, edges.distance(x)) : 0.0;
  });
}

}  // namespace

Restriction parse_restriction(std::string_view on, std::optional<std::array<double, 2>> blend) {
  Restriction restriction;
  if (on.starts_with("marker:") && on.size() > 7)
    restriction.on = OnMarker{std::string(on.substr(7))};
  else if (on.starts_with("label:"))
    restriction.on = parse_label(on, on.substr(6));
  else if (on.starts_with("disc:"))
    restriction.on = parse_disc(on, on.substr(5));
  else if (on != "all")
    refuse_on(on, expected_on);
  if (blend) restriction.blend = parse_blend(*blend);
  return restriction;
}

std::vector<double> weights(const Mesh& mesh, const Restriction& restriction) {
  return std::visit([&](const auto& on) { return weights_of(mesh, on, restriction.blend); }, restriction.on);
}

}  // namespace kinemesh
