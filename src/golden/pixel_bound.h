#pragma once

#include <cmath>
#include <mutex>
#include <optional>
#include <vector>

#include <glm/vec4.hpp>

#include "golden/bounded_surface.h"
#include "golden/drawn_image.h"
#include "golden/frame.h"
#include "golden/near_misses.h"

namespace sheen::golden {

/// Light that punctual lights and emission bring through a pixel, and its coverage: what they are at the sample or near it, and the most
/// that a conforming driver's picture may depart from it while its grid displaces the sample. R G B A.
struct Enclosed {
  glm::dvec4 value{0.0};
  glm::dvec4 deviation{0.0};  ///< infinite where the rules of GLSL ES promise nothing
  bool edge_on = false;       ///< whether one of the surfaces is, see Interpolation

  bool is_bounded() const { return std::isfinite(deviation.x + deviation.y + deviation.z + deviation.w); }
};

/// What is needed to shade on number::Bounded, of a frame.
class PixelBound {
 public:
  /// The frame must outlive this.
  explicit PixelBound(const Frame& frame);

  /// How far a driver may displace a sample that meets these surfaces, along either axis, in pixels.
  double step(const Seen& seen) const;

  /// What a driver may take for the opacity of a surface. @param step  at least step() of it
  Bound opacity(const Hit& hit, const Ray& ray, double step) const { return reader_.opacity(hit, ray, step); }

  const Frame& frame() const { return frame_; }
  const NearMisses& near_misses() const { return near_misses_; }
  const BoundedSurfaceReader& reader() const { return reader_; }
  /// Null unless the settings say that a shader draws directions toward an environment.
  const DrawnImage* drawn_image() const { return drawn_image_ ? &*drawn_image_ : nullptr; }
  /// What a material's surfaces in view space are shaded with. Safe to call from many threads.
  Lighting lighting(int material) const;

 private:
  /// Albedos about what all surfaces of a material have. They cost more than many a picture, and a material may never be met.
  struct Albedos {
    std::once_flag made;
    std::optional<AlbedoAround> sheen;  // without a texture of sheen roughness
    std::optional<GgxAround> base;      // of one roughness, in the physical model
  };
  void make(Albedos& albedos, const SurfaceReader::Material& material) const;

  const Frame& frame_;
  NearMisses near_misses_;
  BoundedSurfaceReader reader_;
  std::optional<DrawnImage> drawn_image_;
  std::vector<PreparedLight> lights_;     // in view space
  mutable std::vector<Albedos> albedos_;  // of each material, made when first asked for
};

}  // namespace sheen::golden
