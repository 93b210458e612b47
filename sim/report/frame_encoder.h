// Frames as compressed bytes for the page's player (web/frames.js). Internal to sim/report/.
//
// Deflated (zlib), numbers as varints: seven bits a byte, low ones first, 128 added where more follow; signed
// ones as 2n or -2n - 1. Positions are rounded to a grid.
//   start   3 corners a face, each as the difference from the number before; labels likewise
//   frame   a byte: 0 key frame, positions as differences from the vertex before; 1 from the frame before;
//           2 from where that frame and the one before it point. x and y of each vertex. Then
//           silent changes; the number of patches, each with a list of its regions and changes;
//           the number of regions, each with seed + 1, faces, inverted, components, explored
//   changes their number; each: face, as a difference, and 3 corners as differences from those before
#pragma once

#include <zlib.h>

#include <cstdint>
#include <span>
#include <string>

#include "sim/report/frame_source.h"

namespace kinemesh::report {

struct RegionRow {
  int step, seed, faces, inverted, components, explored;
};

// What rounds positions: a fraction of the short edges, so that triangles keep their shape however far one
// zooms in.
struct Grid {
  Point origin;
  double step;  // user's length unit
  int size;     // steps across the domain

  static Grid of(const StartMesh& mesh);
};

class FrameEncoder {
 public:
  FrameEncoder(const StartMesh& start, const Grid& grid);
  ~FrameEncoder() { deflateEnd(&stream_); }
  FrameEncoder(const FrameEncoder&) = delete;
  FrameEncoder& operator=(const FrameEncoder&) = delete;

  void add(const Frame& frame, std::span<const RegionRow> regions);
  std::uint64_t size() const { return stream_.total_out; }  // compressed bytes, about: zlib keeps some back
  int n_slots() const { return static_cast<int>(faces_.size()); }  // numbers of faces there have been
  std::string finish();

 private:
  using Grids = std::vector<std::int32_t>;  // x, y of each vertex

  void put(std::uint64_t value);
  void put_signed(std::int64_t value);
  void put_positions(Grids now);
  void put_changes(std::span<const FaceEdit> edits);
  void compress(int flush);

  Grid grid_;
  std::vector<Triangle> faces_;
  Grids last_, earlier_;
  int n_frames_ = 0;
  std::string raw_, packed_;
  z_stream stream_{};
};

}  // namespace kinemesh::report
