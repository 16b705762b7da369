#include "conformance/shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <stdexcept>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace sheen::conformance {
namespace {

constexpr double pi = std::numbers::pi;

/// A point of a surface with parameters s, t in [0, 1].
struct SurfacePoint {
  glm::dvec3 position{0};
  glm::dvec3 normal{0};
  glm::dvec3 along_s{0};  ///< tangent, direction of growing s
};

std::array<float, 3> floats(const glm::dvec3& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}
std::array<float, 2> floats(const glm::dvec2& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y)};
}

/// TEXCOORD_1: the first set turned by a right angle, scaled and moved, so that no texture looks the same through both.
glm::dvec2 second_set(const glm::dvec2& uv) {
  return {0.25 + 1.5 * uv.y, 0.125 + 0.75 * (1.0 - uv.x)};
}

/// Tints that stay above zero, so that no part of the base vanishes.
std::array<float, 4> tint(double s, double t) {
  return {static_cast<float>(0.55 + 0.45 * std::sin(2 * pi * s)), static_cast<float>(0.55 + 0.45 * std::sin(2 * pi * (s + t))),
          static_cast<float>(0.55 + 0.45 * std::cos(2 * pi * t)), static_cast<float>(0.6 + 0.4 * std::cos(2 * pi * s))};
}

/// A grid of columns x rows quads over (s, t); seen from outside, s runs to the right and t down, as the rows of a texture do.
Shape tessellate(int columns, int rows, const glm::dvec2& uv_scale, const std::function<SurfacePoint(double, double)>& surface) {
  Shape shape;
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i) {
      const double s = static_cast<double>(i) / columns;
      const double t = static_cast<double>(j) / rows;
      const SurfacePoint point = surface(s, t);
      const glm::dvec2 uv{uv_scale.x * s, uv_scale.y * t};
      shape.positions.push_back(floats(point.position));
      shape.normals.push_back(floats(glm::normalize(point.normal)));
      const std::array<float, 3> tangent = floats(glm::normalize(point.along_s));
      // glTF 2.0, section 3.7.2.1: bitangent = cross(normal, tangent) w; up in the picture, as the green of a normal texture means it
      // (3.9.3).
      shape.tangents.push_back({tangent[0], tangent[1], tangent[2], 1.0F});
      shape.texcoord_0.push_back(floats(uv));
      shape.texcoord_1.push_back(floats(second_set(uv)));
      shape.colors.push_back(tint(s, t));
    }
  }
  const auto vertex = [columns](int i, int j) { return static_cast<std::uint16_t>(j * (columns + 1) + i); };
  const auto add = [&shape](std::uint16_t a, std::uint16_t b, std::uint16_t c) {
    // A pole's quads have one triangle of no area.
    if (shape.positions[a] == shape.positions[b] || shape.positions[b] == shape.positions[c] || shape.positions[c] == shape.positions[a]) {
      return;
    }
    shape.indices.insert(shape.indices.end(), {a, b, c});
  };
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      add(vertex(i, j), vertex(i, j + 1), vertex(i + 1, j + 1));
      add(vertex(i, j), vertex(i + 1, j + 1), vertex(i + 1, j));
    }
  }
  return shape;
}

/// The seam lies behind, at -Z; t runs from the north pole down. Pole rows are exact, so that their triangles are found to have no area.
SurfacePoint sphere_point(double s, double t) {
  const double longitude = 2 * pi * s - pi;  // s = 0.5 faces +Z
  const double polar = pi * t;
  const bool pole = t == 0.0 || t == 1.0;
  const double ring = pole ? 0.0 : std::sin(polar);
  const double height = t == 0.0 ? 1.0 : t == 1.0 ? -1.0 : std::cos(polar);
  const glm::dvec3 normal{ring * std::sin(longitude), height, ring * std::cos(longitude)};
  return {normal, normal, {std::cos(longitude), 0.0, -std::sin(longitude)}};
}

/// z = 0.22 sin(1.5 pi x + 0.6) cos(1.1 pi y) over [-1, 1]^2, top row first.
SurfacePoint cloth_point(double s, double t) {
  const double x = 2 * s - 1;
  const double y = 1 - 2 * t;
  const double a = 1.5 * pi;
  const double b = 1.1 * pi;
  const double z = 0.22 * std::sin(a * x + 0.6) * std::cos(b * y);
  const double dz_dx = 0.22 * a * std::cos(a * x + 0.6) * std::cos(b * y);
  const double dz_dy = -0.22 * b * std::sin(a * x + 0.6) * std::sin(b * y);
  return {{x, y, z}, {-dz_dx, -dz_dy, 1.0}, {1.0, 0.0, dz_dx}};
}

/// Large radius 0.68, small radius 0.3, its axis tipped from +Z by 50 degrees about X so that it hides part of itself.
SurfacePoint ring_point(double s, double t) {
  const double around = 2 * pi * s;
  const double across = 2 * pi * t;
  const glm::dvec3 out{std::sin(around), std::cos(around), 0.0};
  const glm::dvec3 normal = out * std::cos(across) + glm::dvec3(0, 0, 1) * std::sin(across);
  const glm::dvec3 position = out * 0.68 + normal * 0.3;
  const glm::dvec3 along{std::cos(around), -std::sin(around), 0.0};
  const double tip = 50.0 * pi / 180.0;
  const auto turned = [tip](const glm::dvec3& v) {
    return glm::dvec3(v.x, std::cos(tip) * v.y - std::sin(tip) * v.z, std::sin(tip) * v.y + std::cos(tip) * v.z);
  };
  return {turned(position), turned(normal), turned(along)};
}

SurfacePoint square_point(double s, double t) {
  return {{2 * s - 1, 1 - 2 * t, 0.0}, {0.0, 0.0, 1.0}, {1.0, 0.0, 0.0}};
}

/// A flat patch of triangles that are 1 long and 1/500 high, under normals that swing by 60 degrees: a pixel meets several of them.
Shape slivers() {
  return tessellate(2, 1000, {1.0, 1.0}, [](double s, double t) {
    const double swing = pi / 6 * std::sin(4 * pi * t);
    return SurfacePoint{{2 * s - 1, 1 - 2 * t, 0}, {std::sin(swing), 0, std::cos(swing)}, {std::cos(swing), 0, -std::sin(swing)}};
  });
}

/// A square in columns, each with normals that no file should have but some do: of length 0, of 1e-6 and of 1000, and across each of the
/// outer two from one side of the surface nearly to the other.
Shape broken_normals() {
  Shape shape = tessellate(16, 16, {1.0, 1.0}, square_point);
  constexpr std::size_t across = 17;
  for (std::size_t i = 0; i < shape.normals.size(); ++i) {
    const std::size_t column = i % across;
    const float length = column < 4 ? 1.0F : column < 8 ? 0.0F : column < 12 ? 1e-6F : 1000.0F;
    const float lean = column == 1 ? 0.99F : column == 15 ? -0.99F : 0.0F;
    shape.normals[i] = {length * lean, 0.0F, length * std::sqrt(1.0F - lean * lean)};
  }
  return shape;
}

/// A square whose vertices have 0 or 1 in each channel, by the bits of a hash; in twelfths, which floats round.
Shape motley() {
  Shape shape = tessellate(12, 12, {1.0, 1.0}, square_point);
  for (std::uint32_t i = 0; i < shape.colors.size(); ++i) {
    const std::uint32_t hash = i * 2654435761U;  // of Knuth, by the golden ratio
    for (std::uint32_t c = 0; c < 4; ++c) {
      shape.colors[i].at(c) = static_cast<float>(hash >> (14 + 4 * c) & 1U);
    }
  }
  return shape;
}

struct NamedShape {
  const char* name;
  Shape (*make)();
};
constexpr std::array<NamedShape, 7> all_shapes = {{
    {"sphere",
     [] {
       return tessellate(96, 48, {2.0, 1.0}, sphere_point);
     }},
    {"cloth",
     [] {
       return tessellate(64, 64, {1.0, 1.0}, cloth_point);
     }},
    {"ring",
     [] {
       return tessellate(96, 40, {4.0, 1.0}, ring_point);
     }},
    {"square",
     [] {
       return tessellate(1, 1, {1.0, 1.0}, square_point);
     }},
    {"slivers", slivers},
    {"broken_normals", broken_normals},
    {"motley", motley},
}};

}  // namespace

bool is_shape(const std::string& name) {
  return std::any_of(all_shapes.begin(), all_shapes.end(), [&](const NamedShape& shape) { return name == shape.name; });
}

std::string shape_names() {
  std::string names;
  for (const NamedShape& shape : all_shapes) {
    names += (names.empty() ? "" : ", ") + std::string(shape.name);
  }
  return names;
}

Shape make_shape(const std::string& name) {
  for (const NamedShape& shape : all_shapes) {
    if (name == shape.name) {
      return shape.make();
    }
  }
  throw std::invalid_argument("unknown shape '" + name + "'; known: " + shape_names());
}

void mirror_texcoords(Shape& shape) {
  for (std::array<float, 2>& texcoord : shape.texcoord_0) {
    texcoord[0] = 1.0F - texcoord[0];
  }
  for (std::array<float, 4>& tangent : shape.tangents) {
    for (float& component : tangent) {
      component = -component;
    }
  }
}

}  // namespace sheen::conformance
