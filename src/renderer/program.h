#pragma once

#include <map>
#include <string>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "gles/objects.h"
#include "renderer/assembly.h"

namespace sheen::renderer {

/// A linked program and where its active uniforms are. Setters do nothing for a uniform the program does not have.
class Program {
 public:
  /// Throws gles::Error with the driver's log and the numbered source.
  Program(const gles::Functions& gl, const ShaderText& text);

  void use() const { gl_->UseProgram(program_.name()); }
  /// Names of the active uniforms, an array's without its [0].
  std::vector<std::string> active_uniforms() const;

  void set(const std::string& name, int value) const;
  void set(const std::string& name, double value) const;
  void set(const std::string& name, const glm::ivec2& value) const;
  void set(const std::string& name, const glm::dvec2& value) const;
  void set(const std::string& name, const glm::dvec3& value) const;
  void set(const std::string& name, const glm::dvec4& value) const;
  void set(const std::string& name, const glm::dmat3& value) const;
  void set(const std::string& name, const glm::dmat4& value) const;
  void set(const std::string& name, const std::vector<glm::vec4>& values) const;

 private:
  GLint location(const std::string& name) const;

  const gles::Functions* gl_;
  gles::Program program_;
  std::map<std::string, GLint> locations_;
};

}  // namespace sheen::renderer
