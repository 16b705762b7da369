#pragma once

#include "scene/scene.h"

namespace sheen::bench {

/// A unit sphere of 96 by 48 quads with smooth normals, velvet (sheen) and, if asked, lacquered (clearcoat), under three directional
/// lights.
scene::Scene sphere_scene(bool clearcoat);

}  // namespace sheen::bench
