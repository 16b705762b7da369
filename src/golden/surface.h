#pragma once

#include <cstddef>
#include <cstring>

#include "brdf/base.h"
#include "golden/vec3.h"

namespace sheen::golden {

/// What shading one point needs, with every texture read: numbers only, so that a batch of points is an array of batches.
template <class Real>
struct Surface {
  Vec3<Real> position;     ///< world space, metres
  Vec3<Real> view;         ///< unit, toward the camera
  Vec3<Real> normal;       ///< unit N: interpolated, mapped, negated on a back face
  Vec3<Real> coat_normal;  ///< unit Nc, likewise, with the coat's own map
  brdf::Base<Real> base;
  brdf::Rgb<Real> sheen_color;
  Real sheen_roughness;
  Real clearcoat;   ///< the coat's strength, [0, 1]
  Real coat_alpha;  ///< square of clearcoatRoughness
  brdf::Rgb<Real> emission;
  Real occlusion;  ///< what is left of environment light: 1 + strength (texture.r - 1)
};

/// The same surface in every lane: a struct of numbers, each repeated.
template <class Real>
Surface<Real> spread(const Surface<double>& surface) {
  constexpr std::size_t numbers = sizeof(Surface<double>) / sizeof(double);
  static_assert(sizeof(Surface<Real>) == numbers * sizeof(Real));
  double one[numbers];
  std::memcpy(one, &surface, sizeof(one));
  Real each[numbers];
  for (std::size_t i = 0; i < numbers; ++i) {
    each[i] = Real(one[i]);
  }
  Surface<Real> out;
  std::memcpy(static_cast<void*>(&out), static_cast<const void*>(each), sizeof(each));
  return out;
}

/// Which layers a material has; uniform over a batch.
struct Layers {
  bool sheen = false;
  bool clearcoat = false;
  bool one_normal = false;  ///< whether coat and base have the same, so that half angles are found once for both
};

}  // namespace sheen::golden
