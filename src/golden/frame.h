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
