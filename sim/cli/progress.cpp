#include "sim/cli/progress.h"

#include <fmt/core.h>

#include <algorithm>

#include "sim/cli/console.h"

namespace kinemesh::cli {
namespace {

using Seconds = std::chrono::duration<double>;

constexpr Seconds live_interval(0.1);
constexpr Seconds plain_interval(10.0);
constexpr int plain_lines = 10;  // of a whole run that is faster than that

std::string clock_time(double seconds) {
  const auto whole = static_cast<long long>(std::min(seconds, 359999.0) + 0.5);
  const long long h = whole / 3600, m = whole / 60 % 60, s = whole % 60;
  return h > 0 ? fmt::format("{}:{:02}:{:02}", h, m, s) : fmt::format("{}:{:02}", m, s);
}

// As a multiple of what this program has done; by time, where steps differ in length.
double steps_left(const StepRecord& record, const RunPlan& plan) {
  if (plan.is_adaptive) return (plan.end_time - record.time) / (record.time - plan.start_time);
  return static_cast<double>(plan.steps - record.step) / std::max(1, record.step - plan.steps_done);
}

std::string describe(const StepRecord& record, const RunPlan& plan, int n_faces) {
  const RepairRecord& repair = record.repair;
  const std::string of = plan.is_adaptive ? "" : fmt::format("/{}", plan.steps);
  const std::string quality =
      repair.quality_flips + repair.quality_moves > 0
          ? fmt::format("flips {}  moves {}  ", repair.quality_flips, repair.quality_moves)
          : "";
  return fmt::format("step {}{}{}  t = {:.5g}  inverted {}  regions {}  replaced {:.2f} %  {}{:.1f} ms",
                     record.step, of, record.accepted ? "" : " rejected", record.time,
                     repair.inverted + repair.degenerate, repair.regions.size(),
                     100.0 * repair.replaced / std::max(1, n_faces), quality, record.total_ms);
}

// Single spaces where double ones take too much room, and what fits.
std::string fitted(std::string text, std::size_t width) {
  if (text.size() <= width) return text;
  for (std::size_t at = 0; (at = text.find("  ", at)) != std::string::npos;) text.erase(at, 1);
  return text.substr(0, width);
}

}  // namespace

Progress::Progress(Verbosity verbosity)
    : verbosity_(verbosity),
      is_live_(verbosity == Verbosity::Normal && has_live_line()),
      has_colour_(cli::has_colour()) {}

void Progress::clear_live_line() {
  if (is_line_open_) say("\r\x1b[K");
  is_line_open_ = false;
}

void Progress::note(const std::string& text) {
  if (verbosity_ == Verbosity::Quiet) return;
  clear_live_line();
  print_note(text);
}

void Progress::detail(const std::string& text) {
  if (verbosity_ == Verbosity::Verbose) print_note(text);
}

void Progress::started(const RunPlan& plan) {
  plan_ = plan;
  start_ = last_shown_ = Clock::now();
  const bool is_compared = verbosity_ != Verbosity::Quiet && plan.strategy != "remesh";
  probe_ = RemeshProbe(is_compared ? plan.steps : 0);
}

bool Progress::is_due(int step) const {
  if (verbosity_ == Verbosity::Verbose || (step == plan_.steps && !plan_.is_adaptive)) return true;
  const Seconds waited = Clock::now() - last_shown_;
  if (is_live_) return waited >= live_interval;
  return step % std::max(1, plan_.steps / plain_lines) == 0 || waited >= plain_interval;
}

void Progress::show(const StepRecord& record, int n_faces) {
  last_shown_ = Clock::now();
  const double elapsed = Seconds(last_shown_ - start_).count();
  const double left = elapsed * steps_left(record, plan_);
  const std::string text = describe(record, plan_, n_faces) + "  ETA " + clock_time(left);
  if (!is_live_) {
    say(text + "\n");
    return;
  }
  const char* colour = !has_colour_ ? "" : record.repair.regions.empty() ? "\x1b[32m" : "\x1b[33m";
  say(fmt::format("\r{}{}{}\x1b[K", colour, fitted(text, live_line_width()), has_colour_ ? "\x1b[0m" : ""));
  is_line_open_ = true;
}

void Progress::stepped(const StepRecord& record, const Mesh& mesh) {
  if (verbosity_ == Verbosity::Quiet) return;
  if (is_due(record.step) || (!record.accepted && !plan_.is_adaptive)) show(record, mesh.n_faces());
  probe_.sample(record, mesh);
}

void Progress::finished(const RunSummary& /*summary*/) {
  clear_live_line();
}

}  // namespace kinemesh::cli
