// What is fed with mutants: every kind of file that kinemesh reads.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "tests/fuzz/mutants.h"

namespace kinemesh {

struct Subject {
  std::string name;
  std::function<std::string(Dice&)> mutant;
  // Reads it. Returns what is wrong, or nothing; InputError is the right answer to a broken file.
  std::function<std::string(const std::string&)> read;
};

// folder: a directory that exists, for files that are read from disk.
std::vector<Subject> subjects(const std::filesystem::path& folder);

}  // namespace kinemesh
