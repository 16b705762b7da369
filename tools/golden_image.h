#pragma once

#include <optional>

#include "golden/sampling_goal.h"
#include "image/image.h"
#include "scene/environment.h"
#include "scene/scene.h"
#include "tools/options.h"

namespace sheen::tools {

/// The golden of the picture asked for, for a driver of that many SUBPIXEL_BITS; shows progress. Throws scene::Error.
image::Image golden_image(const scene::Scene& scene, const SceneOptions& options, int subpixel_bits,
                          const std::optional<scene::Environment>& environment = std::nullopt, const golden::SamplingGoal& sampling = {},
                          bool bounds = true);

}  // namespace sheen::tools
