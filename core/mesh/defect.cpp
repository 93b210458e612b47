#include "kinemesh/defect.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace kinemesh {
namespace {

std::string name(const UserEdge& edge) {
  return fmt::format("{}-{}", edge[0], edge[1]);
}

// The culprit with this rank, or what stands in where there is none (a frame corner has no number of the
// user's).
std::string vertex(const Defect& defect, std::size_t i) {
  if (i >= defect.vertices.size() || defect.vertices[i] == none) return "a corner of the frame";
  return fmt::format("vertex {}", int{defect.vertices[i]});
}

std::string face(const Defect& defect) {
  const int number = defect.faces.empty() ? none : defect.faces[0];
  const std::vector<int> vertices(defect.vertices.begin(), defect.vertices.end());
  const auto corners = fmt::format("({})", fmt::join(vertices, ", "));
  return number == none ? "the padding's face " + corners : fmt::format("face {} {}", number, corners);
}

std::string edge(const Defect& defect, std::size_t i) {
  return i < defect.edges.size() ? "edge " + name(defect.edges[i]) : std::string("an edge");
}

std::string sentence(const Defect& d) {
  switch (d.kind) {
    case DefectKind::NonFinitePosition:
      return vertex(d, 0) + " has a position that is not finite";
    case DefectKind::CoincidentVertices:
      return vertex(d, 0) + " and " + vertex(d, 1) + " are at the same point";
    case DefectKind::InvertedFace:
      return face(d) + " is inverted";
    case DefectKind::FlatFace:
      return face(d) + " has no area";
    case DefectKind::CrossingEdges:
      return "constrained " + edge(d, 0) + " crosses constrained " + edge(d, 1);
    case DefectKind::VertexOnEdge:
      return vertex(d, 0) + " lies on constrained " + edge(d, 0);
    case DefectKind::InsideOut:
      return "border " + edge(d, 0) + " has the domain on the wrong side or twice";
    case DefectKind::LabelsMeet:
      return "two labels meet between " + edge(d, 0) + " and " + edge(d, 1);
    case DefectKind::LeftDomain:
      return vertex(d, 0) + " has reached or left the border of the padded mesh";
    case DefectKind::Escaped:
      return vertex(d, 0) + " is on the wrong side of its border or interface";
    case DefectKind::HullMoved:
      return "the convex hull moved at " + vertex(d, 0) + " and there is no frame";
    case DefectKind::NotPlanar:
      return "the faces are not a part of the plane";
    case DefectKind::Connectivity:
      return "the connectivity is inconsistent";
    case DefectKind::MissingEdge:
      return "constrained " + edge(d, 0) + " is not in the mesh";
    case DefectKind::Coverage:
      return "the faces' areas do not add up to the area inside the border";
  }
  return "unknown defect";
}

// Kinds whose culprits say nothing of where to look.
bool has_place(DefectKind kind) {
  return kind != DefectKind::NotPlanar && kind != DefectKind::Connectivity && kind != DefectKind::Coverage &&
         kind != DefectKind::NonFinitePosition && kind != DefectKind::MissingEdge;
}

}  // namespace

std::string Defect::message() const {
  auto text = sentence(*this);
  if (has_place(kind)) text += fmt::format(" at ({}, {})", where.x, where.y);
  if (!detail.empty()) text += ": " + detail;
  return text;
}

const char* to_string(DefectKind kind) {
  switch (kind) {
    case DefectKind::NonFinitePosition:
      return "non-finite position";
    case DefectKind::CoincidentVertices:
      return "coincident vertices";
    case DefectKind::InvertedFace:
      return "inverted face";
    case DefectKind::FlatFace:
      return "flat face";
    case DefectKind::CrossingEdges:
      return "crossing edges";
    case DefectKind::VertexOnEdge:
      return "vertex on edge";
    case DefectKind::InsideOut:
      return "inside out";
    case DefectKind::LabelsMeet:
      return "labels meet";
    case DefectKind::LeftDomain:
      return "left domain";
    case DefectKind::Escaped:
      return "escaped";
    case DefectKind::HullMoved:
      return "hull moved";
    case DefectKind::NotPlanar:
      return "not planar";
    case DefectKind::Connectivity:
      return "connectivity";
    case DefectKind::MissingEdge:
      return "missing edge";
    case DefectKind::Coverage:
      return "coverage";
  }
  return "unknown";
}

}  // namespace kinemesh
