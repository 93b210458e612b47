// Numbers on the command line, for CLI::Option::transform. CLI11 itself takes nan for a number of any range,
// nothing for 0, and 010 for 8.
#pragma once

#include <CLI/CLI.hpp>

namespace kinemesh::cli {

// Refuse what is not such a number, in decimal.
CLI::Validator number_within(double least, double most);
CLI::Validator finite_number();
CLI::Validator integer_within(int least, int most);
CLI::Validator integer();  // that fits into an int

}  // namespace kinemesh::cli
