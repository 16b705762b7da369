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
  double cone_scale = 0.0;          ///< KHR_lights_punctual, "Inner and Outer Cone Angles": angular attenuation = (cd scale + offset)^2
  double cone_offset = 1.0;
};

std::vector<PreparedLight> prepare_lights(const std::vector<scene::Light>& lights);

/// What reaches a point from one light.
template <class Real>
struct Arriving {
  Vec3<Real> direction;        ///< unit, toward the light
  brdf::Rgb<Real> irradiance;  ///< lux at normal incidence
  Real rounding;               ///< share of the irradiance that 32-bit floats may miss near the rim of a cone
};

/// Distant lights, each with its direction and irradiance: lanes of a batch take as many at once. Lengths are a multiple of the lanes.
struct DistantLights {
  const double *x, *y, *z;
  const double *r, *g, *b;

  template <class Real>
  Arriving<Real> arriving(std::size_t first) const {
    using Lanes = number::Lanes<Real>;
    return {{Lanes::load(x + first), Lanes::load(y + first), Lanes::load(z + first)},
            {Lanes::load(r + first), Lanes::load(g + first), Lanes::load(b + first)},
            Real(0)};
  }
};

/// Direction and irradiance at a point (KHR_lights_punctual, "Range Property" and "Inner and Outer Cone Angles"). A point
/// at the light's own position receives nothing.
template <class Real>
Arriving<Real> arriving(const PreparedLight& light, const Vec3<Real>& point) {
  using brdf::max;
  using brdf::min;
  using brdf::select;
  using brdf::sqrt;
  const brdf::Rgb<Real> intensity{Real(light.intensity.x), Real(light.intensity.y), Real(light.intensity.z)};
  if (light.type == scene::LightType::Directional) {
    return {broadcast<Real>(-light.axis), intensity, Real(0)};
  }
  const Vec3<Real> to_light = broadcast<Real>(light.position) - point;
  const Real distance2 = dot(to_light, to_light);
  const auto apart = distance2 > Real(0);
  const Real inverse2 = Real(1) / select(apart, distance2, Real(1));
  const Vec3<Real> direction = to_light * sqrt(inverse2);
  const Real ratio2 = distance2 * Real(light.inverse_range * light.inverse_range);
  const Real window = max(min(Real(1) - ratio2 * ratio2, Real(1)), Real(0));
  Real attenuation = select(apart, window * inverse2, Real(0));
  Real rounding(0);
  if (light.type == scene::LightType::Spot) {
    const Real cd = Real(0) - dot(broadcast<Real>(light.axis), direction);
    const Real cone = max(min(cd * Real(light.cone_scale) + Real(light.cone_offset), Real(1)), Real(0));
    attenuation = attenuation * (cone * cone);
    // Eight roundings of a cosine of 1, times the scale: ((cone + e)^2 - cone^2) / cone^2.
    const Real e(light.cone_scale * 0x1p-21);
    const Real inverse = Real(1) / select(cone > Real(0), cone, Real(1));
    rounding = select(cone > Real(0), e * inverse * (Real(2) + e * inverse), Real(0));
  }
  return {direction, intensity * attenuation, rounding};
}

}  // namespace sheen::golden
