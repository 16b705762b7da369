#pragma once

#include <vector>

#include "albedo/sheen_model.h"

namespace sheen::albedo {

/// Directional albedo E of the sheen lobe with a white sheenColor: the integral of D V (N.L) over the hemisphere of L, by quadrature to a
/// relative error below 3e-7. E(mu, 0) = 0; E may exceed 1.
/// @param n_dot_v          (0, 1]; below 1e-7 it counts as 1e-7
/// @param sheen_roughness  the user's parameter, [0, 1]
double directional_albedo(Visibility visibility, double n_dot_v, double sheen_roughness);

/// Natural logarithm of E, also where E itself underflows; -infinity for sheen_roughness 0.
double log_directional_albedo(Visibility visibility, double n_dot_v, double sheen_roughness);

/// The same to a relative 1e-6 (4e-7 for n_dot_v >= 0.004), at twice the speed.
double log_directional_albedo_fast(Visibility visibility, double n_dot_v, double sheen_roughness);

/// E on the grid of all cosines and roughnesses given, each to 1e-6 (to 3e-7 of itself where it is above 2), on all threads:
/// result[j * n_dot_v.size() + i] = E(n_dot_v[i], sheen_roughness[j]).
std::vector<double> evaluate_grid(Visibility visibility, const std::vector<double>& n_dot_v, const std::vector<double>& sheen_roughness);

}  // namespace sheen::albedo
