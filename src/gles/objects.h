#pragma once

#include <string>
#include <utility>

#include <glad/gles2.h>

#include "gles/context.h"

namespace sheen::gles {

/// A GL object that is deleted with its owner. It belongs to one context, which must be current where it is made, used and deleted.
template <class Kind>
class Object {
 public:
  explicit Object(const Functions& gl) : gl_(&gl), name_(Kind::create(gl)) {}
  ~Object() {
    if (name_ != 0) {
      Kind::destroy(*gl_, name_);
    }
  }
  Object(Object&& other) noexcept : gl_(other.gl_), name_(std::exchange(other.name_, 0)) {}
  Object& operator=(Object&& other) noexcept {
    std::swap(gl_, other.gl_);
    std::swap(name_, other.name_);
    return *this;
  }
  Object(const Object&) = delete;
  Object& operator=(const Object&) = delete;

  GLuint name() const { return name_; }

 private:
  const Functions* gl_;
  GLuint name_;
};

struct BufferKind {
  static GLuint create(const Functions& gl);
  static void destroy(const Functions& gl, GLuint name);
};
struct VertexArrayKind {
  static GLuint create(const Functions& gl);
  static void destroy(const Functions& gl, GLuint name);
};
struct TextureKind {
  static GLuint create(const Functions& gl);
  static void destroy(const Functions& gl, GLuint name);
};
struct RenderbufferKind {
  static GLuint create(const Functions& gl);
  static void destroy(const Functions& gl, GLuint name);
};
struct FramebufferKind {
  static GLuint create(const Functions& gl);
  static void destroy(const Functions& gl, GLuint name);
};
struct ProgramKind {
  static GLuint create(const Functions& gl);
  static void destroy(const Functions& gl, GLuint name);
};

using Buffer = Object<BufferKind>;
using VertexArray = Object<VertexArrayKind>;
using Texture = Object<TextureKind>;
using Renderbuffer = Object<RenderbufferKind>;
using Framebuffer = Object<FramebufferKind>;
using Program = Object<ProgramKind>;

/// Compiles and links GLSL ES 3.00 sources. Throws Error with the driver's log and the numbered source.
Program link_program(const Functions& gl, const std::string& vertex_source, const std::string& fragment_source);

/// Throws Error, naming what was being done, when the context has recorded an error since it was last asked.
void check(const Functions& gl, const std::string& doing);

/// Throws Error with the framebuffer status in GL's words unless the bound framebuffer is complete.
void check_framebuffer(const Functions& gl, const std::string& what);

}  // namespace sheen::gles
