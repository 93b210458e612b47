// What the aims of docs/performance.md are measured with. Each subject is a run of its own; ratios are of
// medians, taken in turn in one process. Everything timed works on meshes that are validated outside what is
// timed.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "kinemesh/mesh.h"
#include "kinemesh/strategy.h"

namespace kinemesh::aims {

// A line of the table.
struct Aim {
  enum class Kind { AtMost, AtLeast, Exactly };
  std::string what;
  Kind kind;
  double aim;
  double measured;
  std::string detail;  // what the number is made of
};

// Prints it as a line of CSV: what,kind,aim,measured,met,detail.
void report(const Aim& aim);

double median(std::vector<double> values);

// Throws std::runtime_error with the defect where the mesh, or the outcome, is not valid.
void require_valid(const Mesh& mesh);
void require_valid(const RepairOutcome& outcome);

// A valid mesh of the unit square and where its vertices go in one step.
struct Move {
  Mesh mesh;
  std::vector<Point> positions;
};
Move jitter_of(int vertices, double amplitude);  // in spacings
Move rotor_of(int vertices);                     // one degree

// The mesh with its vertices there: tangled.
Mesh moved(const Move& move);

// The subjects. n: vertices.
void whole_steps(int n);
void detection(int n);
void regions_against_cgal(int n);
void fixed_tangle(int n);  // up to n
void explored(int n);
void local_growth(int n);  // up to n
void two_threads(int n);
void interior(int n);
void angles(int n);
void memory(int n);
void huge(int n);
void first_step_of_file(int n);

}  // namespace kinemesh::aims
