// `kinemesh untangle`: what is repaired, what stays as it was, and the report.
#include <algorithm>
#include <filesystem>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "kinemesh/types.h"
#include "program.h"

namespace kinemesh::testing {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

class Untangle : public ProgramTest {
 protected:
  Json report(const std::string& name = "r.json") const {
    const Json json = Json::parse(read_text(path(name)), nullptr, false);
    EXPECT_FALSE(json.is_discarded()) << read_text(path(name));
    return json;
  }

  std::vector<std::string> lines(const std::string& name) const { return lines_of(read_text(path(name))); }

  // Vertices of `before` and `after` (OFF files as the program writes them) are the same lines, and so are
  // the faces that are in no region of the report. Returns the union of the regions.
  std::set<int> expect_same_outside(const std::string& before, const std::string& after,
                                    const Json& json) const {
    std::set<int> replaced;
    for (const Json& region : json["regions"])
      for (int face : region["faces"]) replaced.insert(face);
    const std::vector<std::string> old_lines = lines(before), new_lines = lines(after);
    EXPECT_EQ(old_lines.size(), new_lines.size());
    if (old_lines.size() != new_lines.size()) return replaced;
    const int n_faces = json["faces"], first = static_cast<int>(old_lines.size()) - n_faces;
    for (int i = 0; i < static_cast<int>(old_lines.size()); ++i) {
      if (replaced.count(i - first) > 0) continue;
      EXPECT_EQ(old_lines[i], new_lines[i]) << "line " << i + 1;
    }
    return replaced;
  }
};

TEST_F(Untangle, RepairsAndTouchesOnlyTheRegions) {
  write("raw.off", grid_off(8, {{20, 4.3, 2.2}, {66, 2.4, 5.4}}));
  ASSERT_EQ(run({"convert", "raw.off", "in.off"}).code, 0);
  ASSERT_EQ(run({"check", "in.off"}).code, 1);
  const Result result = run({"untangle", "in.off", "-o", "out.off", "--report", "r.json"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  EXPECT_EQ(run({"check", "out.off"}).code, 0);

  const Json json = report();
  EXPECT_EQ(json["schema"], "kinemesh-untangle-1");
  EXPECT_EQ(json["strategy"], "global");
  EXPECT_EQ(json["vertices"], 81);
  EXPECT_EQ(json["faces"], 128);
  EXPECT_GT(json["inverted_before"], 0);
  EXPECT_EQ(json["inverted_after"], 0);
  EXPECT_EQ(json["doubled_edges"], 0);
  ASSERT_EQ(json["regions"].size(), 2u);
  const std::set<int> replaced = expect_same_outside("in.off", "out.off", json);
  EXPECT_GT(replaced.size(), 0u);
  EXPECT_LT(replaced.size(), 64u);
  for (const Json& region : json["regions"]) {
    EXPECT_EQ(region["gamma"], 1);
    EXPECT_EQ(region["retries"], 0);
    EXPECT_EQ(region["explored"].get<size_t>(),
              region["faces"].size() + region["padding_faces"].get<size_t>());
    EXPECT_TRUE(std::is_sorted(region["faces"].begin(), region["faces"].end()));
    EXPECT_NE(std::find(region["faces"].begin(), region["faces"].end(), region["seed"]),
              region["faces"].end());
  }
}

TEST_F(Untangle, ReportHasExactlyTheKeysOfItsSchema) {
  write("in.off", grid_off(4, {{6, 2.4, 1.2}}));
  ASSERT_EQ(run({"untangle", "in.off", "-o", "out.off", "--report", "r.json"}).code, 0);
  const auto keys = [](const Json& json) {
    std::set<std::string> result;
    for (const auto& item : json.items()) result.insert(item.key());
    return result;
  };
  const Json json = report();
  EXPECT_EQ(keys(json),
            (std::set<std::string>{"schema", "strategy", "vertices", "faces", "inverted_before",
                                   "degenerate_before", "inverted_after", "doubled_edges", "regions"}));
  ASSERT_FALSE(json["regions"].empty());
  EXPECT_EQ(
      keys(json["regions"][0]),
      (std::set<std::string>{"seed", "faces", "padding_faces", "inverted", "components", "gamma_first_stable",
                             "gamma", "explored", "crease_edges", "retries", "self_overlap"}));
}

TEST_F(Untangle, ValidMeshStaysAsItIs) {
  write("raw.off", grid_off(5));
  ASSERT_EQ(run({"convert", "raw.off", "in.off"}).code, 0);
  const Result result = run({"untangle", "in.off", "-o", "out.off", "--report", "r.json"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(read_text(path("out.off")), read_text(path("in.off")));
  EXPECT_EQ(report()["regions"], Json::array());
  EXPECT_EQ(report()["inverted_before"], 0);
}

TEST_F(Untangle, FlatFacesAreRepairedAndCounted) {
  write("in.off", grid_off(4, {{6, 2.0, 1.5}}));  // onto the edge of vertices 7 and 12
  const Json before = Json::parse(run({"check", "in.off", "--json"}).out);
  ASSERT_EQ(before["degenerate"], 1);
  EXPECT_EQ(run({"untangle", "in.off", "-o", "out.off", "--report", "r.json"}).code, 0);
  EXPECT_EQ(report()["degenerate_before"], before["degenerate"]);
  EXPECT_EQ(report()["inverted_before"], before["inverted"]);
  EXPECT_EQ(run({"check", "out.off"}).code, 0);
}

TEST_F(Untangle, RemeshReplacesEverythingAsOneRegion) {
  write("in.off", grid_off(6, {{16, 3.4, 2.3}}));
  const Result result =
      run({"untangle", "in.off", "-o", "out.off", "--strategy", "remesh", "--report", "r.json"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(run({"check", "out.off"}).code, 0);
  const Json json = report();
  EXPECT_EQ(json["strategy"], "remesh");
  ASSERT_EQ(json["regions"].size(), 1u);
  ASSERT_EQ(json["regions"][0]["faces"].size(), 72u);
  for (int i = 0; i < 72; ++i) EXPECT_EQ(json["regions"][0]["faces"][i], i);
}

// Vertex 20 has gone through one edge, 66 through many.
TEST_F(Untangle, FlipsAndOptimizeUntangleOrSayThatTheyAreStuck) {
  write("near.off", grid_off(8, {{20, 2.6, 1.3}}));
  write("far.off", grid_off(8, {{66, 6.4, 1.4}}));
  EXPECT_EQ(run({"check", "near.off"}).code, 1);
  EXPECT_EQ(run({"untangle", "near.off", "-o", "out.off", "--strategy", "flips"}).code, 0);
  EXPECT_EQ(run({"check", "out.off"}).code, 0);
  expect_error(run({"untangle", "far.off", "-o", "stuck.off", "--strategy", "flips"}), 1,
               {"far.off: stays tangled: face ", "edge flips are stuck with ", "; nothing was written"});
  EXPECT_FALSE(std::filesystem::exists(path("stuck.off")));
  const auto moved =
      run({"untangle", "far.off", "-o", "moved.off", "--strategy", "optimize", "--report", "r.json"});
  EXPECT_EQ(moved.code, 0);
  EXPECT_NE(moved.out.find(" of 81 vertices moved\n"), std::string::npos) << moved.out;
  EXPECT_EQ(run({"check", "moved.off"}).code, 0);
  EXPECT_TRUE(report()["regions"].empty());
}

TEST_F(Untangle, LocalRepairsOneRegionAfterTheOther) {
  write("raw.off", grid_off(8, {{20, 4.3, 2.2}, {66, 2.4, 5.4}}));
  ASSERT_EQ(run({"convert", "raw.off", "in.off"}).code, 0);
  const Result result =
      run({"untangle", "in.off", "-o", "out.off", "--strategy", "local", "--report", "r.json"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(run({"check", "out.off"}).code, 0);
  const Json json = report();
  EXPECT_EQ(json["strategy"], "local");
  EXPECT_EQ(json["inverted_after"], 0);
  EXPECT_GE(json["regions"].size(), 2u);
  expect_same_outside("in.off", "out.off", json);
}

TEST_F(Untangle, FacesThatAreReplacedTwiceAreCountedOnce) {
  write("raw.off", grid_off(4, {{8, 1.3, 0.9}, {12, 3.4, 2.5}}));
  ASSERT_EQ(run({"convert", "raw.off", "in.off"}).code, 0);
  const Result result =
      run({"untangle", "in.off", "-o", "out.off", "--strategy", "local", "--report", "r.json"});
  EXPECT_EQ(result.code, 0) << result.err;
  const Json json = report();
  std::size_t sum = 0;
  for (const Json& region : json["regions"]) sum += region["faces"].size();
  const auto replaced = expect_same_outside("in.off", "out.off", json);
  EXPECT_LT(replaced.size(), sum);
  EXPECT_NE(result.out.find(std::to_string(replaced.size()) + " of 32 faces replaced"), std::string::npos)
      << result.out;
}

TEST_F(Untangle, SeedRepairsItsRegionAlone) {
  write("raw.off", grid_off(8, {{20, 4.3, 2.2}, {66, 2.4, 5.4}}));
  ASSERT_EQ(run({"convert", "raw.off", "in.off"}).code, 0);
  ASSERT_EQ(run({"untangle", "in.off", "-o", "all.off", "--report", "all.json"}).code, 0);
  const Json all = report("all.json");
  ASSERT_EQ(all["regions"].size(), 2u);
  const std::string seed = std::to_string(all["regions"][1]["seed"].get<int>());
  const Result result = run(
      {"untangle", "in.off", "-o", "out.off", "--strategy", "local", "--seed", seed, "--report", "r.json"});
  EXPECT_EQ(result.code, 1) << result.err;  // the other tangle remains
  const Json json = report();
  ASSERT_EQ(json["regions"].size(), 1u);
  EXPECT_EQ(json["regions"][0]["faces"], all["regions"][1]["faces"]);
  EXPECT_EQ(json["inverted_after"].get<int>() + json["regions"][0]["inverted"].get<int>(),
            json["inverted_before"]);
  expect_same_outside("in.off", "out.off", json);
}

TEST_F(Untangle, SeedHasToBeAnInvertedFace) {
  write("in.off", grid_off(4, {{6, 2.4, 1.2}}));
  const std::vector<std::string> local{"untangle",   "in.off", "-o",    "out.off",
                                       "--strategy", "local",  "--seed"};
  const auto with_seed = [&](const char* seed) {
    auto words = local;
    words.push_back(seed);
    return run(words);
  };
  expect_error(with_seed("31"), 2, {"31", "upright"});
  expect_error(with_seed("32"), 2, {"32", "faces 0 to 31"});
  expect_error(with_seed("x"), 2, {"seed"});
  EXPECT_EQ(files(), std::vector<std::string>{"in.off"});
}

TEST_F(Untangle, MarkersSurvive) {
  const char* const
      su2 =  // vertex 4, the middle of a square of four, is pushed out of its fan towards the top
      "NDIME= 2\nNELEM= 6\n5 0 1 4 0\n5 1 2 5 1\n5 1 5 4 2\n5 2 3 5 3\n5 3 0 4 4\n5 3 4 5 5\n"
      "NPOIN= 6\n0 0 0\n4 0 1\n4 4 2\n0 4 3\n3.5 2 4\n3 2 5\n"
      "NMARK= 1\nMARKER_TAG= wall\nMARKER_ELEMS= 4\n3 0 1\n3 1 2\n3 2 3\n3 3 0\n";
  write("in.su2", su2);
  ASSERT_EQ(run({"check", "in.su2"}).code, 1);
  ASSERT_EQ(run({"untangle", "in.su2", "-o", "out.su2"}).code, 0);
  const Result result = run({"check", "out.su2", "--json"});
  EXPECT_EQ(result.code, 0) << result.out;
  EXPECT_EQ(Json::parse(result.out)["markers"], Json::parse(R"([{"name": "wall", "edges": 4}])"));
}

// The faces of the left half have label 3, the others 5; vertices of the left half tangle.
TEST_F(Untangle, LabelsSurvive) {
  std::string msh = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n25\n", elements;
  for (int v = 0; v < 25; ++v) {
    const Point at = v == 6 ? Point{0.3, 2.4} : Point{v % 5, v / 5};
    msh += std::to_string(v + 1) + ' ' + std::to_string(at.x) + ' ' + std::to_string(at.y) + " 0\n";
  }
  auto add = [&, n = 0](int label, int a, int b, int c) mutable {
    elements += std::to_string(++n) + " 2 2 " + std::to_string(label) + " 1 " + std::to_string(a + 1) + ' ' +
                std::to_string(b + 1) + ' ' + std::to_string(c + 1) + '\n';
  };
  for (int cell = 0; cell < 16; ++cell) {
    const int v = cell / 4 * 5 + cell % 4, label = cell % 4 < 2 ? 3 : 5;
    add(label, v, v + 1, v + 6);
    add(label, v, v + 6, v + 5);
  }
  write("raw.msh", msh + "$EndNodes\n$Elements\n32\n" + elements + "$EndElements\n");
  ASSERT_EQ(run({"convert", "raw.msh", "in.msh"}).code, 0);
  ASSERT_EQ(run({"check", "in.msh"}).code, 1);
  ASSERT_EQ(run({"untangle", "in.msh", "-o", "out.msh"}).code, 0);
  EXPECT_EQ(run({"check", "out.msh"}).code, 0);
  const auto labels = [&](const std::string& name) {
    std::vector<std::string> result;  // of the triangles, in order
    for (const std::string& line : lines(name)) {
      std::istringstream words(line);
      const std::vector<std::string> fields{std::istream_iterator<std::string>(words), {}};
      if (fields.size() == 8 && fields[1] == "2") result.push_back(fields[3]);
    }
    return result;
  };
  EXPECT_EQ(labels("in.msh").size(), 32u);
  EXPECT_EQ(labels("out.msh"), labels("in.msh"));
}

TEST_F(Untangle, NoValidMeshIsSaidAndNothingIsWritten) {
  write("coincident.off", grid_off(4, {{6, 2.0, 1.0}}));  // onto vertex 7
  write("out.off", "precious\n");
  expect_error(run({"untangle", "coincident.off", "-o", "out.off", "--report", "r.json"}), 1,
               {"coincident.off: no valid mesh exists", "6", "7"});
  write("cross.off", "OFF\n6 2 0\n0 0 0\n4 0 0\n0 4 0\n1 -1 0\n3 1 0\n1 1 0\n3 0 1 2\n3 3 4 5\n");
  expect_error(
      run({"untangle", "cross.off", "-o", "out.off"}), 1,
      {"cross.off: no valid mesh exists", "0-1", "--strategy optimize, which moves vertices, finds none"});
  EXPECT_EQ(read_text(path("out.off")), "precious\n");
  EXPECT_EQ(files(), (std::vector<std::string>{"coincident.off", "cross.off", "out.off"}));
}

TEST_F(Untangle, BadRequests) {
  write("in.off", grid_off(4, {{6, 2.4, 1.2}}));
  expect_error(run({"untangle", "in.off", "-o", "out.off", "--strategy", "magic"}), 2,
               {"magic", "global", "remesh"});
  expect_error(run({"untangle", "in.off", "-o", "out.off", "--strategy", "kinetic"}), 2,
               {"strategy kinetic", "positions before the move"});
  expect_error(run({"untangle", "in.off", "-o", "out.off", "--seed", "3"}), 2, {"--seed"});
  expect_error(run({"untangle", "absent.off", "-o", "out.off"}), 2, {"absent.off: "});
  expect_error(run({"untangle", "in.off", "-o", "out.xyz"}), 2, {"out.xyz: ", ".xyz"});
  expect_error(run({"untangle", "in.off", "-o", "absent/out.off"}), 2, {"absent/out.off: "});
  EXPECT_EQ(files(), std::vector<std::string>{"in.off"});
}

// Hard tangles with known answers, where they are at hand.
class SharedCase : public Untangle {};

TEST_F(SharedCase, RegionsAreTheExpectedOnes) {
  const fs::path folder = fs::path(KINEMESH_SHARED_DIR) / "cases";
  if (!fs::exists(folder)) GTEST_SKIP() << folder << " is absent";
  int n_cases = 0;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() != ".off") continue;
    SCOPED_TRACE(entry.path().filename().string());
    ++n_cases;
    fs::path answer = entry.path();
    const Json expected = Json::parse(read_text(answer.replace_extension(".json")))["global"];
    ASSERT_EQ(run({"convert", entry.path().string(), "in.off"}).code, 0);
    const Result result = run({"untangle", "in.off", "-o", "out.off", "--report", "r.json"});
    ASSERT_EQ(result.code, 0) << result.err;
    EXPECT_EQ(run({"check", "out.off"}).code, 0);

    const Json json = report();
    EXPECT_EQ(expect_same_outside("in.off", "out.off", json), expected["triangles"].get<std::set<int>>());
    int inverted = 0, components = 0;
    for (const Json& region : json["regions"]) {
      inverted += region["inverted"].get<int>();
      components += region["components"].get<int>();
    }
    EXPECT_EQ(inverted, expected["inverted"]);
    EXPECT_EQ(components, expected["components"]);
    EXPECT_EQ(json["inverted_before"], expected["inverted"]);
  }
  EXPECT_GT(n_cases, 0);
}

TEST_F(SharedCase, MinimumRegionsAreTheExpectedOnes) {
  const fs::path folder = fs::path(KINEMESH_SHARED_DIR) / "cases";
  if (!fs::exists(folder)) GTEST_SKIP() << folder << " is absent";
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() != ".off") continue;
    fs::path answer = entry.path();
    const Json regions = Json::parse(read_text(answer.replace_extension(".json")))["regions"];
    ASSERT_EQ(run({"convert", entry.path().string(), "in.off"}).code, 0);
    for (const Json& expected : regions) {
      SCOPED_TRACE(entry.path().filename().string() + " seed " + expected["seed"].dump());
      const Result result = run({"untangle", "in.off", "-o", "out.off", "--strategy", "local", "--seed",
                                 expected["seed"].dump(), "--report", "r.json"});
      const Json json = report();
      EXPECT_EQ(result.code, json["inverted_after"] == 0 ? 0 : 1) << result.err;
      ASSERT_EQ(json["regions"].size(), 1u);
      const Json& region = json["regions"][0];
      EXPECT_EQ(region["faces"], expected["triangles"]);
      EXPECT_EQ(region["explored"], expected["size"]);
      for (const char* key : {"seed", "inverted", "components", "gamma_first_stable", "self_overlap"}) {
        EXPECT_EQ(region[key], expected[key]) << key;
      }
      EXPECT_EQ(region["gamma"], expected["gamma"][0]);
      EXPECT_EQ(region["retries"], 0);
      expect_same_outside("in.off", "out.off", json);
    }
  }
}

}  // namespace
}  // namespace kinemesh::testing
