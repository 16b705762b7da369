#include "renderer/textures.h"

#include <algorithm>
#include <string>
#include <utility>

namespace sheen::renderer {
namespace {

constexpr std::size_t light_texels_a_row = 1024;
constexpr int mip_rows = 16;  // MIP_ROWS of shaders/textures.glsl, which says how the levels lie

void check_texture_size(const gles::Functions& gl, const std::string& what, int width, int height) {
  GLint largest = 0;
  gl.GetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
  if (width > largest || height > largest) {
    throw gles::Error(what + " is " + std::to_string(width) + " x " + std::to_string(height) + "; this driver takes textures up to " +
                      std::to_string(largest));
  }
}

/// Binds a texture that nothing filters but the shader.
void bind_unfiltered(const gles::Functions& gl, GLuint name) {
  gl.BindTexture(GL_TEXTURE_2D, name);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
}

gles::Texture upload_floats(const gles::Functions& gl, const std::string& what, GLint internal, GLenum format, int width, int height,
                            const std::vector<float>& values) {
  gles::Texture texture(gl);
  check_texture_size(gl, what, width, height);
  bind_unfiltered(gl, texture.name());
  gl.PixelStorei(GL_UNPACK_ALIGNMENT, 4);
  gl.TexImage2D(GL_TEXTURE_2D, 0, internal, width, height, 0, format, GL_FLOAT, values.data());
  gles::check(gl, "uploading " + what);
  return texture;
}

}  // namespace

GLuint Pictures::texture(const scene::Scene& scene, const TextureUse& use) {
  const scene::Texture& texture = scene.textures.at(static_cast<std::size_t>(use.info->texture));
  const scene::Picture& picture = scene.pictures.at(static_cast<std::size_t>(texture.picture));
  const bool mipmapped = texture.sampler.mip != scene::MipFilter::None;
  const auto [place, fresh] = textures_.try_emplace(Key{texture.picture, use.space, mipmapped}, *gl_);
  if (!fresh) {
    return place->second.name();
  }
  scene::Texels texels = scene::decode(picture, use.space);
  const std::string what = scene.file + ": picture '" + picture.name + "'";
  place->second =
      mipmapped ? upload_mipmapped(*gl_, what, std::move(texels)) : upload_floats(*gl_, what, texels.width, texels.height, texels.rgba);
  return place->second.name();
}

gles::Texture upload_floats(const gles::Functions& gl, const std::string& what, int width, int height,
                            const std::vector<glm::vec4>& texels) {
  check_texture_size(gl, what, width, height);
  gles::Texture texture(gl);
  bind_unfiltered(gl, texture.name());
  gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, width, height, 0, GL_RGBA, GL_FLOAT, texels.data());
  gles::check(gl, "uploading " + what);
  return texture;
}

gles::Texture upload_mipmapped(const gles::Functions& gl, const std::string& what, scene::Texels level0) {
  const int width = level0.width;
  const int height = level0.height;
  const int columns = width + (width + 1) / 2;
  const int rows = height + mip_rows;
  check_texture_size(gl, what + ", with its mipmaps beside it,", columns, rows);
  gles::Texture texture(gl);
  bind_unfiltered(gl, texture.name());
  gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, columns, rows, 0, GL_RGBA, GL_FLOAT, nullptr);
  const std::vector<scene::Texels> levels = scene::mipmaps(std::move(level0));
  for (std::size_t level = 0; level < levels.size(); ++level) {
    const int x = level == 0 ? 0 : width;
    const int y = level == 0 ? 0 : height - (height >> (level - 1)) + static_cast<int>(level) - 1;
    gl.TexSubImage2D(GL_TEXTURE_2D, 0, x, y, levels[level].width, levels[level].height, GL_RGBA, GL_FLOAT, levels[level].rgba.data());
  }
  gles::check(gl, "uploading " + what);
  return texture;
}

gles::Texture upload_table(const gles::Functions& gl, const albedo::Table& table) {
  return upload_floats(gl, "the table of E", GL_R32F, GL_RED, table.width, table.height, table.values);
}

gles::Texture upload_table(const gles::Functions& gl, const albedo::GgxTable& table) {
  return upload_floats(gl, "the table of the GGX lobe's albedo", GL_RG32F, GL_RG, table.width, table.height, table.values);
}

gles::Texture upload_lights(const gles::Functions& gl, std::vector<glm::vec4> vectors) {
  const std::size_t rows = (vectors.size() + light_texels_a_row - 1) / light_texels_a_row;
  vectors.resize(rows * light_texels_a_row, glm::vec4(0.0f));
  return upload_floats(gl, "the table of lights", static_cast<int>(light_texels_a_row), static_cast<int>(rows), vectors);
}

}  // namespace sheen::renderer
