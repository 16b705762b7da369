#pragma once

#include <string>

#include "gles/objects.h"

namespace sheen::renderer {

/// A texture of one level that nothing filters but the shader; it stays bound. `texels` may be null: room alone.
/// Throws gles::Error, naming `what`, where it is too large for the driver or cannot be made.
gles::Texture unfiltered_texture(const gles::Functions& gl, const std::string& what, GLint internal, GLenum format, GLenum type, int width,
                                 int height, const void* texels);

}  // namespace sheen::renderer
