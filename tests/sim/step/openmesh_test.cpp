// A mesh of OpenMesh's that follows the stepper is the stepper's, as OpenMesh's own circulators see it.
#include "kinemesh/openmesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>

#include "kinemesh/shapes.h"
#include "kinemesh/stepper.h"
#include "tests/sim/helpers.h"
#include "tests/sim/step/kicks.h"
#include "tests/untangle/random_tangles.h"

namespace kinemesh {
namespace {

using OpenMesh::EdgeHandle;
using OpenMesh::FaceHandle;
using OpenMesh::HalfedgeHandle;
using OpenMesh::VertexHandle;
using test::all_ways;
using test::grid;
using test::grid_with_hole;
using test::kicked;
using test::snapshot;
using test::stepper_on;
using test::two_labels;
using testing::HasSubstr;

template <class Scalar, int dimension>
struct TraitsOf : OpenMesh::DefaultTraits {
  using Point = OpenMesh::VectorT<Scalar, dimension>;
  using Normal = OpenMesh::VectorT<Scalar, 3>;
  VertexAttributes(OpenMesh::Attributes::Status);
  EdgeAttributes(OpenMesh::Attributes::Status);
  FaceAttributes(OpenMesh::Attributes::Status);
};
template <class Scalar, int dimension>
using OpenMeshOf = OpenMesh::TriMesh_ArrayKernelT<TraitsOf<Scalar, dimension>>;
using Open = OpenMeshOf<double, 2>;

template <class M>
class OpenMeshes : public testing::Test {};
using Kinds = testing::Types<OpenMeshOf<double, 2>, OpenMeshOf<float, 2>, OpenMeshOf<double, 3>,
                             OpenMeshOf<float, 3>, OpenMesh::TriMesh_ArrayKernelT<>>;
TYPED_TEST_SUITE(OpenMeshes, Kinds);

template <class M>
double coordinate(const M& open, int vertex, int axis) {
  return open.point(VertexHandle(vertex))[axis];
}

UserTriangle in_users(const Mesh& mesh, const MeshTriangle& t) {
  return {mesh.user_vertex(t[0]), mesh.user_vertex(t[1]), mesh.user_vertex(t[2])};
}

UserFace user_face_across(const Mesh& mesh, Side side) {
  const Face across = mesh.face_across(side);
  return across == none ? none : mesh.user_face(across);
}

template <class M>
void expect_linked(const M& open, HalfedgeHandle h) {
  ASSERT_EQ(open.next_halfedge_handle(open.prev_halfedge_handle(h)), h);
  ASSERT_EQ(open.prev_halfedge_handle(open.next_halfedge_handle(h)), h);
  ASSERT_EQ(open.to_vertex_handle(h), open.from_vertex_handle(open.next_halfedge_handle(h)));
  ASSERT_EQ(open.face_handle(h), open.face_handle(open.next_halfedge_handle(h)));
}

// Side by side, so that edges with the same ends are told from each other.
template <class M>
void expect_faces(const M& open, const Mesh& mesh) {
  const auto faces = mesh.faces_in_user_order();
  ASSERT_EQ(open.n_faces(), faces.size());
  std::map<int, int> handle{{none, none}};  // by the mesh's number; of padding none
  for (int f = 0; f < mesh.n_faces(); ++f) handle[f] = none;
  for (int f = 0; f < static_cast<int>(faces.size()); ++f) handle[faces[f]] = f;
  for (int f = 0; f < static_cast<int>(faces.size()); ++f) {
    Triangle corners{};
    int k = 0;
    for (const auto v : open.fv_range(FaceHandle(f))) corners.at(k++) = v.idx();
    ASSERT_EQ(k, 3);
    ASSERT_EQ(corners, numbers_of(in_users(mesh, mesh.triangles()[faces[f]]))) << f;
    std::map<int, int> across;  // by the vertex a side starts from
    for (const auto h : open.fh_range(FaceHandle(f))) {
      ASSERT_EQ(open.face_handle(h).idx(), f);
      across[open.from_vertex_handle(h).idx()] = open.opposite_face_handle(h).idx();
    }
    for (const auto side : Mesh::sides(faces[f])) {
      ASSERT_EQ(across.at(mesh.user_vertex(mesh.from(side))), handle.at(mesh.face_across(side))) << f;
    }
  }
}

// Of all halfedges each leaves one vertex, and a vertex on the border names the one without a face.
template <class M>
void expect_vertices(const M& open) {
  std::set<int> met;
  for (const auto v : open.vertices()) {
    int gaps = 0;
    for (const auto h : open.voh_range(v)) {
      ASSERT_EQ(open.from_vertex_handle(h), v);
      ASSERT_TRUE(met.insert(h.idx()).second) << h.idx();
      gaps += open.is_boundary(h);
    }
    ASSERT_LE(gaps, 1);
    ASSERT_EQ(gaps == 1, !open.is_isolated(v) && open.is_boundary(open.halfedge_handle(v)));
  }
  ASSERT_EQ(met.size(), open.n_halfedges());
  std::size_t without_face = 0;
  for (const auto h : open.halfedges()) {
    expect_linked(open, h);
    without_face += open.is_boundary(h);
  }
  ASSERT_EQ(open.n_halfedges(), 3 * open.n_faces() + without_face);
}

template <class M>
void expect_points(const M& open, const Mesh& mesh) {
  using Scalar = typename M::Scalar;
  const auto points = mesh.user_positions();
  ASSERT_EQ(open.n_vertices(), points.size());
  for (int v = 0; v < mesh.n_user_vertices(); ++v) {
    ASSERT_EQ(coordinate(open, v, 0), static_cast<Scalar>(points[v].x));
    ASSERT_EQ(coordinate(open, v, 1), static_cast<Scalar>(points[v].y));
  }
}

using Edges = std::set<std::pair<int, int>>;
std::map<std::string, Edges> edges_of(const std::vector<Marker>& markers) {
  std::map<std::string, Edges> all;
  for (const auto& [name, edges] : markers)
    for (const auto& [a, b] : edges) all[name].insert(std::minmax(a, b));
  return all;
}

template <class M>
void expect_same(const M& open, const Mesh& mesh) {
  expect_faces(open, mesh);
  if (!testing::Test::HasFatalFailure()) expect_vertices(open);
  if (!testing::Test::HasFatalFailure()) expect_points(open, mesh);
  if (testing::Test::HasFatalFailure()) return;
  const auto data = from_openmesh(open), domain = mesh.domain();
  ASSERT_EQ(data.triangles, domain.triangles);
  ASSERT_EQ(edges_of(data.markers), edges_of(domain.markers));
  for (int f = 0; f < data.n_faces(); ++f) ASSERT_EQ(data.label(f), domain.label(f)) << f;
}

// All that OpenMesh knows of a mesh's connectivity, and its points.
template <class M>
auto all_of(const M& open) {
  std::vector<int> numbers;
  std::vector<double> points;
  for (const auto h : open.halfedges())
    numbers.insert(numbers.end(), {open.to_vertex_handle(h).idx(), open.face_handle(h).idx(),
                                   open.next_halfedge_handle(h).idx(), open.prev_halfedge_handle(h).idx()});
  for (const auto v : open.vertices()) {
    numbers.push_back(open.halfedge_handle(v).idx());
    for (const auto x : open.point(v)) points.push_back(x);
  }
  for (const auto f : open.faces()) numbers.push_back(open.halfedge_handle(f).idx());
  return std::pair(numbers, points);
}

// Halfedges of a patch's faces and what lies across, by their ends; a valid mesh has one for any two.
template <class M>
std::map<std::pair<int, int>, int> halfedges_of(const M& open, const ChangedPatch& patch) {
  std::map<std::pair<int, int>, int> all;
  for (const auto& change : patch.faces)
    for (const auto inside : open.fh_range(FaceHandle(change.face)))
      for (const auto h : {inside, inside.opp()}) all[{h.from().idx(), h.to().idx()}] = h.idx();
  return all;
}

// A mesh of the user's that is told of each step, and what it must keep in it.
template <class M>
struct Follower {
  M open;
  int rewritten = 0, kept = 0;  // faces; halfedges of patches

  void follow(const StepChanges& changes) {
    std::vector<std::map<std::pair<int, int>, int>> before;
    for (const auto& patch : changes.patches) before.push_back(halfedges_of(open, patch));
    auto faces = halfedges_of_faces();
    apply(changes, open);
    for (std::size_t p = 0; p < before.size(); ++p) {
      expect_kept(before[p], halfedges_of(open, changes.patches[p]));
      rewritten += static_cast<int>(changes.patches[p].faces.size());
    }
    const auto now = halfedges_of_faces();
    for (const auto& patch : changes.patches)
      for (const auto& change : patch.faces) faces[change.face] = now[change.face];
    EXPECT_EQ(faces, now);
  }

  // The same handles, and between the same vertices the same.
  void expect_kept(const auto& before, const auto& after) {
    std::set<int> gone, come;
    for (const auto& [ends, h] : before) gone.insert(h);
    for (const auto& [ends, h] : after) {
      come.insert(h);
      if (!before.contains(ends)) continue;
      EXPECT_EQ(h, before.at(ends)) << ends.first << " " << ends.second;
      ++kept;
    }
    EXPECT_EQ(gone, come);
  }

  std::vector<std::vector<int>> halfedges_of_faces() const {
    std::vector<std::vector<int>> all(open.n_faces());
    for (const auto f : open.faces())
      for (const auto h : open.fh_range(f)) all[f.idx()].push_back(h.idx());
    return all;
  }
};

TYPED_TEST(OpenMeshes, FollowEveryWayToRepair) {
  for (const auto& options : all_ways()) {
    SCOPED_TRACE(test::name_of(options));
    std::mt19937 random(17);
    Stepper stepper = stepper_on(two_labels(12), options);
    Follower<TypeParam> follower{to_openmesh<TypeParam>(stepper.mesh())};
    stepper.observe([&](const StepChanges& changes) { follower.follow(changes); });
    for (int n = 0; n < 12; ++n) {
      ASSERT_TRUE(stepper.step(kicked(stepper, 0.02 + 0.008 * n, random), 0.5));
      expect_same(follower.open, stepper.mesh());
      if (this->HasFatalFailure()) return;
    }
    EXPECT_GT(follower.rewritten, 50);
    EXPECT_GT(follower.kept, 1000);
  }
}

bool touches_itself(const Mesh& mesh) {
  std::vector<int> gaps(mesh.n_vertices());
  for (const Face f : mesh.faces_in_user_order())
    for (const auto side : Mesh::sides(f)) gaps[mesh.from(side)] += user_face_across(mesh, side) == none;
  return std::ranges::any_of(gaps, [](int n) { return n > 1; });
}

struct Totals {
  int steps = 0, refused = 0, touching = 0, rewritten = 0;
};

// From where the tangle's vertices were to where they are, and on by jumps of half a cell.
void follow_tangle(test::Tangle tangle, std::uint64_t seed, Totals& totals) {
  const std::vector<Point> moved = tangle.mesh.user_positions();
  tangle.mesh.swap_positions(tangle.before);
  if (touches_itself(tangle.mesh)) {
    EXPECT_THROW((void)to_openmesh<Open>(tangle.mesh), InputError);
    ++totals.touching;
    return;
  }
  const auto ways = all_ways();
  Stepper stepper(tangle.mesh, ways[seed % ways.size()]);
  Follower<Open> follower{to_openmesh<Open>(stepper.mesh())};
  stepper.observe([&](const StepChanges& changes) { follower.follow(changes); });
  test::Random random(seed);
  auto next = moved;
  for (int n = 0; n < 4; ++n) {
    const bool is_taken = static_cast<bool>(stepper.step(next, 0.5));
    ++(is_taken ? totals.steps : totals.refused);
    expect_same(follower.open, stepper.mesh());
    if (testing::Test::HasFatalFailure()) return;
    Mesh mesh = stepper.mesh();
    if (seed % 3 == 2)
      test::jump_anywhere(mesh, random);
    else
      test::move_free(mesh, [&](const Point& p) {
        return p + 0.3 * Point(random.between(-1, 1), random.between(-1, 1));
      });
    next = mesh.user_positions();
  }
  totals.rewritten += follower.rewritten;
}

TEST(OpenMeshes, FollowThousandsOfTangles) {
  Totals totals;
  for (std::uint64_t seed = 0; seed < 1500 && !HasFatalFailure(); ++seed) {
    SCOPED_TRACE(seed);
    const auto tangle = seed % 3 == 0   ? test::random_tangle(seed)
                        : seed % 3 == 1 ? test::lattice_tangle(seed)
                                        : test::polyomino_tangle(seed);
    follow_tangle(tangle, seed, totals);
  }
  EXPECT_GT(totals.steps, 2000);
  EXPECT_GT(totals.refused, 100);
  EXPECT_GT(totals.touching, 20);
  EXPECT_GT(totals.rewritten, 20000);
}

// Changes without a stepper: flips wherever an edge has two other corners, whatever the shape of the faces.
struct Flips {
  Mesh mesh;
  std::map<UserFace, UserTriangle> before;  // of the faces they rewrite, by the user's number
  int doubled = 0;                          // edges they have made between vertices that had one

  void flip(Side side) {
    const Side across = mesh.opposite(side);
    if (!mesh.is_flippable(side) || mesh.is_padding(Mesh::face_of(side))) return;
    if (mesh.apex(side) == mesh.apex(across)) return;
    for (const Face face : {Mesh::face_of(side), Mesh::face_of(across)})
      before.try_emplace(mesh.user_face(face), in_users(mesh, mesh.triangles()[face]));
    doubled += are_joined(mesh.apex(side), mesh.apex(across));
    mesh.flip(side);
  }

  bool are_joined(Vertex a, Vertex b) const {
    for (const Face f : mesh.faces())
      for (const auto side : Mesh::sides(f))
        if (mesh.from(side) == a && mesh.to(side) == b) return true;
    return false;
  }

  std::vector<ChangedPatch> patches() const {
    ChangedPatch patch;
    const auto faces = mesh.faces_in_user_order();
    for (const auto& [face, corners] : before) {
      const Face now = faces[face];
      const int label = mesh.label(now);
      patch.faces.push_back({face, corners, in_users(mesh, mesh.triangles()[now]), label, label});
    }
    return {patch};
  }
};

template <class M>
void apply_to(M& open, const Mesh& mesh, const std::vector<ChangedPatch>& patches) {
  const RepairRecord repair;
  apply({.mesh = mesh,
         .positions_before = mesh.positions(),
         .repair = repair,
         .patches = patches,
         .moved_by_quality = {}},
        open);
}

TEST(OpenMeshes, TellEdgesWithTheSameEndsFromEachOther) {
  test::Random random(5);
  Flips flips{build_mesh(two_labels(6)), {}};
  Open open = to_openmesh<Open>(flips.mesh);
  for (int n = 0; n < 1000; ++n) {
    flips.before.clear();
    for (int i = 0; i < 1 + n % 8; ++i)
      flips.flip(Mesh::side(Face(random.below(flips.mesh.n_faces())), random.below(3)));
    if (flips.before.empty()) continue;
    apply_to(open, flips.mesh, flips.patches());
    expect_same(open, flips.mesh);
    if (n % 100 == 0) expect_same(to_openmesh<Open>(flips.mesh), flips.mesh);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(flips.doubled, 100);
}

TYPED_TEST(OpenMeshes, AreTakenAndGivenBack) {
  for (const auto& data : {two_labels(8), make_disk(200), make_annulus(300), make_channel(400), grid(5)}) {
    const Mesh mesh = build_mesh(data, {.frame = 0.25});
    const auto open = to_openmesh<TypeParam>(mesh);
    expect_same(open, mesh);
    if (this->HasFatalFailure()) return;
    expect_same(open, build_mesh(open, {.frame = 0.25}));
  }
}

TEST(OpenMeshes, GiveTheMeshTheirArraysGive) {
  const auto data = two_labels(8);
  EXPECT_EQ(snapshot(build_mesh(to_openmesh<Open>(build_mesh(data)))), snapshot(build_mesh(data)));
}

// As users make them: by add_face, which chooses halfedges of its own.
template <class M>
M added_one_by_one(const MeshData& data) {
  M open;
  for (const Point& p : data.points) {
    typename M::Point point(3.5);
    point[0] = static_cast<typename M::Scalar>(p.x);
    point[1] = static_cast<typename M::Scalar>(p.y);
    open.add_vertex(point);
  }
  for (const auto& [a, b, c] : data.triangles)
    open.add_face(VertexHandle(a), VertexHandle(b), VertexHandle(c));
  return open;
}

TYPED_TEST(OpenMeshes, MayBeMadeByHand) {
  std::mt19937 random(3);
  const auto data = two_labels(12);
  auto open = added_one_by_one<TypeParam>(data);
  ASSERT_EQ(from_openmesh(open).triangles, data.triangles);
  for (int f = 0; f < data.n_faces(); f += 2)  // their corners may begin anywhere
    open.set_halfedge_handle(FaceHandle(f), open.next_halfedge_handle(open.halfedge_handle(FaceHandle(f))));
  Stepper stepper = stepper_on(from_openmesh(open), {.quality = "delaunay"});
  Follower<TypeParam> follower{open};
  stepper.observe([&](const StepChanges& changes) { follower.follow(changes); });
  for (int n = 0; n < 10; ++n) {
    ASSERT_TRUE(stepper.step(kicked(stepper, 0.05, random), 0.5));
    expect_same(follower.open, stepper.mesh());
    if (this->HasFatalFailure()) return;
  }
  if constexpr (TypeParam::Point::size_ == 3) {
    for (int v = 0; v < data.n_vertices(); ++v) EXPECT_EQ(coordinate(follower.open, v, 2), 3.5);
  }
}

TEST(OpenMeshes, HaveLockedVerticesThatAreFixed) {
  auto open = to_openmesh<Open>(build_mesh(grid(4), {.frame = 0.0, .fixed = {7}}));
  open.status(VertexHandle(12)).set_locked(true);
  const Mesh mesh = build_mesh(open, {.frame = 0.0, .fixed = {3}});
  for (const UserVertex v : Numbers<UserVertex>(mesh.n_user_vertices()))
    EXPECT_EQ(mesh.is_fixed(mesh.vertex_of_user(v)), v == 3 || v == 7 || v == 12) << v;
}

TEST(OpenMeshes, KeepAnIsolatedVertex) {
  auto data = grid(4);
  data.points.push_back({0.3, 0.3});
  const Mesh mesh = build_mesh(data);
  const auto open = to_openmesh<Open>(mesh);
  expect_same(open, mesh);
  EXPECT_TRUE(open.is_isolated(VertexHandle(25)));
}

template <class Call>
std::string refusal(const Call& call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(OpenMeshes, AreRefusedByName) {
  const auto whole = to_openmesh<OpenMeshOf<double, 3>>(build_mesh(grid(4)));
  const auto refused = [&](const auto& spoil) {
    auto open = whole;
    spoil(open);
    return refusal([&] { (void)build_mesh(open); });
  };
  EXPECT_EQ(refused([](auto&) {}), "");
  EXPECT_EQ(refused([](auto& open) { open.delete_face(FaceHandle(5), false); }),
            "face 5 of the OpenMesh mesh is deleted, garbage_collection() expected before");
  EXPECT_EQ(refused([](auto& open) { open.delete_vertex(VertexHandle(12)); }),
            "vertex 12 of the OpenMesh mesh is deleted, garbage_collection() expected before");
  EXPECT_EQ(refused([](auto& open) { open.point(VertexHandle(7))[2] = 0.5; }),
            "vertex 7 of the OpenMesh mesh has another third coordinate than vertex 0");
  EXPECT_EQ(refused([](auto& open) { open.point(VertexHandle(7))[1] = NAN; }),
            "vertex 7 has a position that is not finite");
  EXPECT_EQ(refused([](auto& open) {
              OpenMesh::EPropHandleT<int> wrong;
              open.add_property(wrong, "marker:inlet");
            }),
            "edge property 'marker:inlet' of the OpenMesh mesh is not of bool");
  EXPECT_EQ(refused([](auto& open) {
              OpenMesh::FPropHandleT<int> label;
              open.get_property_handle(label, "label");
              open.remove_property(label);
              OpenMesh::FPropHandleT<double> wrong;
              open.add_property(wrong, "label");
            }),
            "face property 'label' of the OpenMesh mesh is not of int");
  EXPECT_EQ(refused([](auto& open) { open.clear(); }), "the mesh has no faces");
}

// Two squares that have a corner in common.
TEST(OpenMeshes, DoNotTouchThemselvesInAVertex) {
  MeshData data;
  data.points = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {2, 1}, {2, 2}, {1, 2}};
  data.triangles = {{0, 1, 2}, {0, 2, 3}, {2, 4, 5}, {2, 5, 6}};
  const std::string expected = "the domain touches itself in vertex 2, which an OpenMesh mesh cannot follow";
  EXPECT_EQ(refusal([&] { (void)to_openmesh<Open>(build_mesh(data)); }), expected);
  EXPECT_EQ(refusal([&] { (void)build_mesh(added_one_by_one<Open>(data)); }), expected);
}

TEST(OpenMeshes, HoldPositionsThatFit) {
  auto data = grid(1);
  for (auto& p : data.points) p *= 1e100;
  const Mesh mesh = build_mesh(data);
  EXPECT_EQ(refusal([&] { (void)to_openmesh<Open>(mesh); }), "");
  EXPECT_EQ(refusal([&] { (void)to_openmesh<OpenMeshOf<float, 2>>(mesh); }),
            "vertex 1 of the OpenMesh mesh has a position too large for its coordinates");
}

// A step of a mesh that was spoilt before: vetoed with a message that has `said` in it, and nothing has
// changed.
template <class M, class Spoil>
void expect_veto(const std::string& said, const Spoil& spoil, const StepperOptions& options = {}) {
  SCOPED_TRACE(said);
  std::mt19937 random(7);
  Stepper stepper = stepper_on(two_labels(12), options);
  auto open = to_openmesh<M>(stepper.mesh());
  spoil(open);
  stepper.observe([&](const StepChanges& changes) { apply(changes, open); });
  const auto mesh_before = snapshot(stepper.mesh());
  const auto open_before = all_of(open);
  EXPECT_THAT(refusal([&] { (void)stepper.step(kicked(stepper, 0.1, random), 0.5); }), HasSubstr(said));
  EXPECT_EQ(snapshot(stepper.mesh()), mesh_before);
  EXPECT_EQ(all_of(open), open_before);
}

TEST(OpenMeshes, VetoAStepThatIsNotTheirs) {
  expect_veto<Open>("the OpenMesh mesh has 170 vertices, the stepper's 169", [](Open& open) {
    open.add_vertex({0.0, 0.0});
  });
  expect_veto<Open>("the OpenMesh mesh has 281 faces, the stepper's 280", [](Open& open) {
    open.add_face(VertexHandle(70), VertexHandle(71), VertexHandle(83));  // in the hole
  });
  expect_veto<Open>(" is deleted, garbage_collection() expected before",
                    [](Open& open) { open.delete_face(FaceHandle(100), false); });
  for (const int f : {30, 100, 200, 270})
    expect_veto<Open>(" or a neighbour of it is not as in the stepper's mesh before the step",
                      [&](Open& open) {
                        for (const auto e : open.fe_range(FaceHandle(f)))
                          if (open.is_flip_ok(e)) return open.flip(e);
                      });
}

// Gives one of the two faces at an edge an edge of its own: all corners are as they were.
void slit(Open& open, EdgeHandle edge) {
  const auto old = open.halfedge_handle(edge, 1);
  const auto face = open.face_handle(old);
  const auto from = open.from_vertex_handle(old), to = open.to_vertex_handle(old);
  const auto before = open.prev_halfedge_handle(old), after = open.next_halfedge_handle(old);
  const auto own = open.new_edge(from, to), gap = open.opposite_halfedge_handle(own);
  open.set_face_handle(own, face);
  open.set_next_halfedge_handle(before, own);
  open.set_next_halfedge_handle(own, after);
  open.set_halfedge_handle(face, own);
  open.set_boundary(old);
  open.set_next_halfedge_handle(old, gap);
  open.set_next_halfedge_handle(gap, old);
}

TEST(OpenMeshes, VetoAStepWhereFacesAreNotJoinedAsTheirs) {
  const Mesh mesh = build_mesh(grid(6));
  auto next = mesh.user_positions();
  next[24] = {0.3, 0.7};  // through a few faces
  const Open whole = to_openmesh<Open>(mesh);
  int vetoes = 0;
  for (const auto e : whole.edges()) {
    if (whole.is_boundary(e)) continue;
    Open open = whole;
    slit(open, e);
    bool is_at_rewritten = false;
    Stepper stepper(mesh);
    const auto before = all_of(open);
    stepper.observe([&](const StepChanges& changes) {
      for (const auto& patch : changes.patches)
        for (const auto& change : patch.faces)
          for (const int i : {0, 1})
            is_at_rewritten |= whole.face_handle(whole.halfedge_handle(e, i)).idx() == change.face;
      apply(changes, open);
    });
    const auto said = refusal([&] { (void)stepper.step(next, 0.5); });
    EXPECT_EQ(said != "", is_at_rewritten) << e.idx();
    if (said == "") continue;
    EXPECT_EQ(all_of(open), before);
    ++vetoes;
  }
  EXPECT_GT(vetoes, 10);
  EXPECT_LT(vetoes, 90);
}

TEST(OpenMeshes, VetoAStepOutOfTheirRange) {
  auto data = grid(4);
  for (auto& p : data.points) p *= 1e38;
  Stepper stepper = stepper_on(data, {});
  auto open = to_openmesh<OpenMeshOf<float, 2>>(stepper.mesh());
  stepper.observe([&](const StepChanges& changes) { apply(changes, open); });
  for (auto& p : data.points) p += Point(4e38, 0.0);
  const auto before = all_of(open);
  EXPECT_EQ(refusal([&] { (void)stepper.step(data.points, 0.5); }),
            "vertex 0 of the OpenMesh mesh has a position too large for its coordinates");
  EXPECT_EQ(all_of(open), before);
}

TEST(OpenMeshes, VetoAStepInWhichAVertexEscapes) {
  const auto data = grid_with_hole(8, 3, 5);
  Stepper stepper = stepper_on(data, {.allow_escaped = true});
  Open open = to_openmesh<Open>(stepper.mesh());
  bool is_following = true;
  stepper.observe([&](const StepChanges& changes) {
    if (is_following) apply(changes, open);
  });
  auto next = data.points;
  next[2 * 9 + 2] = {0.5, 0.5};  // into the hole
  const auto before = all_of(open);
  EXPECT_THAT(refusal([&] { (void)stepper.step(next, 0.5); }), HasSubstr("a vertex has escaped, and face "));
  EXPECT_EQ(all_of(open), before);

  is_following = false;
  ASSERT_TRUE(stepper.step(next, 0.5));
  open = to_openmesh<Open>(stepper.mesh());
  expect_same(open, stepper.mesh());
  is_following = true;
  EXPECT_EQ(refusal([&] { (void)stepper.step(next, 0.5); }),
            "the numbers of the stepper's faces have gaps since vertices have escaped");
}

// Across an interface the faces stay in the domain, and change their label.
TEST(OpenMeshes, FollowAVertexAcrossAnInterface) {
  const auto data = two_labels(12);
  Stepper stepper = stepper_on(data, {.allow_escaped = true});
  Open open = to_openmesh<Open>(stepper.mesh());
  stepper.observe([&](const StepChanges& changes) { apply(changes, open); });
  auto next = data.points;
  next[6 * 13 + 2] = {0.36, 0.48};  // from x = 1/6, the interface is at 1/4
  const auto outcome = stepper.step(next, 0.5);
  ASSERT_TRUE(outcome);
  EXPECT_EQ(outcome.record.repair.escaped, 1);
  EXPECT_NE(stepper.mesh().domain().labels, data.labels);
  expect_same(open, stepper.mesh());
}

}  // namespace
}  // namespace kinemesh
