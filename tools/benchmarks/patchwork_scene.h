#pragma once

#include "scene/scene.h"

namespace sheen::bench {

/// Sixteen flat cloths in one plane, four by four, each of a sheen roughness of its own from 0.7 down to 2e-5, under a directional light:
/// what is found once a material, where little is shaded.
scene::Scene patchwork_scene();

}  // namespace sheen::bench
