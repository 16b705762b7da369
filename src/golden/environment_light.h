#pragma once

#include <vector>

#include <glm/vec3.hpp>

#include "golden/band_limited.h"
#include "golden/image_light.h"
#include "scene/environment.h"

namespace sheen::golden {

/// World directions to an image's brightest texels, 16 at most: they may be all that lights a surface.
std::vector<glm::dvec3> brightest_directions(const scene::Environment& environment);

/// An image that lights, split into a sum of two: what exceeds a threshold (the sun, lamps), and the rest. A surface turned away from the
/// sun then spends no direction on it, and no direction drawn elsewhere meets it by a rare chance that would make the mean jump.
class EnvironmentLight {
 public:
  /// The argument must outlive this and have an image.
  explicit EnvironmentLight(const scene::Environment& environment);

  glm::dvec3 radiance(const glm::dvec3& direction) const { return environment_.radiance(direction); }
  const ImageLight& soft() const { return soft_; }
  const ImageLight& bright() const { return bright_; }
  /// What each part holds toward the brightest texels of the whole.
  const std::vector<LightPoint>& soft_brightest() const { return soft_brightest_; }
  const std::vector<LightPoint>& bright_brightest() const { return bright_brightest_; }
  /// What of the soft part varies slowly.
  const BandLimited& slow() const { return slow_; }
  /// Whether what is bright lies apart (lamps), not in one place (the sun).
  bool bright_scattered() const { return bright_sine_ > 0.25; }
  /// Whether all that is bright lies below the horizon of a unit normal.
  bool bright_below(const Vec3<double>& normal) const;

 private:
  const scene::Environment& environment_;
  ImageLight soft_, bright_;
  std::vector<LightPoint> soft_brightest_, bright_brightest_;
  BandLimited slow_;
  Vec3<double> bright_axis_{0, 1, 0};  // of a cone that holds all that is bright
  double bright_sine_ = 1.0;           // of its half angle; 1: no such cone below a hemisphere
};

}  // namespace sheen::golden
