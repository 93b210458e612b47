// A benchmark as pictures: gnuplot scripts with their data inside, and SVG where there is a gnuplot.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "kinemesh/compare.h"
#include "sim/compare/bench_bound.h"

namespace kinemesh::cli {

// Files in the folder `plots`, without their endings.
inline constexpr std::array bench_plot_names{"steps", "sweep", "sizes", "explored", "bound"};

struct Curve {
  std::string name;
  int style;  // of colour and symbol
  std::vector<std::pair<double, double>> points;
};

// Gathers what is drawn, but for strategies that replace everything (sizes, exploring) and rounds without
// valid mesh; of more curves or points than can be told apart one of every so many:
//   steps     time of each step, without the move; with a sweep over numbers instead
//   sweep     median time of a step against the swept key
//   sizes     how many regions have how many faces
//   explored  faces explored against faces of R*
//   bound     time of single explorations against the bound of Theorem 4.4
class BenchPlots {
 public:
  // key: the swept one; empty: none.
  BenchPlots(std::string title, std::string key) : title_(std::move(title)), key_(std::move(key)) {}

  void add(const Round& round, const std::string& value);
  void add(const BoundSample& sample);

  // Writes scripts, `plots`/NAME.gp, and pictures beside them. Nothing to draw, no plot. Returns what the
  // user should know: where they are, or what is missing to make them. Throws InputError where a script
  // cannot be written.
  std::string write(const std::filesystem::path& directory) const;

 private:
  struct Times {
    std::vector<double> steps, milliseconds;
  };
  using Pairs = std::vector<std::pair<double, double>>;

  std::vector<Curve> curves_of_steps() const;
  std::vector<Curve> curves_of_sweep() const;
  std::vector<Curve> curves_of_sizes() const;
  std::vector<Curve> curves_of_exploring() const;
  int style_of(const std::string& strategy) const;
  bool sweeps_numbers() const;

  std::string title_, key_;
  std::vector<std::string> strategies_, values_;                        // in the order of appearance
  std::set<std::string> seen_;                                          // of the values
  std::map<std::pair<std::string, std::string>, Times> times_;          // by strategy and value
  std::map<std::string, std::map<int, int>> regions_;                   // faces, how many
  std::map<std::string, std::map<std::pair<int, int>, int>> explored_;  // faces and explored
  Pairs bound_;
};

}  // namespace kinemesh::cli
