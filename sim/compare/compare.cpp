#include "kinemesh/compare.h"

#include <malloc.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <utility>

#include "core/base/stopwatch.h"
#include "core/mesh/frame.h"
#include "kinemesh/error.h"
#include "kinemesh/run.h"
#include "kinemesh/setup.h"
#include "kinemesh/validate.h"
#include "motion/following.h"

namespace kinemesh {
namespace {

// Not given back yet; without what other threads than the first have taken in small pieces.
std::int64_t allocated_bytes() {
  const auto info = mallinfo2();
  return static_cast<std::int64_t>(info.uordblks + info.hblkhd);
}

std::int64_t bytes_of(const StepRecord& record) {
  const std::int64_t before = allocated_bytes();
  const StepRecord copy = record;
  return allocated_bytes() - before;
}

class Competitor {
 public:
  Competitor(const RepairSpec& repair, const Mesh& mesh, const Motion& motion)
      : options_(stepper_options(repair, motion)), held_bytes_(allocated_bytes()), stepper_(mesh, options_) {
    held_bytes_ = allocated_bytes() - held_bytes_;
  }

  const std::string& strategy() const { return options_.strategy; }
  const Mesh& mesh() const { return stepper_.mesh(); }
  // Records that other threads have filled are subtracted but were never added: hence not below 0.
  std::size_t held_bytes() const { return static_cast<std::size_t>(std::max<std::int64_t>(held_bytes_, 0)); }

  StepOutcome step(std::span<const Point> positions, double dt) {
    const std::int64_t before = allocated_bytes();
    auto outcome = stepper_.step(positions, dt);
    held_bytes_ += allocated_bytes() - bytes_of(outcome.record) - before;
    if (const auto defect = outcome ? validate(mesh()) : std::nullopt)
      throw std::logic_error("strategy " + strategy() + " leaves " + defect->message() + " at step " +
                             std::to_string(outcome.record.step));
    return outcome;
  }

  void follow(const Competitor& other) {
    const std::int64_t before = allocated_bytes();
    stepper_ = Stepper(other.mesh(), options_, other.stepper_.time(), other.stepper_.steps_done());
    held_bytes_ += allocated_bytes() - before;
  }

 private:
  StepperOptions options_;
  std::int64_t held_bytes_;
  Stepper stepper_;
};

class Contest {
 public:
  Contest(const Scenario& scenario, std::span<const std::string> strategies, SetUp set_up)
      : time_(scenario.time),
        motion_(std::move(set_up.motion)),
        mesh_(std::move(set_up.mesh)),
        now_(mesh_.positions().begin(), mesh_.positions().end()),
        next_(now_) {
    if (!motion_.roles().empty()) following_.emplace(mesh_, motion_.interior());
    for (const auto& strategy : strategies) {
      RepairSpec repair = scenario.repair;
      repair.strategy = strategy;
      competitors_.emplace_back(repair, mesh_, motion_);
    }
  }

  std::optional<std::string> run(const std::function<void(const Round&)>& tell,
                                 const TangledMeshViewer& view) {
    for (int step = 1; step <= time_.steps; ++step) {
      if (view) show_tangled(step, view);
      if (auto why = do_step(step, tell)) return why;
    }
    return std::nullopt;
  }

 private:
  // The interior follows on the mesh of the first competitor: they all are valid.
  void move(int step) {
    const double t = time_.time_after(step - 1), end = time_.time_after(step);
    const TimeStep whole{t, end, end - t, static_cast<std::uint64_t>(step - 1)};
    motion_.advance(now_, whole, next_);
    const Stopwatch clock;
    if (following_ && !following_->follow(leader().mesh(), motion_, whole, next_).converged)
      throw InputError("the interior does not follow the border in step " + std::to_string(step));
    interior_ms_ = following_ ? clock.milliseconds() : 0.0;
  }

  // Whose mesh the common positions are of where the interior follows.
  Competitor& leader() { return competitors_[leader_]; }

  // Unless its frame cannot follow; the step then says so.
  void show_tangled(int step, const TangledMeshViewer& view) {
    move(step);
    Mesh tangled = competitors_.front().mesh();
    auto positions = next_;
    if (follow(tangled, positions)) return;
    tangled.swap_positions(positions);
    view(step, tangled);
  }

  std::optional<std::string> do_step(int step, const std::function<void(const Round&)>& tell) {
    const double dt = time_.time_after(step) - time_.time_after(step - 1);
    move(step);
    const auto positions = mesh_.in_user_order(next_);
    std::vector<StepOutcome> outcomes;
    for (auto& competitor : competitors_) outcomes.push_back(competitor.step(positions, dt));
    const auto valid = std::find_if(outcomes.begin(), outcomes.end(), [](const auto& o) { return bool(o); });
    for (std::size_t i = 0; i < outcomes.size(); ++i) {
      if (!outcomes[i] && valid != outcomes.end())
        competitors_[i].follow(competitors_[valid - outcomes.begin()]);
      outcomes[i].record.interior_ms = interior_ms_;
      tell({competitors_[i].strategy(), outcomes[i].record, competitors_[i].mesh(),
            competitors_[i].held_bytes()});
    }
    if (valid == outcomes.end()) return why_all_stopped(outcomes);
    if (following_)
      go_on_with(valid - outcomes.begin());
    else
      std::swap(now_, next_);
    return std::nullopt;
  }

  // Each strategy's reason, where there are several.
  std::string why_all_stopped(std::span<const StepOutcome> outcomes) const {
    if (outcomes.size() == 1) return why_stopped(outcomes.front());
    std::string reasons;
    for (std::size_t i = 0; i < outcomes.size(); ++i)
      reasons += (i == 0 ? "" : "; ") + competitors_[i].strategy() + ": " + why_stopped(outcomes[i]);
    return reasons;
  }

  void go_on_with(std::ptrdiff_t competitor) {
    following_->accept();
    leader_ = static_cast<std::size_t>(competitor);
    std::ranges::copy(leader().mesh().positions(), now_.begin());
  }

  TimeSpec time_;
  Motion motion_;
  std::optional<Following> following_;
  std::size_t leader_ = 0;
  double interior_ms_ = 0.0;
  Mesh mesh_;                      // as it was at first
  std::vector<Point> now_, next_;  // the common positions, in its numbering
  std::vector<Competitor> competitors_;
};

// Where the text is cut: at commas that stand in no brackets and no quotes.
std::vector<std::string> parts_of(const std::string& text) {
  std::vector<std::string> parts(1);
  int depth = 0;
  bool is_quoted = false;
  for (const char c : text) {
    is_quoted ^= c == '"';
    if (!is_quoted) depth += (c == '[') - (c == ']');
    if (c == ',' && depth == 0 && !is_quoted)
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

}  // namespace

std::optional<std::string> compare_strategies(const Scenario& scenario, SetUp made,
                                              std::span<const std::string> strategies,
                                              const std::function<void(const Round&)>& tell,
                                              const TangledMeshViewer& view) {
  return Contest(scenario, strategies, std::move(made)).run(tell, view);
}

Sweep parse_sweep(const std::string& text) {
  const auto equals = text.find('=');
  const auto refuse = [&] { throw InputError("--sweep " + text + ": key=value,value,... expected"); };
  if (equals == std::string::npos || equals == 0) refuse();
  Sweep sweep{text.substr(0, equals), parts_of(text.substr(equals + 1))};
  if (std::ranges::find(sweep.values, "") != sweep.values.end()) refuse();
  return sweep;
}

}  // namespace kinemesh
