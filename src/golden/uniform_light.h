#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <vector>

#include "albedo/quadrature.h"
#include "golden/curve_cache.h"
#include "golden/shade.h"

namespace sheen::golden {

/// Integrals over the hemisphere of L with weight s(N.L) N.L: of 1/pi, of w/pi, of D Vis and of D Vis w, w = (1 - V.H)^5.
struct BaseIntegrals {
  double diffuse = 0, diffuse_w = 0, specular = 0, specular_w = 0;
};

/// @param alpha    square of roughness, [0, 1]; 0 is a mirror, whose lobe is a delta of weight s(N.V)
/// @param n_dot_v  (0, 1]
/// @param scale    s at a cosine N.L
/// @param kinks    cosines in (0, 1), besides N.V, where s or a derivative of it jumps
/// @param effort   Full: to about 1e-7. Fast: to 1e-4, in a fifth of the time. That error is continuous: where alpha or n_dot_v differ by a
///                 share, what the integrals differ by is found to 3e-3 of that share.
BaseIntegrals base_integrals(double alpha, double n_dot_v, const std::function<double(double)>& scale,
                             const std::vector<double>& kinks = {}, albedo::Effort effort = albedo::Effort::Full);

/// What the base sends toward the camera under light of 1 from everywhere: brdf::base_brdf with its integrals in the place of the terms.
brdf::Rgb<double> base_light(const brdf::Base<double>& base, const BaseIntegrals& in);

/// Light of one radiance from every direction. Toward the camera it makes, without emission, by quadrature to about 1e-7 (and what E itself
/// is off):
///   L [ (1-k) (sheenColor E(N.V) + integral of s base N.L) + k integral of D_c Vis_c Nc.L ] occlusion,
/// each lobe over its own normal's hemisphere. The base's Fresnel terms are affine in the colours, so four integrals serve every colour:
/// they are kept until forget(). One a thread.
class UniformLight {
 public:
  /// @param radiance  from every direction
  UniformLight(const Lighting& lighting, const brdf::Rgb<double>& radiance);

  /// @param effort  of base_integrals; Fast tells what a slightly different surface would send
  brdf::Rgb<double> shade(const Surface<double>& surface, Layers layers, albedo::Effort effort = albedo::Effort::Full);

  /// What a shader that reads E once, at the smaller cosine, may add to that: see SheenLayer::single_lookup_scale. By Fast.
  brdf::Rgb<double> lookup(const Surface<double>& surface, Layers layers);

  void forget() { kept_.clear(); }

 private:
  enum class Of : unsigned char { Base, BaseUnderSheen, Coat };
  using Key = std::array<std::uint64_t, 6>;  // of what, how well, and the bits of the numbers it depends on

  /// Of integrals, what the base sends.
  brdf::Rgb<double> reflected(const Surface<double>& surface, double n_dot_v, const BaseIntegrals& in) const;

  template <class Find>
  const BaseIntegrals& kept(Of of, const std::array<double, 4>& numbers, albedo::Effort effort, const Find& find);

  Lighting lighting_;
  CurveCache curves_;
  brdf::Rgb<double> radiance_;
  std::map<Key, BaseIntegrals> kept_;
};

}  // namespace sheen::golden
