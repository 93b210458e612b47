// What keeps a mesh from being valid, with the culprits: the one vocabulary of validation, embedding and
// failed repairs.
#pragma once

#include <string>
#include <vector>

#include "kinemesh/types.h"

#pragma GCC visibility push(default)
namespace kinemesh {

enum class DefectKind {
  NonFinitePosition,   // vertices: the one
  CoincidentVertices,  // vertices: both; where
  InvertedFace,        // faces: the one; vertices: its corners
  FlatFace,            // faces: the one; vertices: its corners
  CrossingEdges,       // edges: both constrained edges; where they meet
  VertexOnEdge,        // vertices: the one; edges: the constrained edge it lies on
  InsideOut,           // edges: a border edge with the domain on its wrong side, or covered more than once
  LabelsMeet,          // edges: two constrained edges between which two labels meet
  LeftDomain,          // vertices: one that is outside the border of the padded mesh, or on it
  Escaped,             // vertices: one on the wrong side of its border or interface
  HullMoved,           // vertices: one of the convex hull of a mesh without a frame
  NotPlanar,           // the faces do not form a part of the plane: a handle, a twist, no border
  Connectivity,        // faces or vertices: where sides and numbering disagree
  MissingEdge,         // edges: a constrained edge that is not in the mesh
  Coverage,            // the areas do not add up to the area inside the border
};

// All numbers are the user's (order of the input, from 0).
struct Defect {
  DefectKind kind = DefectKind::Connectivity;
  std::vector<UserVertex> vertices = {};
  std::vector<UserFace> faces = {};
  std::vector<UserEdge> edges = {};
  Point where{0.0, 0.0};    // a place to look at; rounded
  std::string detail = {};  // a clause that only this case can add, may be empty

  std::string message() const;  // one sentence that names kind, culprits and place
};

const char* to_string(DefectKind kind);

}  // namespace kinemesh
#pragma GCC visibility pop
