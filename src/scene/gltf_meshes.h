#pragma once

#include <string>
#include <vector>

#include "scene/gltf_accessors.h"
#include "scene/json_element.h"
#include "scene/scene.h"

namespace sheen::scene {

/// Reads every mesh into scene.primitives (scene.materials must be there; the default material is appended where a primitive names none)
/// and returns, mesh by mesh, which primitives it is made of. Strips and fans become triangles; points and lines are left out with a
/// warning. Component types beyond the core's are read where the file names KHR_mesh_quantization; a file that does not require it, as it
/// must, is warned of. Throws Error for whatever glTF 2.0, section 3.7.2, or that extension forbids.
std::vector<std::vector<int>> read_meshes(const Element& root, const Accessors& accessors, Scene& scene);

}  // namespace sheen::scene
