#pragma once

// Small scenes for this room's tests, built as plain data.

#include <cmath>
#include <functional>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "golden/golden.h"
#include "golden/surface.h"

namespace sheen::golden::test {

/// A camera at z = distance that looks along -Z at the origin.
inline scene::Camera camera_at(double distance, double yfov = 0.6) {
  scene::Camera camera;
  camera.world_from_camera = glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 0.0, distance));
  camera.yfov = yfov;
  return camera;
}

inline scene::Camera orthographic_at(double distance, double ymag) {
  scene::Camera camera = camera_at(distance);
  camera.perspective = false;
  camera.ymag = ymag;
  camera.zfar = 100.0;
  return camera;
}

inline scene::Light directional(glm::dvec3 toward_light, glm::dvec3 color = glm::dvec3(1.0), double lux = 1.0) {
  scene::Light light;
  light.direction = -glm::normalize(toward_light);
  light.color = color;
  light.intensity = lux;
  return light;
}

/// A purely Lambertian material: no specular, no metal.
inline scene::Material lambertian(glm::dvec4 color) {
  scene::Material m;
  m.base_color_factor = color;
  m.metallic_factor = 0.0;
  m.specular.factor = 0.0;
  m.has_ior_or_specular = true;
  return m;
}

/// Pinkish cloth, a fifth of it metal.
inline scene::Material cloth(double roughness) {
  scene::Material m;
  m.metallic_factor = 0.2;
  m.roughness_factor = roughness;
  m.sheen.color_factor = {0.9, 0.5, 0.7};
  m.sheen.roughness_factor = 0.3;
  return m;
}

/// A point of pink cloth, a third of it metal, under lacquer whose normal is tilted, with V in the plane of X and N.
inline Surface<double> cloth_under_lacquer(double n_dot_v) {
  Surface<double> s{};
  s.normal = {0.0, 1.0, 0.0};
  s.coat_normal = {0.2, std::sqrt(1.0 - 0.04 - 0.01), 0.1};
  s.view = {std::sqrt(1.0 - n_dot_v * n_dot_v), n_dot_v, 0.0};
  s.base.color = {0.5, 0.3, 0.2};
  s.base.metallic = 0.3;
  s.base.alpha = 0.09;
  s.base.dielectric_f0 = {0.04, 0.04, 0.04};
  s.base.specular = 1.0;
  s.sheen_color = {0.8, 0.6, 0.9};
  s.sheen_roughness = 0.4;
  s.clearcoat = 0.7;
  s.coat_alpha = 0.04;
  s.occlusion = 1.0;
  return s;
}

/// The square [-half, half]^2 at height z, facing +Z, with texture coordinates (0,0) at its upper left and the normal (bend x, bend y, 1)
/// at each corner: a linear function of the position, so that interpolation is exact wherever the diagonal runs.
inline scene::Primitive square(double half, double z = 0.0, double bend = 0.0) {
  scene::Primitive p;
  for (const glm::dvec2 c : {glm::dvec2(-1, 1), glm::dvec2(-1, -1), glm::dvec2(1, -1), glm::dvec2(1, 1)}) {
    p.positions.emplace_back(c.x * half, c.y * half, z);
    p.normals.emplace_back(bend * c.x * half, bend * c.y * half, 1.0);
    p.tangents.emplace_back(1.0f, 0.0f, 0.0f, 1.0f);
    p.texcoords[0].emplace_back(0.5 + 0.5 * c.x, 0.5 - 0.5 * c.y);
  }
  p.indices = {0, 1, 2, 0, 2, 3};
  return p;
}

/// A sphere of radius 1 with analytic normals, poles on the Y axis.
inline scene::Primitive sphere(int columns, int rows) {
  scene::Primitive p;
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i) {
      const double phi = 2.0 * 3.14159265358979323846 * i / columns;
      const double theta = 3.14159265358979323846 * j / rows;
      const glm::vec3 n(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi));
      p.positions.push_back(n);
      p.normals.push_back(n);
    }
  }
  const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(j * (columns + 1) + i); };
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      for (const std::uint32_t v : {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j), at(i + 1, j + 1), at(i, j + 1)}) {
        p.indices.push_back(v);
      }
    }
  }
  return p;
}

inline void add(scene::Scene& s, scene::Primitive primitive, const scene::Material& material, const glm::dmat4& place = glm::dmat4(1.0)) {
  primitive.material = static_cast<int>(s.materials.size());
  s.materials.push_back(material);
  s.instances.push_back({static_cast<int>(s.primitives.size()), place});
  s.primitives.push_back(std::move(primitive));
}

inline scene::Scene scene_with(const scene::Primitive& primitive, const scene::Material& material, const scene::Camera& camera,
                               std::vector<scene::Light> lights) {
  scene::Scene s;
  s.file = "test";
  s.cameras.push_back(camera);
  s.lights = std::move(lights);
  add(s, primitive, material);
  return s;
}

inline Settings settings_for(int width, int height, bool bounds = false) {
  Settings settings;
  settings.view.width = width;
  settings.view.height = height;
  settings.bounds = bounds;
  return settings;
}

/// An 8-bit picture from a function of column and row.
inline scene::Picture picture(int width, int height, const std::function<glm::ivec4(int, int)>& code) {
  scene::Picture p;
  p.width = width;
  p.height = height;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const glm::ivec4 c = code(x, y);
      for (int k = 0; k < 4; ++k) {
        p.codes.push_back(static_cast<std::uint16_t>(c[k]));
      }
    }
  }
  return p;
}

/// Adds a picture and a texture that reads it; returns the reference to it.
inline scene::TextureInfo add_texture(scene::Scene& s, scene::Picture p, scene::Sampler sampler = {}) {
  s.pictures.push_back(std::move(p));
  s.textures.push_back({static_cast<int>(s.pictures.size()) - 1, sampler});
  scene::TextureInfo info;
  info.texture = static_cast<int>(s.textures.size()) - 1;
  return info;
}

inline glm::dvec3 rgb(const image::Image& im, int x, int y, int first = 0) {
  return {im.at(x, y, first), im.at(x, y, first + 1), im.at(x, y, first + 2)};
}

}  // namespace sheen::golden::test
