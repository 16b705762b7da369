#include "tools/benchmarks/patchwork_scene.h"

#include <cmath>

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>

namespace sheen::bench {

scene::Scene patchwork_scene() {
  constexpr int side = 4;
  scene::Scene scene;
  scene.file = "patchwork";
  for (int patch = 0; patch < side * side; ++patch) {
    scene::Material material;
    material.metallic_factor = 0.0;
    material.sheen.color_factor = {0.9, 0.5, 0.4};
    material.sheen.roughness_factor = std::exp(-0.7 * (patch + 0.5));
    scene.materials.push_back(material);
    scene::Primitive primitive;
    primitive.positions = {{-0.5F, -0.5F, 0}, {0.5F, -0.5F, 0}, {0.5F, 0.5F, 0}, {-0.5F, 0.5F, 0}};
    primitive.normals.assign(4, {0, 0, 1});
    primitive.indices = {0, 1, 2, 0, 2, 3};
    primitive.material = patch;
    scene.primitives.push_back(primitive);
    const int row = patch / side;
    const glm::dvec3 place(patch % side - 1.5, row - 1.5, 0);
    scene.instances.push_back({patch, glm::translate(glm::dmat4(1.0), place)});
  }
  scene::Light light;
  light.intensity = 2.0;
  light.direction = glm::normalize(glm::dvec3(-1, -1, -1));
  scene.lights.push_back(light);
  return scene;
}

}  // namespace sheen::bench
