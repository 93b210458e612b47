// Runs the real binary and keeps what it said; a folder of its own for each test.
#pragma once

#include <gtest/gtest.h>
#include <sys/types.h>

#include <filesystem>
#include <initializer_list>
#include <map>
#include <string>
#include <vector>

namespace kinemesh::testing {

struct Result {
  int code = -1;  // exit code; 128 + signal if one ended the process
  std::string out;
  std::string err;

  std::vector<std::string> err_lines() const;
};

std::vector<std::string> lines_of(const std::string& text);
std::string read_text(const std::filesystem::path& path);

// The environment of a program that is started while this lives.
class Environment {
 public:
  explicit Environment(std::map<std::string, std::string> variables) : variables_(std::move(variables)) {
    for (const auto& [name, value] : variables_) setenv(name.c_str(), value.c_str(), 1);
  }
  ~Environment() {
    for (const auto& [name, value] : variables_) unsetenv(name.c_str());
  }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

 private:
  std::map<std::string, std::string> variables_;
};

// A test with an empty folder, removed afterwards.
class ProgramTest : public ::testing::Test {
 protected:
  ProgramTest();
  ~ProgramTest() override;

  std::filesystem::path path(const std::string& name) const { return folder_ / name; }
  std::string write(const std::string& name, const std::string& text) const;  // returns the path
  std::vector<std::string> files() const;                                     // names in the folder, sorted

  // Runs `kinemesh ARGUMENTS` in the folder and waits for its end.
  Result run(const std::vector<std::string>& arguments) const;

  pid_t start(const std::vector<std::string>& arguments, int err_file = -1) const;  // -1: kept for wait

  // As the first process of a pid namespace of its own, with the number 1 there, where the system allows it;
  // the process that is returned ends as the program does, and the program with it.
  pid_t start_in_namespace(const std::vector<std::string>& arguments) const;
  Result wait(pid_t process) const;

  // Likewise, with a terminal as its stderr, of so many columns (0: unknown). Pre: has_terminals(), as
  // machines with /dev/pts do.
  static bool has_terminals();
  Result run_on_terminal(const std::vector<std::string>& arguments, unsigned short columns = 0) const;

  // The contract of an error: this code, nothing on stdout, one line "kinemesh: ..." that has all of `words`.
  void expect_error(const Result& result, int code, std::initializer_list<const char*> words) const;

 private:
  pid_t start(const std::vector<std::string>& arguments, int err_file, bool in_namespace) const;

  std::filesystem::path folder_;
  std::filesystem::path capture_;
};

// OFF texts. A grid of n x n cells on [0, n]^2, each cut by its rising diagonal: face 2 (row n + column) lies
// below it, the next one above; vertex row (n + 1) + column.
struct Move {
  int vertex;
  double x, y;
};
std::string grid_off(int n, const std::vector<Move>& moves = {});

}  // namespace kinemesh::testing
