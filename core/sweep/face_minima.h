// The smallest area and angle of the domain's faces, kept stretch by stretch: what has been measured on the
// way, by a sweep for inverted faces say, need not be measured again but where faces have been rewritten
// since or vertices have moved.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/sweep/face_sweep_kernel.h"
#include "core/sweep/moved_blocks.h"
#include "kinemesh/mesh.h"

namespace kinemesh {

// Of some faces, as twice_area and tangent_of_smallest_angle have them (kinemesh/measure.h).
struct Minima {
  double twice_area = std::numeric_limits<double>::infinity();
  double tangent = std::numeric_limits<double>::infinity();
};

class FaceMinima {
 public:
  // Nothing is known of a mesh of so many faces.
  void reset(int n_faces);

  // Vertices have moved, anywhere if it is null. In all threads.
  void outdate_moved(const Mesh& mesh, const MovedBlocks* moved);

  // What a sweep has seen of a stretch (core/sweep/face_sweep.h), padding included. Several at the same time,
  // of different stretches.
  void set(int stretch, const Sight& seen, const Mesh& mesh);

  // A sweep has proved all faces of the stretch upright, padding included, and nothing has changed since.
  bool is_upright(int stretch) const { return known_[stretch] == Known::Upright; }

  // Of a stretch as of the last update.
  const Minima& of_stretch(int stretch) const { return minima_[stretch]; }

  // These faces have been rewritten, or their corners have moved.
  void outdate(std::span<const Face> faces);

  // Measures what is not known, in all threads; the result does not depend on their number, nor on what was
  // known. Takes no memory, and does with one thread where TBB has none left.
  Minima update(const Mesh& mesh);

 private:
  enum class Known : std::uint8_t { Nothing, Minima, Upright };  // the latter with minima

  // Where the corners of a stretch are: in 64 blocks from `first` on, most of them, and in a few others; in
  // more than `most_others` as if anywhere.
  struct Corners {
    static constexpr int most_others = 4;
    std::uint64_t near = 0;  // bit i: block first + i; 0 before anybody has looked
    int first = 0;
    int n_others = 0;
    std::array<int, most_others> others;
  };
  static Corners corners_of(int stretch, const Mesh& mesh);
  bool has_moved(int stretch, const Mesh& mesh, const MovedBlocks& moved);

  std::vector<Minima> minima_;    // per stretch
  std::vector<Known> known_;      // likewise
  std::vector<Corners> corners_;  // likewise, or empty as long as nobody wants them
  std::vector<int> unknown_;      // scratch
};

}  // namespace kinemesh
