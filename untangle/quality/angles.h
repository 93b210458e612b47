// Keeps every angle above a wanted one, by flips and moves where there is a smaller one and nowhere else.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "core/sweep/face_minima.h"
#include "kinemesh/detail/vertex_freedom.h"
#include "kinemesh/mesh.h"
#include "untangle/places/joint_star.h"
#include "untangle/places/star.h"
#include "untangle/quality/quality_pass.h"

namespace kinemesh {

struct AngleOptions {
  double angle = 25.0;   // degrees, above 0 and below 60: faces of the domain with a smaller one are bad
  int max_rounds = 300;  // 0 or more
};

struct AngleCounts {
  int flips = 0, moves = 0;
  int rounds = 0;       // in which something was done; if fewer than max_rounds, no proposal is left
  int left = 0;         // faces that are bad in the end
  bool is_cut = false;  // memory was short, so that it ended early
};

// Moves [Freitag 1995] and flips where an angle is too small, combined as in [Klingner 2007].
//
// In rounds, each bad face proposes what leaves the largest smallest angle among the faces it touches: the
// flip of a side, which touches two faces, or the move of a corner to its best place
// (untangle/places/star.h), which touches the faces around it. In a round in which no bad face has a
// proposal, each tries to move all vertices near it together (untangle/places/joint_star.h): those of the
// faces around it, or else, as long as no worse face is among those touched, of two, four, eight rings of
// faces; or else those of the faces around it after the flip of a side. A proposal has to make the smallest
// angle of the faces it touches larger, by 0.01 percent at least, and leave them upright, exactly. Of
// proposals that touch a common face that with the smaller key is done: the smallest angle that is touched,
// then the users' numbers of what it moves or flips, or of the face it is for. Greedily in the order of keys;
// the same come out if again and again each goes ahead whose key is smallest among those it shares faces with
// [Blelloch 2012], as several machines with a part of the mesh each can find out. Ends when no proposal is
// left.
//
// The mesh's smallest angle never gets smaller, a valid mesh stays valid, and one without bad faces bit for
// bit what it was. Labels and constrained edges stay; vertices move as VertexFreedom says, those on curves
// by themselves only: joint moves leave them where they are. The bits of the result depend neither on the
// number of threads nor on how the mesh is stored, and not on its scale if that changes by a power of two.
// Padding faces have no angle here.
//
// Takes 5 bytes a face and 5 a vertex when made. Cost of a run: of the minima that are outdated, of 64 faces
// for each bad one at most, and some 10 microseconds for each move that is thought of, a millisecond for a
// joint one; on a curve three passes over its segments, besides.
class AngleUpkeep : public QualityPass {
 public:
  // For meshes of this one's size. Throws InputError for options out of range, `held` of another size, or the
  // number of a curve that there is not.
  explicit AngleUpkeep(const Mesh& mesh, const AngleOptions& options = {}, VertexFreedom freedom = {});

  // Pre: the mesh is valid. `minima` as in QualityInputs.
  AngleCounts run(Mesh& mesh, FaceMinima* minima = nullptr) noexcept;

  QualityCounts improve(Mesh& mesh, const QualityInputs& inputs) override;
  bool moves_vertices() const override { return true; }
  std::span<const Face> flipped_faces() const override { return flipped_; }
  std::span<const MovedVertex> moved_vertices() const override { return moved_; }

 private:
  // Where a vertex should go. Angles by their tangents, of the smallest among the faces touched.
  struct Place {
    Vertex vertex;
    Point where{0.0, 0.0};
    double before = 0.0, after = 0.0;
  };

  // Where the vertices around a bad face should go together.
  struct Joint {
    Face face;
    int round = 0;  // after which this was found
    std::vector<Face>
        faces{};  // that the last try has looked at: while they are as they were, it is left at that
    Side edge{};  // to be flipped besides; its lower side
    std::vector<Place> moves{};
    double before = 0.0, after = 0.0;  // after is 0 if nothing helps
  };

  struct Proposal {
    double before = 0.0, after = 0.0;
    UserTriangle users{};          // of the vertex, the edge or the face, ascending at the end
    Side edge{};                   // to be flipped; its lower side
    int place = none;              // or where to move
    const Joint* joint = nullptr;  // or where several move

    bool is_none() const { return users[2] == none; }
    bool comes_before(const Proposal& other) const;  // by their keys
    bool is_preferred_to(const Proposal& other) const;
  };
  static Proposal better(const Proposal& a, const Proposal& b);

  enum class Freedom { None, Line, Curve, Plane };

  void forget();
  void find_bad(const Mesh& mesh, FaceMinima& minima);
  bool is_bad(const Mesh& mesh, Face face) const;
  bool do_round(Mesh& mesh, AngleCounts& counts);
  void propose(const Mesh& mesh);
  void propose_jointly(const Mesh& mesh);
  bool is_outdated(const Joint& joint) const;
  void find_joint(const Mesh& mesh, Joint& joint) const;
  bool try_joint(const Mesh& mesh, std::span<const FreeVertex> free, Side edge, Joint& joint) const;
  std::vector<FreeVertex> free_vertices_around(const Mesh& mesh, Face face, int n_rings) const;
  void find_places(const Mesh& mesh);
  void ask_for_place(const Mesh& mesh, Vertex vertex);
  Freedom freedom_of(const Mesh& mesh, Vertex vertex) const;
  std::optional<Point> best_place(const Mesh& mesh, Vertex vertex, const Star& star) const;
  void find_place(const Mesh& mesh, Place& place) const;
  Proposal best_at(const Mesh& mesh, Face face) const;
  Proposal flip_of(const Mesh& mesh, Side side) const;
  Proposal move_of(const Mesh& mesh, Vertex vertex) const;
  Proposal proposal_of(const Mesh& mesh, const Joint& joint) const;
  void choose(const Mesh& mesh);
  bool take(const Mesh& mesh, const Proposal& proposal);
  void carry_out(Mesh& mesh, AngleCounts& counts);
  std::span<const Place> moves_of(const Proposal& proposal) const;
  void move(Mesh& mesh, const Place& place) noexcept;
  void flip(Mesh& mesh, Side edge) noexcept;
  void find_still_bad(const Mesh& mesh);

  AngleOptions options_;
  VertexFreedom freedom_;
  std::span<const char> stays_;  // in this call, see QualityInputs
  double wanted_;                // tangent
  FaceMinima own_minima_;

  std::vector<Face> bad_;
  std::vector<Proposal> proposals_;
  std::vector<Proposal> winners_;
  std::vector<Face> touched_;  // by the winners
  std::vector<int> round_;     // per face: the last in which a winner has touched it
  int n_rounds_ = 0;

  std::vector<Place> places_;  // that somebody has asked for
  std::vector<int> place_of_;  // per vertex: the number of its place as things are; or none
  std::size_t n_found_ = 0;    // places, the first ones

  std::map<Face, Joint> joints_;  // by the bad face; since all were stuck for the first time

  std::vector<Face> flipped_;
  std::vector<char> is_flipped_;  // per face
  std::vector<MovedVertex> moved_;
  std::vector<char> is_moved_;  // per vertex
};

struct AngleOutcome {
  AngleCounts counts;
  double min_angle_before_deg = 0.0, min_angle_after_deg = 0.0;  // as measure has them
};

// The same for a mesh of one's own. Throws InputError for options out of range, and if the mesh has an
// inverted or flat face, which `smooth` and the strategies are for; nothing has changed then.
AngleOutcome improve_angles(Mesh& mesh, const AngleOptions& options = {}, const VertexFreedom& freedom = {});

}  // namespace kinemesh
