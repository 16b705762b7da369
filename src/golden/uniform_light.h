#pragma once

#include <functional>
#include <vector>

#include "golden/shade.h"

namespace sheen::golden {

/// Radiance toward the camera that uniform light makes, without emission, by quadrature to about 1e-7 (and what E itself is off):
///   L [ (1-k) (sheenColor E(N.V) + integral of s base N.L) + k integral of D_c Vis_c Nc.L ] occlusion,
/// each lobe over its own normal's hemisphere. The base's Fresnel terms are affine in the colours, so four integrals serve every colour.
/// @param radiance  of the light, from every direction
Shaded<double> shade_uniform(const Surface<double>& surface, Layers layers, const Lighting& lighting, const brdf::Rgb<double>& radiance);

/// Integrals over the hemisphere of L with weight s(N.L) N.L: of 1/pi, of w/pi, of D Vis and of D Vis w, w = (1 - V.H)^5.
struct BaseIntegrals {
  double diffuse = 0, diffuse_w = 0, specular = 0, specular_w = 0;
};

/// @param alpha    square of roughness, [0, 1]; 0 is a mirror, whose lobe is a delta of weight s(N.V)
/// @param n_dot_v  (0, 1]
/// @param scale    s at a cosine N.L
/// @param kinks    cosines in (0, 1), besides N.V, where s or a derivative of it jumps
BaseIntegrals base_integrals(double alpha, double n_dot_v, const std::function<double(double)>& scale,
                             const std::vector<double>& kinks = {});

/// What the base sends toward the camera under light of 1 from everywhere: brdf::base_brdf with its integrals in the place of the terms.
brdf::Rgb<double> base_light(const brdf::Base<double>& base, const BaseIntegrals& in);

}  // namespace sheen::golden
