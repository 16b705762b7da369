#include "renderer/program.h"

#include <glm/gtc/type_ptr.hpp>

namespace sheen::renderer {

Program::Program(const gles::Functions& gl, const ShaderText& text)
    : gl_(&gl), program_(gles::link_program(gl, text.vertex, text.fragment)) {
  GLint count = 0;
  GLint longest = 0;
  gl.GetProgramiv(program_.name(), GL_ACTIVE_UNIFORMS, &count);
  gl.GetProgramiv(program_.name(), GL_ACTIVE_UNIFORM_MAX_LENGTH, &longest);
  std::vector<char> name(static_cast<std::size_t>(longest) + 1, '\0');
  for (GLint i = 0; i < count; ++i) {
    GLsizei length = 0;
    GLint size = 0;
    GLenum type = 0;
    gl.GetActiveUniform(program_.name(), static_cast<GLuint>(i), static_cast<GLsizei>(name.size()), &length, &size, &type, name.data());
    const std::string full(name.data(), static_cast<std::size_t>(length));
    locations_[full.substr(0, full.find('['))] = gl.GetUniformLocation(program_.name(), full.c_str());
  }
}

std::vector<std::string> Program::active_uniforms() const {
  std::vector<std::string> names;
  names.reserve(locations_.size());
  for (const auto& [name, location] : locations_) {
    names.push_back(name);
  }
  return names;
}

GLint Program::location(const std::string& name) const {
  const auto found = locations_.find(name);
  return found == locations_.end() ? -1 : found->second;
}

void Program::set(const std::string& name, int value) const {
  gl_->Uniform1i(location(name), value);
}
void Program::set(const std::string& name, double value) const {
  gl_->Uniform1f(location(name), static_cast<float>(value));
}
void Program::set(const std::string& name, const glm::ivec2& value) const {
  gl_->Uniform2iv(location(name), 1, glm::value_ptr(value));
}
void Program::set(const std::string& name, const glm::dvec2& value) const {
  gl_->Uniform2fv(location(name), 1, glm::value_ptr(glm::vec2(value)));
}
void Program::set(const std::string& name, const glm::dvec3& value) const {
  gl_->Uniform3fv(location(name), 1, glm::value_ptr(glm::vec3(value)));
}
void Program::set(const std::string& name, const glm::dvec4& value) const {
  gl_->Uniform4fv(location(name), 1, glm::value_ptr(glm::vec4(value)));
}
void Program::set(const std::string& name, const glm::dmat3& value) const {
  gl_->UniformMatrix3fv(location(name), 1, GL_FALSE, glm::value_ptr(glm::mat3(value)));
}
void Program::set(const std::string& name, const glm::dmat4& value) const {
  gl_->UniformMatrix4fv(location(name), 1, GL_FALSE, glm::value_ptr(glm::mat4(value)));
}
void Program::set(const std::string& name, const std::vector<glm::vec4>& values) const {
  if (values.empty()) {
    return;
  }
  gl_->Uniform4fv(location(name), static_cast<GLsizei>(values.size()), glm::value_ptr(values.front()));
}

}  // namespace sheen::renderer
