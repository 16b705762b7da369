#pragma once

#include <cstddef>

#include "golden/layers.h"

// What a surface shows of its coat and of what lies below, each for itself. Where normal maps leave both normals open, either depends on
// its own alone, but for the coat's weight: as many shadings as there are normals, not pairs of them.

namespace sheen::golden {

/// What a coat needs of a Surface; numbers only, as there.
template <class Real>
struct CoatSurface {
  Vec3<Real> position, view, coat_normal;
  Real clearcoat, coat_alpha;
};

/// What may differ between surfaces below a coat that are one but for their normal maps; numbers only.
template <class Real>
struct BelowSurface {
  Vec3<Real> normal;
  Real coat_weight;  ///< k, 0 where there is no coat
};

/// What a coat adds under all lights, in lux / sr, and its weight.
template <class Real>
struct CoatSum {
  brdf::Rgb<Real> radiance;
  Real weight;
};

/// What comes through a coat under all lights, emission included, in lux / sr; and the sum of its terms' sizes.
template <class Real>
struct BelowSum {
  brdf::Rgb<Real> radiance, size;
};

/// Whether further terms change nothing of a sum, which nothing is promised of.
template <class Real>
bool is_hopeless(const brdf::Rgb<Real>& sum) {
  if constexpr (requires(const Real& x) { x.is_bounded(); }) {
    return !sum.r.is_bounded() && !sum.g.is_bounded() && !sum.b.is_bounded();
  }
  return false;
}

template <class Lobe, class Real>
CoatSum<Real> coat_sum(const CoatSurface<Real>& surface, const Lighting& lighting) {
  const CoatLayer<Real, Lobe> coat(surface, lighting);
  LightPart<Real> part = no_light<Real>();
  const brdf::Rgb<Real> black = part.coat;
  CoatSum<Real> out{black, coat.weight()};
  for (std::size_t i = 0; i < lighting.light_count && !is_hopeless(out.radiance); ++i) {
    part.coat = black;
    coat.add_light(arriving(lighting.lights[i], surface.position), part);
    out.radiance = out.radiance + part.coat;
  }
  return out;
}

/// @param surface  its normals and its coat's numbers do not matter
template <class Lobe, class Real>
BelowSum<Real> below_sum(Surface<Real> surface, const BelowSurface<Real>& at, Layers layers, const Lighting& lighting) {
  surface.normal = at.normal;
  const BelowCoat<Real, Lobe> below(surface, layers, lighting, at.coat_weight);
  // Unclamped, the scale may be negative, and with it the base.
  const bool has_signs = layers.sheen && lighting.sheen.scaling == brdf::AlbedoScaling::Literal;
  BelowSum<Real> out{below.emission(), below.emission()};
  brdf::Rgb<Real> no_lookup;
  HalfAngles<Lobe> half;
  for (std::size_t i = 0; i < lighting.light_count && !is_hopeless(out.radiance); ++i) {
    LightPart<Real> part = no_light<Real>();
    below.add_light(arriving(lighting.lights[i], surface.position), false, part, no_lookup, half);
    out.radiance = (layers.sheen ? out.radiance + part.sheen : out.radiance) + part.base;
    if (has_signs) {
      out.size = out.size + part.sheen + absolute(part.base);
    }
  }
  if (!has_signs) {
    out.size = out.radiance;
  }
  return out;
}

}  // namespace sheen::golden
