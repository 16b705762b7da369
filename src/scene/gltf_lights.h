#pragma once

#include <vector>

#include "scene/json_element.h"
#include "scene/scene.h"

namespace sheen::scene {

/// The lights of a document's KHR_lights_punctual, not yet placed. Throws Error for values outside the extension's schema.
std::vector<Light> read_lights(const Element& root);

}  // namespace sheen::scene
