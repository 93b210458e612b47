// Whose mistake an exception is about. Expected outcomes (no valid mesh exists) are results, not exceptions:
// kinemesh/defect.h.
#pragma once

#include <stdexcept>
#include <string>

#pragma GCC visibility push(default)
namespace kinemesh {

// A caller's or a file's mistake. what() reads "FILE:LINE: what, and what was expected"; FILE and LINE are
// left out where they are not known.
class InputError : public std::runtime_error {
 public:
  explicit InputError(const std::string& what) : std::runtime_error(what) {}
  InputError(const std::string& file, int line, const std::string& what)
      : std::runtime_error(line > 0 ? file + ":" + std::to_string(line) + ": " + what : file + ": " + what),
        file_(file),
        line_(line) {}

  const std::string& file() const { return file_; }
  int line() const { return line_; }  // from 1; 0 where there is none

 private:
  std::string file_;
  int line_ = 0;
};

// Nobody's mistake: the machine lacks what it takes, as on a full disk, at a limit of files or their size,
// where a device fails. The same call may succeed later. what() names the file.
class ResourceError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace kinemesh
#pragma GCC visibility pop
