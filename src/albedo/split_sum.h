#pragma once

#include <vector>

namespace sheen::albedo {

/// The split sum of a GGX lobe with Schlick's Fresnel term: its directional albedo at normal reflectance f0 is f0 scale + bias
/// (Karis 2013, "Real Shading in Unreal Engine 4", equation 8, there with another shadowing).
struct SplitSum {
  double scale;  ///< integral of D Vis (1 - w) (N.L) over the hemisphere of L, w = (1 - V.H)^5; [0, 1]
  double bias;   ///< integral of D Vis w (N.L); [0, 1]. scale + bias is the single-scattering albedo at f0 = 1.
};

/// The split sum of D and the height-correlated Smith Vis of glTF 2.0 Appendix B (brdf/ggx.h), by quadrature to an absolute 1e-6.
/// At roughness 0 that of a mirror: bias (1 - N.V)^5, scale the rest.
/// @param n_dot_v    (0, 1]; below 1e-7 it counts as 1e-7
/// @param roughness  the user's parameter, [0, 1]; alpha is its square
SplitSum ggx_split_sum(double n_dot_v, double roughness);

/// Integral of w (N.L) / pi over the hemisphere of L, w = (1 - V.H)^5: what Schlick's Fresnel term takes from a Lambertian base at f0 = 0;
/// by quadrature to an absolute 1e-9.
/// @param n_dot_v  [0, 1]
double diffuse_fresnel(double n_dot_v);

/// The split sums of all cosines and roughnesses given, on all threads: result[j * n_dot_v.size() + i] is that of n_dot_v[i] and
/// roughness[j].
std::vector<SplitSum> evaluate_split_sum_grid(const std::vector<double>& n_dot_v, const std::vector<double>& roughness);

}  // namespace sheen::albedo
