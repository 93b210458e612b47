#include "kinemesh/registry.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <optional>

#include "motion/fields/rigid.h"

namespace kinemesh {
namespace {

using testing::HasSubstr;

const VelocityField& velocity(const AnyField& field) {
  return *std::get<0>(field);
}
const DisplacementField& displacement(const AnyField& field) {
  return *std::get<1>(field);
}
const NoiseField& noise(const AnyField& field) {
  return *std::get<2>(field);
}

// Any value of the right kind.
ParameterValue sample(const ParameterInfo& parameter) {
  switch (parameter.kind) {
    case ParameterKind::Vector:
    case ParameterKind::Direction:
    case ParameterKind::Size:
      return std::vector<double>{2.0, 3.0};
    case ParameterKind::Numbers:
      return std::vector<double>{2.0};
    case ParameterKind::Points:
      return std::vector<Point>{{2.0, 3.0}};
    case ParameterKind::Seed:
      return std::int64_t{7};
    case ParameterKind::Text:
      return std::string("x");
    default:
      return 0.5;
  }
}

// With what it requires; nothing for a field that wants a file, which has tests of its own.
std::optional<AnyField> made(const FieldInfo& info) {
  FieldParameters required;
  for (const auto& parameter : info.parameters) {
    if (parameter.kind == ParameterKind::File) return std::nullopt;
    if (!parameter.otherwise) required.emplace(parameter.name, sample(parameter));
  }
  return make_field(info.name, required);
}

TEST(Registry, MakesEveryFieldUnderItsName) {
  std::vector<std::string> names;
  for (const auto& info : fields()) {
    names.push_back(info.name);
    EXPECT_FALSE(info.description.empty());
    if (const auto field = made(info)) {
      EXPECT_EQ(name_of(*field), info.name);
    }
  }
  EXPECT_THAT(names, testing::IsSupersetOf({"rotation", "pitch", "plunge", "translate", "shear", "swirl",
                                            "taylor-green", "gresho", "twist", "rotor", "jitter", "brownian",
                                            "expression", "displacement", "zalesak", "grid", "plugin",
                                            "vortices", "recorded"}));
}

TEST(Fields, AnswerForManyPointsAsForOne) {
  const std::vector<Point> x{{0.1, 0.2}, {0.7, 0.9}, {-2.0, 3.0}, {0.5, 0.5}, {0.0, 0.0}};
  const std::vector<std::uint64_t> vertices{0, 7, 12, 1000000, 3};
  int seen = 0;
  for (const auto& info : fields()) {
    const auto field = made(info);
    if (!field) continue;
    std::vector<Point> many(x.size()), one;
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (const auto* v = std::get_if<0>(&*field)) one.push_back((*v)->velocity(x[i], 0.3));
      if (const auto* d = std::get_if<1>(&*field)) one.push_back((*d)->displacement(x[i], 0.3));
      if (const auto* n = std::get_if<2>(&*field)) one.push_back((*n)->kick(vertices[i], 4, 0.1, 0.2));
    }
    if (const auto* v = std::get_if<0>(&*field)) (*v)->velocities(x, 0.3, many);
    if (const auto* d = std::get_if<1>(&*field)) (*d)->displacements(x, 0.3, many);
    if (const auto* n = std::get_if<2>(&*field)) (*n)->kicks(vertices, 4, 0.1, 0.2, many);
    EXPECT_EQ(std::memcmp(many.data(), one.data(), many.size() * sizeof(Point)), 0) << info.name;
    ++seen;
  }
  EXPECT_GT(seen, 12);
}

TEST(Registry, HandsParametersOver) {
  const auto rotation =
      make_field("rotation", {{"center", std::vector<double>{1.0, 0.0}}, {"rate", std::int64_t{2}}});
  EXPECT_EQ(velocity(rotation).velocity({1.0, 1.0}, 0.0), Point(-2.0, 0.0));

  const auto pitch = make_field(
      "pitch", {{"center", std::vector<double>{0.0, 0.0}}, {"amplitude_deg", 90.0}, {"omega", 1.0}});
  const Point turned = displacement(pitch).displacement({1.0, 0.0}, 0.5 * std::numbers::pi);
  EXPECT_NEAR(turned.x, -1.0, 1e-15);
  EXPECT_NEAR(turned.y, 1.0, 1e-15);

  const auto one = make_field("jitter", {{"amplitude", 1.0}, {"seed", std::int64_t{4}}});
  const auto same = make_field("jitter", {{"amplitude", 1.0}, {"seed", std::int64_t{4}}});
  const auto other = make_field("jitter", {{"amplitude", 1.0}});
  EXPECT_EQ(noise(one).kick(0, 0, 1.0, 1.0), noise(same).kick(0, 0, 1.0, 1.0));
  EXPECT_NE(noise(one).kick(0, 0, 1.0, 1.0), noise(other).kick(0, 0, 1.0, 1.0));
}

TEST(Registry, FillsInTheUnitSquareAndTakesOneNumberForASize) {
  const auto unit = make_field("gresho", {});
  EXPECT_NEAR(velocity(unit).velocity({0.6, 0.5}, 0.0).y, 0.5, 1e-14);
  const auto big =
      make_field("gresho", {{"center", std::vector<double>{0.0, 0.0}}, {"size", std::int64_t{2}}});
  EXPECT_NEAR(velocity(big).velocity({0.2, 0.0}, 0.0).y, 1.0, 1e-14);
}

struct Refusal {
  std::string key, what;
};

Refusal refusal(const std::string& name, const FieldParameters& parameters) {
  try {
    make_field(name, parameters);
  } catch (const ParameterError& error) {
    return {error.key(), error.what()};
  }
  return {};
}

TEST(Registry, NamesTheFieldAndTheParameterThatIsWrong) {
  const std::vector<double> origin{0.0, 0.0};
  const double nan = std::numeric_limits<double>::quiet_NaN();

  auto r = refusal("swirll", {});
  EXPECT_EQ(r.key, "field");
  EXPECT_THAT(r.what, testing::AllOf(HasSubstr("\"swirll\""), HasSubstr("swirl")));

  r = refusal("rotation", {{"center", origin}, {"rat", 1.0}});
  EXPECT_EQ(r.key, "rat");
  EXPECT_EQ(r.what, "field \"rotation\": unknown parameter rat, expected center, rate");

  r = refusal("rotation", {{"center", origin}});
  EXPECT_EQ(r.key, "rate");
  EXPECT_EQ(r.what, "field \"rotation\": parameter rate is missing, expected a number (radians per time)");

  r = refusal("rotor", {{"center", origin}, {"radius", -1.0}, {"rate", 1.0}});
  EXPECT_EQ(r.key, "radius");
  EXPECT_EQ(r.what, "field \"rotor\": radius = -1, expected a number greater than 0 (of the disc, length)");

  EXPECT_EQ(refusal("rotor", {{"center", 1.0}, {"radius", 1.0}, {"rate", 1.0}}).key, "center");
  EXPECT_EQ(refusal("rotor", {{"center", origin}, {"radius", 1.0}, {"rate", std::string("1")}}).key, "rate");
  EXPECT_EQ(refusal("rotor", {{"center", origin}, {"radius", 1.0}, {"rate", nan}}).key, "rate");
  EXPECT_EQ(refusal("translate", {{"velocity", std::vector<double>{1.0, 2.0, 3.0}}}).key, "velocity");
  EXPECT_EQ(refusal("plunge", {{"direction", origin}, {"amplitude", 1.0}, {"omega", 1.0}}).key, "direction");
  EXPECT_EQ(refusal("gresho", {{"size", std::vector<double>{1.0, 0.0}}}).key, "size");
  EXPECT_EQ(refusal("jitter", {{"amplitude", 0.1}, {"seed", 1.5}}).key, "seed");
  EXPECT_EQ(refusal("jitter", {{"amplitude", 0.1}, {"seed", std::int64_t{-1}}}).key, "seed");
  EXPECT_EQ(refusal("brownian", {{"diffusion", -0.1}}).key, "diffusion");
  const ParameterValue two_points = std::vector<Point>{{0.0, 0.0}, {1.0, 0.0}}, one = origin[0];
  r = refusal("vortices", {{"points", two_points}, {"strengths", std::vector<double>{1.0}}, {"core", 0.1}});
  EXPECT_EQ(r.key, "strengths");
  EXPECT_EQ(r.what, "field \"vortices\": 1 strengths, expected one for each of the points, 2");
  EXPECT_EQ(refusal("vortices", {{"points", origin}, {"strengths", origin}, {"core", 0.1}}).key, "points");
  EXPECT_EQ(refusal("vortices", {{"points", two_points}, {"strengths", one}, {"core", 0.1}}).key,
            "strengths");
  EXPECT_EQ(refusal("vortices", {{"points", two_points}, {"strengths", origin}, {"core", 0.0}}).key, "core");
  EXPECT_EQ(refusal("expression", {{"u", std::string("x")}, {"v", std::string("(")}}).key, "v");
  EXPECT_EQ(refusal("expression", {{"u", 1.0}, {"v", std::string("x")}}).key, "u");
}

TEST(Registry, WritesValuesAsScenariosDo) {
  EXPECT_EQ(to_string(ParameterValue{0.1}), "0.1");
  EXPECT_EQ(to_string(ParameterValue{std::int64_t{3}}), "3");
  EXPECT_EQ(to_string(ParameterValue{std::vector<double>{0.5, 1.0}}), "[0.5, 1]");
  EXPECT_EQ(to_string(ParameterValue{std::vector<Point>{{0.5, 1.0}, {2.0, 3.0}}}), "[[0.5, 1], [2, 3]]");
  EXPECT_EQ(to_string(ParameterValue{std::string("x + y")}), "\"x + y\"");
}

// v = strength (x, y): a field of the user's.
class Expansion final : public VelocityField {
 public:
  explicit Expansion(double strength) : strength_(strength) {}
  std::string_view name() const override { return "expansion"; }
  Point velocity(const Point& x, double) const override { return strength_ * x; }

 private:
  double strength_;
};

TEST(Registry, TakesNewFieldsOnce) {
  const FieldInfo info{
      "expansion", "away from the origin", {{"strength", ParameterKind::Number, "1 per time"}}};
  const auto make = [](const CheckedParameters& p) {
    return std::make_shared<Expansion>(p.number("strength"));
  };
  register_field(info, make);
  EXPECT_EQ(velocity(make_field("expansion", {{"strength", 3.0}})).velocity({1.0, 2.0}, 0.0),
            Point(3.0, 6.0));
  EXPECT_THROW(register_field(info, make), InputError);
  EXPECT_THROW(register_field({"swirl", "mine", {}}, make), InputError);
}

}  // namespace
}  // namespace kinemesh
