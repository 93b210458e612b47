// Fields written as formulas in x, y and t, in muParser's language (sin, exp, min, ?:, ^ ...); pi is a
// constant.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "kinemesh/field.h"
#include "kinemesh/parameters.h"

namespace kinemesh {

enum class FormulaIn : std::uint8_t { PlaceAndTime, Time };

// One formula f(x, y, t), or f(t). May be evaluated from several threads at once: each has a parser of its
// own.
class Formula {
 public:
  // key: the parameter it is the value of, for messages. Throws ParameterError that quotes the text and says
  // where it stops making sense.
  Formula(const std::string& key, const std::string& text, FormulaIn in = FormulaIn::PlaceAndTime);
  ~Formula();
  Formula(Formula&&) noexcept;
  Formula& operator=(Formula&&) noexcept;

  double operator()(const Point& x, double t) const;

 private:
  struct Parsers;
  std::unique_ptr<Parsers> parsers_;
};

// v = (u(x, y, t), v(x, y, t)).
class ExpressionVelocity final : public VelocityField {
 public:
  ExpressionVelocity(const std::string& u, const std::string& v);  // throws ParameterError
  std::string_view name() const override { return "expression"; }
  Point velocity(const Point& x, double t) const override { return {u_(x, t), v_(x, t)}; }

 private:
  Formula u_, v_;
};

// d = (dx(x, y, t), dy(x, y, t)); x and y are the initial position.
class ExpressionDisplacement final : public DisplacementField {
 public:
  ExpressionDisplacement(const std::string& dx, const std::string& dy);  // throws ParameterError
  std::string_view name() const override { return "displacement"; }
  Point displacement(const Point& initial, double t) const override {
    return {dx_(initial, t), dy_(initial, t)};
  }

 private:
  Formula dx_, dy_;
};

}  // namespace kinemesh
