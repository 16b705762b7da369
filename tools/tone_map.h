#pragma once

#include <array>

#include "image/image.h"

namespace sheen::tools {

enum class ToneMap { None, KhronosPbrNeutral };

/// Display-referred colour, [0, 1], of a scene-linear Rec.709 colour >= 0: "Khronos PBR Neutral Tone Mapper", Khronos Group 2024, section
/// "Tone mapping function". Colours whose largest channel stays below 0.8 keep hue and saturation.
std::array<double, 3> khronos_pbr_neutral(const std::array<double, 3>& color);

/// Multiplies the radiance by 2^exposure and maps it; coverage and further channels stay. The colour is divided by its coverage before
/// the curve and multiplied by it after, so that an edge keeps the colour of its surface.
void apply_display(image::Image& picture, ToneMap tone_map, double exposure);

}  // namespace sheen::tools
