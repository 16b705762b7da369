#pragma once

#include <string>

#include "scene/scene.h"
#include "tools/options.h"

namespace sheen::tools {

/// The light that "directional:X,Y,Z:LUX" describes: (X, Y, Z) points toward the light, in any length but 0; LUX >= 0.
/// Throws UsageError, naming what is wrong.
scene::Light parse_light(const std::string& text);

/// Two numbers "REL,ABS", both finite and >= 0. Throws UsageError.
Tolerance parse_tolerance(const std::string& text);

/// Loads the scene and puts the lights of --light in place of its own. Warnings of the loader go to stderr. Throws scene::Error.
scene::Scene load_scene(const SceneOptions& options);

/// Throws InputError when nothing lights the scene, and says what to give.
void require_light(const scene::Scene& scene);

}  // namespace sheen::tools
