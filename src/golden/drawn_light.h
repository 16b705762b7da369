#pragma once

#include <cstdint>

#include <glm/vec3.hpp>

#include "golden/bounded_surface.h"
#include "golden/drawn_directions.h"
#include "golden/drawn_image.h"
#include "golden/pixel_bound.h"
#include "golden/seen.h"

namespace sheen::golden {

/// How far the light of an environment may be off in a picture of our shaders that draw directions toward it, besides what those directions
/// leave by chance: each direction, what arrives from there, what the surface makes of it, and what that is divided by are bounded
/// together. The mean over directions is estimated from a few of them, drawn in the same ways, and the most that this leaves is added. One
/// a thread.
class DrawnLight {
 public:
  struct Open {
    glm::dvec3 off{0.0};      ///< radiance
    glm::dvec3 largest{0.0};  ///< the most of the radiance that one direction of a picture brings, as far as those looked at tell
  };

  /// The argument must outlive this; its frame has an environment toward which directions are drawn.
  explicit DrawnLight(const PixelBound& bound);

  /// Of what a ray through a pixel's centre sees.
  /// @param surfaces  of the layers, back to front, as SurfaceReader has them
  /// @param opacities  of the same
  /// @param behind  what is behind them may be off by
  /// @param stream  a number that no other pixel has
  Open open(const Seen& seen, const Ray& ray, const Surface<double>* surfaces, const double* opacities, const Open& behind,
            std::uint64_t stream);

  /// Of the environment itself, where a ray through a pixel's centre shows it.
  Open open_background(const Ray& ray) const;

  /// Of one surface in view space.
  /// @param counts  of the directions that this looks at
  /// @param drawn   directions that a picture draws: it adds up as many
  template <class Lobe>
  static Open open(const Surface<Bound>& surface, Layers layers, const Lighting& lighting, const DrawnImage& image, const WayCounts& counts,
                   int drawn, std::uint64_t stream);

 private:
  Surface<Bound> read(const Hit& hit, const Ray& ray, const Surface<double>& truth);

  const PixelBound& bound_;
  TrianglesInView triangles_;
  BoundedSurface read_;
};

}  // namespace sheen::golden
