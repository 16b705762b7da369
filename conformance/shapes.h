#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace sheen::conformance {

/// A tessellated surface with analytic normals and tangents, as a glTF primitive stores it. The two texture coordinate sets differ, so that
/// reading the wrong one shows. Triangles wind counter-clockwise seen from outside.
struct Shape {
  std::vector<std::array<float, 3>> positions;
  std::vector<std::array<float, 3>> normals;
  std::vector<std::array<float, 4>> tangents;  ///< along the u of TEXCOORD_0; w so that cross(N, T) w follows its v
  std::vector<std::array<float, 2>> texcoord_0;
  std::vector<std::array<float, 2>> texcoord_1;
  std::vector<std::array<float, 4>> colors;  ///< linear RGBA, but for "motley" smooth
  std::vector<std::uint16_t> indices;
};

/// "sphere" (radius 1, 96 x 48), "cloth" (a rolling patch that faces +Z), "ring" (a torus, turned toward the viewer), "square" (flat,
/// from -1 to 1 in x and y, faces +Z), "slivers" (the same of triangles 500 times as long as high), "broken_normals" (the same with
/// normals of length 0, 1e-6 and 1000) or "motley" (the same, its colours of 0 and 1).
bool is_shape(const std::string& name);
/// The names, for messages.
std::string shape_names();
/// Throws std::invalid_argument for an unknown name.
Shape make_shape(const std::string& name);

/// Lets u of TEXCOORD_0 run the other way: tangents turn about, and with them their w, so that bitangents stay.
void mirror_texcoords(Shape& shape);

}  // namespace sheen::conformance
