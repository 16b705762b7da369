#include "renderer/geometry.h"

#include <algorithm>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace sheen::renderer {
namespace {

void check_sizes(const scene::Scene& scene, const scene::Primitive& primitive) {
  const std::size_t count = primitive.positions.size();
  const auto wrong = [&](const char* what) {
    const auto index = &primitive - scene.primitives.data();
    throw scene::Error(scene.file, "primitives[" + std::to_string(index) + "]", what);
  };
  const auto fits = [&](std::size_t size) { return size == 0 || size == count; };
  if (primitive.normals.size() != count || !fits(primitive.tangents.size()) || !fits(primitive.colors.size()) ||
      !fits(primitive.texcoords[0].size()) || !fits(primitive.texcoords[1].size())) {
    wrong("all attributes of a primitive have as many elements as POSITION (glTF 2.0, section 3.7.2.1)");
  }
  if (primitive.indices.size() % 3 != 0) {
    wrong("a list of triangles has three indices each (glTF 2.0, section 3.7.2.1)");
  }
  const bool inside = std::all_of(primitive.indices.begin(), primitive.indices.end(), [&](std::uint32_t index) { return index < count; });
  if (!inside) {
    wrong("an index is below the number of vertices (glTF 2.0, section 3.7.2.1)");
  }
}

Box box_of(const std::vector<glm::vec3>& positions) {
  if (positions.empty()) {
    return {};
  }
  glm::vec3 low = positions.front();
  glm::vec3 high = positions.front();
  for (const glm::vec3& position : positions) {
    low = glm::min(low, position);
    high = glm::max(high, position);
  }
  return {glm::dvec3(low), glm::dvec3(high)};
}

}  // namespace

Geometry::Geometry(const gles::Functions& gl, const scene::Scene& scene, const scene::Primitive& primitive, const ShaderPlan& plan)
    : primitive_(&primitive), box_(box_of(primitive.positions)), vertex_array_(gl), indices_(gl) {
  check_sizes(scene, primitive);
  gl.BindVertexArray(vertex_array_.name());
  const glm::vec3 centre(0.5 * (box_.low + box_.high));
  const std::vector<glm::vec3>* positions = &primitive.positions;
  std::vector<glm::vec3> moved;
  if (glm::length(glm::dvec3(centre)) > 4.0 * glm::length(box_.high - box_.low)) {
    origin_ = glm::dvec3(centre);
    box_ = {box_.low - origin_, box_.high - origin_};
    moved = primitive.positions;
    for (glm::vec3& position : moved) {
      position -= centre;
    }
    positions = &moved;
  }
  const auto upload = [&](GLuint location, GLint components, const auto& values) {
    attribute(gl, location, components, values.data(), values.size() * sizeof(values[0]));
  };
  upload(0, 3, *positions);
  if (plan.normals) {
    upload(1, 3, primitive.normals);
  }
  if (plan.tangents) {
    upload(2, 4, primitive.tangents);
  }
  for (GLuint set = 0; set < 2; ++set) {
    if (plan.texcoords[set] && !primitive.texcoords.at(set).empty()) {
      upload(3 + set, 2, primitive.texcoords.at(set));
    }
  }
  if (plan.colors) {
    upload(5, 4, primitive.colors);
  }
  gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.name());
  gl.BufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(primitive.indices.size() * sizeof(std::uint32_t)),
                primitive.indices.data(), GL_STATIC_DRAW);
  gl.BindVertexArray(0);
  gles::check(gl, "uploading geometry");
}

void Geometry::attribute(const gles::Functions& gl, GLuint location, GLint components, const void* data, std::size_t bytes) {
  const gles::Buffer& buffer = attributes_.emplace_back(gl);
  gl.BindBuffer(GL_ARRAY_BUFFER, buffer.name());
  gl.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(bytes), data, GL_STATIC_DRAW);
  gl.EnableVertexAttribArray(location);
  gl.VertexAttribPointer(location, components, GL_FLOAT, GL_FALSE, 0, nullptr);
}

void Geometry::draw(const gles::Functions& gl) const {
  gl.BindVertexArray(vertex_array_.name());
  gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.name());
  gl.DrawElements(GL_TRIANGLES, static_cast<GLsizei>(primitive_->indices.size()), GL_UNSIGNED_INT, nullptr);
  gl.BindVertexArray(0);
}

void Geometry::draw(const gles::Functions& gl, const std::vector<std::uint32_t>& triangles) const {
  std::vector<std::uint32_t> ordered;
  ordered.reserve(triangles.size() * 3);
  for (const std::uint32_t triangle : triangles) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      ordered.push_back(primitive_->indices.at(std::size_t{triangle} * 3 + corner));
    }
  }
  const gles::Buffer buffer(gl);
  gl.BindVertexArray(vertex_array_.name());
  gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffer.name());
  gl.BufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(ordered.size() * sizeof(std::uint32_t)), ordered.data(), GL_STREAM_DRAW);
  gl.DrawElements(GL_TRIANGLES, static_cast<GLsizei>(ordered.size()), GL_UNSIGNED_INT, nullptr);
  gl.BindVertexArray(0);
}

glm::dmat3 normal_matrix(const glm::dmat4& matrix) {
  const glm::dmat3 m(matrix);
  // The cofactors are the inverse transpose times the determinant, whose sign alone matters to a direction.
  glm::dmat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
  double largest = 0.0;
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row) {
      largest = std::max(largest, std::abs(cofactors[column][row]));
    }
  }
  const double sign = glm::dot(m[0], cofactors[0]) < 0.0 ? -1.0 : 1.0;
  return largest > 0.0 ? cofactors * (sign / largest) : cofactors;
}

scene::Camera tighten_depth_range(scene::Camera camera, const std::vector<Box>& boxes, const std::vector<glm::dmat4>& view_from_local) {
  double nearest = std::numeric_limits<double>::infinity();
  double farthest = 0.0;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (unsigned corner = 0; corner < 8; ++corner) {
      const glm::dvec3 local((corner & 1) != 0 ? boxes[i].high.x : boxes[i].low.x, (corner & 2) != 0 ? boxes[i].high.y : boxes[i].low.y,
                             (corner & 4) != 0 ? boxes[i].high.z : boxes[i].low.z);
      const double depth = -(view_from_local[i] * glm::dvec4(local, 1.0)).z;
      nearest = std::min(nearest, depth);
      farthest = std::max(farthest, depth);
    }
  }
  // A margin of a thousandth keeps clipping, which is in single precision, off the surfaces themselves.
  const double margin = 1e-3 * farthest;
  const double znear = std::max(camera.znear, std::min(nearest * 0.999, nearest - margin));
  const double zfar = std::min(camera.zfar, farthest + margin);
  if (!(farthest > 0.0) || !(zfar > znear)) {
    return camera;
  }
  camera.znear = znear;
  camera.zfar = zfar;
  return camera;
}

}  // namespace sheen::renderer
