#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "golden/geometry.h"
#include "golden/rays.h"
#include "golden/seen.h"
#include "golden/surface_reader.h"

namespace sheen::golden {

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

  /// How close to a depth another must be for a depth buffer or the clip range not to tell which is nearer.
  double depth_tolerance(double depth) const;

  /// What trace() finds where no other triangle is near the ray. None where the triangle's own edge, a clip plane or its alpha matters.
  std::optional<Hit> trace_alone(std::uint32_t triangle, const Ray& ray) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sheen::golden
