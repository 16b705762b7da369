#pragma once

#include <vector>

#include <glm/vec4.hpp>

#include "golden/bounded_surface.h"
#include "golden/frame.h"

namespace sheen::golden {

/// Light that punctual lights and emission bring through a pixel, and its coverage: what they are at the sample, and the most that a
/// conforming driver's picture may depart from it while its grid displaces the sample. R G B A.
struct Enclosed {
  glm::dvec4 value{0.0};
  glm::dvec4 deviation{0.0};  ///< infinite where the rules of GLSL ES promise nothing
};

/// Shades what a ray sees on number::Bounded.
class PixelBound {
 public:
  /// The frame must outlive this.
  explicit PixelBound(const Frame& frame);

  /// How far a driver may displace a sample that meets these surfaces, along either axis, in pixels.
  double step(const Seen& seen) const;

  /// @param step  at least step(seen)
  Enclosed of(const Seen& seen, const Ray& ray, double step) const;

 private:
  const Frame& frame_;
  BoundedSurfaceReader reader_;
  std::vector<PreparedLight> lights_;  // in view space
};

}  // namespace sheen::golden
