#pragma once

#include <string>

#include "renderer/features.h"

namespace sheen::renderer {

/// GLSL ES 3.00 sources of the two stages.
struct ShaderText {
  std::string vertex;
  std::string fragment;
};

/// Puts the plan's defines and files together, and nothing else.
ShaderText assemble(const ShaderPlan& plan, const Settings& settings);

}  // namespace sheen::renderer
