#pragma once

#include <string>
#include <vector>

#include "scene/gltf_accessors.h"
#include "scene/json_element.h"
#include "scene/scene.h"

namespace sheen::scene {

/// Reads every mesh into scene.primitives (scene.materials must be there; the default material is appended where a primitive names none)
/// and returns, mesh by mesh, which primitives it is made of. Strips and fans become triangles; points and lines are left out with a
/// warning. Throws Error for whatever glTF 2.0, section 3.7.2, forbids.
std::vector<std::vector<int>> read_meshes(const Element& root, const Accessors& accessors, Scene& scene);

}  // namespace sheen::scene
