// Structs of the caller that begin with their size. It may have been compiled with a version that knows fewer
// members than this one, or more.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <string>

#include "c/arguments.h"

namespace kinemesh {

// Larger is no struct's: the size has not been set.
inline constexpr std::size_t most_bytes = 4096;

// The caller's struct, whose size must at least be `least`: what the first version of it had.
template <class Struct>
Struct* sized(Struct* given, std::size_t least, const char* name) {
  const std::size_t size = required(given, name)->size;
  if (size < least || size > most_bytes)
    throw InputError(std::string(name) + "->size is " + std::to_string(size) + ", sizeof *" + name + " (" +
                     std::to_string(sizeof(Struct)) + " in this version) expected");
  return given;
}

// `defaults` with what the caller's struct has. What it has beyond must be 0. Pre: sized.
template <class Struct>
Struct read(const Struct* given, Struct defaults, const char* name) {
  const auto* bytes = reinterpret_cast<const unsigned char*>(given);
  const std::size_t known = std::min(given->size, sizeof(Struct));
  if (std::any_of(bytes + known, bytes + given->size, [](unsigned char byte) { return byte != 0; }))
    throw InputError(std::string(name) + " has members that this version does not know, 0 expected in them");
  std::memcpy(&defaults, given, known);
  return defaults;
}

// As much as the caller's struct has room for, its size becoming that. Pre: sized.
template <class Struct>
void write(Struct ours, Struct* given) {
  ours.size = std::min(given->size, sizeof(Struct));
  std::memcpy(given, &ours, ours.size);
}

}  // namespace kinemesh
