#pragma once

#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "gles/objects.h"
#include "renderer/features.h"
#include "scene/scene.h"

namespace sheen::renderer {

/// The box around a primitive's positions.
struct Box {
  glm::dvec3 low{0.0};
  glm::dvec3 high{0.0};
};

/// A primitive on the GPU: the attributes its plan asks for. Positions far from the origin are stored relative to their box's centre.
class Geometry {
 public:
  /// Throws scene::Error where an index or an attribute's length does not fit the positions.
  Geometry(const gles::Functions& gl, const scene::Scene& scene, const scene::Primitive& primitive, const ShaderPlan& plan);

  const Box& box() const { return box_; }
  /// What was subtracted from every position: the local matrix to draw with is world_from_local * translate(origin).
  const glm::dvec3& origin() const { return origin_; }
  /// Draws every triangle in the primitive's order.
  void draw(const gles::Functions& gl) const;
  /// Draws these triangles in this order.
  void draw(const gles::Functions& gl, const std::vector<std::uint32_t>& triangles) const;

 private:
  void attribute(const gles::Functions& gl, GLuint location, GLint components, const void* data, std::size_t bytes);

  const scene::Primitive* primitive_;
  Box box_;
  glm::dvec3 origin_{0.0};
  gles::VertexArray vertex_array_;
  gles::Buffer indices_;
  std::vector<gles::Buffer> attributes_;
};

/// The matrix of normals: the inverse transpose of a matrix's upper 3 x 3 up to a positive factor, which also exists where the inverse does
/// not.
glm::dmat3 normal_matrix(const glm::dmat4& matrix);

/// The camera with its near and far planes moved to where the drawn geometry begins and ends, never outward. No picture changes, but the
/// depth buffer's digits go where surfaces are. `boxes` in the local spaces of `view_from_local`.
scene::Camera tighten_depth_range(scene::Camera camera, const std::vector<Box>& boxes, const std::vector<glm::dmat4>& view_from_local);

}  // namespace sheen::renderer
