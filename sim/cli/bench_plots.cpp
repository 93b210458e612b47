#include "sim/cli/bench_plots.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <optional>

#include "core/base/printable.h"
#include "core/io/atomic_file.h"
#include "kinemesh/error.h"
#include "sim/cli/bench_score.h"

namespace kinemesh::cli {
namespace {

namespace fs = std::filesystem;

// Distinguishable whatever one's colour vision, by Okabe and Ito.
constexpr std::array colours{"#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000"};
constexpr std::array symbols{7, 5, 9, 11, 13, 6, 4};

std::optional<double> number_in(const std::string& text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

constexpr std::size_t most_text = 200;  // characters of a title or name

// Within single quotes gnuplot reads neither backslashes nor backquotes, which would start a command. Single
// quotes are joined to the rest: written twice, as its manual says, gnuplot 5.4 takes several of them for the
// end.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : printable(text, most_text)) result += c == '\'' ? "'.\"'\".'" : std::string{c};
  return result + "'";
}

using Pairs = std::vector<std::pair<double, double>>;
using Curves = std::vector<Curve>;

struct Plot {
  std::string name, title, x, y;
  bool log_x = true, has_lines = true;
  std::string reference{};  // a function of x and its title, as gnuplot's `plot` takes it
};

// What is not above 0 has no logarithm.
bool can_be_drawn(const Plot& plot, const std::pair<double, double>& point) {
  return point.second > 0.0 && (!plot.log_x || point.first > 0.0);
}

// More than can be told apart would only make pictures that nothing can open.
constexpr std::size_t most_points = 5000, most_curves = 40;

std::size_t stride_for(std::size_t n, std::size_t most) {
  return std::max<std::size_t>(1, (n + most - 1) / most);
}

std::string data_block(const Plot& plot, int number, const Pairs& points) {
  const std::size_t stride = stride_for(points.size(), most_points);
  std::string text = stride > 1 ? fmt::format("# one of every {} points\n", stride) : "";
  text += fmt::format("$curve{} << end\n", number);
  for (std::size_t i = 0; i < points.size(); i += stride)
    if (can_be_drawn(plot, points[i])) text += fmt::format("{} {}\n", points[i].first, points[i].second);
  return text + "end\n";
}

Curves some_of(const Curves& curves) {
  const std::size_t stride = stride_for(curves.size(), most_curves);
  Curves some;
  for (std::size_t i = 0; i < curves.size(); i += stride) some.push_back(curves[i]);
  return some;
}

std::string line_of(const Plot& plot, int number, const Curve& curve) {
  const std::size_t style = curve.style % colours.size();
  return fmt::format("$curve{} using 1:2 with {} lc rgb \"{}\" lw 2 pt {} ps {} title {}", number,
                     plot.has_lines ? "linespoints" : "points", colours[style], symbols[style],
                     plot.has_lines ? 0.8 : 0.4, quoted(curve.name));
}

std::string script(const Plot& plot, const Curves& curves) {
  std::string text = fmt::format(
      "# Makes {0}.svg: gnuplot {0}.gp\n"
      "set encoding utf8\n"
      "set terminal svg size 720,480 noenhanced font \"sans-serif,14\" background \"#ffffff\"\n"
      "set output \"{0}.svg\"\nset title {1}\nset xlabel {2}\nset ylabel {3}\n"
      "set logscale {4}\nset grid lc rgb \"#dddddd\"\nset key outside right top\nset format y \"%g\"\nset "
      "format x \"%g\"\n"
      "set offsets graph 0.02, graph 0.02\n",
      plot.name, quoted(plot.title), quoted(plot.x), quoted(plot.y), plot.log_x ? "xy" : "y");
  std::string list;
  for (int i = 0; i < static_cast<int>(curves.size()); ++i) {
    text += data_block(plot, i, curves[i].points);
    list += (list.empty() ? "" : ", \\\n  ") + line_of(plot, i, curves[i]);
  }
  if (!plot.reference.empty()) list += ", \\\n  " + plot.reference + " with lines lc rgb \"#888888\" dt 2";
  return text + "plot " + list + "\n";
}

// Ours, but for what makes gnuplot do more than its script says.
std::vector<char*> environment_of_gnuplot() {
  std::vector<char*> variables;
  for (char** variable = environ; *variable != nullptr; ++variable)
    if (!std::string_view(*variable).starts_with("GNU")) variables.push_back(*variable);
  variables.push_back(nullptr);
  return variables;
}

// False if there is no gnuplot, or it fails.
bool run_gnuplot(const fs::path& script) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addchdir_np(&actions, script.parent_path().c_str());
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  std::string program = "gnuplot", no_settings = "-d", file = script.filename().string();
  char* const arguments[] = {program.data(), no_settings.data(), file.data(), nullptr};
  const auto environment = environment_of_gnuplot();
  pid_t child = 0;
  const bool spawned = posix_spawnp(&child, "gnuplot", &actions, nullptr, arguments, environment.data()) == 0;
  posix_spawn_file_actions_destroy(&actions);
  int status = 0;
  return spawned && waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

bool is_empty(const Plot& plot, const Curves& curves) {
  return std::ranges::all_of(curves, [&](const auto& curve) {
    return std::ranges::none_of(curve.points, [&](const auto& point) { return can_be_drawn(plot, point); });
  });
}

// The line of slope 1 through the middle of a cloud.
std::string slope_one(const Pairs& points) {
  std::vector<double> ratios;
  for (const auto& [x, y] : points) ratios.push_back(y / x);
  return fmt::format("{} * x title \"in proportion\"", median(ratios));
}

}  // namespace

void BenchPlots::add(const Round& round, const std::string& value) {
  if (std::ranges::find(strategies_, round.strategy) == strategies_.end())
    strategies_.push_back(round.strategy);
  if (seen_.insert(value).second) values_.push_back(value);
  if (!round.record.accepted) return;
  auto& times = times_[{round.strategy, value}];
  times.steps.push_back(round.record.step);
  times.milliseconds.push_back(round.record.total_ms - round.record.move_ms);
  for (const auto& region : round.record.repair.regions) {
    const int faces = static_cast<int>(region.faces.size());
    if (faces == round.mesh.n_faces()) continue;
    ++regions_[round.strategy][faces];
    ++explored_[round.strategy][{faces, region.explored}];
  }
}

void BenchPlots::add(const BoundSample& sample) {
  bound_.emplace_back(sample.bound(), sample.explore_us);
}

bool BenchPlots::sweeps_numbers() const {
  return !key_.empty() &&
         std::ranges::all_of(values_, [](const auto& value) { return number_in(value).has_value(); });
}

int BenchPlots::style_of(const std::string& strategy) const {
  return static_cast<int>(std::ranges::find(strategies_, strategy) - strategies_.begin());
}

Curves BenchPlots::curves_of_steps() const {
  Curves curves;
  for (const auto& [key, times] : times_) {
    const auto& [strategy, value] = key;
    const int style = value.empty() ? style_of(strategy) : static_cast<int>(curves.size());
    auto& curve = curves.emplace_back(Curve{value.empty() ? strategy : strategy + ", " + value, style, {}});
    for (std::size_t i = 0; i < times.steps.size(); ++i)
      curve.points.emplace_back(times.steps[i], times.milliseconds[i]);
  }
  return curves;
}

Curves BenchPlots::curves_of_sweep() const {
  Curves curves;
  for (const auto& strategy : strategies_) {
    auto& points = curves.emplace_back(Curve{strategy, style_of(strategy), {}}).points;
    for (const auto& value : values_) {
      const auto found = times_.find({strategy, value});
      if (found != times_.end()) points.emplace_back(*number_in(value), median(found->second.milliseconds));
    }
    std::sort(points.begin(), points.end());
  }
  return curves;
}

// By powers of two: a point stands at the least number of faces it counts.
Curves BenchPlots::curves_of_sizes() const {
  Curves curves;
  for (const auto& [strategy, sizes] : regions_) {
    std::map<unsigned, int> counts;
    for (const auto& [faces, count] : sizes) counts[std::bit_floor(static_cast<unsigned>(faces))] += count;
    curves.push_back({strategy, style_of(strategy), Pairs(counts.begin(), counts.end())});
  }
  return curves;
}

Curves BenchPlots::curves_of_exploring() const {
  Curves curves;
  for (const auto& [strategy, pairs] : explored_) {
    auto& points = curves.emplace_back(Curve{strategy, style_of(strategy), {}}).points;
    for (const auto& [pair, count] : pairs) points.emplace_back(pair);
  }
  return curves;
}

std::string BenchPlots::write(const fs::path& directory) const {
  const fs::path folder = directory / "plots";
  fs::create_directories(folder);
  bool drawn = true;
  const auto draw = [&](const Plot& plot, const Curves& curves) {
    if (is_empty(plot, curves)) return;
    const fs::path file = folder / (plot.name + ".gp");
    write_file_atomically(file, script(plot, curves));
    drawn = run_gnuplot(file) && drawn;
  };
  if (sweeps_numbers()) {
    draw({"sweep", title_, key_, "median step without the move, ms"}, curves_of_sweep());
  } else {
    const Curves all = curves_of_steps(), some = some_of(all);
    const auto remark =
        some.size() < all.size() ? fmt::format(": {} of {} curves", some.size(), all.size()) : "";
    draw({"steps", title_ + remark, "step", "step without the move, ms", false}, some);
  }
  draw({"sizes", title_, "faces of a region, by powers of two", "regions"}, curves_of_sizes());
  draw({"explored", title_, "faces of R*", "faces explored", true, false, "x title \"all of R*\""},
       curves_of_exploring());
  if (!bound_.empty())
    draw({"bound", title_, "n- + (n+ max(d, delta) + k) ln n", "exploration, microseconds", true, false,
          slope_one(bound_)},
         {{"local, a seed", 0, bound_}});
  return drawn ? folder.string()
               : folder.string() + ": scripts for gnuplot, which makes the plots where it is installed";
}

}  // namespace kinemesh::cli
