// The ways to make a moved mesh valid again, behind one interface and chosen by name.
#pragma once

#include <boost/container/small_vector.hpp>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/sweep/face_minima.h"
#include "kinemesh/defect.h"
#include "kinemesh/mesh.h"

namespace kinemesh {

// Numbers of a region's faces. Those of most regions, which are small, take no memory of their own.
using RegionFaces = boost::container::small_vector<int, 12>;

// One replaced region. Counts include padding unless said otherwise.
struct RegionRecord {
  int seed = none;         // user's number: `local` the face it started from, others the smallest inverted or
                           // flat one; none if it is padding, or all of them are
  RegionFaces faces;       // R*: the mesh's faces (not the user's numbers), ascending, as they were when it
                           // was found; their handles now hold the new faces
  RegionFaces user_faces;  // the domain's faces among them, user's numbers, ascending
  std::vector<int> kept;   // those of `faces` that were not replaced, ascending; none unless retained
  int inverted = 0;        // inverted faces in it
  int degenerate = 0;      // flat faces in it
  int components = 0;      // inverted components
  int explored = 0;        // faces read as candidates; equals faces.size()
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
  // Where the vertices came from, by the mesh's numbers: the mesh was valid there. Empty if nobody knows.
  std::span<const Point> before{};
  // Where the faces' areas and angles go that detection sees before anything is rewritten; nobody wants them
  // if null. What they know already must be true of the mesh before the move; where nothing has moved it
  // spares detection a look.
  FaceMinima* minima = nullptr;
  const MovedBlocks* moved = nullptr;  // anything may have moved if null
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
  [[nodiscard]] virtual RepairOutcome repair(Mesh& mesh, const RepairOptions& options) = 0;
};

struct StrategyInfo {
  std::string name;
  std::string description;  // one line for `kinemesh list`, its guarantee included
  std::function<std::unique_ptr<Strategy>()> make;
};

// Built-in and registered ones. A name registered twice is an InputError, and so is an unknown one.
std::span<const StrategyInfo> strategies();
void register_strategy(StrategyInfo info);
std::unique_ptr<Strategy> make_strategy(std::string_view name);

}  // namespace kinemesh
