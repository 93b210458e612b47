// Fields by name: what scenarios and `kinemesh list` know of them.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "kinemesh/field.h"
#include "kinemesh/parameters.h"
#include "kinemesh/types.h"

#pragma GCC visibility push(default)
namespace kinemesh {

enum class ParameterKind {
  Number,             // finite
  PositiveNumber,     // > 0
  NonNegativeNumber,  // >= 0
  Vector,             // [x, y], finite
  Direction,          // [x, y], not both 0
  Size,               // [width, height] or one number for both; > 0
  Numbers,            // [a, b, ...], finite, at least one
  Points,             // [[x, y], ...], finite, at least one
  Seed,               // integer >= 0
  Text,
  File,          // a text; relative to the scenario's folder, absolute for the field
  OptionalFile,  // likewise, or empty
};

inline bool is_file(ParameterKind kind) {
  return kind == ParameterKind::File || kind == ParameterKind::OptionalFile;
}

struct ParameterInfo {
  std::string name;
  ParameterKind kind;
  std::string meaning;                                     // with its unit
  std::optional<ParameterValue> otherwise = std::nullopt;  // default; nothing: required
};

struct FieldInfo {
  std::string name;
  std::string description;
  std::vector<ParameterInfo> parameters;
  bool takes_others = false;  // hands on parameters that are not listed, whatever they are
};

// As a scenario writes it: 0.5, [0.5, 0.5], "x + y".
std::string to_string(const ParameterValue& value);

// Parameters that have been checked against a FieldInfo: all there, of the right kind and in range.
class CheckedParameters {
 public:
  // Throws ParameterError: a key the field does not have, one it needs and does not get, a wrong type, out of
  // range.
  CheckedParameters(const FieldInfo& info, const FieldParameters& given);

  // Pre: the field has that parameter and it is of that kind.
  double number(std::string_view name) const;
  Point point(std::string_view name) const;  // Vector, Direction and Size
  const std::vector<double>& numbers(std::string_view name) const;
  const std::vector<Point>& points(std::string_view name) const;
  std::uint64_t seed(std::string_view name) const;
  const std::string& text(std::string_view name) const;      // Text and File
  const FieldParameters& others() const { return others_; }  // those not listed, as given

 private:
  FieldParameters values_, others_;
};

using FieldFactory = std::function<AnyField(const CheckedParameters&)>;

// All fields, built in first, then in the order they were registered.
std::vector<FieldInfo> fields();

// Throws ParameterError: key "field" for an unknown name, else as CheckedParameters does and the field's own
// constructor.
AnyField make_field(std::string_view name, const FieldParameters& parameters);

// Adds a field of the user's, for scenarios that are read from then on. Throws InputError if the name is
// taken. All three from any threads.
void register_field(const FieldInfo& info, const FieldFactory& factory);

}  // namespace kinemesh
#pragma GCC visibility pop
