#pragma once

#include <optional>

#include "albedo/curve.h"
#include "albedo/interpolant.h"

namespace sheen::golden {

/// E at the roughness asked for last, kept: most surfaces of a picture share it. One a thread.
class CurveCache {
 public:
  const albedo::Curve* at(const albedo::Interpolant* interpolant, double sheen_roughness) {
    if (!curve_ || curve_->sheen_roughness() != sheen_roughness) {
      curve_.emplace(*interpolant, sheen_roughness);
    }
    return &*curve_;
  }

 private:
  std::optional<albedo::Curve> curve_;
};

}  // namespace sheen::golden
