#pragma once

#include <cstddef>
#include <optional>
#include <type_traits>
#include <utility>

#include "golden/layers.h"
#include "number/lanes.h"

namespace sheen::golden {

/// Radiance of a surface, and what an approximation granted to a shader may change in it.
template <class Real>
struct Shaded {
  brdf::Rgb<Real> radiance;
  brdf::Rgb<Real> lookup;  ///< error of reading E once, at min(N.V, N.L), instead of taking the larger of two
  Real mirrored;           ///< 1 where N.V <= 0 mirrored V, of either lobe's normal, else 0
};

/// What does not depend on a light.
template <class Real>
struct ViewPart {
  Real n_dot_v, e_v, coat_weight;
  brdf::Rgb<Real> emission;
};

/// A listener that the optimiser removes.
struct NoListener {
  static constexpr bool wants_e_l = false;
  template <class Real>
  void view(const ViewPart<Real>&) {}
  template <class Real>
  void light(std::size_t, const LightPart<Real>&) {}
};

/// One surface while its lights are gone through: what none of them changes, found once.
/// @tparam Lobe  the arithmetic of lobes and Fresnel terms, that of all else being Real
template <class Real, class Lobe>
class Shading {
 public:
  using Color = brdf::Rgb<Real>;

  Shading(const Surface<Real>& surface, Layers layers, const Lighting& lighting)
      : coat_(layers.clearcoat ? std::optional<CoatLayer<Real, Lobe>>(std::in_place, surface, lighting) : std::nullopt),
        below_(surface, layers, lighting, coat_weight()),
        one_normal_(layers.one_normal) {}

  Color emission() const { return below_.emission(); }
  ViewPart<Real> view() const { return {below_.n_dot_v(), below_.e_v(), coat_weight(), emission()}; }
  Real mirrored() const {
    using brdf::max;
    return coat_ ? max(below_.mirrored(), coat_->mirrored()) : below_.mirrored();
  }

  /// What one light adds. Where it lies behind a lobe's normal in every lane, that lobe is not evaluated.
  /// @param wants_e_l  whether E(N.L) is to be told though the model does not need it
  /// @param lookup     is added to; see Shaded
  LightPart<Real> light(const Arriving<Real>& light, bool wants_e_l, Color& lookup) const {
    LightPart<Real> part = no_light<Real>();
    HalfAngles<Lobe> half;
    below_.add_light(light, wants_e_l, part, lookup, half);
    if (coat_ && !one_normal_) {
      coat_->add_light(light, part);
    } else if (coat_ && part.lit) {
      coat_->add_lit(light, part.n_dot_l, half, part);
    }
    return part;
  }

 private:
  Real coat_weight() const { return coat_ ? coat_->weight() : Real(0); }

  std::optional<CoatLayer<Real, Lobe>> coat_;
  BelowCoat<Real, Lobe> below_;
  bool one_normal_;
};

/// The radiance after a light's part, in the shader's order of summation; layers that are not there add nothing.
/// @param radiance  so far
template <class Real>
brdf::Rgb<Real> with_light(const brdf::Rgb<Real>& radiance, Layers layers, const brdf::Rgb<Real>& sheen, const brdf::Rgb<Real>& base,
                           const brdf::Rgb<Real>& coat) {
  const brdf::Rgb<Real> below = (layers.sheen ? radiance + sheen : radiance) + base;
  return layers.clearcoat ? below + coat : below;
}

/// Radiance toward the camera, in lux / sr:
///   L_o = sum over lights E [ (1-k) (f_sheen + s base) max(N.L,0) + k D_c Vis_c max(Nc.L,0) ] + (1-k) emission.
/// Every term passes `listener`, so that what is reported and what is drawn come from one evaluation.
template <class Lobe, class Real, class Listener>
Shaded<Real> shade_with(const Surface<Real>& surface, Layers layers, const Lighting& lighting, Listener&& listener) {
  constexpr bool wants_e_l = std::remove_cvref_t<Listener>::wants_e_l;
  const Shading<Real, Lobe> shading(surface, layers, lighting);
  listener.view(shading.view());
  Shaded<Real> out{shading.emission(), {Real(0), Real(0), Real(0)}, shading.mirrored()};
  for (std::size_t i = 0; i < lighting.light_count; ++i) {
    const Arriving<Real> light = lighting.distant != nullptr ? lighting.distant->arriving<Real>(i * number::Lanes<Real>::count)
                                                             : arriving(lighting.lights[i], surface.position);
    const LightPart<Real> part = shading.light(light, wants_e_l, out.lookup);
    listener.light(i, part);
    out.radiance = with_light(out.radiance, layers, part.sheen, part.base, part.coat);
  }
  return out;
}

/// The same in one arithmetic.
template <class Real, class Listener>
Shaded<Real> shade(const Surface<Real>& surface, Layers layers, const Lighting& lighting, Listener&& listener) {
  return shade_with<Real>(surface, layers, lighting, listener);
}

}  // namespace sheen::golden
