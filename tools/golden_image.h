#pragma once

#include "image/image.h"
#include "scene/scene.h"
#include "tools/options.h"

namespace sheen::tools {

/// The golden of the picture asked for, with its bounds, for a driver of that many SUBPIXEL_BITS; shows progress. Throws scene::Error.
image::Image golden_image(const scene::Scene& scene, const SceneOptions& options, int subpixel_bits);

}  // namespace sheen::tools
