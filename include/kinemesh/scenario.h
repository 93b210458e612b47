// What a run is made of, as a TOML file describes it: mesh, bodies, motions, interior, border, time, repair,
// output.
//
// Times, lengths and angles are in the user's units and radians unless a name says `_deg`. The structs hold
// checked values with all defaults in place; `Where` remembers the line for errors that only the mesh can
// tell.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "kinemesh/error.h"
#include "kinemesh/interior.h"
#include "kinemesh/motion.h"
#include "kinemesh/parameters.h"

#pragma GCC visibility push(default)
namespace kinemesh {

// The place in a scenario something was written at, for messages.
struct Where {
  std::string file;  // or the `--set key=value` it came from
  int line = 0;      // from 1; 0 where there is none
};

inline InputError error_at(const Where& where, const std::string& what) {
  return where.file.empty() ? InputError(what) : InputError(where.file, where.line, what);
}

// [mesh]: a file, or else a shape.
struct MeshSpec {
  std::filesystem::path file;  // absolute; empty: a shape
  bool split_quads = false;    // of a file: cut quadrilaterals in two instead of refusing them
  std::string shape;
  int vertices = 10000;    // of a shape
  std::uint64_t seed = 1;  // of a shape
  int k = 2;               // of the shape umbilic
  double frame = 0.25;     // margin of the outer padding in bounding-box diagonals; 0: none
  Where where, frame_where;
};

// [[motion]], or one of a body's
struct MotionSpec {
  std::string field;
  FieldParameters parameters;
  std::vector<std::string> on{"all"};          // of a body's: unused
  std::optional<std::array<double, 2>> blend;  // lengths
  Where where;
  std::map<std::string, Where, std::less<>> key_where;

  Where where_of(std::string_view key) const;  // of the key, or of the motion
};

// [[body]]
struct BodyScenario {
  std::vector<std::string> on;
  std::vector<MotionSpec> motions;
  Where where;
  std::map<std::string, Where, std::less<>> key_where;

  Where where_of(std::string_view key) const;  // of the key, or of the body
};

// [interior]
struct InteriorSpec {
  InteriorOptions options = {.follow = Follow::None};  // harmonic where there is a body
  Where where;
  std::map<int, Where> label_where;  // of each stiffness
};

// [border]
struct BorderSpec {
  BorderConditions conditions;
  std::map<std::string, Where, std::less<>> marker_where;
};

// [time] adaptive: steps that fail or replace too much are undone and halved (sim/run/adaptive_steps.h).
struct AdaptiveSpec {
  std::optional<double> max_region_share;  // faces of the regions over all faces; nothing: any
  double min_dt = 0.0;                     // from 0 < min_dt <= dt; fewer than 2^31 of them reach the end
  double max_dt = 0.0;                     // at least dt
};

// [time]: two of end, dt and steps are given.
struct TimeSpec {
  double dt = 0.0;
  double end = 0.0;
  int steps = 0;
  Integrator integrator = Integrator::Rk4;
  std::optional<AdaptiveSpec> adaptive = std::nullopt;  // of steps that begin with dt

  double time_after(int step) const;  // step dt; the last step is shortened to end
};

// The smallest number of steps of length dt that reach `end`, not counting one that is left by rounding: 100
// for 1 and 0.01. Nothing if an int does not hold it. Pre: both positive and finite.
std::optional<int> steps_to_reach(double end, double dt);

// [repair]
struct RepairSpec {
  std::string strategy = "global";
  std::string quality = "none";
  double angle = 25.0;  // degrees; of quality "angles"
  bool allow_escaped = false;
  bool retain = false;
};

// [output]
struct OutputSpec {
  int every = 10;        // steps between meshes written; 0: only the first and the last
  int checkpoint = 10;   // steps between checkpoints; 0: none
  bool patches = false;  // write patches.bin
};

struct Scenario {
  std::filesystem::path file;  // as given
  MeshSpec mesh;
  std::vector<BodyScenario> bodies;
  std::vector<MotionSpec> motions;  // one body or motion at least
  InteriorSpec interior;
  BorderSpec border;
  TimeSpec time;
  RepairSpec repair;
  OutputSpec output;

  std::string name() const { return file.stem().string(); }
};

// Reads and checks a scenario, `overrides` ("motion.0.rate=2") applied first. Relative mesh files are
// relative to the scenario's folder. Throws InputError with file and line, or the override: missing file,
// TOML that does not parse, unknown keys, fields, strategies or shapes, missing ones, wrong types, out of
// range.
Scenario load_scenario(const std::filesystem::path& file, std::span<const std::string> overrides = {});

// The same from memory; `file` stands for it in errors and relative paths.
Scenario parse_scenario(std::string_view text, const std::filesystem::path& file,
                        std::span<const std::string> overrides = {});

// What moves a mesh that is there already, for set_up(scenario, mesh): [[body]], [[motion]], [interior],
// [border] and [repair] as in a scenario, and no other table; mesh, time and output stay empty. Throws as
// parse_scenario.
Scenario parse_motions(std::string_view text, const std::filesystem::path& file);

const char* to_string(BorderCondition condition);  // as a scenario has it
const char* to_string(Follow follow);

// The scenario with absolute paths and every default written out: loads back to the same run, bit by bit.
std::string to_toml(const Scenario& scenario);

// The first line in which two texts of to_toml differ, in words; nothing if they are the same.
std::optional<std::string> scenario_difference(const std::string& there, const std::string& here);

}  // namespace kinemesh
#pragma GCC visibility pop
