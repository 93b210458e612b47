#include "kinemesh/detail/short_list.h"

#include <gtest/gtest.h>

#include <random>
#include <utility>
#include <vector>

#include "kinemesh/types.h"

namespace kinemesh {
namespace {

using List = ShortList<Face, 3>;

void expect_same(const List& list, const std::vector<Face>& expected) {
  ASSERT_EQ(list.size(), expected.size());
  EXPECT_EQ(list.empty(), expected.empty());
  EXPECT_TRUE(std::equal(list.begin(), list.end(), expected.begin(), expected.end()));
  EXPECT_TRUE(list == List(expected.begin(), expected.end()));
}

// One of all that a list can do, done to a vector as well.
void change(List& list, std::vector<Face>& vector, std::mt19937& random) {
  const auto below = [&](std::size_t n) { return static_cast<std::ptrdiff_t>(random() % n); };
  switch (random() % 7) {
    case 0:
    case 1:
      list.push_back(Face(static_cast<int>(random() % 100)));
      vector.push_back(list.back());
      break;
    case 2:
      if (vector.empty()) break;
      list.push_back(list.front());  // one of its own, while it grows
      vector.push_back(Face(vector.front()));
      break;
    case 3: {
      const auto first = below(vector.size() + 1), last = first + below(vector.size() - first + 1);
      list.erase(list.begin() + first, list.begin() + last);
      vector.erase(vector.begin() + first, vector.begin() + last);
      break;
    }
    case 4: {
      List copy(list);
      copy.push_back(Face(7));  // of no consequence
      list = List(list);
      break;
    }
    case 5: {
      List other(vector.begin(), vector.begin() + below(vector.size() + 1));
      vector.assign(other.begin(), other.end());
      list = std::move(other);
      break;
    }
    default:
      list.reserve(static_cast<std::size_t>(below(20)));
  }
}

TEST(ShortList, DoesWhatAVectorDoes) {
  std::mt19937 random(1);
  for (int n = 0; n < 300; ++n) {
    List list;
    std::vector<Face> vector;
    for (int i = 0; i < 60; ++i) {
      change(list, vector, random);
      expect_same(list, vector);
    }
    list.clear();
    expect_same(list, {});
  }
}

TEST(Ids, ReadAsIntsAndAreOfOneKind) {
  static_assert(!std::is_convertible_v<Vertex, Face> && !std::is_convertible_v<int, Face>);
  static_assert(!std::is_constructible_v<UserFace, Face>);
  const Face none_yet, seven(7);
  EXPECT_TRUE(none_yet == none && seven != none);
  EXPECT_EQ(none_yet, -1);
  EXPECT_EQ(seven + 1, 8);
  EXPECT_EQ(std::hash<Face>()(seven), std::hash<int>()(7));
  int sum = 0;
  for (const Vertex v : Numbers<Vertex>(5)) sum += v;
  EXPECT_EQ(sum, 10);
}

}  // namespace
}  // namespace kinemesh
