#pragma once

#include <array>
#include <string>

#include "image/image.h"
#include "image/io.h"

namespace sheen::image {

/// Indices of R, G and B; `who` needs them and is named in the Error thrown when one is missing.
inline std::array<int, 3> rgb_channels(const Image& image, const char* who) {
  const std::array<int, 3> rgb = {image.channel("R"), image.channel("G"), image.channel("B")};
  if (rgb[0] < 0 || rgb[1] < 0 || rgb[2] < 0) {
    throw Error(std::string(who) + " needs the channels R, G and B");
  }
  return rgb;
}

}  // namespace sheen::image
