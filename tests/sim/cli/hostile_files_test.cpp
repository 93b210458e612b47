// Files made to take memory or time, given to the program: it takes them quickly, or refuses them in one
// line.
#include <chrono>
#include <nlohmann/json.hpp>

#include "program.h"

namespace kinemesh::testing {
namespace {

constexpr int many = 80'000;

std::string repeated(const std::string& text, int n) {
  std::string all;
  for (int i = 0; i < n; ++i) all += text;
  return all;
}

class HostileFiles : public ProgramTest {
 protected:
  // What takes a tenth of it here; what is quadratic takes many times as long.
  Result run_quickly(const std::vector<std::string>& arguments) const {
    const auto before = std::chrono::steady_clock::now();
    Result result = run(arguments);
    EXPECT_LT(std::chrono::steady_clock::now() - before, std::chrono::seconds(8)) << arguments[0];
    return result;
  }
};

// A fan about vertex 0, every spoke and every side of the rim a marker of its own.
std::string fan_with_markers(int n_spokes) {
  std::string points = "NPOIN= " + std::to_string(n_spokes + 1) + "\n0 0\n";
  std::string faces = "NDIME= 2\nNELEM= " + std::to_string(n_spokes - 1) + "\n", markers;
  for (int i = 0; i < n_spokes; ++i) {
    const double t = 2.0 * i / (n_spokes - 1) - 1.0;  // on a parabola
    points += std::to_string(t) + " " + std::to_string(2.0 - t * t) + "\n";
    const std::string v = std::to_string(i + 1), w = std::to_string(i);
    if (i > 0) faces += "5 0 " + v + " " + w + "\n";
    markers += "MARKER_TAG= spoke" + v + "\nMARKER_ELEMS= 1\n3 0 " + v + "\n";
  }
  return faces + points + "NMARK= " + std::to_string(n_spokes) + "\n" + markers;
}

TEST_F(HostileFiles, ManyMarkersAreCheckedAndConverted) {
  write("a.su2", fan_with_markers(2000));
  const Result small = run({"check", "a.su2", "--json"});
  ASSERT_EQ(small.code, 0) << small.err;
  std::string grid = "NDIME= 2\nNELEM= 2\n5 0 1 2\n5 0 2 3\nNPOIN= 4\n0 0\n1 0\n1 1\n0 1\nNMARK= 80000\n";
  for (int i = 0; i < many; ++i)
    grid += "MARKER_TAG= wall" + std::to_string(i) + "\nMARKER_ELEMS= 1\n3 0 1\n";
  write("b.su2", grid);
  const Result checked = run_quickly({"check", "b.su2", "--json"});
  ASSERT_EQ(checked.code, 0) << checked.err;
  const auto markers = nlohmann::json::parse(checked.out).at("markers");
  ASSERT_EQ(markers.size(), std::size_t{many});
  EXPECT_EQ(markers[many - 1].at("name"), "wall79999");
  for (const auto& [from, to] :
       {std::pair("b.su2", "b.vtu"), std::pair("b.vtu", "b.msh"), std::pair("b.msh", "c.su2")})
    EXPECT_EQ(run_quickly({"convert", from, to}).code, 0);
  EXPECT_EQ(run_quickly({"check", "c.su2"}).code, 0);
}

TEST_F(HostileFiles, ManyMarkersOfABorderAreSetUp) {
  std::string mesh = "NDIME= 2\nNELEM= 2\n5 0 1 2\n5 0 2 3\nNPOIN= 4\n0 0\n1 0\n1 1\n0 1\nNMARK= 80000\n";
  std::string scenario =
      "mesh.file = 'a.su2'\n[[motion]]\nfield = 'swirl'\n[time]\ndt = 0.1\nsteps = 1\n[border]\n";
  for (int i = 0; i < many; ++i) {
    mesh += "MARKER_TAG= wall" + std::to_string(i) + "\nMARKER_ELEMS= 1\n3 0 1\n";
    scenario += "wall" + std::to_string(i) + " = 'fixed'\n";
  }
  write("a.su2", mesh);
  write("a.toml", scenario);
  const Result good = run_quickly({"run", "a.toml", "--dry-run", "-q"});
  EXPECT_EQ(good.code, 0) << good.err;
  write("b.toml", scenario + "valve = 'fixed'\n");
  const Result bad = run_quickly({"run", "b.toml", "--dry-run", "-q"});
  expect_error(bad, 2, {"b.toml:80008: ", "no marker 'valve' in the mesh", "and 79950 more"});
}

TEST_F(HostileFiles, DeepScenariosAndOverridesAreRefused) {
  const std::string good =
      "mesh.shape = 'square'\n[[motion]]\nfield = 'swirl'\n[time]\ndt = 0.1\nsteps = 1\n";
  write("good.toml", good);
  write("deep.toml", good + "[" + repeated("a.", 35'000) + "a]\n");
  expect_error(run({"run", "deep.toml", "--dry-run"}), 2, {"deep.toml:7: nested more than 256 deep"});
  for (const std::string& set : {repeated("a.", 35'000) + "a=1", "a=" + repeated("{a=", 20'000)})
    expect_error(run({"run", "good.toml", "--dry-run", "--set", set}), 2,
                 {"--set ", "nested more than 256 deep"});
}

const std::string tangled = grid_off(4, {{6, 2.5, 2.2}});

TEST_F(HostileFiles, DamagedReportsOfUntangleAreRefused) {
  write("a.off", tangled);
  const std::string head = R"({"schema": "kinemesh-untangle-1", "strategy": "global", "regions": [)";
  const auto refused = [&](const std::string& report, std::initializer_list<const char*> words) {
    write("r.json", report);
    expect_error(run({"draw", "a.off", "--region", "r.json", "-o", "a.svg"}), 2, words);
  };
  refused(repeated("[", 1'000'000), {"r.json: nested more than 256 deep"});
  refused(head + repeated("[", 300) + repeated("]", 300) + "]}", {"r.json: nested more than 256 deep"});
  refused(head + R"({"seed": 0, "faces": [1e300]}]})", {"r.json: damaged: 1e+300 is no number of a face"});
  refused(head + R"({"seed": 4294967296, "faces": [0]}]})", {"4294967296 is no number of a face"});
  refused(head + R"({"seed": -2, "faces": [0]}]})", {"r.json: damaged: -2 is no number of a face"});
}

TEST_F(HostileFiles, ASeedThatIsNoFaceIsNoReportOfTheMesh) {
  write("a.off", tangled);
  ASSERT_EQ(run({"untangle", "a.off", "-o", "b.off", "--report", "r.json"}).code, 0);
  auto report = nlohmann::json::parse(read_text(path("r.json")));
  ASSERT_EQ(run({"draw", "a.off", "--region", "r.json", "-o", "a.svg"}).code, 0);
  report.at("regions")[0].at("seed") = 1'000'000;
  write("r.json", report.dump());
  expect_error(run({"draw", "a.off", "--region", "r.json", "-o", "a.svg"}), 2,
               {"r.json", "is not the report of untangling a.off"});
}

}  // namespace
}  // namespace kinemesh::testing
