#include "gles/objects.h"

#include <sstream>
#include <vector>

namespace sheen::gles {
namespace {

/// A shader lives only until its program is linked.
class Shader {
 public:
  Shader(const Functions& gl, GLenum stage) : gl_(gl), name_(gl.CreateShader(stage)) {}
  ~Shader() { gl_.DeleteShader(name_); }
  Shader(const Shader&) = delete;
  Shader& operator=(const Shader&) = delete;
  GLuint name() const { return name_; }

 private:
  const Functions& gl_;
  GLuint name_;
};

std::string numbered(const std::string& source) {
  std::istringstream lines(source);
  std::ostringstream out;
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    out << number << ": " << line << '\n';
  }
  return out.str();
}

void compile(const Functions& gl, const Shader& shader, const char* stage, const std::string& source) {
  const char* const text = source.c_str();
  gl.ShaderSource(shader.name(), 1, &text, nullptr);
  gl.CompileShader(shader.name());
  GLint compiled = GL_FALSE;
  gl.GetShaderiv(shader.name(), GL_COMPILE_STATUS, &compiled);
  if (compiled == GL_TRUE) {
    return;
  }
  GLint length = 0;
  gl.GetShaderiv(shader.name(), GL_INFO_LOG_LENGTH, &length);
  std::vector<char> log(static_cast<std::size_t>(length) + 1, '\0');
  gl.GetShaderInfoLog(shader.name(), length, nullptr, log.data());
  throw Error(std::string(stage) + " shader does not compile:\n" + log.data() + "\n" + numbered(source));
}

const char* error_name(GLenum code) {
  switch (code) {
    case GL_INVALID_ENUM:
      return "GL_INVALID_ENUM";
    case GL_INVALID_VALUE:
      return "GL_INVALID_VALUE";
    case GL_INVALID_OPERATION:
      return "GL_INVALID_OPERATION";
    case GL_INVALID_FRAMEBUFFER_OPERATION:
      return "GL_INVALID_FRAMEBUFFER_OPERATION";
    case GL_OUT_OF_MEMORY:
      return "GL_OUT_OF_MEMORY";
    default:
      return "an unknown error";
  }
}

const char* framebuffer_status_name(GLenum status) {
  switch (status) {
    case GL_FRAMEBUFFER_INCOMPLETE_ATTACHMENT:
      return "GL_FRAMEBUFFER_INCOMPLETE_ATTACHMENT";
    case GL_FRAMEBUFFER_INCOMPLETE_MISSING_ATTACHMENT:
      return "GL_FRAMEBUFFER_INCOMPLETE_MISSING_ATTACHMENT";
    case GL_FRAMEBUFFER_INCOMPLETE_DIMENSIONS:
      return "GL_FRAMEBUFFER_INCOMPLETE_DIMENSIONS";
    case GL_FRAMEBUFFER_INCOMPLETE_MULTISAMPLE:
      return "GL_FRAMEBUFFER_INCOMPLETE_MULTISAMPLE";
    case GL_FRAMEBUFFER_UNSUPPORTED:
      return "GL_FRAMEBUFFER_UNSUPPORTED";
    default:
      return "an unknown status";
  }
}

}  // namespace

GLuint BufferKind::create(const Functions& gl) {
  GLuint name = 0;
  gl.GenBuffers(1, &name);
  return name;
}
void BufferKind::destroy(const Functions& gl, GLuint name) {
  gl.DeleteBuffers(1, &name);
}

GLuint VertexArrayKind::create(const Functions& gl) {
  GLuint name = 0;
  gl.GenVertexArrays(1, &name);
  return name;
}
void VertexArrayKind::destroy(const Functions& gl, GLuint name) {
  gl.DeleteVertexArrays(1, &name);
}

GLuint TextureKind::create(const Functions& gl) {
  GLuint name = 0;
  gl.GenTextures(1, &name);
  return name;
}
void TextureKind::destroy(const Functions& gl, GLuint name) {
  gl.DeleteTextures(1, &name);
}

GLuint RenderbufferKind::create(const Functions& gl) {
  GLuint name = 0;
  gl.GenRenderbuffers(1, &name);
  return name;
}
void RenderbufferKind::destroy(const Functions& gl, GLuint name) {
  gl.DeleteRenderbuffers(1, &name);
}

GLuint FramebufferKind::create(const Functions& gl) {
  GLuint name = 0;
  gl.GenFramebuffers(1, &name);
  return name;
}
void FramebufferKind::destroy(const Functions& gl, GLuint name) {
  gl.DeleteFramebuffers(1, &name);
}

GLuint ProgramKind::create(const Functions& gl) {
  return gl.CreateProgram();
}
void ProgramKind::destroy(const Functions& gl, GLuint name) {
  gl.DeleteProgram(name);
}

Program link_program(const Functions& gl, const std::string& vertex_source, const std::string& fragment_source) {
  const Shader vertex(gl, GL_VERTEX_SHADER);
  const Shader fragment(gl, GL_FRAGMENT_SHADER);
  compile(gl, vertex, "vertex", vertex_source);
  compile(gl, fragment, "fragment", fragment_source);
  Program program(gl);
  gl.AttachShader(program.name(), vertex.name());
  gl.AttachShader(program.name(), fragment.name());
  gl.LinkProgram(program.name());
  GLint linked = GL_FALSE;
  gl.GetProgramiv(program.name(), GL_LINK_STATUS, &linked);
  if (linked != GL_TRUE) {
    GLint length = 0;
    gl.GetProgramiv(program.name(), GL_INFO_LOG_LENGTH, &length);
    std::vector<char> log(static_cast<std::size_t>(length) + 1, '\0');
    gl.GetProgramInfoLog(program.name(), length, nullptr, log.data());
    throw Error(std::string("program does not link:\n") + log.data() + "\nvertex shader:\n" + numbered(vertex_source) +
                "fragment shader:\n" + numbered(fragment_source));
  }
  gl.DetachShader(program.name(), vertex.name());
  gl.DetachShader(program.name(), fragment.name());
  return program;
}

void check(const Functions& gl, const std::string& doing) {
  const GLenum code = gl.GetError();
  if (code != GL_NO_ERROR) {
    throw Error(doing + ": " + error_name(code));
  }
}

void check_framebuffer(const Functions& gl, const std::string& what) {
  const GLenum status = gl.CheckFramebufferStatus(GL_FRAMEBUFFER);
  if (status != GL_FRAMEBUFFER_COMPLETE) {
    throw Error(what + ": the framebuffer is not complete, " + framebuffer_status_name(status));
  }
}

}  // namespace sheen::gles
