// The ways to make a moved mesh valid again, behind one interface and chosen by name.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kinemesh/defect.h"
#include "kinemesh/detail/short_list.h"
#include "kinemesh/mesh.h"

// Details.
namespace kinemesh {
class FaceMinima;   // core/sweep/face_minima.h
class MovedBlocks;  // core/sweep/moved_blocks.h
}  // namespace kinemesh

#pragma GCC visibility push(default)
namespace kinemesh {

// One replaced region. Counts include padding unless said otherwise.
struct RegionRecord {
  UserFace seed;                   // `local`: the face it started from, others: the smallest inverted or flat
                                   // one; none if it is padding, or all of them are
  ShortList<Face> faces;           // R*, ascending, as they were when it was found; these numbers now stand
                                   // for the new faces
  ShortList<UserFace> user_faces;  // the domain's faces among them, ascending
  std::vector<Face> kept;          // those of `faces` that were not replaced, ascending; none unless retained
  int inverted = 0;                // inverted faces in it
  int degenerate = 0;              // flat faces in it
  int components = 0;              // inverted components
  int explored = 0;                // faces read as candidates; equals faces.size()
  int border_edges = 0;
  int crease_edges = 0;        // edges between an inverted and an upright face
  int gamma_first_stable = 1;  // signed cover when extending first came to rest [Agarwal 2008, §4]
  int gamma = 1;               // and at the end
  int rounds = 0;              // of growing shadows [Agarwal 2008, §4]
  int grown = 0;               // convex pieces that these added to the shadow
  int retries = 0;             // enlargements the safety net needed; 0 outside freak cases
  bool self_overlap = false;   // the region's border overlaps itself in the plane
  bool fallback = false;       // of `local` and `kinetic`: replaced as a piece of the global walk
  Point centre{0.0, 0.0};      // of the bounding box of its vertices

  int padding_faces() const { return static_cast<int>(faces.size() - user_faces.size()); }
};

struct RepairRecord {
  int inverted = 0;    // faces, padding included
  int degenerate = 0;  // flat faces
  int components = 0;  // inverted components
  std::vector<RegionRecord> regions;
  int replaced = 0;       // faces rewritten
  int escaped = 0;        // vertices now on the wrong side of their border or interface
  int doubled_edges = 0;  // pairs of edges with the same ends that were made while other tangles remained
  int quality_flips = 0, quality_moves = 0;
  double detect_ms = 0.0, explore_ms = 0.0, triangulate_ms = 0.0, splice_ms = 0.0, quality_ms = 0.0;

  int region_faces() const;      // sum over the regions
  int region_faces_max() const;  // 0 without regions
  int explored() const;
  int crease_edges() const;
  int retries() const;
};

// Either every face is upright (no defect), or the mesh is bit for bit as it was and the defect says why.
struct RepairOutcome {
  RepairRecord record;
  std::optional<Defect> defect;

  explicit operator bool() const { return !defect; }
};

struct RepairOptions {
  bool allow_escaped = false;  // count vertices on the wrong side of border or interface instead of failing
  bool retain = false;         // keep upright faces of a region that need not be replaced
};

// The move that has brought a mesh to where it is to be repaired.
class Move {
 public:
  // before: where the vertices came from, by the mesh's numbers; the mesh was valid there. Empty if nobody
  // knows. It stays where it is as long as the move is of use.
  Move(const RepairOptions& options = {}, std::span<const Point> before = {})
      : options_(options), before_(before) {}

  const RepairOptions& options() const { return options_; }
  std::span<const Point> before() const { return before_; }

  // What a stepper knows besides and strategies hand on to detection, which sees all faces before anything is
  // rewritten: minima takes their areas and angles, or nobody wants them; what it knows already is true of
  // the mesh before the move, and where nothing has moved it spares a look. Without `moved` all may have.
  void know(FaceMinima* minima, const MovedBlocks* moved) {
    minima_ = minima;
    moved_ = moved;
  }
  FaceMinima* minima() const { return minima_; }
  const MovedBlocks* moved() const { return moved_; }

 private:
  RepairOptions options_;
  std::span<const Point> before_;
  FaceMinima* minima_ = nullptr;
  const MovedBlocks* moved_ = nullptr;
};

class Strategy {
 public:
  virtual ~Strategy() = default;

  virtual std::string_view name() const = 0;

  // True if repair() may write positions, of vertices that are not fixed and on no constrained edge. All
  // others change connectivity only.
  virtual bool moves_vertices() const { return false; }

  // Makes every face upright or changes nothing; does not throw but for lack of memory and for what a
  // strategy says of itself. Each face that was rewritten is in `faces` of one of the record's regions and
  // not in its `kept`: observers are told by these. Deterministic, whatever the number of threads. May keep
  // scratch memory between calls; one object per thread. Pre: finite positions; the border of the padded mesh
  // is convex, as hull_defect and follow (core/mesh/frame.h) keep it.
  [[nodiscard]] virtual RepairOutcome repair(Mesh& mesh, const Move& move) = 0;
};

struct StrategyInfo {
  std::string name;
  std::string description;  // one line for `kinemesh list`, its guarantee included
  std::function<std::unique_ptr<Strategy>()> make;
};

// Built-in ones, then those that were registered. A name registered twice is an InputError, and so is an
// unknown one. From any threads.
std::vector<StrategyInfo> strategies();
void register_strategy(StrategyInfo info);
std::unique_ptr<Strategy> make_strategy(std::string_view name);

}  // namespace kinemesh
#pragma GCC visibility pop
