#include "gles/context.h"

#include <cstring>

#include <glad/gles2.h>

#include "gles/contexts.h"

namespace sheen::gles {
namespace {

const char* words(const GLubyte* text) {
  return text != nullptr ? reinterpret_cast<const char*>(text) : "unknown";
}

}  // namespace

Context::Context(ContextKind kind) : kind_(kind), functions_(std::make_unique<Functions>()) {}

Context::~Context() = default;

std::unique_ptr<Context> Context::create(ContextKind kind, const LibraryNames& names) {
  return kind == ContextKind::OsMesa ? create_osmesa_context(names.osmesa) : create_egl_context(names.egl);
}

std::unique_ptr<Context> Context::create_any(ContextKind preferred, const LibraryNames& names) {
  const ContextKind other = preferred == ContextKind::OsMesa ? ContextKind::Egl : ContextKind::OsMesa;
  std::string why;
  for (const ContextKind kind : {preferred, other}) {
    try {
      return create(kind, names);
    } catch (const Unavailable& unavailable) {
      why += (why.empty() ? "" : "\n") + std::string(unavailable.what());
    }
  }
  throw Unavailable(why);
}

void Context::load(Loader get_proc_address, const std::string& platform) {
  if (gladLoadGLES2Context(functions_.get(), get_proc_address) == 0) {
    throw Unavailable(platform + ": the context's GL functions cannot be loaded");
  }
  const Functions& gl = *functions_;
  info_.renderer = words(gl.GetString(GL_RENDERER));
  info_.version = words(gl.GetString(GL_VERSION));
  info_.desktop = std::strncmp(info_.version.c_str(), "OpenGL ES", 9) != 0;
  info_.platform = platform;
  if (gl.ES_VERSION_3_0 == 0) {
    throw Unavailable(platform + ": " + info_.renderer + " offers only " + info_.version + ", GL ES 3.0 is needed");
  }
  gl.GetIntegerv(GL_SUBPIXEL_BITS, &info_.subpixel_bits);
  GLint range[2] = {0, 0};
  GLint precision = 23;
  gl.GetShaderPrecisionFormat(GL_FRAGMENT_SHADER, GL_MEDIUM_FLOAT, range, &precision);
  info_.mediump_bits = precision;
}

}  // namespace sheen::gles
