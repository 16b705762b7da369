#pragma once

#include "brdf/albedo_scaling.h"
#include "brdf/sheen.h"

namespace sheen::albedo {

using brdf::AlbedoScaling;
using brdf::Visibility;

/// N.V below this counts as this, in the golden and in the shader alike: Charlie's V has no value at N.V = 0. Small enough that a
/// 4096-pixel-wide sphere meets it on fewer than one pixel in a million.
inline constexpr double min_n_dot_v = 1e-4;

/// The choices the specification leaves open about sheen.
struct SheenModel {
  Visibility visibility = Visibility::Charlie;
  AlbedoScaling scaling = AlbedoScaling::Full;
};

}  // namespace sheen::albedo
