#pragma once

#include <optional>
#include <string>

#include "scene/environment.h"
#include "scene/scene.h"
#include "tools/options.h"

namespace sheen::tools {

/// The light that "directional:X,Y,Z:LUX" describes: (X, Y, Z) points toward the light, in any length but 0; LUX >= 0.
/// Throws UsageError, naming what is wrong.
scene::Light parse_light(const std::string& text);

/// Two numbers "REL,ABS", both finite and >= 0. Throws UsageError.
Tolerance parse_tolerance(const std::string& text);

/// Loads the scene and puts the lights of --light in place of its own. Warnings of the loader, and which layers the model leaves out, go to
/// stderr. Throws scene::Error.
scene::Scene load_scene(const SceneOptions& options);

/// What --environment and --environment-rotation describe, none if the first is empty: "uniform:R,G,B" with radiances >= 0, or an equirect
/// .hdr or .exr, whose values must be finite and >= 0. Throws UsageError, InputError, image::Error.
std::optional<scene::Environment> load_environment(const SceneOptions& options);

/// Throws InputError when nothing lights the scene, and says what to give.
void require_light(const scene::Scene& scene, const std::optional<scene::Environment>& environment = std::nullopt);

}  // namespace sheen::tools
