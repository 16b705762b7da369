#include "scene/scene.h"

#include <glm/matrix.hpp>

namespace sheen::scene {

bool Instance::mirrored() const {
  return glm::determinant(glm::dmat3(world_from_local)) < 0.0;
}

}  // namespace sheen::scene
