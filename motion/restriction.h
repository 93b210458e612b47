// Which vertices a motion acts on, and how strongly: weights, measured once on the initial mesh.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "kinemesh/mesh.h"
#include "motion/fields/parameters.h"

namespace kinemesh {

struct OnAll {};
struct OnMarker {  // the ends of the marker's edges
  std::string name;
};
struct OnLabel {  // the corners of the faces with that label
  int label;
};
struct OnDisc {  // |x - center| <= radius
  Point center;
  double radius;
};

// Fades the motion out over the distance to the marker's edges, to the border of the label's faces, or to the
// disc: 1 up to `full`, 1 - s^2 (3 - 2 s) between, s from 0 to 1, and 0 from `zero` on; 1 inside the label's
// faces and the disc.
struct Blend {
  double full, zero;  // lengths, 0 <= full < zero
};

struct Restriction {
  std::variant<OnAll, OnMarker, OnLabel, OnDisc> on = OnAll{};
  std::optional<Blend> blend;  // nothing: 1 there and 0 elsewhere
};

// on: "all", "marker:NAME", "label:N" or "disc:[x,y,r]"; blend: [full, zero]. Throws ParameterError with key
// "on" or "blend".
Restriction parse_restriction(std::string_view on, std::optional<std::array<double, 2>> blend = std::nullopt);

// One weight in [0, 1] per vertex of the mesh; empty: 1 everywhere. Rounded. Throws ParameterError (key "on")
// for a marker or label the mesh does not have. Cost: O(n log m) for m edges that are named, in parallel.
std::vector<double> weights(const Mesh& mesh, const Restriction& restriction);

}  // namespace kinemesh
