#pragma once

#include <vector>

#include "scene/json_element.h"
#include "scene/scene.h"

namespace sheen::scene {

/// What nodes place in the world.
struct Placeables {
  std::vector<std::vector<int>> meshes;  ///< primitives of each mesh
  std::vector<Camera> cameras;
  std::vector<Light> lights;
};

/// Walks the default scene (the first where the file names none; every root node, with a warning, where it has no scenes) and fills
/// scene.instances, lights and cameras. Cameras keep the order of the document's list, so that an index means the same to every viewer.
/// Throws Error for what glTF 2.0, section 3.5, forbids: references out of range, cycles, two parents, matrix together with TRS.
void place_nodes(const Element& root, const Placeables& placeables, Scene& scene);

}  // namespace sheen::scene
