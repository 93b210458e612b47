// Random kicks from counter-based numbers: vertex (the user's number), step and seed decide, so that neither
// threads nor renumbering nor a restart change them. Fields of one kind with one seed give the same kicks;
// give each its own.
#pragma once

#include "kinemesh/field.h"

namespace kinemesh {

// Uniform in [-amplitude h, amplitude h]^2 each step, whatever its length; h is the spacing.
class Jitter final : public NoiseField {
 public:
  Jitter(double amplitude, std::uint64_t seed)
      : amplitude_(amplitude), seed_(seed) {}  // amplitude in spacings
  std::string_view name() const override { return "jitter"; }
  Point kick(std::uint64_t vertex, std::uint64_t step, double dt, double spacing) const override;

 private:
  double amplitude_;
  std::uint64_t seed_;
};

// Brownian motion: each component Gaussian with standard deviation sqrt(2 diffusion dt), by the transform of
// [Box 1958].
class Brownian final : public NoiseField {
 public:
  Brownian(double diffusion, std::uint64_t seed)
      : diffusion_(diffusion), seed_(seed) {}  // length^2 per time, >= 0
  std::string_view name() const override { return "brownian"; }
  Point kick(std::uint64_t vertex, std::uint64_t step, double dt, double spacing) const override;

 private:
  double diffusion_;
  std::uint64_t seed_;
};

}  // namespace kinemesh
