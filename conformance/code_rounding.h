#pragma once

namespace sheen::conformance {

/// How far a colour that came as an 8-bit sRGB code may lie from the linear value it was made of: half a code to either side, the wider of
/// the two. PNG colours are not premultiplied: the code's half step counts times alpha, and alpha's own half step times the colour.
/// @param value  linear, premultiplied   @param alpha  coverage; 1 where the picture has none
double color_rounding(double value, double alpha);

/// The same of coverage, which is no sRGB.
inline constexpr double alpha_rounding = 0.5 / 255.0;

}  // namespace sheen::conformance
