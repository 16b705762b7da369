#pragma once

#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

#include "scene/scene.h"

namespace sheen::renderer {

/// Four vectors a light, in view space, as shaders/lights.glsl describes them; made in double.
std::vector<glm::vec4> pack_lights(const std::vector<scene::Light>& lights, const glm::dmat4& view_from_world);

}  // namespace sheen::renderer
