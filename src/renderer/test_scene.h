#pragma once

#include <cstdint>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

#include "scene/scene.h"

namespace sheen::renderer::test {

/// A picture of codes of 8 bits, RGBA, first row v = 0.
inline scene::Picture picture(int width, int height, std::vector<std::uint16_t> codes) {
  scene::Picture made;
  made.name = "picture";
  made.width = width;
  made.height = height;
  made.codes = std::move(codes);
  return made;
}

/// A square of side 2 in the plane z = 0, facing +Z; texture coordinates (0, 0) at its upper left, as glTF pictures lie. Each set and each
/// attribute is there, so that any feature can be tried on it.
inline scene::Primitive square() {
  scene::Primitive primitive;
  primitive.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  primitive.normals.assign(4, {0, 0, 1});
  primitive.tangents.assign(4, {1, 0, 0, 1});
  primitive.texcoords[0] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
  primitive.texcoords[1] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  primitive.indices = {0, 1, 2, 0, 2, 3};
  return primitive;
}

/// A white Lambertian material: what a value can be computed for by hand.
inline scene::Material lambert() {
  scene::Material material;
  material.metallic_factor = 0.0;
  material.has_ior_or_specular = true;
  material.specular.factor = 0.0;
  return material;
}

/// The square filling an orthographic picture, seen from +Z, under one directional light of 1 lux along its normal.
inline scene::Scene square_scene(const scene::Material& material = lambert()) {
  scene::Scene made;
  made.file = "square";
  made.materials = {material};
  made.primitives = {square()};
  made.instances = {{0, glm::dmat4(1.0)}};
  made.lights.emplace_back();
  scene::Camera camera;
  camera.perspective = false;
  camera.ymag = 1.0;
  camera.znear = 0.1;
  camera.zfar = 10.0;
  camera.world_from_camera = glm::translate(glm::dmat4(1.0), glm::dvec3(0, 0, 2));
  made.cameras = {camera};
  return made;
}

/// Adds a texture of that picture and returns a reference to it.
inline scene::TextureInfo add_texture(scene::Scene& made, scene::Picture content, scene::Sampler sampler = {}) {
  made.pictures.push_back(std::move(content));
  made.textures.push_back({static_cast<int>(made.pictures.size()) - 1, sampler});
  scene::TextureInfo info;
  info.texture = static_cast<int>(made.textures.size()) - 1;
  return info;
}

}  // namespace sheen::renderer::test
