#pragma once

#include <string>
#include <vector>

#include "renderer/features.h"

namespace sheen::renderer {

/// Macros that every program of the renderer has: MIN_N_DOT_V and the limits of the shading's precision.
std::vector<std::string> shading_limits(Precision precision);

/// The macro of the formulation, which lobes and layers read.
const char* formulation_define(Formulation formulation);

/// "SMALLEST_SHEEN_ROUGHNESS=...", below which the stable form draws no sheen. alpha_g = 9e-10: the lobe is a line thinner than any
/// pixel, and 1 / alpha_g is still far inside a float's range.
inline constexpr const char* smallest_sheen_roughness_define = "SMALLEST_SHEEN_ROUGHNESS=3.0e-5";

/// A file of shaders/ with the precision that it is compiled in.
ShaderFile shader_file(const std::string& name);

/// The files that define the sheen lobe's visibility, in their order.
std::vector<std::string> sheen_visibility_files(albedo::Visibility visibility);

}  // namespace sheen::renderer
