#include "sim/cli/numbers.h"

#include <fmt/core.h>

#include <charconv>
#include <limits>
#include <system_error>

namespace kinemesh::cli {
namespace {

template <class Number>
CLI::Validator validator(Number least, Number most, const std::string& what, const std::string& help) {
  const auto read = [=](std::string& text) {
    Number value{};
    const char *begin = text.data() + text.starts_with('+'), *end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(begin, end, value);
    const bool is_within = error == std::errc() && stop == end && least <= value && value <= most;
    if (!is_within) return fmt::format("{} expected, not {}", what, text.empty() ? "nothing" : text);
    text = fmt::format("{}", value);  // for CLI11 to read
    return std::string();
  };
  return {read, help};
}

}  // namespace

CLI::Validator number_within(double least, double most) {
  return validator(least, most, fmt::format("a number from {} to {}", least, most),
                   fmt::format("in [{} - {}]", least, most));
}

CLI::Validator finite_number() {
  constexpr double most = std::numeric_limits<double>::max();
  return validator(-most, most, "a finite number", "");
}

CLI::Validator integer_within(int least, int most) {
  return validator(least, most, fmt::format("an integer from {} to {}", least, most),
                   fmt::format("in [{} - {}]", least, most));
}

CLI::Validator integer() {
  using Limits = std::numeric_limits<int>;
  return validator(Limits::min(), Limits::max(), "an integer", "");
}

}  // namespace kinemesh::cli
