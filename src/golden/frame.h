#pragma once

#include <optional>
#include <vector>

#include "golden/direction_pool.h"
#include "golden/environment_light.h"
#include "golden/geometry.h"
#include "golden/golden.h"
#include "golden/lights.h"
#include "golden/rays.h"
#include "golden/shade.h"
#include "golden/surface_reader.h"
#include "golden/tracer.h"

namespace sheen::golden {

/// How far along either axis a driver may displace a sample, in pixels, at the least. Each vertex goes to the nearest place of a grid of
/// SUBPIXEL_BITS (OpenGL ES 3.0.6, table 6.29), so by half its spacing; a point within the triangle goes by a mean of what its vertices do.
/// OpenGL ES does not say "nearest"; Direct3D 11.3 does (section 3.4.4.1, 16.8 fixed point, round to nearest even), which the same hardware
/// serves. And by the roundings of a vertex's place in the window, 8 of highp's epsilon relative to its size: of the transform 4, of the
/// division by w 2.5, of the viewport's scale and offset. Where the transform cancels, by more: PixelBound::step().
double displacement(const Settings& settings);

/// A scene made ready to be asked for pixels: everything that all of them share.
struct Frame {
  /// The arguments must outlive this. Throws scene::Error.
  Frame(const scene::Scene& scene_in, const Settings& settings_in);
  Frame(const Frame&) = delete;
  Frame& operator=(const Frame&) = delete;

  Lighting lighting(const TermFactors& factors = {}) const;

  const scene::Scene& scene;
  const Settings& settings;
  RayGenerator rays;
  Geometry geometry;
  SurfaceReader reader;
  Tracer tracer;
  std::vector<PreparedLight> lights;
  std::optional<EnvironmentLight> environment;  ///< only if it is an image
  std::optional<DirectionPool> directions;      ///< likewise
  albedo::SheenModel model;                     ///< resolved
  std::optional<albedo::Interpolant> albedo;    ///< only if a material in use has sheen
  std::optional<albedo::GgxInterpolant> ggx;    ///< only for the physical model
};

}  // namespace sheen::golden
