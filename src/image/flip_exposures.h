#pragma once

#include <cstdint>
#include <vector>

namespace sheen::image {

/// Linear Rec.709 colours, interleaved, rows from the top.
struct LinearRgb {
  int width = 0;
  int height = 0;
  std::vector<float> values;  ///< 3 * width * height
};

/// The exposures of HDR-FLIP in stops: `count` of them, evenly from `start` to `stop`.
struct Exposures {
  double start = 0, stop = 0;
  int count = 1;
  double at(int i) const { return count < 2 ? start : start + (stop - start) * i / (count - 1); }
};

/// Tone mapped value in [0, 1] of a scene-linear value >= 0 (already exposed): Narkowicz 2016, "ACES Filmic Tone Mapping Curve", with the
/// factor 0.6 that cancels its pre-exposure, as HDR-FLIP takes it (Andersson et al. 2021, section 3.1).
float aces_tone_map(float x);

/// From the exposure that maps the reference's largest luminance to 0.85 of the display's range to the one that maps its median there:
/// Andersson et al. 2021, section 3.2; count = max(2, ceil(stop - start)).
/// The median is taken over the pixels whose `mask` is not 0 (black background is no part of a picture that says what it covers), and over
/// the positive luminances where it would be 0, for which the paper has no exposure; a reference without light gets one exposure of 0.
Exposures hdr_exposures(const LinearRgb& reference, const std::vector<std::uint8_t>& mask);

}  // namespace sheen::image
