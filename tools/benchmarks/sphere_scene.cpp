#include "tools/benchmarks/sphere_scene.h"

#include <cmath>
#include <cstdint>

#include <glm/geometric.hpp>

namespace sheen::bench {
namespace {

scene::Primitive sphere(int columns, int rows) {
  constexpr double pi = 3.14159265358979323846;
  scene::Primitive primitive;
  for (int row = 0; row <= rows; ++row) {
    for (int column = 0; column <= columns; ++column) {
      const double theta = pi * row / rows;
      const double phi = 2.0 * pi * column / columns;
      const glm::vec3 normal(glm::dvec3(std::sin(theta) * std::sin(phi), std::cos(theta), std::sin(theta) * std::cos(phi)));
      primitive.positions.push_back(normal);
      primitive.normals.push_back(normal);
    }
  }
  const auto vertex = [columns](int row, int column) { return static_cast<std::uint32_t>(row * (columns + 1) + column); };
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const std::uint32_t a = vertex(row, column);
      const std::uint32_t b = vertex(row + 1, column);
      const std::uint32_t c = vertex(row + 1, column + 1);
      const std::uint32_t d = vertex(row, column + 1);
      if (row + 1 < rows) {
        primitive.indices.insert(primitive.indices.end(), {a, b, c});
      }
      if (row > 0) {
        primitive.indices.insert(primitive.indices.end(), {a, c, d});
      }
    }
  }
  return primitive;
}

}  // namespace

scene::Scene sphere_scene(bool clearcoat) {
  scene::Scene scene;
  scene.file = "sphere";
  scene::Material material;
  material.base_color_factor = {0.4, 0.05, 0.08, 1.0};
  material.metallic_factor = 0.0;
  material.roughness_factor = 0.6;
  material.sheen.color_factor = {0.9, 0.5, 0.4};
  material.sheen.roughness_factor = 0.4;
  if (clearcoat) {
    material.clearcoat.factor = 1.0;
    material.clearcoat.roughness_factor = 0.2;
  }
  scene.materials.push_back(material);
  scene.primitives.push_back(sphere(96, 48));
  scene.instances.emplace_back();
  for (const glm::dvec3& toward : {glm::dvec3(1, 1, 1), glm::dvec3(-1, 0.5, 1), glm::dvec3(0, 1, -1)}) {
    scene::Light light;
    light.intensity = 2.0;
    light.direction = glm::normalize(-toward);
    scene.lights.push_back(light);
  }
  return scene;
}

}  // namespace sheen::bench
