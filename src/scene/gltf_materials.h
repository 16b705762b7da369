#pragma once

#include <string>
#include <vector>

#include "scene/gltf_textures.h"
#include "scene/json_element.h"
#include "scene/scene.h"

namespace sheen::scene {

/// The materials of a document, in its order. Throws Error for factors outside their schema's range and for the pairs of extensions that
/// the specifications forbid (KHR_materials_sheen, "Exclusions", and its like).
/// @param warnings  receives what is read but not drawn
std::vector<Material> read_materials(const Element& root, Textures& textures, std::vector<std::string>& warnings);

}  // namespace sheen::scene
