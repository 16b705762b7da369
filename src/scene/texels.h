#pragma once

#include <vector>

#include <glm/vec4.hpp>

#include "scene/scene.h"

namespace sheen::scene {

enum class ColorSpace { Linear, Srgb };

/// Decoded texels: linear floats, RGBA, first row is v = 0.
struct Texels {
  int width = 0;
  int height = 0;
  std::vector<glm::vec4> rgba;
};

/// Reads a picture as linear floats, a few rows at a time: 16 bytes a texel are much, for a large picture. The picture must outlive it.
class RowDecoder {
 public:
  RowDecoder(const Picture& picture, ColorSpace space);

  /// `count` rows from row `first`, to `out`.
  void operator()(int first, int count, glm::vec4* out) const;

 private:
  const Picture& picture_;
  std::vector<float> color_, alpha_;  // by code
};

/// The picture as linear floats; Srgb decodes r, g, b by IEC 61966-2-1 and leaves a linear.
Texels decode(const Picture& picture, ColorSpace space);

/// The mipmap chain from level 0 down to 1 x 1: each texel is the mean of the region of the level above that it covers (exact box filter,
/// also for odd sizes), in linear light, computed in double. Sizes are max(1, floor(size / 2)), OpenGL ES 3.0.6 section 3.8.10.4.
std::vector<Texels> mipmaps(Texels level0);
/// The same from level 1 on, to the last bit.
std::vector<Texels> mipmaps_below(const Picture& picture, ColorSpace space);

}  // namespace sheen::scene
