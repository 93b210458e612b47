// The few types everything else is written in.
#pragma once

#include <array>
#include <cmath>
#include <compare>
#include <cstddef>
#include <functional>
#include <glm/vec2.hpp>
#include <iterator>
#include <limits>

#pragma GCC visibility push(default)
namespace kinemesh {

using Point = glm::dvec2;             // user's length unit
using Triangle = std::array<int, 3>;  // numbers in plain arrays of points, counter-clockwise when upright
using Edge = std::array<int, 2>;      // likewise

// Label of the faces that embed the domain in a convex set [Agarwal 2008, §1, boundary assumption]; never
// exported. Every other int32 is a user's label.
inline constexpr int padding_label = std::numeric_limits<int>::min();

// "No such vertex, face, edge or marker": an Id, or an int, that is -1.
struct None {
  constexpr operator int() const { return -1; }
};
inline constexpr None none;

// A number that knows what it counts: a vertex is passed for no face, and no int for either but on purpose.
// Reads as an int, and costs what one costs.
template <class Of>
class Id {
 public:
  constexpr Id() = default;  // none
  constexpr Id(None) {}
  constexpr explicit Id(int number) : number_(number) {}
  template <class Other>
  explicit Id(Id<Other>) = delete;

  constexpr operator int() const { return number_; }
  constexpr Id& operator++() {
    ++number_;
    return *this;
  }

  friend constexpr bool operator==(Id a, Id b) = default;
  friend constexpr auto operator<=>(Id a, Id b) = default;
  template <class Other>
  friend constexpr bool operator==(Id a, Id<Other> b) = delete;

 private:
  int number_ = -1;
};

// Of a Mesh, which numbers vertices, faces and sides as suits it.
using Vertex = Id<struct OfVertices>;
using Face = Id<struct OfFaces>;
using Side = Id<struct OfSides>;  // a face's share of an edge, see kinemesh/mesh.h
using MeshTriangle = std::array<Vertex, 3>;
using MeshEdge = std::array<Vertex, 2>;
using Sides = std::array<Side, 3>;  // of a face

// In the order of what the user gave.
using UserVertex = Id<struct OfUserVertices>;
using UserFace = Id<struct OfUserFaces>;
using UserTriangle = std::array<UserVertex, 3>;
using UserEdge = std::array<UserVertex, 2>;

// For plain arrays.
template <class Of>
constexpr Triangle numbers_of(const std::array<Id<Of>, 3>& t) {
  return {t[0], t[1], t[2]};
}

// All from 0 to n - 1, one after the other.
template <class Number>
class Numbers {
 public:
  class iterator {
   public:
    using iterator_category = std::input_iterator_tag;
    using value_type = Number;
    using difference_type = std::ptrdiff_t;
    using pointer = void;
    using reference = Number;

    constexpr iterator() = default;
    constexpr explicit iterator(Number at) : at_(at) {}
    constexpr Number operator*() const { return at_; }
    constexpr iterator& operator++() {
      ++at_;
      return *this;
    }
    constexpr iterator operator++(int) {
      const iterator before = *this;
      ++at_;
      return before;
    }
    friend constexpr bool operator==(iterator a, iterator b) = default;

   private:
    Number at_{0};
  };

  constexpr explicit Numbers(int n) : n_(n) {}
  constexpr int size() const { return n_; }
  constexpr iterator begin() const { return iterator(Number(0)); }
  constexpr iterator end() const { return iterator(Number(n_)); }

 private:
  int n_;
};

inline double dot(const Point& a, const Point& b) {
  return a.x * b.x + a.y * b.y;
}

inline double cross(const Point& a, const Point& b) {  // twice the signed area of 0, a, b
  return a.x * b.y - a.y * b.x;
}

inline bool is_finite(const Point& p) {
  return std::isfinite(p.x) && std::isfinite(p.y);
}

}  // namespace kinemesh
#pragma GCC visibility pop

template <class Of>
struct std::hash<kinemesh::Id<Of>> {
  std::size_t operator()(kinemesh::Id<Of> id) const noexcept { return std::hash<int>()(id); }
};
