// A region and its repair in four pictures: the tangle; the shadow X, also where it has grown; R*, the faces
// that go; the new faces.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "kinemesh/mesh.h"
#include "kinemesh/svg.h"

namespace kinemesh::draw {

struct RegionFigure {
  const Mesh& before;
  const Mesh& after;         // its repair: same vertices, same numbers of faces
  std::vector<Face> region;  // R*
  Face seed = none;          // to be drawn darker, or none
  bool is_local = false;     // X as a local exploration from the seed finds it; else inverted faces' shadows
  std::optional<ViewBox> view = {};  // default: the region with a margin
  double width = 976.0;              // pixels, of all
};

// As SVG. Colours that the colour-blind can tell apart.
std::string format_region_figure(const RegionFigure& figure);

}  // namespace kinemesh::draw
