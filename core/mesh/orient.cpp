#include "kinemesh/orient.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>

#include "core/base/parallel.h"
#include "core/mesh/sides.h"
#include "kinemesh/predicates.h"

namespace kinemesh {
namespace {

std::string number_of(std::size_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

// Side k of a face runs from corner k to corner k + 1 and has the number 3 face + k.
int start_of(const MeshData& data, int side) {
  return data.triangles[side / 3][side % 3];
}
int end_of(const MeshData& data, int side) {
  return data.triangles[side / 3][(side + 1) % 3];
}
int apex_of(const MeshData& data, int side) {
  return data.triangles[side / 3][(side + 2) % 3];
}

void check_corners(const MeshData& data) {
  for (int face = 0; face < data.n_faces(); ++face) {
    const Triangle& t = data.triangles[face];
    for (int v : t) {
      if (v < 0 || v >= data.n_vertices()) {
        throw FaceError(face, "vertex " + std::to_string(v) +
                                  " does not exist, expected a number from 0 and below " +
                                  std::to_string(data.n_vertices()));
      }
    }
    if (t[0] == t[1] || t[0] == t[2])
      throw FaceError(face, "vertex " + std::to_string(t[0]) + " is there twice");
    if (t[1] == t[2]) throw FaceError(face, "vertex " + std::to_string(t[1]) + " is there twice");
  }
}

// Why sides cannot be paired: the first face in the file's order that has an edge with more than two, or the
// same vertices as another.
class Refusal {
 public:
  explicit Refusal(const MeshData& data) {
    for (int side = 0; side < 3 * data.n_faces(); ++side) {
      const auto [low, high] = std::minmax({start_of(data, side), end_of(data, side)});
      sides_.push_back({low, high, apex_of(data, side), side});
    }
    std::sort(sides_.begin(), sides_.end());
    for (std::size_t begin = 0, end = 0; begin < sides_.size(); begin = end) {
      while (end < sides_.size() && sides_[end].is_beside(sides_[begin])) ++end;
      look_at({&sides_[begin], end - begin});
    }
  }

  [[noreturn]] void raise() const { throw FaceError(face_, reason_); }

 private:
  struct Side {
    int low, high, apex, number;
    auto operator<=>(const Side&) const = default;
    bool is_beside(const Side& other) const { return low == other.low && high == other.high; }
    int face() const { return number / 3; }
  };

  // All sides of one edge.
  void look_at(std::span<const Side> sides) {
    for (std::size_t i = 1; i < sides.size(); ++i) {
      if (sides[i].apex != sides[i - 1].apex) continue;
      return blame(sides[i].face(), "has the same vertices as face " + std::to_string(sides[i - 1].face()));
    }
    if (sides.size() < 3) return;
    std::vector<int> faces;
    for (const Side& side : sides) faces.push_back(side.face());
    std::nth_element(faces.begin(), faces.begin() + 2, faces.end());
    blame(faces[2], "is one of " + std::to_string(sides.size()) + " at the edge between vertices " +
                        std::to_string(sides[0].low) + " and " + std::to_string(sides[0].high) +
                        ", expected at most two");
  }

  void blame(int face, std::string reason) {
    if (face_ != none && face_ <= face) return;
    face_ = face;
    reason_ = std::move(reason);
  }

  std::vector<Side> sides_;
  int face_ = none;
  std::string reason_;
};

// Which side lies across each, whichever way it runs.
std::vector<int> paired_sides(const MeshData& data) {
  auto pairs = pair_sides(data.triangles, data.n_vertices(), Winding::Any);
  const auto is_same_face = [&](int side) {
    const int twin = pairs.opposite[side];
    return twin != none && apex_of(data, side) == apex_of(data, twin);
  };
  const int n_sides = static_cast<int>(pairs.opposite.size());
  if (pairs.conflict != none || find_first(n_sides, grain::items, is_same_face) != none)
    Refusal(data).raise();
  return std::move(pairs.opposite);
}

// Twice the signed area of many faces, compensated [Neumaier 1974] so that their order hardly matters. long
// double: products of very large coordinates stay finite.
class SignedArea {
 public:
  void add(const Point& a, const Point& b, const Point& c) {
    const long double ax = a.x, ay = a.y;
    const long double p = (b.x - ax) * (c.y - ay), q = (b.y - ay) * (c.x - ax);
    add(p - q);
    magnitude_ += std::fabs(p) + std::fabs(q);
  }
  // Each term is off by less than 4 units in the last place of its products, and the sum by less than 2 more:
  // what rounding alone could have made negative is not.
  bool is_negative() const {
    return sum_ + lost_ < -8 * std::numeric_limits<long double>::epsilon() * magnitude_;
  }

 private:
  void add(long double x) {
    const long double next = sum_ + x;
    lost_ += std::fabs(sum_) >= std::fabs(x) ? (sum_ - next) + x : (x - next) + sum_;
    sum_ = next;
  }
  long double sum_ = 0, lost_ = 0, magnitude_ = 0;
};

class Winder {
 public:
  explicit Winder(MeshData& data)
      : data_(data), twins_(paired_sides(data)), state_(data.triangles.size(), State::Unseen) {}

  std::vector<std::string> run() {
    for (int face = 0; face < data_.n_faces(); ++face) {
      if (state_[face] == State::Unseen) wind_part(face);
    }
    for (int face = 0; face < data_.n_faces(); ++face) {
      if (state_[face] == State::Turned) std::swap(data_.triangles[face][1], data_.triangles[face][2]);
    }
    return notes();
  }

 private:
  enum class State : std::uint8_t { Unseen, Kept, Turned };
  static State other(State s) { return s == State::Kept ? State::Turned : State::Kept; }

  void wind_part(int first) {
    part_.assign(1, first);
    state_[first] = State::Kept;
    for (std::size_t i = 0; i < part_.size(); ++i) walk_from(part_[i]);
    const bool mixed =
        std::any_of(part_.begin(), part_.end(), [&](int f) { return state_[f] == State::Turned; });
    if (is_part_clockwise()) turn_part_over(mixed);
    if (mixed) count_turned_faces();
  }

  void walk_from(int face) {
    for (int side = 3 * face; side < 3 * face + 3; ++side) {
      const int twin = twins_[side];
      if (twin == none) continue;
      const bool agree = start_of(data_, side) == end_of(data_, twin);
      const State wanted = agree ? state_[face] : other(state_[face]);
      State& state = state_[twin / 3];
      if (state == State::Unseen) {
        state = wanted;
        part_.push_back(twin / 3);
      } else if (state != wanted) {
        throw FaceError(std::max(face, twin / 3), "cannot be wound like face " +
                                                      std::to_string(std::min(face, twin / 3)) +
                                                      " beside it: the surface has only one side");
      }
    }
  }

  bool is_part_clockwise() const {
    SignedArea area;
    for (int face : part_) {
      const auto& [a, b, c] = data_.triangles[face];
      const bool turned = state_[face] == State::Turned;
      area.add(data_.points[a], data_.points[turned ? c : b], data_.points[turned ? b : c]);
    }
    return area.is_negative();
  }

  void turn_part_over(bool mixed) {
    for (int face : part_) state_[face] = other(state_[face]);
    if (!mixed) ++turned_parts_;
  }

  void count_turned_faces() {
    turned_faces_ +=
        std::count_if(part_.begin(), part_.end(), [&](int f) { return state_[f] == State::Turned; });
  }

  std::vector<std::string> notes() const {
    std::vector<std::string> notes;
    if (turned_faces_ > 0) {
      notes.push_back(number_of(turned_faces_, "face") + " turned over, wound against their neighbours");
    }
    if (turned_parts_ > 0) {
      notes.push_back(number_of(turned_parts_, "connected part") + " turned over, clockwise as a whole");
    }
    return notes;
  }

  MeshData& data_;
  std::vector<int> twins_;    // per side
  std::vector<State> state_;  // per face
  std::vector<int> part_;     // faces of the connected part at hand, in the order of the walk
  std::size_t turned_faces_ = 0, turned_parts_ = 0;
};

// The filter of orientation() without what comes behind it, for points that may be anything.
bool is_surely_upright(const Point& a, const Point& b, const Point& c) {
  const double l = (a.x - c.x) * (b.y - c.y), r = (a.y - c.y) * (b.x - c.x);
  return l - r > orientation_bound(std::abs(l), std::abs(r));
}

bool has_upright_faces(const MeshData& data) {
  const auto exists = [&](int v) { return v >= 0 && v < data.n_vertices(); };
  return find_first(data.n_faces(), grain::items, [&](int face) {
           const auto& [a, b, c] = data.triangles[face];
           const bool exist = exists(a) && exists(b) && exists(c);
           return !exist || !is_surely_upright(data.points[a], data.points[b], data.points[c]);
         }) == none;
}

// What nearly all files hold: faces that are upright one by one, so that no two have the same vertices and no
// part is clockwise as a whole, and across each side one that is wound like it. False where in doubt.
bool is_consistent(const MeshData& data) {
  return has_upright_faces(data) && pair_sides(data.triangles, data.n_vertices()).conflict == none;
}

}  // namespace

std::vector<std::string> make_consistent(MeshData& data) {
  check_size(data.points.size(), "vertices");
  check_size(data.triangles.size(), "faces");
  if (is_consistent(data)) return {};
  check_corners(data);
  return Winder(data).run();
}

}  // namespace kinemesh
