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

/// What --environment, --environment-rotation and --background describe: "uniform:R,G,B" or an equirect .hdr or .exr. Without them none, or
/// uniform:1,1,1 where the scene has no light, which a note on stderr says. Throws UsageError, scene::Error, image::Error.
std::optional<scene::Environment> load_environment(const SceneOptions& options, const scene::Scene& scene);

/// What a picture is made of.
struct Input {
  scene::Scene scene;
  std::optional<scene::Environment> environment;
};

/// Both of them, read side by side. Throws what load_scene() and load_environment() do, the scene's error before the environment's.
Input load_input(const SceneOptions& options);

}  // namespace sheen::tools
