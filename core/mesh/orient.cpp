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

// Which sides lie across each other: sides sorted by their lower vertex (counting), then by the upper one
// within each bucket, which holds about three.
class Twins {
 public:
  explicit Twins(const MeshData& data) : data_(data), twin_(3 * data.triangles.size(), none) {
    sort_by_lower_vertex();
    for (std::size_t v = 0; v + 1 < first_.size(); ++v) match(first_[v], first_[v + 1]);
    if (culprit_ != none) throw FaceError(culprit_, reason_);
  }
  int operator[](int side) const { return twin_[side]; }

 private:
  struct Side {
    int upper, apex, number;
    auto operator<=>(const Side&) const = default;
  };

  void sort_by_lower_vertex() {
    first_.assign(data_.points.size() + 1, 0);
    const int n = static_cast<int>(twin_.size());
    for (int side = 0; side < n; ++side) ++first_[lower(side) + 1];
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    std::vector<int> next(first_.begin(), first_.end() - 1);
    sides_.resize(twin_.size());
    for (int side = 0; side < n; ++side) {
      const int upper = std::max(start_of(data_, side), end_of(data_, side));
      sides_[next[lower(side)]++] = {upper, apex_of(data_, side), side};
    }
  }
  int lower(int side) const { return std::min(start_of(data_, side), end_of(data_, side)); }

  // The sides of one bucket.
  void match(int begin, int end) {
    std::sort(sides_.begin() + begin, sides_.begin() + end);
    while (begin < end) {
      int run = begin + 1;
      while (run < end && sides_[run].upper == sides_[begin].upper) ++run;
      match_edge(begin, run);
      begin = run;
    }
  }

  // All sides over one edge.
  void match_edge(int begin, int end) {
    if (end - begin == 2 && sides_[begin].apex != sides_[begin + 1].apex) {
      twin_[sides_[begin].number] = sides_[begin + 1].number;
      twin_[sides_[begin + 1].number] = sides_[begin].number;
    } else if (end - begin >= 2) {
      refuse_edge(begin, end);
    }
  }

  void refuse_edge(int begin, int end) {
    for (int i = begin + 1; i < end; ++i) {
      if (sides_[i].apex != sides_[i - 1].apex) continue;
      const int face = sides_[i].number / 3;
      blame(face, "has the same vertices as face " + std::to_string(sides_[i - 1].number / 3));
      return;
    }
    std::vector<int> faces;
    for (int i = begin; i < end; ++i) faces.push_back(sides_[i].number / 3);
    std::nth_element(faces.begin(), faces.begin() + 2, faces.end());
    const int side = sides_[begin].number;
    blame(faces[2], "is one of " + std::to_string(end - begin) + " at the edge between vertices " +
                        std::to_string(lower(side)) + " and " + std::to_string(sides_[begin].upper) +
                        ", expected at most two");
  }

  // The first face in the file's order is the one reported, whatever the order of the buckets.
  void blame(int face, std::string reason) {
    if (culprit_ != none && culprit_ <= face) return;
    culprit_ = face;
    reason_ = std::move(reason);
  }

  const MeshData& data_;
  std::vector<int> twin_;
  std::vector<int> first_;  // per vertex: begin of its bucket
  std::vector<Side> sides_;
  int culprit_ = none;
  std::string reason_;
};

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
  explicit Winder(MeshData& data) : data_(data), twins_(data), state_(data.triangles.size(), State::Unseen) {}

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
  Twins twins_;
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
