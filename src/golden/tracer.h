#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "golden/geometry.h"
#include "golden/rays.h"
#include "golden/surface_reader.h"

namespace sheen::golden {

/// What a ray sees.
struct Seen {
  std::optional<Hit> nearest;  ///< nearest opaque (or MASK, kept) surface within the clip range
  std::optional<Hit> tie;      ///< another surface at a depth that a depth buffer may not tell from the nearest one's
  /// Whether a depth buffer or the clip range may decide otherwise about a surface that matters: a BLEND one at the nearest one's depth, or
  /// one at either clip plane.
  bool ambiguous = false;
  std::vector<Hit> blended;  ///< BLEND surfaces in front of it, in drawing order
  std::vector<Hit> masked;   ///< MASK surfaces in front, kept or not; only if asked for

  void clear();
  bool empty() const { return !nearest && blended.empty(); }
  /// Whether both meet the same sides of the same triangles.
  bool same_triangles(const Seen& other) const;
  /// Whether a triangle's side is among what is seen, or masks that were asked for.
  bool shows(std::uint32_t triangle, bool front) const;
};

/// Casts rays with Embree, which is single precision, and recomputes every hit in double; near edges the triangle that the exact ray passes
/// through is looked for.
class Tracer {
 public:
  /// Builds the acceleration structure. The arguments must outlive this.
  Tracer(const scene::Scene& scene, const Geometry& geometry, const SurfaceReader& reader, const RayGenerator& rays);
  ~Tracer();
  Tracer(const Tracer&) = delete;
  Tracer& operator=(const Tracer&) = delete;

  /// Single-sided surfaces seen from behind are invisible, MASK surfaces where alpha < cutoff too. Thread-safe; `seen` is cleared first and
  /// given back filled, so that its memory serves the next ray.
  /// @param with_masked  whether to fill `masked`
  /// @param also         met by the ray as it is said to be, whatever its triangle's plane says: of a triangle that is too narrow for one
  void trace(const Ray& ray, bool with_masked, Seen& seen, const Hit* also = nullptr) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sheen::golden
