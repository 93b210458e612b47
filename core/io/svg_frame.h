// Where things are in a drawing: from the user's coordinates to pixels.
#pragma once

#include "kinemesh/svg.h"

namespace kinemesh::io {

// y down; as wide as asked for and as high as the view then is, but between 1 pixel and 10 times the width.
// Computes with halves, so that not even the largest doubles overflow.
class SvgFrame {
 public:
  SvgFrame(const ViewBox& view, double width);

  double width() const { return width_; }
  double height() const { return height_; }
  Point pixel(const Point& p) const;

 private:
  ViewBox view_;
  double width_, height_, scale_;
};

// Of all faces, with a little room around for the lines.
ViewBox whole_view(const MeshData& mesh);

}  // namespace kinemesh::io
