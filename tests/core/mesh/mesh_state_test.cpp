// A mesh that was taken apart comes back in all that can be asked of it, and goes on alike.
#include "core/mesh/mesh_state.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <set>

#include "kinemesh/validate.h"
#include "tests/core/mesh/disordered.h"
#include "tests/core/mesh/edges.h"
#include "tests/core/mesh/snapshot.h"
#include "tests/untangle/random_tangles.h"
#include "tests/untangle/repairs.h"

namespace kinemesh {

static bool operator==(const Marker& a, const Marker& b) {
  return a.name == b.name && a.edges == b.edges;
}

static bool operator==(const Constraint& a, const Constraint& b) {
  return a.from == b.from && a.to == b.to && a.left == b.left && a.right == b.right && a.marker == b.marker;
}

static bool operator==(const ListedConstraint& a, const ListedConstraint& b) {
  return a.from == b.from && a.to == b.to && a.left == b.left && a.right == b.right && a.marker == b.marker;
}

namespace test {
namespace {

using ::testing::HasSubstr;

// The first accessor whose answer differs, or "".
std::string difference(const Mesh& a, const Mesh& b) {
  std::string found;
  const auto compare = [&](const char* name, const auto& get) {
    if (found.empty() && !(get(a) == get(b))) found = name;
  };
  const auto compare_each = [&](const char* name, const auto& numbers, const auto& get) {
    compare(name, [&](const Mesh& mesh) {
      std::vector<std::decay_t<decltype(get(mesh, *numbers(mesh).begin()))>> values;
      for (const auto i : numbers(mesh)) values.push_back(get(mesh, i));
      return values;
    });
  };
  const auto faces = [](const Mesh& m) { return m.faces(); };
  const auto vertices = [](const Mesh& m) { return m.vertices(); };
  const auto user_vertices = [](const Mesh& m) { return Numbers<UserVertex>(m.n_user_vertices()); };
  const auto list = [](const auto& items) { return std::vector(items.begin(), items.end()); };
  compare("snapshot", snapshot_of);
  compare("n_edges", [](const Mesh& m) { return m.n_edges(); });
  compare("n_user_vertices", [](const Mesh& m) { return m.n_user_vertices(); });
  compare("n_user_faces", [](const Mesh& m) { return m.n_user_faces(); });
  compare("constraints", [&](const Mesh& m) { return list(m.constraints()); });
  compare("markers", [](const Mesh& m) { return m.markers(); });
  compare("marker_names", [](const Mesh& m) { return m.marker_names(); });
  compare("hull", [&](const Mesh& m) { return list(m.hull()); });
  compare("frame", [&](const Mesh& m) { return list(m.frame()); });
  compare("frame_margin", [](const Mesh& m) { return m.frame_margin(); });
  compare("faces_in_user_order", [](const Mesh& m) { return m.faces_in_user_order(); });
  compare("user_positions", [](const Mesh& m) { return m.user_positions(); });
  compare("domain().triangles", [](const Mesh& m) { return m.domain().triangles; });
  compare("domain().labels", [](const Mesh& m) { return m.domain().labels; });
  compare("domain().markers", [](const Mesh& m) { return m.domain().markers; });
  compare("domain().label_names", [](const Mesh& m) { return m.domain().label_names; });
  compare_each("has_constraint", faces, [](const Mesh& m, Face f) {
    return Triangle{m.has_constraint(Mesh::side(f, 0)), m.has_constraint(Mesh::side(f, 1)),
                    m.has_constraint(Mesh::side(f, 2))};
  });
  compare_each("is_isolated", vertices, [](const Mesh& m, Vertex v) { return m.is_isolated(v); });
  compare_each("is_constrained", vertices, [](const Mesh& m, Vertex v) { return m.is_constrained(v); });
  compare_each("home_label", vertices, [](const Mesh& m, Vertex v) { return m.home_label(v); });
  compare_each("is_fixed", vertices, [](const Mesh& m, Vertex v) { return m.is_fixed(v); });
  compare_each("user_vertex", vertices, [](const Mesh& m, Vertex v) { return m.user_vertex(v); });
  compare_each("vertex_of_user", user_vertices,
               [](const Mesh& m, UserVertex u) { return m.vertex_of_user(u); });
  return found;
}

Mesh restored(const Mesh& mesh) {
  const MeshBase base = base_of(mesh);
  return restore(base, state_of(mesh, base.order));
}

// The padding's numbers, too, which can be asked only once a face has changed sides.
bool have_same_parts(const Mesh& a, const Mesh& b) {
  const MeshBase of_a = base_of(a), of_b = base_of(b);
  return of_a.order.vertices == of_b.order.vertices && of_a.order.faces == of_b.order.faces &&
         of_a.order.constraints == of_b.order.constraints && of_a.order.turned == of_b.order.turned &&
         of_a.constraints == of_b.constraints &&
         state_of(a, of_a.order).doubled == state_of(b, of_b.order).doubled;
}

// Cells with labels, some missing; marked lines, inner ones and a second name for some; isolated and fixed
// vertices.
MeshData random_data(Random& random) {
  MeshData data = random_grid(3 + random.below(5), 3 + random.below(5), random);
  std::erase_if(data.triangles, [&](const Triangle&) { return random.one_in(9); });
  if (random.one_in(2))
    for (std::size_t f = 0; f < data.triangles.size(); ++f) data.labels.push_back(random.below(3) - 1);
  data.label_names = {{1, "one"}};
  for (const char* name : {"first", "second", "none"}) {
    Marker& marker = data.markers.emplace_back(Marker{name, {}});
    for (int i = 0; i < 6 && marker.name != "none"; ++i) {
      const Triangle& t = data.triangles[random.below(data.n_faces())];
      marker.edges.push_back({t[1], t[0]});
    }
  }
  data.points.push_back({0.3, 0.4});
  return data;
}

std::vector<int> random_fixed(const MeshData& data, Random& random) {
  std::set<int> fixed;
  while (random.below(4) > 0) fixed.insert(random.below(data.n_vertices()));
  return {fixed.begin(), fixed.end()};
}

BuildOptions random_options(const MeshData& data, Random& random) {
  return {.frame = random.one_in(2) ? 0.5 : 0.0, .fixed = random_fixed(data, random)};
}

Mesh random_mesh(std::uint64_t seed) {
  Random random(seed);
  if (seed % 4 == 0) return random_tangle(seed).mesh;
  if (seed % 4 == 1) return polyomino_tangle(seed).mesh;
  const MeshData data = random_data(random);
  return build_mesh(data, random_options(data, random));
}

void throw_free(Mesh& mesh, Random& random) {
  const double reach = random.between(0.01, 1.0);
  move_free(mesh, [&](const Point& p) {
    return snapped(p + Point(random.between(-reach, reach), random.between(-reach, reach)));
  });
}

void flip_some(Mesh& mesh, Random& random) {
  for (int i = 0; i < mesh.n_edges(); ++i) {
    const Side side = random_edge(mesh, random);
    if (mesh.is_flippable(side) && mesh.apex(side) != mesh.apex(mesh.opposite(side))) mesh.flip(side);
  }
}

// Nothing, a repair that may let vertices escape, or flips without sense, which leave doubled edges.
void change(Mesh& mesh, Random& random) {
  const int what = random.below(4);
  if (what == 0) return flip_some(mesh, random);
  for (int i = 0; i < what; ++i) {
    throw_free(mesh, random);
    (void)repair(mesh, true, i % 2 == 0 ? "global" : "local");
  }
}

TEST(MeshState, ComesBackAndGoesOnAlike) {
  int n_changed = 0, n_doubled = 0, n_escaped = 0;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    Mesh mesh = random_mesh(seed);
    const auto before = snapshot_of(mesh);
    ASSERT_EQ(difference(mesh, restored(mesh)), "") << seed;
    Random random(seed);
    change(mesh, random);
    Mesh other = restored(mesh);
    ASSERT_EQ(difference(mesh, other), "") << seed;
    ASSERT_TRUE(have_same_parts(mesh, other)) << seed;
    n_changed += !(snapshot_of(mesh) == before);
    n_doubled += !state_of(mesh, base_of(mesh).order).doubled.empty();
    for (const Vertex v : mesh.vertices())
      n_escaped += !mesh.is_isolated(v) && !mesh.is_constrained(v) &&
                   mesh.label(Mesh::face_of(mesh.side_from(v))) != mesh.home_label(v);
    for (int i = 0; i < 3; ++i) {
      Random once(seed + i), again(seed + i);
      throw_free(mesh, once);
      throw_free(other, again);
      const auto first = repair(mesh, true), second = repair(other, true);
      ASSERT_EQ(message(first.defect), message(second.defect)) << seed;
      ASSERT_EQ(difference(mesh, other), "") << seed;
    }
  }
  EXPECT_GT(n_changed, 250);
  EXPECT_GT(n_doubled, 50);
  EXPECT_GT(n_escaped, 50);
}

TEST(MeshState, DoesNotDependOnTheMeshsOrder) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    Random random(seed);
    const MeshData data = random_data(random);
    const BuildOptions options = random_options(data, random);
    const Mesh a = build_mesh(data, options), b = disordered(data, options, seed);
    const MeshBase of_a = base_of(a), of_b = base_of(b);
    EXPECT_NE(of_a.order.vertices, of_b.order.vertices);
    EXPECT_EQ(of_a.fixed, of_b.fixed);
    EXPECT_EQ(of_a.home, of_b.home);
    ASSERT_TRUE(of_a.constraints == of_b.constraints) << seed;
    const MeshState state_a = state_of(a, of_a.order), state_b = state_of(b, of_b.order);
    EXPECT_EQ(state_a.positions, state_b.positions);
    EXPECT_EQ(state_a.labels, state_b.labels);
    EXPECT_EQ(state_a.constraint_sides, state_b.constraint_sides) << seed;
    const auto domain = [&](const MeshState& state) {
      return std::vector(state.triangles.begin(), state.triangles.begin() + data.n_faces());
    };
    EXPECT_EQ(domain(state_a), domain(state_b)) << seed;
    EXPECT_EQ(domain(state_a), data.triangles);
  }
}

// What restore says to parts that were changed.
class Refused : public ::testing::Test {
 protected:
  Refused() : mesh_(build_mesh(data(), {.frame = 0.5, .fixed = {1}})), base_(base_of(mesh_)) {
    state_ = state_of(mesh_, base_.order);
  }

  static MeshData data() {
    Random random(1);
    MeshData data = random_grid(3, 3, random);
    for (int f = 0; f < data.n_faces(); ++f) data.labels.push_back(f < 9);
    data.markers = {{"inner", {{data.triangles[0][0], data.triangles[0][1]}}}};
    return data;
  }

  std::string error(const std::function<void(MeshBase&, MeshState&)>& change) const {
    MeshBase base = base_;
    MeshState state = state_;
    change(base, state);
    try {
      (void)restore(base, state);
      return "none";
    } catch (const InputError& e) {
      return e.what();
    }
  }

  Mesh mesh_;
  MeshBase base_;
  MeshState state_;
};

TEST_F(Refused, PartsOfOtherSizes) {
  const char* const sizes = "different sizes";
  EXPECT_EQ(error([](MeshBase&, MeshState&) {}), "none");
  EXPECT_THAT(error([](MeshBase& b, MeshState&) { b.home.pop_back(); }), HasSubstr(sizes));
  EXPECT_THAT(error([](MeshBase& b, MeshState&) { b.order.faces.pop_back(); }), HasSubstr(sizes));
  EXPECT_THAT(error([](MeshBase& b, MeshState&) { b.order.constraints.pop_back(); }), HasSubstr(sizes));
  EXPECT_THAT(error([](MeshBase&, MeshState& s) { s.labels.pop_back(); }), HasSubstr(sizes));
  EXPECT_THAT(error([](MeshBase&, MeshState& s) { s.positions.clear(); }), HasSubstr("fewer than three"));
  EXPECT_THAT(error([](MeshBase& b, MeshState&) { b.frame = -1.0; }), HasSubstr("margin"));
}

TEST_F(Refused, WhatTheMeshDoesNotHave) {
  EXPECT_THAT(error([](MeshBase& b, MeshState&) { b.order.vertices[3] = b.order.vertices[4]; }),
              HasSubstr("no permutation"));
  EXPECT_THAT(error([](MeshBase& b, MeshState&) { b.order.faces[3] = -1; }), HasSubstr("no permutation"));
  EXPECT_THAT(error([](MeshBase& b, MeshState&) { b.fixed = {1000}; }), HasSubstr("fixed vertex"));
  EXPECT_THAT(error([](MeshBase& b, MeshState&) { b.constraints[2].marker = 1; }), HasSubstr("a marker"));
  EXPECT_THAT(error([](MeshBase& b, MeshState&) {
                b.markers[0].edges[0] = {0, 8};
              }),
              HasSubstr("not constrained"));
  EXPECT_THAT(error([](MeshBase&, MeshState& s) { s.triangles[5][1] = 1000; }), HasSubstr("corner"));
  EXPECT_THAT(error([](MeshBase&, MeshState& s) { s.triangles[5][1] = s.triangles[5][0]; }),
              HasSubstr("two corners"));
  EXPECT_THAT(error([](MeshBase&, MeshState& s) { s.constraint_sides[2] = 3; }), HasSubstr("side"));
  EXPECT_THAT(error([](MeshBase&, MeshState& s) { s.doubled = {{0, 1 << 20}}; }), HasSubstr("side"));
  EXPECT_THAT(error([](MeshBase&, MeshState& s) { std::ranges::fill(s.labels, padding_label); }),
              HasSubstr("nothing but padding"));
}

TEST_F(Refused, WhatDoesNotFitTogether) {
  EXPECT_THAT(error([](MeshBase&, MeshState& s) {
                const int last = static_cast<int>(s.positions.size()) - 1;
                for (Triangle& t : s.triangles)
                  for (int& v : t) v = v == last ? last - 1 : v == last - 1 ? last : v;
              }),
              HasSubstr("frame"));
  EXPECT_NE(error([](MeshBase&, MeshState& s) { std::swap(s.triangles[5][0], s.triangles[5][1]); }), "none");
  EXPECT_NE(error([](MeshBase&, MeshState& s) { s.doubled = {{0, 5}}; }), "none");
  EXPECT_NE(error([](MeshBase&, MeshState& s) { s.labels[0] = 7; }), "none");
  EXPECT_THAT(error([](MeshBase&, MeshState& s) { s.constraint_sides[1] = s.constraint_sides[0]; }),
              HasSubstr("twice"));
  EXPECT_NE(error([](MeshBase& b, MeshState&) { b.constraints[0].left = 7; }), "none");
  EXPECT_NE(error([](MeshBase& b, MeshState& s) {
              b.constraints.pop_back();
              s.constraint_sides.pop_back();
              b.order.constraints = {};
              for (std::size_t i = 0; i < b.constraints.size(); ++i)
                b.order.constraints.push_back(static_cast<int>(i));
            }),
            "none");
}

// Whatever single number is changed, what comes out is valid in its connectivity or nothing.
TEST_F(Refused, OrValidWhateverNumberIsChanged) {
  int n_refused = 0, n_read = 0;
  const auto try_all = [&](auto get, std::size_t size) {
    for (std::size_t i = 0; i < size; ++i) {
      for (const int value : {-2147483647, -1, 0, 1, 7, 1000, 2147483647}) {
        MeshBase base = base_;
        MeshState state = state_;
        get(base, state, i) = value;
        try {
          EXPECT_FALSE(validate_connectivity(restore(base, state)));
          ++n_read;
        } catch (const InputError&) {
          ++n_refused;
        }
      }
    }
  };
  const auto corner = [](MeshBase&, MeshState& s, std::size_t i) -> int& {
    return s.triangles[i / 3][i % 3];
  };
  const auto label = [](MeshBase&, MeshState& s, std::size_t i) -> int& { return s.labels[i]; };
  const auto side = [](MeshBase&, MeshState& s, std::size_t i) -> int& { return s.constraint_sides[i]; };
  const auto vertex = [](MeshBase& b, MeshState&, std::size_t i) -> int& { return b.order.vertices[i]; };
  const auto from = [](MeshBase& b, MeshState&, std::size_t i) -> int& { return b.constraints[i].from; };
  const auto to = [](MeshBase& b, MeshState&, std::size_t i) -> int& { return b.constraints[i].to; };
  const auto left = [](MeshBase& b, MeshState&, std::size_t i) -> int& { return b.constraints[i].left; };
  try_all(corner, 3 * state_.triangles.size());
  try_all(label, state_.labels.size());
  try_all(side, state_.constraint_sides.size());
  try_all(vertex, base_.order.vertices.size());
  try_all(from, base_.constraints.size());
  try_all(to, base_.constraints.size());
  try_all(left, base_.constraints.size());
  EXPECT_GT(n_refused, 1000);
  EXPECT_GT(n_read, 10);
}

}  // namespace
}  // namespace test
}  // namespace kinemesh
