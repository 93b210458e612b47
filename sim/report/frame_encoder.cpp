#include "sim/report/frame_encoder.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <new>
#include <utility>

namespace kinemesh::report {
namespace {

constexpr int key_frame_every = 32;  // so that going back does not mean starting again
constexpr int steps_per_edge = 64;   // of the grid, in a short edge

enum Mode : char { key = 0, held = 1, extrapolated = 2 };

// Longer than one edge in a hundred.
double short_edge(const StartMesh& mesh) {
  std::vector<double> lengths;
  for (const Triangle& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      const Point d = mesh.points[t[k]] - mesh.points[t[(k + 1) % 3]];
      lengths.push_back(std::hypot(d.x, d.y));
    }
  if (lengths.empty()) return 0.0;
  const auto place = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 100);
  std::nth_element(lengths.begin(), place, lengths.end());
  return *place;
}

std::int32_t round_to(double value) {
  return static_cast<std::int32_t>(std::lround(std::clamp(value, -1e9, 1e9)));
}

}  // namespace

Grid Grid::of(const StartMesh& mesh) {
  Point low(0.0), high(1.0);
  if (!mesh.points.empty()) low = high = mesh.points.front();
  for (const Point& p : mesh.points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  const double extent = std::max(high.x - low.x, high.y - low.y);
  const double across = extent * steps_per_edge / std::max(short_edge(mesh), extent * 1e-9);
  const int bits = std::clamp(static_cast<int>(std::ceil(std::log2(across))), 12, 26);
  return {low, extent / (1 << bits), 1 << bits};
}

FrameEncoder::FrameEncoder(const StartMesh& start, const Grid& grid) : grid_(grid), faces_(start.triangles) {
  if (deflateInit(&stream_, 6) != Z_OK) throw std::bad_alloc();
  int corner = 0, label = 0;
  for (const Triangle& t : start.triangles)
    for (const int v : t) put_signed(v - std::exchange(corner, v));
  for (const int l : start.labels) put_signed(std::int64_t{l} - std::exchange(label, l));
}

void FrameEncoder::add(const Frame& frame, std::span<const RegionRow> regions) {
  Grids now;
  for (const Point& p : frame.positions) {
    now.push_back(round_to((p.x - grid_.origin.x) / grid_.step));
    now.push_back(round_to((p.y - grid_.origin.y) / grid_.step));
  }
  put_positions(std::move(now));
  put_changes(frame.silent);
  put(frame.patches.size());
  for (const PatchEdit& patch : frame.patches) {
    put(patch.regions.size());
    for (const int region : patch.regions) put(static_cast<std::uint64_t>(region));
    put_changes(patch.faces);
  }
  put(regions.size());
  for (const RegionRow& r : regions)
    for (const int n : {r.seed + 1, r.faces, r.inverted, r.components, r.explored})
      put(static_cast<std::uint64_t>(std::max(0, n)));
  ++n_frames_;
  compress(Z_NO_FLUSH);
}

// Key frames now and then; else whichever guess leaves less.
void FrameEncoder::put_positions(Grids now) {
  const bool is_key = n_frames_ % key_frame_every == 0;
  std::int64_t held_rest = 0, extrapolated_rest = 0;
  for (std::size_t i = 0; i < now.size() && !is_key; ++i) {
    held_rest += std::abs(std::int64_t{now[i]} - last_[i]);
    extrapolated_rest += std::abs(std::int64_t{now[i]} - 2 * std::int64_t{last_[i]} + earlier_[i]);
  }
  const Mode mode = is_key ? key : extrapolated_rest < held_rest ? extrapolated : held;
  raw_.push_back(mode);
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (mode == key)
      put_signed(std::int64_t{now[i]} - (i < 2 ? 0 : now[i - 2]));
    else
      put_signed(std::int64_t{now[i]} - last_[i] -
                 (mode == extrapolated ? std::int64_t{last_[i]} - earlier_[i] : 0));
  }
  earlier_ = mode == key ? now : last_;
  last_ = std::move(now);
}

void FrameEncoder::put_changes(std::span<const FaceEdit> edits) {
  put(edits.size());
  int last = 0;
  for (const FaceEdit& edit : edits) {
    if (edit.face >= n_slots()) faces_.resize(edit.face + 1, {0, 0, 0});
    put_signed(edit.face - std::exchange(last, edit.face));
    for (int k = 0; k < 3; ++k) put_signed(edit.corners[k] - faces_[edit.face][k]);
    faces_[edit.face] = edit.corners;
  }
}

void FrameEncoder::put(std::uint64_t value) {
  for (; value > 127; value >>= 7) raw_.push_back(static_cast<char>(value | 128));
  raw_.push_back(static_cast<char>(value));
}

void FrameEncoder::put_signed(std::int64_t value) {
  put(value < 0 ? 2 * static_cast<std::uint64_t>(-(value + 1)) + 1 : 2 * static_cast<std::uint64_t>(value));
}

void FrameEncoder::compress(int flush) {
  char buffer[1 << 16];
  stream_.next_in = reinterpret_cast<Bytef*>(raw_.data());
  stream_.avail_in = static_cast<uInt>(raw_.size());
  do {
    stream_.next_out = reinterpret_cast<Bytef*>(buffer);
    stream_.avail_out = sizeof buffer;
    deflate(&stream_, flush);
    packed_.append(buffer, sizeof buffer - stream_.avail_out);
  } while (stream_.avail_out == 0);
  raw_.clear();
}

std::string FrameEncoder::finish() {
  compress(Z_FINISH);
  return std::move(packed_);
}

}  // namespace kinemesh::report
