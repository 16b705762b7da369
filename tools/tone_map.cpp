#include "tools/tone_map.h"

#include <algorithm>
#include <cmath>

namespace sheen::tools {

std::array<double, 3> khronos_pbr_neutral(const std::array<double, 3>& color) {
  constexpr double f90 = 0.04;                     // Fresnel offset of a dielectric of ior 1.5
  constexpr double start_compression = 0.8 - f90;  // K_s
  constexpr double desaturation = 0.15;            // K_d
  constexpr double headroom = 1.0 - start_compression;
  const double low = std::min({color[0], color[1], color[2]});
  const double offset = low < 2.0 * f90 ? low - low * low / (4.0 * f90) : f90;
  std::array<double, 3> c{color[0] - offset, color[1] - offset, color[2] - offset};
  const double peak = std::max({c[0], c[1], c[2]});
  if (peak < start_compression) {
    return c;
  }
  const double new_peak = 1.0 - headroom * headroom / (peak + headroom - start_compression);
  const double g = 1.0 - 1.0 / (desaturation * (peak - new_peak) + 1.0);
  for (double& channel : c) {
    channel = channel * (new_peak / peak) * (1.0 - g) + new_peak * g;
  }
  return c;
}

void apply_display(image::Image& picture, ToneMap tone_map, double exposure) {
  if (tone_map == ToneMap::None && exposure == 0.0) {
    return;
  }
  const double gain = std::exp2(exposure);
  const std::array<int, 3> rgb{picture.channel("R"), picture.channel("G"), picture.channel("B")};
  if (std::any_of(rgb.begin(), rgb.end(), [](int index) { return index < 0; })) {
    return;
  }
  const int alpha = tone_map == ToneMap::None ? -1 : picture.channel("A");
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const double coverage = alpha < 0 ? 1.0 : picture.at(x, y, alpha);
      if (!(coverage > 0.0)) {
        continue;
      }
      std::array<double, 3> color{};
      for (std::size_t i = 0; i < 3; ++i) {
        color[i] = gain * picture.at(x, y, rgb[i]) / coverage;
      }
      if (tone_map == ToneMap::KhronosPbrNeutral) {
        color = khronos_pbr_neutral(color);
      }
      for (std::size_t i = 0; i < 3; ++i) {
        picture.at(x, y, rgb[i]) = static_cast<float>(color[i] * coverage);
      }
    }
  }
}

}  // namespace sheen::tools
