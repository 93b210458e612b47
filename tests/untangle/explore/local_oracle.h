// The minimum locally removable region by brute force: the paper's definitions, literally, on lifts.
#pragma once

#include <optional>
#include <vector>

#include "tests/untangle/explore/sheets.h"

namespace kinemesh::test {

using Cells = std::vector<bool>;  // a set of cells: part of the plane
using Lifts = std::vector<bool>;  // a set of lifts: part of the mesh

struct LocalRegion {
  Lifts lifts;                  // R
  std::vector<Face> faces;      // R*, ascending
  std::vector<int> components;  // J, ascending
  int inverted = 0;             // faces of J
  int gamma_first_stable = 0;
  int growths = 0;
};

class LocalOracle {
 public:
  explicit LocalOracle(const Sheets& sheets);

  // The algorithm of [Agarwal 2008, §4] from an inverted component, but that X keeps what has grown. Throws
  // std::logic_error where a lemma of the paper fails.
  LocalRegion region(int component) const;

  // The intersection of all locally removable regions that contain the component, by conditions (i)-(iii) of
  // [Agarwal 2008, §3] over all sets of inverted components (Lemma 3.2: these are enough). Cost: exponential
  // in their number.
  Lifts minimum(int component) const;

  // Condition (i) to (iii).
  bool is_locally_removable(const Lifts& r) const;

  // The paper's sketch, walking whole faces, without growing; may overstep the minimum.
  std::vector<Face> sketch(int component) const;

  // N(from, x): what can be reached from these lifts without leaving x.
  Lifts neighbourhood(const Lifts& from, const Cells& x) const;
  Cells shadow(const std::vector<int>& components) const;
  Lifts lifts_of(const std::vector<int>& components) const;
  std::vector<int> components_in(const Lifts& r) const;
  std::vector<Face> faces_of(const Lifts& r) const;

  // Signed number of lifts over each cell; 0 outside.
  std::vector<int> gamma(const Lifts& r) const;
  // The value of gamma_R over f(R), or nothing if it is not constant.
  std::optional<int> constant_gamma(const Lifts& r) const;

  // G(J): x and what pairs of upright sheets, both in r over the border of x, reach together. Pre: f(r) = x.
  Cells grown(const Lifts& r, const Cells& x) const;

  // Where one leaves r: a lift of r and the step out of it.
  struct Exit {
    int lift;
    Sheets::Step step;
  };
  std::vector<Exit> border(const Lifts& r) const;

  // The border of r is mapped one to one onto that of f(r), and is bounded by simple curves away from
  // crease vertices [Agarwal 2008, Lemma 3.1].
  bool is_border_bijective(const Lifts& r) const;

  // The border of R* overlaps itself in the plane.
  bool overlaps_itself(const std::vector<Face>& faces) const;
  // It does so over the component's shadow: there the faces of R* have lifts outside R.
  bool overlaps_itself(const std::vector<Face>& faces, int component) const;

 private:
  std::vector<int> windings(const std::vector<Face>& faces) const;
  std::vector<std::pair<int, int>> first_pairs(const Lifts& r, const Cells& x) const;

  const Sheets& sheets_;
  std::vector<Cells> shadow_of_;        // per component
  std::vector<bool> is_crease_vertex_;  // per vertex of the subdivision: the set Q
};

}  // namespace kinemesh::test
