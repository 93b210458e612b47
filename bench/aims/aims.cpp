#include "aims.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <numbers>
#include <stdexcept>

#include "kinemesh/build.h"
#include "kinemesh/motion.h"
#include "kinemesh/shapes.h"
#include "kinemesh/validate.h"
#include "motion/fields/noise.h"
#include "motion/fields/rigid.h"

namespace kinemesh::aims {
namespace {

void require(const std::optional<Defect>& defect) {
  if (defect) throw std::runtime_error(defect->message());
}

struct Verdict {
  const char* word;
  bool met;
};

Verdict judge(const Aim& aim) {
  switch (aim.kind) {
    case Aim::Kind::AtMost:
      return {"at most", aim.measured <= aim.aim};
    case Aim::Kind::AtLeast:
      return {"at least", aim.measured >= aim.aim};
    case Aim::Kind::Exactly:
      return {"exactly", aim.measured == aim.aim};
  }
  throw std::logic_error("no such kind of aim");
}

template <class Field>
Move move_of(int vertices, std::shared_ptr<Field> field) {
  Mesh mesh = build_mesh(make_square(vertices));
  const Motion motion(mesh, {{std::move(field), {}}});
  std::vector<Point> positions(mesh.n_vertices());
  motion.advance(mesh.positions(), 0.0, 1.0, 0, positions);
  return {std::move(mesh), std::move(positions)};
}

}  // namespace

void report(const Aim& aim) {
  const auto [word, met] = judge(aim);
  fmt::print("\"{}\",{},{:g},{:.4g},{},\"{}\"\n", aim.what, word, aim.aim, aim.measured,
             met ? "met" : "missed", aim.detail);
  std::fflush(stdout);
}

double median(std::vector<double> values) {
  if (values.empty()) throw std::logic_error("nothing was measured");
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

void require_valid(const Mesh& mesh) {
  require(validate(mesh));
}

void require_valid(const RepairOutcome& outcome) {
  require(outcome.defect);
}

Move jitter_of(int vertices, double amplitude) {
  return move_of(vertices, std::make_shared<Jitter>(amplitude, 1));
}

Move rotor_of(int vertices) {
  return move_of(vertices, std::make_shared<Rotor>(Point(0.5, 0.5), 0.3, std::numbers::pi / 180.0));
}

Mesh moved(const Move& move) {
  Mesh mesh = move.mesh;
  auto positions = move.positions;
  mesh.swap_positions(positions);
  return mesh;
}

}  // namespace kinemesh::aims
