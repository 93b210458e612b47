#include "untangle/fill/part_gluing.h"

#include <algorithm>
#include <iterator>
#include <map>

#include "untangle/fill/shadow_border.h"
#include "untangle/fill/surface.h"

namespace kinemesh {
namespace {

// The corner of the face at which the vertex is.
int corner_at(const PlaneFace& face, int v) {
  const auto& corners = face.corners;
  return static_cast<int>(std::find(corners.begin(), corners.end(), v) - corners.begin());
}

class Gluing {
 public:
  Gluing(const RemeshableSet& set, const ShadowBorder& border) : set_(set), border_(border) {
    surface_.points = border.points;
  }

  std::optional<NewFaces> run(std::span<const PlanePart> parts) {
    for (const auto& part : parts) add(part);
    if (!close_seams() || !remove_extra_vertices()) return std::nullopt;
    auto faces = convert();
    if (faces.size() != static_cast<int>(set_.faces().size()) || !fits_border(faces)) return std::nullopt;
    return faces;
  }

 private:
  // --- 6: gluing ---

  void add(const PlanePart& part) {
    const int first = 3 * surface_.n_faces();
    for (const auto& face : part) {
      const auto& [a, b, c] = face.corners;
      surface_.add_face(a, b, c);
    }
    for (int i = 0; i < static_cast<int>(part.size()); ++i) {
      for (int k = 0; k < 3; ++k) glue(part, i, k, first);
    }
  }

  // `first` is the part's first side.
  void glue(const PlanePart& part, int i, int k, int first) {
    const auto& [corners, sides] = part[i];
    const auto& across = sides[k];
    const int side = first + 3 * i + k;
    surface_.constraints[side] = across.sub == none ? across.constraint : constraint_under(across.sub);
    if (across.face != none)
      surface_.glue(side, first + 3 * across.face + corner_at(part[across.face], corners[(k + 1) % 3]));
    else if (across.sub == none && !set_.is_inner(across.mesh_side))
      surface_.glue(side, ~across.mesh_side);
    else
      seams_[seam_of(set_.mesh(), part[i], k)].push_back(side);
  }

  // Of the crease that the sub-segment lies on.
  int constraint_under(int sub) const { return set_.mesh().constraint_of(border_.subs[sub].crease); }

  // False if one does not have two sides.
  bool close_seams() {
    return std::ranges::all_of(seams_, [&](const auto& seam) {
      const auto& sides = seam.second;
      if (sides.size() != 2) return false;
      surface_.glue(sides[0], sides[1]);
      return true;
    });
  }

  // --- 7: only vertices of the mesh ---

  bool remove_extra_vertices() {
    std::vector<int> side_at(surface_.points.size(), none);  // a side that starts at the vertex
    const auto note_sides_from = [&](std::size_t first) {
      for (std::size_t s = first; s < surface_.corners.size(); ++s)
        side_at[surface_.corners[s]] = static_cast<int>(s);
    };
    note_sides_from(0);
    for (std::size_t v = set_.n_vertices(); v < side_at.size(); ++v) {
      const auto n_before = surface_.corners.size();
      if (!surface_.remove_vertex(side_at[v])) return false;
      note_sides_from(n_before);
    }
    return true;
  }

  NewFaces convert() const {
    const auto number = numbers();
    NewFaces faces;
    for (int f = 0; f < surface_.n_faces(); ++f) {
      if (number[f] == none) continue;
      MeshTriangle corners;
      Triangle neighbours, constraints;
      for (int k = 0; k < 3; ++k) {
        const int side = 3 * f + k, mate = surface_.mates[side];
        corners[k] = set_.vertex(surface_.corners[side]);
        neighbours[k] = mate < 0 ? mate : number[mate / 3];
        constraints[k] = surface_.constraints[side];
      }
      faces.add(corners, neighbours, constraints);
    }
    return faces;
  }

  // Per face: among those alive, or none.
  std::vector<int> numbers() const {
    std::vector<int> number(surface_.n_faces(), none);
    int n = 0;
    for (int f = 0; f < surface_.n_faces(); ++f) {
      if (surface_.alive[f]) number[f] = n++;
    }
    return number;
  }

  // Each side of the border of R* bounds one new face, from end to end.
  bool fits_border(const NewFaces& faces) const {
    std::vector<Side> found;
    for (int f = 0; f < faces.size(); ++f) {
      for (int k = 0; k < 3; ++k) {
        const Side mesh_side(~faces.neighbours[f][k]);
        if (mesh_side < 0) continue;
        if (!runs_along(faces.triangles[f], k, mesh_side)) return false;
        found.push_back(mesh_side);
      }
    }
    std::sort(found.begin(), found.end());
    return found == border_of_set();
  }

  bool runs_along(const MeshTriangle& corners, int k, Side mesh_side) const {
    return corners[k] == set_.mesh().from(mesh_side) && corners[(k + 1) % 3] == set_.mesh().to(mesh_side);
  }

  // The sides inside it, ascending.
  std::vector<Side> border_of_set() const {
    std::vector<Side> border;
    for (const Face face : set_.faces()) {
      const auto sides = set_.mesh().sides(face);
      std::copy_if(sides.begin(), sides.end(), std::back_inserter(border),
                   [&](Side side) { return !set_.is_inner(side); });
    }
    std::sort(border.begin(), border.end());
    return border;
  }

  const RemeshableSet& set_;
  const ShadowBorder& border_;
  Surface surface_;
  std::map<Seam, std::vector<int>> seams_;  // the sides along each
};

}  // namespace

std::optional<NewFaces> glue_parts(const RemeshableSet& set, const ShadowBorder& border,
                                   std::span<const PlanePart> parts) {
  return Gluing(set, border).run(parts);
}

}  // namespace kinemesh
