#pragma once

#include <cstddef>
#include <vector>

#include <glm/vec3.hpp>

#include "golden/vec3.h"
#include "number/lanes.h"
#include "scene/scene.h"

namespace sheen::golden {

/// A punctual light, made ready to be evaluated (KHR_lights_punctual).
struct PreparedLight {
  scene::LightType type = scene::LightType::Directional;
  glm::dvec3 intensity{0.0};  ///< colour times lux or candela
  glm::dvec3 position{0.0};
  glm::dvec3 axis{0.0, 0.0, -1.0};  ///< unit, the way the light travels
  double inverse_range = 0.0;       ///< 1/m; 0: unlimited
  /// KHR_lights_punctual, "Inner and Outer Cone Angles": angular attenuation = (cd scale + offset)^2 with offset = -cos(outer) scale, taken
  /// as ((cd - cos(outer)) scale)^2, which keeps its digits at the rim of a narrow cone.
  double cone_scale = 0.0;
  double cone_cos_outer = 0.0;
};

std::vector<PreparedLight> prepare_lights(const std::vector<scene::Light>& lights);

/// What reaches a point from one light.
template <class Real>
struct Arriving {
  Vec3<Real> direction;        ///< unit, toward the light
  brdf::Rgb<Real> irradiance;  ///< lux at normal incidence
};

/// Distant lights, each with its direction and irradiance: lanes of a batch take as many at once. Lengths are a multiple of the lanes.
struct DistantLights {
  const double *x, *y, *z;
  const double *r, *g, *b;

  template <class Real>
  Arriving<Real> arriving(std::size_t first) const {
    using Lanes = number::Lanes<Real>;
    return {{Lanes::load(x + first), Lanes::load(y + first), Lanes::load(z + first)},
            {Lanes::load(r + first), Lanes::load(g + first), Lanes::load(b + first)}};
  }
};

/// Direction and irradiance at a point (KHR_lights_punctual, "Range Property" and "Inner and Outer Cone Angles"). A point
/// at the light's own position receives nothing.
template <class Real>
Arriving<Real> arriving(const PreparedLight& light, const Vec3<Real>& point) {
  using brdf::inversesqrt;
  using brdf::max;
  using brdf::min;
  using brdf::select;
  const brdf::Rgb<Real> intensity{Real(light.intensity.x), Real(light.intensity.y), Real(light.intensity.z)};
  if (light.type == scene::LightType::Directional) {
    return {broadcast<Real>(-light.axis), intensity};
  }
  const Vec3<Real> to_light = broadcast<Real>(light.position) - point;
  const Real distance2 = dot(to_light, to_light);
  const auto apart = distance2 > Real(0);
  const Real squared = select(apart, distance2, Real(1));
  const Vec3<Real> direction = to_light * inversesqrt(squared);
  const Real ratio2 = distance2 * Real(light.inverse_range) * Real(light.inverse_range);
  const Real window = max(min(Real(1) - ratio2 * ratio2, Real(1)), Real(0));
  Real attenuation = select(apart, window / squared, Real(0));
  if (light.type == scene::LightType::Spot) {
    const Real cd = Real(0) - dot(broadcast<Real>(light.axis), direction);
    const Real cone = max(min((cd - Real(light.cone_cos_outer)) * Real(light.cone_scale), Real(1)), Real(0));
    attenuation = attenuation * (cone * cone);
  }
  return {direction, intensity * attenuation};
}

}  // namespace sheen::golden
