#pragma once

#include <optional>
#include <string>
#include <vector>

#include "renderer/features.h"

namespace sheen::renderer {

/// What can be evaluated alone: a function of shaders/, or an operation of GLSL that they stand on.
struct ShaderFunction {
  std::string name;                    ///< "sheen_distribution", "exp2"
  std::vector<std::string> arguments;  ///< as GLSL declares them: "vec3 N", "float alpha"
  std::string call;                    ///< a GLSL expression of the arguments
  int channels = 1;                    ///< of what it gives
  std::vector<std::string> files;      ///< of shaders/, beside common.glsl
  std::vector<std::string> defines;
  std::optional<albedo::Visibility> table;  ///< reads the table of E of this visibility
  bool highp_call = false;                  ///< its arguments stay highp where the shading is mediump

  /// Numbers that its arguments hold together: 3 for each vec3.
  int scalars() const;
};

/// All of them.
const std::vector<ShaderFunction>& shader_functions();

/// The one of that name. Throws std::invalid_argument.
const ShaderFunction& shader_function(const std::string& name);

/// The files and macros that the function is compiled with: as they are for drawing.
ShaderPlan plan_function(const ShaderFunction& function, const Settings& settings);

/// The main() that follows them. It reads the arguments of the pixel (x, y), rows from the top, from the texture u_arguments, which is
/// u_rows rows high for every four numbers: number i from channel i mod 4 of the texel (x, y + u_rows (i / 4)).
std::string function_main(const ShaderFunction& function, const Settings& settings);

}  // namespace sheen::renderer
