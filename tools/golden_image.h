#pragma once

#include "golden/golden.h"
#include "image/image.h"
#include "scene/environment.h"
#include "scene/scene.h"
#include "tools/options.h"

namespace sheen::tools {

/// What a golden depends on besides the picture asked for.
struct GoldenRequest {
  const scene::Environment* environment = nullptr;
  golden::SamplingGoal sampling{};
  int subpixel_bits = golden::Settings().subpixel_bits;    ///< of the driver it is to judge
  golden::Precision precision = golden::Precision::Highp;  ///< of the shader it is to judge
  bool bounds = true;
  int drawn_directions = 0;  ///< of golden::Settings
};

/// The golden of the picture asked for; shows progress. Throws scene::Error.
image::Image golden_image(const scene::Scene& scene, const SceneOptions& options, const GoldenRequest& request);

}  // namespace sheen::tools
