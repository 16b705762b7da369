#pragma once

#include <numbers>
#include <vector>

#include "image/flip_exposures.h"

namespace sheen::image {

/// Pixels per degree of visual angle of the observer the authors assume: 0.7 m away from a monitor 0.7 m and 3840 pixels wide
/// (Andersson et al. 2020, section 4.1 and their reference program): 67.02.
inline constexpr double default_pixels_per_degree = 0.7 * (3840.0 / 0.7) * std::numbers::pi / 180.0;

/// FLIP per pixel in [0, 1], rows from the top, between two pictures shown one after the other on a display; values outside [0, 1] are
/// clipped. Both pictures must be finite and of one size. Deterministic whatever the number of threads. Source: Andersson, Nilsson,
/// Akenine-Moeller, Oskarsson, Astroem, Fairchild, "FLIP: A Difference Evaluator for Alternating Images", Proc. ACM Comput. Graph.
/// Interact. Tech. 3(2), 2020.
std::vector<float> ldr_flip(const LinearRgb& reference, const LinearRgb& test, double pixels_per_degree = default_pixels_per_degree);

/// The largest LDR-FLIP per pixel over the exposures, both pictures tone mapped by the ACES fit. Negative values are clipped to 0.
/// Source: Andersson, Nilsson, Shirley, Akenine-Moeller, "Visualizing Errors in Rendered High Dynamic Range Images", Eurographics 2021.
std::vector<float> hdr_flip(const LinearRgb& reference, const LinearRgb& test, const Exposures& exposures,
                            double pixels_per_degree = default_pixels_per_degree);

}  // namespace sheen::image
