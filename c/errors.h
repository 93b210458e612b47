// How what goes wrong reaches C: exceptions inside; a status, a sentence and numbers outside.
#pragma once

#include <optional>
#include <stdexcept>
#include <string>

#include "kinemesh.h"
#include "kinemesh/defect.h"

namespace kinemesh {

// Anything but KINEMESH_OK that no exception of the library stands for.
class Failure : public std::runtime_error {
 public:
  Failure(kinemesh_status status, const std::string& what, std::optional<Defect> defect = std::nullopt)
      : std::runtime_error(what), status_(status), defect_(std::move(defect)) {}
  kinemesh_status status() const { return status_; }
  const std::optional<Defect>& defect() const { return defect_; }

 private:
  kinemesh_status status_;
  std::optional<Defect> defect_;
};

// Throws what a step or a repair has failed for.
[[noreturn]] void refuse(const Defect& defect);

// In a catch block: keeps message and culprits for kinemesh_error and kinemesh_culprits.
kinemesh_status report_exception() noexcept;

// How many calls of this thread have failed.
unsigned n_failures() noexcept;

// Runs `work` and turns what it throws into a status.
template <class Work>
kinemesh_status guarded(const Work& work) noexcept {
  try {
    work();
    return KINEMESH_OK;
  } catch (...) {
    return report_exception();
  }
}

// What `work` returns, or `otherwise` where it throws.
template <class T, class Work>
T guarded_or(T otherwise, const Work& work) noexcept {
  T result = otherwise;
  (void)guarded([&] { result = work(); });
  return result;
}

}  // namespace kinemesh
