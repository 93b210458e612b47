#include "motion/fields/builtin_fields.h"

#include <numbers>

#include "motion/fields/expression.h"
#include "motion/fields/noise.h"
#include "motion/fields/oscillation.h"
#include "motion/fields/plugin_field.h"
#include "motion/fields/prescribed_path.h"
#include "motion/fields/recorded.h"
#include "motion/fields/rigid.h"
#include "motion/fields/sampled_grid.h"
#include "motion/fields/vortical.h"

namespace kinemesh {
namespace {

using Kind = ParameterKind;
using Parameters = CheckedParameters;

const std::vector<double> unit_center{0.5, 0.5}, unit_size{1.0, 1.0}, origin{0.0, 0.0};

ParameterInfo center_of(const char* what) {
  return {"center", Kind::Vector, what};
}
ParameterInfo rate_of(const char* what) {
  return {"rate", Kind::Number, what};
}
ParameterInfo box_center() {
  return {"center", Kind::Vector, "centre of the box", unit_center};
}
ParameterInfo box_size() {
  return {"size", Kind::Size, "width and height of the box, length", unit_size};
}
ParameterInfo omega() {
  return {"omega", Kind::Number, "angular frequency, radians per time"};
}
ParameterInfo seed() {
  return {"seed", Kind::Seed, "of the random numbers", std::int64_t{1}};
}

VortexBox box(const Parameters& p) {
  return {p.point("center"), p.point("size")};
}
double radians(double degrees) {
  return degrees * (std::numbers::pi / 180.0);
}

std::vector<RegisteredField> rigid_fields() {
  return {
      {{"rotation",
        "rigid rotation, counter-clockwise",
        {center_of("centre of the rotation"), rate_of("radians per time")}},
       [](const Parameters& p) { return std::make_shared<Rotation>(p.point("center"), p.number("rate")); }},
      {{"zalesak",
        "Zalesak's rotation about (0.5, 0.5)",
        {{"period", Kind::PositiveNumber, "time of one turn", 628.0}}},
       [](const Parameters& p) { return std::make_shared<ZalesakRotation>(p.number("period")); }},
      {{"translate", "the same velocity everywhere", {{"velocity", Kind::Vector, "length per time"}}},
       [](const Parameters& p) { return std::make_shared<Translation>(p.point("velocity")); }},
      {{"shear",
        "u = rate (y - center y)",
        {rate_of("1 per time"), {"center", Kind::Vector, "a point that stays", origin}}},
       [](const Parameters& p) { return std::make_shared<Shear>(p.point("center"), p.number("rate")); }},
      {{"rotor",
        "rigid disc turning in a still mesh",
        {center_of("centre of the disc"),
         {"radius", Kind::PositiveNumber, "of the disc, length"},
         rate_of("radians per time")}},
       [](const Parameters& p) {
         return std::make_shared<Rotor>(p.point("center"), p.number("radius"), p.number("rate"));
       }},
  };
}

AnyField point_vortices(const Parameters& p) {
  const auto& points = p.points("points");
  const auto& strengths = p.numbers("strengths");
  if (points.size() != strengths.size())
    throw ParameterError("strengths", "field \"vortices\": " + std::to_string(strengths.size()) +
                                          " strengths, expected one for each of the points, " +
                                          std::to_string(points.size()));
  return std::make_shared<PointVortices>(points, strengths, p.number("core"));
}

std::vector<RegisteredField> vortical_fields() {
  return {
      {{"swirl",
        "LeVeque's swirl, back at t = period",
        {{"period", Kind::PositiveNumber, "time", 8.0}, box_center(), box_size()}},
       [](const Parameters& p) { return std::make_shared<Swirl>(box(p), p.number("period")); }},
      {{"taylor-green", "Taylor-Green vortex, steady", {box_center(), box_size()}},
       [](const Parameters& p) { return std::make_shared<TaylorGreen>(box(p)); }},
      {{"gresho", "Gresho's vortex, steady", {box_center(), box_size()}},
       [](const Parameters& p) { return std::make_shared<Gresho>(box(p)); }},
      {{"twist",
        "twisting rotation inside a still border, back at t = period",
        {{"rate", Kind::Number, "at the centre and t = 0, radians per time", 1.0},
         {"period", Kind::PositiveNumber, "time", 8.0},
         box_center(),
         box_size()}},
       [](const Parameters& p) {
         return std::make_shared<Twist>(box(p), p.number("rate"), p.number("period"));
       }},
      {{"vortices",
        "point vortices that stay where they are, counter-clockwise",
        {{"points", Kind::Points, "where they are"},
         {"strengths", Kind::Numbers, "circulation of each, length^2 per time"},
         {"core", Kind::PositiveNumber, "radius of the fastest ring around each, length"}}},
       point_vortices},
  };
}

std::vector<RegisteredField> body_fields() {
  return {
      {{"pitch",
        "turns by amplitude sin(omega t), counter-clockwise",
        {center_of("centre of the rotation"), {"amplitude_deg", Kind::Number, "degrees"}, omega()}},
       [](const Parameters& p) {
         return std::make_shared<Pitch>(p.point("center"), radians(p.number("amplitude_deg")),
                                        p.number("omega"));
       }},
      {{"plunge",
        "moves by amplitude sin(omega t)",
        {{"direction", Kind::Direction, "where to, of any length"},
         {"amplitude", Kind::Number, "length"},
         omega()}},
       [](const Parameters& p) {
         return std::make_shared<Plunge>(p.point("direction"), p.number("amplitude"), p.number("omega"));
       }},
      {{"rigid",
        "turns about a centre and shifts, by formulas of t or a table",
        {{"center", Kind::Vector, "of the turn, where it is at the start", origin},
         {"x", Kind::Text, "shift, a formula of t, length", "0"},
         {"y", Kind::Text, "shift, a formula of t, length", "0"},
         {"angle", Kind::Text, "a formula of t, radians, counter-clockwise", "0"},
         {"file", Kind::OptionalFile, "table of t,x,y,angle instead of the formulas", ""}}},
       prescribed_path},
  };
}

std::vector<RegisteredField> noise_fields() {
  return {
      {{"jitter",
        "uniform in a square each step, whatever its length",
        {{"amplitude", Kind::NonNegativeNumber, "half the square's side, in spacings"}, seed()}},
       [](const Parameters& p) { return std::make_shared<Jitter>(p.number("amplitude"), p.seed("seed")); }},
      {{"brownian",
        "Gaussian, standard deviation sqrt(2 diffusion dt)",
        {{"diffusion", Kind::NonNegativeNumber, "length^2 per time"}, seed()}},
       [](const Parameters& p) { return std::make_shared<Brownian>(p.number("diffusion"), p.seed("seed")); }},
  };
}

std::vector<RegisteredField> formula_fields() {
  return {
      {{"expression",
        "velocity by formulas in x, y and t",
        {{"u", Kind::Text, "length per time"}, {"v", Kind::Text, "length per time"}}},
       [](const Parameters& p) { return std::make_shared<ExpressionVelocity>(p.text("u"), p.text("v")); }},
      {{"displacement",
        "displacement by formulas in t and the initial x and y",
        {{"dx", Kind::Text, "length"}, {"dy", Kind::Text, "length"}}},
       [](const Parameters& p) {
         return std::make_shared<ExpressionDisplacement>(p.text("dx"), p.text("dy"));
       }},
  };
}

std::vector<RegisteredField> file_fields() {
  return {
      {{"grid",
        "velocity sampled on a rectilinear grid, bilinear between samples",
        {{"file", Kind::File, "table of t,x,y,u,v or x,y,u,v"}}},
       [](const Parameters& p) {
         return std::make_shared<SampledGrid>(std::filesystem::path(p.text("file")));
       }},
      {{"recorded",
        "positions recorded in a file, linear in time between them",
        {{"file", Kind::File, "table (.csv) or series of meshes (.pvd)"}}},
       [](const Parameters& p) { return std::make_shared<RecordedPositions>(p.text("file")); }},
      {{"plugin",
        "a motion from a shared library (kinemesh/plugin.h); further parameters are the plug-in's own",
        {{"library", Kind::File, "shared library"}},
        true},
       [](const Parameters& p) { return make_plugin_field(p.text("library"), p.others()); }},
  };
}

}  // namespace

std::vector<RegisteredField> builtin_fields() {
  std::vector<RegisteredField> all;
  for (const auto& group :
       {rigid_fields(), vortical_fields(), body_fields(), noise_fields(), formula_fields(), file_fields()})
    all.insert(all.end(), group.begin(), group.end());
  return all;
}

}  // namespace kinemesh
