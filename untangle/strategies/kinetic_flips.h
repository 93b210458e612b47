// A kinetic triangulation: vertices move, and an edge is flipped whenever a face collapses.
#pragma once

#include <queue>
#include <set>
#include <span>
#include <vector>

#include "core/exact/kinetic_predicates.h"
#include "core/mesh/undo.h"

namespace kinemesh {

struct KineticCounts {
  int events = 0;  // faces that collapsed
  int flips = 0;
  int stuck = 0;  // events that no flip could follow
};

// Every vertex moves from `before` to where the mesh has it, at constant speed, in time 0 to 1. That a face
// is upright is a certificate, which fails at a root of its area, a quadratic of time [Basch 1997]. Failures
// are taken in the exact order of these roots, at the same time by face: one corner then lies on the opposite
// edge, and flipping that edge leaves two upright faces.
//
// Degenerate: at one time several faces may collapse, or corners meet; "after" an instant stands for all of
// some interval behind it. Edges that leave two faces upright after the instant are flipped first. A flat
// face whose longest edge has another flat face beside it, all of them on one line, has that edge flipped
// nonetheless: faces on lines get other edges, until one with a corner off the line is met. Of two vertices
// that meet one turns around the other, edge by edge. Both kinds of flips take an edge once at most at an
// instant, which is why they end; the first kind leaves fewer faces that are not upright. What still cannot
// be flipped stays as it is: a corner that has reached a constrained edge or the hull, or two others at once.
// It may come back by itself, and is tried again whenever a face beside it changes.
//
// At the end, time 1, flat faces are treated like inverted ones.
class KineticFlips {
 public:
  // Pre: the mesh, at `before`, is valid. Both stay where they are.
  KineticFlips(Undo& undo, std::span<const Point> before);

  // True if every face is upright at the end; otherwise some may not be. Cost: a sweep over the faces, in
  // parallel, and O(log n) for each event and flip. Whatever it throws, undo knows what has been flipped.
  [[nodiscard]] bool run();

  const KineticCounts& counts() const { return counts_; }

 private:
  struct Event {
    CollapseTime when;
    Face face;
    MeshTriangle corners;  // out of date once the face has others
  };
  struct Later {
    bool operator()(const Event& e, const Event& f) const;
  };

  void follow();
  bool finish();
  void handle(const Event& event);
  void start_instant(const CollapseTime& time);
  void schedule(Face face, const CollapseTime* from);
  void settle();
  bool improve(Face face);
  bool flip_on_line(Face face);
  bool flip_beside_meeting(Face face);
  void flip(Side edge);

  MovingPoint moving(Vertex vertex) const { return {before_[vertex], mesh_.position(vertex)}; }
  KineticQuadratic area(const MeshTriangle& corners) const;
  bool is_upright(const MeshTriangle& corners) const;
  bool is_flat(const MeshTriangle& corners) const;
  bool have_met(Vertex u, Vertex v) const;
  int inner_corner(const MeshTriangle& corners) const;
  bool leaves_upright_faces(Side edge) const;

  Undo& undo_;
  const Mesh& mesh_;
  std::span<const Point> before_;
  std::priority_queue<Event, std::vector<Event>, Later> events_;
  CollapseTime now_ = CollapseTime::end();
  bool is_at_end_ = false;
  std::vector<Face> doubtful_;  // faces that may not be upright at this instant
  std::set<MeshEdge> gone_;     // ends of edges on lines that were flipped at this instant
  KineticCounts counts_;
};

}  // namespace kinemesh
