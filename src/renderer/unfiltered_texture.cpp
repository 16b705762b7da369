#include "renderer/unfiltered_texture.h"

namespace sheen::renderer {

gles::Texture unfiltered_texture(const gles::Functions& gl, const std::string& what, GLint internal, GLenum format, GLenum type, int width,
                                 int height, const void* texels) {
  GLint largest = 0;
  gl.GetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
  if (width > largest || height > largest) {
    throw gles::Error(what + " is " + std::to_string(width) + " x " + std::to_string(height) + "; this driver takes textures up to " +
                      std::to_string(largest));
  }
  gles::Texture texture(gl);
  gl.BindTexture(GL_TEXTURE_2D, texture.name());
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
  gl.PixelStorei(GL_UNPACK_ALIGNMENT, 4);
  gl.TexImage2D(GL_TEXTURE_2D, 0, internal, width, height, 0, format, type, texels);
  gles::check(gl, "uploading " + what);
  return texture;
}

}  // namespace sheen::renderer
