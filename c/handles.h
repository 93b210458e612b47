// What the handles of kinemesh.h stand for, and who uses one at a time.
#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "c/arguments.h"
#include "c/errors.h"
#include "kinemesh/mesh_data.h"
#include "kinemesh/motion.h"
#include "kinemesh/stepper.h"

namespace kinemesh {

// Many who read, or one who changes; nobody waits.
class Users {
 public:
  bool enter_to_read() noexcept {
    int n = n_.load();
    while (n >= 0)
      if (n_.compare_exchange_weak(n, n + 1)) return true;
    return false;
  }
  bool enter_to_change() noexcept {
    int nobody = 0;
    return n_.compare_exchange_strong(nobody, -1);
  }
  void leave() noexcept {
    if (n_.load() < 0)
      n_ = 0;
    else
      --n_;
  }

 private:
  std::atomic<int> n_ = 0;  // who read; -1: the one who changes
};

// A caller's handle for the length of a call: to read if it is const, else to change. Throws KINEMESH_BUSY
// where others are in the way.
template <class Handle>
class Using {
 public:
  Using(Handle* handle, const char* name) : handle_(required(handle, name)) {
    const bool is_in =
        std::is_const_v<Handle> ? handle->users.enter_to_read() : handle->users.enter_to_change();
    if (!is_in)
      throw Failure(KINEMESH_BUSY,
                    std::string(name) + " is in use, by another thread or by the step that is observed");
  }
  ~Using() {
    if (handle_) handle_->users.leave();
  }
  Using(const Using&) = delete;
  Using& operator=(const Using&) = delete;
  Handle* operator->() const { return handle_; }
  Handle* release() { return std::exchange(handle_, nullptr); }  // nobody gets in any more

 private:
  Handle* handle_;
};

// NULL is fine.
template <class Handle>
void destroy(Handle* handle, const char* name) {
  if (handle) delete Using(handle, name).release();
}

}  // namespace kinemesh

struct kinemesh_mesh {
  kinemesh::MeshData data;
  mutable kinemesh::Users users = {};
};

struct kinemesh_stepper {
  kinemesh::Stepper stepper;
  std::optional<kinemesh::Motion> motion = std::nullopt;  // of a scenario
  double time_rest = 0.0;                                 // what rounding has taken from the stepper's time
  std::vector<kinemesh::RegionRecord> regions = {};       // of the last step taken
  mutable kinemesh::Users users = {};
};
