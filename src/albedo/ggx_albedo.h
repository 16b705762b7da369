#pragma once

#include "brdf/multiple_scattering.h"

namespace sheen::albedo {

using GgxAlbedo = brdf::LobeAlbedo<double>;

/// alpha up to which those who read tables take the GGX lobe for a mirror, which loses nothing: at n_dot_v 1e-4 it loses less than 1e-8. A
/// little below the square of 1e-4, so that no rounding of that roughness straddles it. shaders/ggx_albedo.glsl repeats it.
inline constexpr double mirror_alpha = 9.9e-9;

/// Albedo of the GGX lobe D Vis (brdf/ggx.h) at one cosine, by quadrature: the loss 1 - E to a relative 1e-9, the bias to an absolute 1e-6
/// (ggx_split_sum).
/// @param n_dot_v  (0, 1]; below 1e-7 it counts as 1e-7 in the bias, below 1e-12 as 1e-12 in the loss
/// @param alpha  [0, 1]
GgxAlbedo ggx_albedo(double n_dot_v, double alpha);

/// The loss alone, some ten times as fast.
double ggx_loss(double n_dot_v, double alpha);

/// Its average over the hemisphere, 2 integral of ggx_albedo(mu) mu dmu: the loss to a relative 1e-7.
GgxAlbedo ggx_average_albedo(double alpha);

}  // namespace sheen::albedo
