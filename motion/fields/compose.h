// Fields made of fields. Motions add up and are restricted by themselves (kinemesh/motion.h); these serve
// where one field is asked for.
#pragma once

#include <vector>

#include "kinemesh/field.h"

namespace kinemesh {

// v = v1 + v2 + ...; 0 for none.
class SumField final : public VelocityField {
 public:
  explicit SumField(std::vector<std::shared_ptr<const VelocityField>> parts) : parts_(std::move(parts)) {}
  std::string_view name() const override { return "sum"; }
  Point velocity(const Point& x, double t) const override;

 private:
  std::vector<std::shared_ptr<const VelocityField>> parts_;
};

// v inside the closed disc, 0 outside; the disc stands still, vertices pass through it.
class DiscField final : public VelocityField {
 public:
  DiscField(std::shared_ptr<const VelocityField> field, const Point& center, double radius)
      : field_(std::move(field)), center_(center), radius_(radius) {}
  std::string_view name() const override { return field_->name(); }
  Point velocity(const Point& x, double t) const override;

 private:
  std::shared_ptr<const VelocityField> field_;
  Point center_;
  double radius_;
};

}  // namespace kinemesh
