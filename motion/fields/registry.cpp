#include "kinemesh/registry.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/registry.h"
#include "motion/fields/builtin_fields.h"

namespace kinemesh {
namespace {

Registry<RegisteredField>& registry() {
  static Registry<RegisteredField> all("field", builtin_fields());
  return all;
}

const char* expectation(ParameterKind kind) {
  switch (kind) {
    case ParameterKind::Number:
      return "a number";
    case ParameterKind::PositiveNumber:
      return "a number greater than 0";
    case ParameterKind::NonNegativeNumber:
      return "a number that is not negative";
    case ParameterKind::Vector:
      return "[x, y]";
    case ParameterKind::Direction:
      return "[x, y], not both 0";
    case ParameterKind::Size:
      return "[width, height] or one number for both, greater than 0";
    case ParameterKind::Numbers:
      return "a list of numbers, [a, b, ...]";
    case ParameterKind::Points:
      return "a list of points, [[x, y], ...]";
    case ParameterKind::Seed:
      return "an integer that is not negative";
    case ParameterKind::Text:
      return "a text";
    case ParameterKind::File:
    case ParameterKind::OptionalFile:
      return "the name of a file";
  }
  return "";
}

bool all_finite(const std::vector<double>& v) {
  return std::all_of(v.begin(), v.end(), [](double x) { return std::isfinite(x); });
}
bool all_finite(const std::vector<Point>& v) {
  return std::all_of(v.begin(), v.end(), is_finite);
}

template <class List>
bool fits_list(const ParameterValue& value) {
  const auto* list = std::get_if<List>(&value);
  return list && !list->empty() && all_finite(*list);
}

bool fits_pair(ParameterKind kind, const std::vector<double>& v) {
  if (v.size() != 2 || !all_finite(v)) return false;
  if (kind == ParameterKind::Size) return v[0] > 0.0 && v[1] > 0.0;
  return kind == ParameterKind::Vector || std::hypot(v[0], v[1]) > 0.0;
}

bool fits_number(ParameterKind kind, double x) {
  if (kind == ParameterKind::PositiveNumber) return x > 0.0 && std::isfinite(x);
  return std::isfinite(x) && (kind == ParameterKind::Number || x >= 0.0);
}

// Numbers become doubles and sizes pairs, so that fields see one type per kind.
ParameterValue widened(ParameterKind kind, ParameterValue value) {
  if (const auto* n = std::get_if<std::int64_t>(&value); n && kind != ParameterKind::Seed)
    value = static_cast<double>(*n);
  if (const auto* x = std::get_if<double>(&value); x && kind == ParameterKind::Size)
    value = std::vector<double>{*x, *x};
  return value;
}

bool fits(ParameterKind kind, const ParameterValue& value) {
  switch (kind) {
    case ParameterKind::Number:
    case ParameterKind::PositiveNumber:
    case ParameterKind::NonNegativeNumber:
      return std::holds_alternative<double>(value) && fits_number(kind, std::get<double>(value));
    case ParameterKind::Vector:
    case ParameterKind::Direction:
    case ParameterKind::Size:
      return std::holds_alternative<std::vector<double>>(value) &&
             fits_pair(kind, std::get<std::vector<double>>(value));
    case ParameterKind::Numbers:
      return fits_list<std::vector<double>>(value);
    case ParameterKind::Points:
      return fits_list<std::vector<Point>>(value);
    case ParameterKind::Seed:
      return std::holds_alternative<std::int64_t>(value) && std::get<std::int64_t>(value) >= 0;
    case ParameterKind::Text:
    case ParameterKind::OptionalFile:
      return std::holds_alternative<std::string>(value);
    case ParameterKind::File:
      return std::holds_alternative<std::string>(value) && !std::get<std::string>(value).empty();
  }
  return false;
}

template <class Items>
std::string names_of(const Items& items) {
  std::string list;
  for (const auto& item : items) list += (list.empty() ? "" : ", ") + item.name;
  return list;
}

[[noreturn]] void refuse(const FieldInfo& field, const std::string& key, const std::string& why) {
  throw ParameterError(key, fmt::format("field \"{}\": {}", field.name, why));
}

// Those that the field does not list.
FieldParameters unlisted(const FieldInfo& info, const FieldParameters& given) {
  FieldParameters others;
  for (const auto& parameter : given)
    if (std::none_of(info.parameters.begin(), info.parameters.end(),
                     [&](const auto& p) { return p.name == parameter.first; }))
      others.insert(parameter);
  return others;
}

}  // namespace

std::string to_string(const ParameterValue& value) {
  if (const auto* x = std::get_if<double>(&value)) return fmt::format("{}", *x);
  if (const auto* n = std::get_if<std::int64_t>(&value)) return fmt::format("{}", *n);
  if (const auto* text = std::get_if<std::string>(&value)) return '"' + *text + '"';
  if (const auto* numbers = std::get_if<std::vector<double>>(&value))
    return fmt::format("[{}]", fmt::join(*numbers, ", "));
  std::string list;
  for (const Point& p : std::get<std::vector<Point>>(value))
    list += fmt::format("{}[{}, {}]", list.empty() ? "" : ", ", p.x, p.y);
  return "[" + list + "]";
}

CheckedParameters::CheckedParameters(const FieldInfo& info, const FieldParameters& given) {
  others_ = unlisted(info, given);
  if (!others_.empty() && !info.takes_others) {
    const std::string& key = others_.begin()->first;
    refuse(info, key, "unknown parameter " + key + ", expected " + names_of(info.parameters));
  }
  for (const auto& [name, kind, meaning, otherwise] : info.parameters) {
    const auto found = given.find(name);
    if (found == given.end() && !otherwise)
      refuse(info, name,
             "parameter " + name + " is missing, expected " + expectation(kind) + " (" + meaning + ")");
    const ParameterValue& value = found == given.end() ? *otherwise : found->second;
    const ParameterValue wide = widened(kind, value);
    if (!fits(kind, wide))
      refuse(info, name,
             name + " = " + to_string(value) + ", expected " + expectation(kind) + " (" + meaning + ")");
    values_.emplace(name, wide);
  }
}

double CheckedParameters::number(std::string_view name) const {
  return std::get<double>(values_.find(name)->second);
}

Point CheckedParameters::point(std::string_view name) const {
  const auto& pair = std::get<std::vector<double>>(values_.find(name)->second);
  return {pair[0], pair[1]};
}

const std::vector<double>& CheckedParameters::numbers(std::string_view name) const {
  return std::get<std::vector<double>>(values_.find(name)->second);
}

const std::vector<Point>& CheckedParameters::points(std::string_view name) const {
  return std::get<std::vector<Point>>(values_.find(name)->second);
}

std::uint64_t CheckedParameters::seed(std::string_view name) const {
  return static_cast<std::uint64_t>(std::get<std::int64_t>(values_.find(name)->second));
}

const std::string& CheckedParameters::text(std::string_view name) const {
  return std::get<std::string>(values_.find(name)->second);
}

std::vector<FieldInfo> fields() {
  const auto all = registry().all();
  return {all.begin(), all.end()};
}

AnyField make_field(std::string_view name, const FieldParameters& parameters) {
  const RegisteredField& field = [&]() -> const RegisteredField& {
    try {
      return registry().find(name);
    } catch (const InputError& error) {
      throw ParameterError("field", error.what());
    }
  }();
  return field.make(CheckedParameters(field, parameters));
}

void register_field(const FieldInfo& info, const FieldFactory& factory) {
  registry().add({info, factory});
}

}  // namespace kinemesh
