#include "sim/report/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/io/atomic_file.h"
#include "sim/report/bench_rows.h"
#include "sim/report/frame_encoder.h"
#include "sim/report/page.h"
#include "sim/report/table.h"
#include "sim/run/csv_log.h"

namespace kinemesh::report {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::size_t most_rows = 5000;  // points of a plot: more than any screen is wide

std::vector<std::string> names_in(const char* header) {
  std::vector<std::string> names{""};
  for (const char* c = header; *c; ++c)
    if (*c == ',')
      names.emplace_back();
    else
      names.back() += *c;
  return names;
}

const std::vector<std::string> needed_of_steps = {"step",      "time",       "faces",      "vertices",
                                                  "inverted",  "degenerate", "replaced",   "min_angle_deg",
                                                  "move_ms",   "detect_ms",  "explore_ms", "triangulate_ms",
                                                  "splice_ms", "quality_ms", "total_ms"};

// Runs of earlier versions do not have them.
const std::vector<std::string> welcome_of_steps = {"quality_flips", "quality_moves", "interior_ms"};

// Collects the parts of a page.
class Maker {
 public:
  Maker(const fs::path& directory, const ReportOptions& options) : directory_(directory), options_(options) {
    std::error_code error;
    if (!fs::is_directory(directory, error)) throw InputError(directory.string(), 0, "a folder expected");
    if (!has("steps.csv") && !has("bench.csv"))
      throw InputError(directory.string(), 0,
                       "steps.csv of a run or bench.csv of a benchmark expected in this folder");
  }

  Report make() {
    data_["title"] = "kinemesh: " + fs::absolute(directory_ / "").parent_path().filename().string();
    data_["facts"] = "";
    data_["scenario"] = has("scenario.toml") ? read_file(directory_ / "scenario.toml") : "";
    if (has("run.json")) tell_run();
    if (has("steps.csv")) add_steps();
    if (has("regions.csv")) add_regions();
    if (has("bench.csv")) add_bench();
    const std::string frames = has("steps.csv") ? encode_mesh() : "";
    const std::string html = fill_page(packed_data(), frames);
    if (html.size() > limit()) refuse(html.size());
    return {html, notes_};
  }

 private:
  bool has(const char* name) const { return fs::exists(directory_ / name); }
  std::uint64_t limit() const { return static_cast<std::uint64_t>(options_.max_megabytes * 1e6); }
  void note(std::string text) { notes_.push_back(std::move(text)); }

  [[noreturn]] void refuse(std::uint64_t size) const {
    throw InputError(fmt::format("--max-size {}: the plots alone need {:.1f} MB", options_.max_megabytes,
                                 static_cast<double>(size) / 1e6));
  }

  std::string packed_data() {
    data_["notes"] = notes_;
    return base64(deflated(data_.dump(-1, ' ', false, Json::error_handler_t::replace)));
  }

  void tell_run() {
    const Json run = Json::parse(read_file(directory_ / "run.json"), nullptr, false);
    if (!run.is_object()) throw InputError((directory_ / "run.json").string(), 0, "is no JSON of a run");
    if (const auto stopped = run.find("stopped"); stopped != run.end() && stopped->is_string())
      note("The run stopped: " + stopped->get<std::string>());
    if (run.value("state", Json()) == "running") note("The run was still going on, or was killed.");
    const Json version = run.value("version", Json());
    if (version.is_string()) data_["facts"] = "made by kinemesh " + version.get<std::string>();
  }

  void add_steps() {
    steps_ = read_table(directory_ / "steps.csv", needed_of_steps);
    for (std::size_t row = 0; row < steps_.size; ++row)
      times_[static_cast<int>(steps_.numbers["step"][row])] = steps_.numbers["time"][row];
    if (steps_.size == 0) note("No step has been made.");
    const std::string facts = data_["facts"];
    if (steps_.size > 0)
      data_["facts"] = fmt::format("{}, {} step{} to time {:.6g}{}{}", size_of(steps_), steps_.size,
                                   steps_.size == 1 ? "" : "s", steps_.numbers["time"].back(),
                                   facts.empty() ? "" : "; ", facts);
    auto shown = needed_of_steps;
    for (const std::string& name : welcome_of_steps)
      if (steps_.numbers.contains(name)) shown.push_back(name);
    data_["steps"] = columns(thinned(steps_, "steps"), shown);
  }

  // Of the meshes, of which a sweep may have several.
  static std::string size_of(const Table& table) {
    const auto range = [&](const char* name) {
      const auto [least, most] = std::ranges::minmax(table.numbers.at(name));
      return least < most ? fmt::format("{:.0f} to {:.0f}", least, most) : fmt::format("{:.0f}", most);
    };
    return fmt::format("{} vertices, {} triangles", range("vertices"), range("faces"));
  }

  // The step of each bunch that has most inverted faces, or else the smallest angle, so that peaks stay.
  Table thinned(const Table& table, const char* what) {
    const std::size_t bunch = (table.size + most_rows - 1) / most_rows;
    if (bunch <= 1) return table;
    note(
        fmt::format("The plots show one of every {} {}, that with the most inverted triangles, or else the "
                    "smallest angle.",
                    bunch, what));
    const auto &inverted = table.numbers.at("inverted"), &angle = table.numbers.at("min_angle_deg");
    const auto is_calmer = [&](std::size_t a, std::size_t b) {
      return inverted[a] < inverted[b] || (inverted[a] == inverted[b] && angle[a] > angle[b]);
    };
    std::vector<std::size_t> rows;
    for (std::size_t start = 0; start < table.size; start += bunch) {
      std::size_t most = start;
      for (std::size_t row = start; row < std::min(table.size, start + bunch); ++row)
        if (is_calmer(most, row)) most = row;
      rows.push_back(most);
    }
    return select(table, rows);
  }

  static Json columns(const Table& table, const std::vector<std::string>& names) {
    Json json = Json::object();
    for (const std::string& name : names) json[name] = table.numbers.at(name);
    return json;
  }

  void add_regions() {
    const Table table = read_table(directory_ / "regions.csv",
                                   {"step", "seed", "faces", "inverted", "components", "explored"});
    const auto integer = [&](const char* name, std::size_t row) {
      const double value = table.numbers.at(name)[row];
      return std::isfinite(value) && std::abs(value) < 2e9 ? static_cast<int>(value) : none;
    };
    for (std::size_t row = 0; row < table.size; ++row)
      regions_.push_back({integer("step", row), integer("seed", row), integer("faces", row),
                          integer("inverted", row), integer("components", row), integer("explored", row)});
    std::ranges::stable_sort(regions_, {}, &RegionRow::step);
    if (data_.contains("steps")) data_["sizes"] = size_quantiles();
  }

  std::span<const RegionRow> regions_of(int step) const {
    const auto first = std::ranges::lower_bound(regions_, step, {}, &RegionRow::step);
    return {first, std::ranges::upper_bound(first, regions_.end(), step, {}, &RegionRow::step)};
  }

  // At the steps of the plots.
  Json size_quantiles() const {
    std::vector<double> times, median, p90, most, count;
    const Json& steps = data_["steps"];
    for (std::size_t i = 0; i < steps["step"].size(); ++i) {
      std::vector<int> sizes;
      for (const RegionRow& region : regions_of(steps["step"][i].get<int>())) sizes.push_back(region.faces);
      std::ranges::sort(sizes);
      const auto quantile = [&](double q) {
        return sizes.empty() ? 0 : sizes[static_cast<std::size_t>(q * static_cast<double>(sizes.size() - 1))];
      };
      times.push_back(steps["time"][i].get<double>());
      count.push_back(static_cast<double>(sizes.size()));
      median.push_back(quantile(0.5));
      p90.push_back(quantile(0.9));
      most.push_back(quantile(1.0));
    }
    return {{"time", times}, {"median", median}, {"p90", p90}, {"max", most}, {"count", count}};
  }

  // Columns that steps.csv does not have are what a sweep has varied: numbers, if all of its values are.
  void add_bench() {
    auto needed = needed_of_steps;
    needed.push_back("accepted");
    auto required = needed;
    required.push_back("strategy");
    const auto usual = names_in(steps_csv_header);
    const Table all = read_table(directory_ / "bench.csv", required, [&](const std::string& name) {
      return std::ranges::find(usual, name) == usual.end();
    });
    const Table rows = thin_bench(all, notes_);
    Json bench;
    bench["rows"] = columns(rows, needed);
    bench["strategies"] = distinct(rows.texts.at("strategy"));
    bench["swept"] = Json::array();
    for (const auto& [name, values] : rows.texts) {
      const auto numbers = all_numbers(values);
      bench["rows"][name] = numbers ? Json(*numbers) : Json(values);
      if (name != "strategy" && distinct(values).size() > 1) bench["swept"].push_back(name);
    }
    if (rows.size == 0) note("The benchmark has no rows yet.");
    if (rows.size > 0 && data_["facts"] == "")
      data_["facts"] = fmt::format("{} strategies; {}", bench["strategies"].size(), size_of(rows));
    data_["bench"] = rows.size > 0 ? bench : Json();
  }

  static std::optional<std::vector<double>> all_numbers(const std::vector<std::string>& values) {
    std::vector<double> numbers;
    for (const std::string& value : values) numbers.push_back(number_of(value));
    const bool are_finite = std::ranges::all_of(numbers, [](double v) { return std::isfinite(v); });
    return are_finite ? std::optional(numbers) : std::nullopt;
  }

  // The player's frames as base64, and their description in data_; every step, or one of two, four...
  // whatever fits.
  std::string encode_mesh() {
    if (!open_frames(directory_, times_)) {
      note("No meshes to play: the folder has neither patches.bin nor mesh_*.vtu.");
      return "";
    }
    const std::uint64_t others = page_template().size() + packed_data().size() + 2000;
    if (others > limit()) refuse(others);
    const std::uint64_t room = (limit() - others) / 4 * 3;
    for (int stride = 1;; stride *= 2) {
      const auto frames = encode(stride, room);
      if (frames) return base64(*frames);
      if (stride > static_cast<int>(times_.size()) * 2) break;
    }
    note(fmt::format("The meshes are left out: not even two of them fit into {} MB; --max-size gives more.",
                     options_.max_megabytes));
    return "";
  }

  // Nothing if it takes more room.
  std::optional<std::string> encode(int stride, std::uint64_t room) {
    const auto source = open_frames(directory_, times_);
    const Grid grid = Grid::of(source->start());
    FrameEncoder encoder(source->start(), grid);
    Json list = Json::array();
    std::map<int, Triangle> skipped;
    int n_skipped = 0;
    auto next = source->next();
    for (int i = 0; next; ++i) {
      Frame frame = std::move(*next);
      next = source->next();
      if (next && i % stride != 0) {
        skip(frame, skipped);
        ++n_skipped;
        continue;
      }
      for (const FaceEdit& edit : frame.silent) skipped[edit.face] = edit.corners;
      frame.silent.clear();
      for (const auto& [face, corners] : skipped) frame.silent.push_back({face, corners});
      skipped.clear();
      encoder.add(frame, source->has_every_step() ? regions_of(frame.step) : std::span<const RegionRow>());
      list.push_back({{"step", frame.step}, {"time", frame.time}});
      if (encoder.size() + 32 * list.size() > room) return std::nullopt;
    }
    std::string packed = encoder.finish();
    if (packed.size() + 32 * list.size() > room) return std::nullopt;
    describe_mesh(*source, grid, encoder.n_slots(), std::move(list), n_skipped);
    return packed;
  }

  static void skip(const Frame& frame, std::map<int, Triangle>& skipped) {
    for (const FaceEdit& edit : frame.silent) skipped[edit.face] = edit.corners;
    for (const PatchEdit& patch : frame.patches)
      for (const FaceEdit& edit : patch.faces) skipped[edit.face] = edit.corners;
  }

  void describe_mesh(const FrameSource& source, const Grid& grid, int n_slots, Json frames, int n_skipped) {
    const std::size_t n = frames.size();
    if (n_skipped > 0)
      note(fmt::format("The player has {} of {} frames, to keep the page below {} MB; --max-size gives more.",
                       n, n + static_cast<std::size_t>(n_skipped), options_.max_megabytes));
    if (!source.has_every_step())
      note(
          "Only the meshes written can be shown; `kinemesh run` with --set output.patches=true keeps every "
          "step.");
    data_["mesh"] = {{"vertices", source.start().points.size()},
                     {"faces", source.start().triangles.size()},
                     {"slots", n_slots},
                     {"box", {grid.origin.x, grid.origin.y, grid.step}},
                     {"grid", grid.size},
                     {"from", source.has_every_step() ? "patches" : "series"},
                     {"frames", std::move(frames)}};
  }

  fs::path directory_;
  ReportOptions options_;
  Json data_ = Json::object();
  std::vector<std::string> notes_;
  Table steps_;
  std::map<int, double> times_;     // of steps
  std::vector<RegionRow> regions_;  // by step
};

}  // namespace

Report make_report(const fs::path& directory, const ReportOptions& options) {
  return Maker(directory, options).make();
}

}  // namespace kinemesh::report
