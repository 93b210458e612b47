// What is known by name: fields, strategies, qualities, shapes.
#pragma once

#include <deque>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "kinemesh/error.h"

namespace kinemesh {

// Info has a `name`. Built-in ones come first, then those that were added, in their order. From any threads.
template <class Info>
class Registry {
 public:
  // what: one of them, "strategy".
  Registry(std::string what, std::vector<Info> built_in)
      : what_(std::move(what)), all_(built_in.begin(), built_in.end()) {}

  std::vector<Info> all() const {
    const std::lock_guard lock(mutex_);
    return {all_.begin(), all_.end()};
  }

  // Stays where it is. Throws InputError for a name that is not there.
  const Info& find(std::string_view name) const {
    const std::lock_guard lock(mutex_);
    if (const Info* found = at(name)) return *found;
    std::string names;
    for (const Info& info : all_) names += (names.empty() ? "" : ", ") + info.name;
    throw InputError("unknown " + what_ + " \"" + std::string(name) + "\", expected one of " + names);
  }

  // Throws InputError where there is one of that name, or none at all.
  void add(Info info) {
    const std::lock_guard lock(mutex_);
    if (info.name.empty()) throw InputError("a " + what_ + " without a name");
    if (at(info.name)) throw InputError("there is already a " + what_ + " \"" + info.name + "\"");
    all_.push_back(std::move(info));
  }

 private:
  const Info* at(std::string_view name) const {
    for (const Info& info : all_)
      if (info.name == name) return &info;
    return nullptr;
  }

  std::string what_;
  mutable std::mutex mutex_;
  std::deque<Info> all_;  // addresses last
};

}  // namespace kinemesh
