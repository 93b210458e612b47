#include "sim/run/run_report.h"

#include <fmt/chrono.h>

#include <algorithm>
#include <ctime>
#include <nlohmann/json.hpp>

#include "core/io/atomic_file.h"

namespace kinemesh {
namespace {

using Json = nlohmann::ordered_json;

std::string now_utc() {
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
}

const char* to_string(RunState state) {
  switch (state) {
    case RunState::Running:
      return "running";
    case RunState::Done:
      return "done";
    case RunState::Stopped:
      break;
  }
  return "stopped";
}

Json mesh_json(const RunPlan& plan) {
  return {{"vertices", plan.vertices},
          {"faces", plan.faces},
          {"padding_faces", plan.padding_faces},
          {"markers", plan.markers}};
}

Json totals_json(const RunSummary& s) {
  return {{"rejected", s.rejected},           {"steps_tangled", s.steps_tangled},
          {"inverted", s.inverted},           {"regions", s.regions},
          {"region_faces", s.region_faces},   {"region_faces_max", s.region_faces_max},
          {"replaced", s.replaced},           {"share_mean", s.share_mean},
          {"share_max", s.share_max},         {"retries", s.retries},
          {"quality_flips", s.quality_flips}, {"quality_moves", s.quality_moves},
          {"min_angle_deg", s.min_angle_deg}};
}

Json times_json(const PhaseTimes& ms) {
  return {{"move", ms.move},
          {"interior", ms.interior},
          {"detect", ms.detect},
          {"explore", ms.explore},
          {"triangulate", ms.triangulate},
          {"splice", ms.splice},
          {"quality", ms.quality},
          {"total", ms.total},
          {"write", ms.write}};
}

}  // namespace

void add_step(RunSummary& summary, const StepRecord& record, int n_faces) {
  const RepairRecord& repair = record.repair;
  const int tangled = repair.inverted + repair.degenerate;
  const double share = static_cast<double>(repair.replaced) / n_faces;
  summary.share_mean = (summary.share_mean * summary.steps + share) / (summary.steps + 1);
  summary.share_max = std::max(summary.share_max, share);
  summary.steps = record.step;
  summary.time = record.time;
  summary.steps_tangled += tangled > 0 ? 1 : 0;
  summary.inverted += tangled;
  summary.regions += static_cast<long long>(repair.regions.size());
  summary.region_faces += repair.region_faces();
  summary.region_faces_max = std::max(summary.region_faces_max, repair.region_faces_max());
  summary.replaced += repair.replaced;
  summary.escaped_max = std::max(summary.escaped_max, repair.escaped);
  summary.retries += repair.retries();
  summary.quality_flips += repair.quality_flips;
  summary.quality_moves += repair.quality_moves;
  summary.min_angle_deg = std::min(summary.min_angle_deg, record.min_angle_deg);
  summary.ms.move += record.move_ms;
  summary.ms.interior += record.interior_ms;
  summary.ms.detect += repair.detect_ms;
  summary.ms.explore += repair.explore_ms;
  summary.ms.triangulate += repair.triangulate_ms;
  summary.ms.splice += repair.splice_ms;
  summary.ms.quality += repair.quality_ms;
  summary.ms.total += record.total_ms;
}

RunJson::RunJson(const std::filesystem::path& directory, const Scenario& scenario, const RunOptions& options,
                 std::set<std::string> files)
    : path_(directory / "run.json"),
      scenario_(scenario),
      options_(options),
      started_(now_utc()),
      files_(std::move(files)) {
  files_.insert("run.json");
}

void RunJson::write(const RunSummary& summary, RunState state) {
  summary_ = summary;
  state_ = state;
  const auto is_missing = [&](const std::string& name) {
    return name != "run.json" && !std::filesystem::exists(path_.parent_path() / name);
  };
  if (state == RunState::Done) std::erase_if(files_, is_missing);
  put();
}

void RunJson::claim(std::initializer_list<std::string> names) {
  const auto before = files_.size();
  files_.insert(names);
  if (files_.size() > before) put();
}

void RunJson::put() const {
  Json json;
  json["schema"] = "kinemesh-run-1";
  json["version"] = KINEMESH_VERSION;
  json["scenario"] = std::filesystem::absolute(scenario_.file).lexically_normal().string();
  json["argv"] = options_.argv;
  json["seed"] = scenario_.mesh.shape.empty() ? Json() : Json(scenario_.mesh.seed);
  json["threads"] = summary_.plan.threads;
  json["strategy"] = summary_.plan.strategy;
  json["mesh"] = mesh_json(summary_.plan);
  json["steps_planned"] = summary_.plan.steps;
  json["end"] = summary_.plan.end_time;
  json["started"] = started_;
  json["state"] = to_string(state_);
  if (state_ != RunState::Running) json["ended"] = now_utc();
  json["steps"] = summary_.steps;
  json["time"] = summary_.time;
  if (summary_.stopped) json["stopped"] = *summary_.stopped;
  json["totals"] = totals_json(summary_);
  json["ms"] = times_json(summary_.ms);
  json["files"] = files_;
  // A name in another encoding than UTF-8 is no reason to lose the record of a run.
  write_file_atomically(path_, json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace kinemesh
