// The numbers people ask a mesh for first.
#pragma once

#include <array>

#include "kinemesh/mesh.h"

#pragma GCC visibility push(default)
namespace kinemesh {

// Faces so large that products of their sides overflow count for nothing.
struct Measures {
  double area = 0.0;           // of the domain: sum of the faces' signed areas
  double min_area = 0.0;       // smallest signed face area
  double min_angle_deg = 0.0;  // smallest angle of any face; 0 if one is flat or inverted
};

// Of a triangle, signed; rounded.
double twice_area(const std::array<Point, 3>& corners);

// Of a triangle's smallest angle, rounded; 0 if it is flat or inverted. Grows with the angle.
double tangent_of_smallest_angle(const std::array<Point, 3>& corners);

// Over the domain's faces; rounded. In all threads; the result does not depend on their number.
Measures measure(const Mesh& mesh);

// An angle that is less than a right one, from its tangent.
double degrees(double tangent);

// The unit "spacing": sqrt(domain area / user's vertices).
double mean_spacing(const Mesh& mesh);

}  // namespace kinemesh
#pragma GCC visibility pop
