#pragma once

#include <optional>
#include <vector>

#include <glm/mat4x4.hpp>

#include "scene/json_element.h"
#include "scene/scene.h"

namespace sheen::scene {

/// The cameras of a document, not yet placed. Throws Error for what glTF 2.0, section 3.10.3, forbids.
std::vector<Camera> read_cameras(const Element& root);

/// Rotation and translation of a node's world transform, its scale ignored (glTF 2.0, section 3.10.2): the viewing axis -Z is kept exactly,
/// Y is made perpendicular to it, and X follows, so that mirroring is ignored as well. Nothing where the transform leaves no direction.
std::optional<glm::dmat4> rigid_part(const glm::dmat4& world);

}  // namespace sheen::scene
