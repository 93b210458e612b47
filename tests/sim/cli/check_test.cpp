// `kinemesh check`: every way in which a mesh can be valid or not.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "program.h"

namespace kinemesh::testing {
namespace {

using Json = nlohmann::json;

class Check : public ProgramTest {
 protected:
  Json check(const std::string& file, int code) const {
    const Result result = run({"check", file, "--json"});
    EXPECT_EQ(result.code, code) << result.out << result.err;
    const Json json = Json::parse(result.out, nullptr, false);
    EXPECT_FALSE(json.is_discarded()) << result.out;
    EXPECT_EQ(json.value("schema", ""), "kinemesh-check-1");
    EXPECT_EQ(json.value("valid", code != 0), code == 0);
    EXPECT_EQ(json["culprits"].empty(), code == 0) << json["culprits"];
    return json;
  }
};

TEST_F(Check, ValidGrid) {
  const Json json = check(write("grid.off", grid_off(3)), 0);
  EXPECT_EQ(json["vertices"], 16);
  EXPECT_EQ(json["isolated_vertices"], 0);
  EXPECT_EQ(json["faces"], 18);
  EXPECT_EQ(json["inverted"], 0);
  EXPECT_EQ(json["degenerate"], 0);
  EXPECT_EQ(json["inverted_components"], 0);
  EXPECT_EQ(json["connected_parts"], 1);
  EXPECT_EQ(json["border_loops"], 1);
  EXPECT_EQ(json["markers"], Json::array());
  EXPECT_NEAR(json["min_angle_deg"].get<double>(), 45.0, 1e-12);
  EXPECT_EQ(json["min_area"], 0.5);
}

// Vertex 5 = (1, 1) of a 3 x 3 grid goes to (2.5, 1.25), across two sides of the hexagon around it: (1,
// 0)-(2, 1), which face 3 has, and (2, 1)-(2, 2), which face 8 has.
TEST_F(Check, TangledGridNamesItsFaces) {
  const Json json = check(write("grid.off", grid_off(3, {{5, 2.5, 1.25}})), 1);
  EXPECT_EQ(json["inverted"], 2);
  EXPECT_EQ(json["degenerate"], 0);
  EXPECT_EQ(json["inverted_components"], 1);
  EXPECT_EQ(json["min_area"], -0.25);
  ASSERT_EQ(json["culprits"].size(), 2u);
  const Json culprit = json["culprits"][0];
  EXPECT_EQ(culprit["kind"], "inverted face");
  EXPECT_EQ(culprit["faces"], Json({3}));
  EXPECT_EQ(culprit["vertices"], Json({1, 6, 5}));
  EXPECT_EQ(json["culprits"][1]["faces"], Json({8}));
}

// Vertex 5 = (1, 1) goes to (3, 1): halfway it is at vertex 6 = (2, 1), with which it has faces 3 and 8.
TEST_F(Check, TowardAnotherMesh) {
  const auto from = write("from.off", grid_off(3)), to = write("to.off", grid_off(3, {{5, 3.0, 1.0}}));
  const Json json = Json::parse(run({"check", from, "--toward", to, "--json"}).out);
  EXPECT_EQ(json["max_safe_step"], 0.5);
  EXPECT_EQ(json["first_flat_face"], 3);
  const Result table = run({"check", from, "--toward", to});
  EXPECT_EQ(table.code, 0);
  EXPECT_NE(table.out.find(": 0.5 of it, then face 3 is flat"), std::string::npos) << table.out;
  const Json all = Json::parse(run({"check", from, "--toward", from, "--json"}).out);
  EXPECT_EQ(all["max_safe_step"], 1.0);
  EXPECT_TRUE(all["first_flat_face"].is_null());
  expect_error(run({"check", from, "--toward", write("small.off", grid_off(2))}), 2,
               {"small.off: 9 vertices, 16"});
  expect_error(run({"check", from, "--toward", "none.off"}), 2, {"none.off"});
}

TEST_F(Check, OnlyTheFirstCulpritsAreNamed) {
  const Json json =
      check(write("grid.off", grid_off(8, {{20, 6.5, 3.5}, {50, 1.4, 2.7}, {41, 7.5, 7.25}})), 1);
  EXPECT_GT(json["inverted"], 5);
  EXPECT_EQ(json["degenerate"], 0);
  EXPECT_EQ(json["culprits"].size(), 5u);
  const std::string table = run({"check", path("grid.off").string()}).out;
  EXPECT_NE(table.find("  and " + std::to_string(json["inverted"].get<int>() - 5) +
                       " more inverted or flat faces\n"),
            std::string::npos)
      << table;
}

// Corner (0, 0) of the middle cell lands on the far corner's diagonal: exactly its two faces there become
// flat.
TEST_F(Check, FlatFaceIsDegenerateNotInverted) {
  const Json json = check(write("flat.off", "OFF\n4 2 0\n0 0 0\n2 0 0\n1 1 0\n1 0 0\n3 0 3 2\n3 0 1 3\n"), 1);
  EXPECT_EQ(json["inverted"], 0);
  EXPECT_EQ(json["degenerate"], 1);
  EXPECT_EQ(json["min_angle_deg"], 0.0);
  EXPECT_EQ(json["min_area"], 0.0);
  EXPECT_EQ(json["culprits"][0]["kind"], "flat face");
  EXPECT_EQ(json["culprits"][0]["faces"], Json({1}));
}

TEST_F(Check, TwoSeparateTanglesAreTwoComponents) {
  const Json json = check(write("two.off", grid_off(12, {{14, 2.2, 1.0}, {141, 10.0, 11.8}})), 1);
  EXPECT_EQ(json["inverted_components"], 2);
}

TEST_F(Check, MirroredMeshIsTurnedOverWithOneNote) {
  const std::string file =
      write("mirrored.off", "OFF\n4 2 0\n0 0 0\n-1 0 0\n-1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n");
  EXPECT_EQ(check(file, 0)["inverted"], 0);
  const Result result = run({"check", file});
  ASSERT_EQ(result.err_lines().size(), 1u) << result.err;
  EXPECT_EQ(result.err.rfind("kinemesh: note: ", 0), 0u) << result.err;
}

TEST_F(Check, MixedWindingIsMadeConsistent) {
  const Json json =
      check(write("mixed.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 3 2\n"), 0);
  EXPECT_EQ(json["border_loops"], 1);
}

TEST_F(Check, BowTieIsValid) {
  const Json json =
      check(write("tie.off", "OFF\n5 2 0\n0 0 0\n2 -1 0\n2 1 0\n-2 1 0\n-2 -1 0\n3 0 1 2\n3 0 3 4\n"), 0);
  EXPECT_EQ(json["connected_parts"], 2);
  EXPECT_EQ(json["border_loops"], 2);
}

TEST_F(Check, IsolatedVertexIsValidAndCounted) {
  const Json json = check(write("alone.off", "OFF\n4 1 0\n0 0 0\n9 9 0\n1 0 0\n0 1 0\n3 0 2 3\n"), 0);
  EXPECT_EQ(json["vertices"], 4);
  EXPECT_EQ(json["isolated_vertices"], 1);
}

TEST_F(Check, RingHasTwoBorderLoops) {
  const Json json = check(write("ring.off",
                                "OFF\n8 8 0\n0 0 0\n3 0 0\n3 3 0\n0 3 0\n1 1 0\n2 1 0\n2 2 0\n1 2 0\n"
                                "3 0 1 5\n3 0 5 4\n3 1 2 6\n3 1 6 5\n3 2 3 7\n3 2 7 6\n3 3 0 4\n3 3 4 7\n"),
                          0);
  EXPECT_EQ(json["border_loops"], 2);
  EXPECT_EQ(json["connected_parts"], 1);
}

TEST_F(Check, PartsThatCrossAreNamedWithBothEdges) {
  const Json json = check(
      write("cross.off", "OFF\n6 2 0\n0 0 0\n4 0 0\n0 4 0\n1 -1 0\n3 1 0\n1 1 0\n3 0 1 2\n3 3 4 5\n"), 1);
  EXPECT_EQ(json["inverted"], 0);
  ASSERT_EQ(json["culprits"].size(), 1u);
  EXPECT_EQ(json["culprits"][0]["edges"].size(), 2u);
}

TEST_F(Check, PartWithinAnotherIsNotValid) {
  const Json json = check(
      write("nested.off", "OFF\n6 2 0\n0 0 0\n9 0 0\n0 9 0\n1 1 0\n2 1 0\n1 2 0\n3 0 1 2\n3 3 4 5\n"), 1);
  EXPECT_EQ(json["inverted"], 0);
  EXPECT_EQ(json["culprits"][0]["kind"], "inside out");
}

// Ten upright faces that go twice around one vertex: only the border tells.
TEST_F(Check, WindingTwiceIsNotValid) {
  std::string off = "OFF\n11 10 0\n0 0 0\n";
  for (int i = 0; i < 10; ++i) {
    const double angle = 4.0 * 3.14159265358979 * i / 10.0, r = 1.0 + 0.05 * i;
    off += std::to_string(r * std::cos(angle)) + " " + std::to_string(r * std::sin(angle)) + " 0\n";
  }
  for (int i = 0; i < 10; ++i)
    off += "3 0 " + std::to_string(i + 1) + " " + std::to_string((i + 1) % 10 + 1) + "\n";
  const Json json = check(write("twice.off", off), 1);
  EXPECT_EQ(json["inverted"], 0);
  EXPECT_EQ(json["degenerate"], 0);
  EXPECT_EQ(json["border_loops"], 1);
}

TEST_F(Check, TableSaysTheSameAsJson) {
  const std::string file = write("grid.off", grid_off(3, {{5, 2.5, 1.25}}));
  const Json json = check(file, 1);
  const Result result = run({"check", file});
  EXPECT_EQ(result.code, 1);
  EXPECT_EQ(result.err, "");
  EXPECT_NE(result.out.find("\nnot valid:\n"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find(json["culprits"][0]["message"].get<std::string>()), std::string::npos);
  const std::vector<std::string> lines = lines_of(result.out);
  for (size_t i = 1; i < lines.size(); ++i) EXPECT_LE(lines[i].size(), 100u) << lines[i];  // 0 is the path
}

TEST_F(Check, MarkersAreCounted) {
  const std::string su2 =
      "NDIME= 2\nNELEM= 2\n5 0 1 2 0\n5 0 2 3 1\nNPOIN= 4\n0 0 0\n1 0 1\n1 1 2\n0 1 3\n"
      "NMARK= 2\nMARKER_TAG= wall\nMARKER_ELEMS= 3\n3 0 1\n3 1 2\n3 2 3\nMARKER_TAG= inlet\nMARKER_ELEMS= "
      "1\n3 3 0\n";
  const Json json = check(write("box.su2", su2), 0);
  EXPECT_EQ(json["markers"], Json::parse(R"([{"name": "wall", "edges": 3}, {"name": "inlet", "edges": 1}])"));
}

TEST_F(Check, MarkerOnNoEdgeIsNotValid) {
  const std::string su2 =
      "NDIME= 2\nNELEM= 2\n5 0 1 2 0\n5 0 2 3 1\nNPOIN= 4\n0 0 0\n1 0 1\n1 1 2\n0 1 3\n"
      "NMARK= 1\nMARKER_TAG= wall\nMARKER_ELEMS= 1\n3 1 3\n";
  const Json json = check(write("box.su2", su2), 1);
  EXPECT_EQ(json["culprits"][0]["kind"], "missing edge");
  EXPECT_EQ(json["culprits"][0]["edges"], Json::parse("[[1, 3]]"));
  EXPECT_NE(json["culprits"][0]["message"].get<std::string>().find("wall"), std::string::npos);
}

}  // namespace
}  // namespace kinemesh::testing
