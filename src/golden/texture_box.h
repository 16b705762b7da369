#pragma once

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include "golden/texture.h"

namespace sheen::golden {

/// A texture's value at a point, and the most that each channel departs from it.
struct Spread {
  glm::dvec4 value{0.0};
  glm::dvec4 radius{0.0};
};

/// What a texture may give at coordinates that lie within `reach` of uv along either axis, at one level of detail: at the corners of that
/// box and wherever in it the filter has an edge (nearest) or a bend (linear), between which it is bilinear and so has no extremes; with a
/// shader's roundings in highp of the filter's arithmetic.
Spread sample_box(const Texture& texture, glm::dvec2 uv, glm::dvec2 reach, double lambda);

}  // namespace sheen::golden
