#include "renderer/textures.h"

#include <algorithm>
#include <string>
#include <utility>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

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

int Pictures::first_equal(const scene::Scene& scene, int picture) const {
  const scene::Picture& wanted = scene.pictures.at(static_cast<std::size_t>(picture));
  for (const auto& [other, first] : same_as_) {
    const scene::Picture& known = scene.pictures[static_cast<std::size_t>(first)];
    if (known.width == wanted.width && known.height == wanted.height && known.bits == wanted.bits && known.codes == wanted.codes) {
      return first;
    }
  }
  return picture;
}

Pictures::Key Pictures::key_of(const scene::Scene& scene, const TextureUse& use) const {
  const scene::Texture& texture = scene.textures.at(static_cast<std::size_t>(use.info->texture));
  return {same_as_.at(texture.picture), use.space, texture.sampler.mip != scene::MipFilter::None};
}

void Pictures::prepare(const scene::Scene& scene, const std::vector<TextureUse>& uses) {
  std::vector<Key> keys;
  for (const TextureUse& use : uses) {
    const int picture = scene.textures.at(static_cast<std::size_t>(use.info->texture)).picture;
    if (!same_as_.contains(picture)) {
      same_as_.emplace(picture, first_equal(scene, picture));
    }
    const Key key = key_of(scene, use);
    if (!textures_.contains(key) && std::find(keys.begin(), keys.end(), key) == keys.end()) {
      keys.push_back(key);
    }
  }
  // No more pictures at once than there are processors: each takes 16 bytes a texel, with its
  // mipmaps 21, while it waits for its upload.
  const auto at_once = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
  for (std::size_t first = 0; first < keys.size(); first += at_once) {
    std::vector<std::vector<scene::Texels>> levels(std::min(at_once, keys.size() - first));
    tbb::parallel_for(std::size_t{0}, levels.size(), [&](std::size_t i) {
      const auto& [picture, space, mipmapped] = keys[first + i];
      scene::Texels texels = scene::decode(scene.pictures.at(static_cast<std::size_t>(picture)), space);
      if (mipmapped) {
        levels[i] = scene::mipmaps(std::move(texels));
      } else {
        levels[i].push_back(std::move(texels));
      }
    });
    for (std::size_t i = 0; i < levels.size(); ++i) {
      const auto& [picture, space, mipmapped] = keys[first + i];
      const std::string what = scene.file + ": picture '" + scene.pictures[static_cast<std::size_t>(picture)].name + "'";
      const scene::Texels& level0 = levels[i].front();
      textures_.emplace(keys[first + i], mipmapped ? upload_mipmapped(*gl_, what, levels[i])
                                                   : upload_floats(*gl_, what, level0.width, level0.height, level0.rgba));
    }
  }
}

GLuint Pictures::texture(const scene::Scene& scene, const TextureUse& use) const {
  return textures_.at(key_of(scene, use)).name();
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

gles::Texture upload_mipmapped(const gles::Functions& gl, const std::string& what, const std::vector<scene::Texels>& levels) {
  const int width = levels.front().width;
  const int height = levels.front().height;
  const int columns = width + (width + 1) / 2;
  const int rows = height + mip_rows;
  check_texture_size(gl, what + ", with its mipmaps beside it,", columns, rows);
  gles::Texture texture(gl);
  bind_unfiltered(gl, texture.name());
  gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, columns, rows, 0, GL_RGBA, GL_FLOAT, nullptr);
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
