#include "renderer/textures.h"

#include <algorithm>
#include <span>
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

/// Room for an RGBA32F picture, bound; with its mipmaps beside it as shaders/textures.glsl says.
gles::Texture allocate(const gles::Functions& gl, const std::string& what, int width, int height, bool mipmapped) {
  const int columns = mipmapped ? width + (width + 1) / 2 : width;
  const int rows = mipmapped ? height + mip_rows : height;
  check_texture_size(gl, mipmapped ? what + ", with its mipmaps beside it," : what, columns, rows);
  gles::Texture texture(gl);
  bind_unfiltered(gl, texture.name());
  gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, columns, rows, 0, GL_RGBA, GL_FLOAT, nullptr);
  return texture;
}

/// Texels into the bound texture.
void put(const gles::Functions& gl, int x, int y, int width, int height, const std::vector<glm::vec4>& texels) {
  gl.TexSubImage2D(GL_TEXTURE_2D, 0, x, y, width, height, GL_RGBA, GL_FLOAT, texels.data());
}

/// Level 0 of a picture into the bound texture, decoded band by band, as many at once as there are processors: what is decoded stays in
/// their caches.
void put_rows(const gles::Functions& gl, const scene::Picture& picture, scene::ColorSpace space) {
  const scene::RowDecoder decoder(picture, space);
  constexpr int texels_a_band = 1 << 14;
  const int band = std::clamp(texels_a_band / picture.width, 1, picture.height);
  std::vector<std::vector<glm::vec4>> bands(static_cast<std::size_t>(tbb::this_task_arena::max_concurrency()));
  for (int first = 0; first < picture.height; first += band * static_cast<int>(bands.size())) {
    const auto begin = [&](std::size_t i) { return std::min(first + band * static_cast<int>(i), picture.height); };
    tbb::parallel_for(std::size_t{0}, bands.size(), [&](std::size_t i) {
      const int rows = begin(i + 1) - begin(i);
      bands[i].resize(static_cast<std::size_t>(rows) * static_cast<std::size_t>(picture.width));
      decoder(begin(i), rows, bands[i].data());
    });
    for (std::size_t i = 0; i < bands.size(); ++i) {
      put(gl, 0, begin(i), picture.width, begin(i + 1) - begin(i), bands[i]);
    }
  }
}

/// The levels from 1 on into the bound texture of a picture of that size.
void put_below(const gles::Functions& gl, int width, int height, std::span<const scene::Texels> levels) {
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const int y = height - (height >> i) + static_cast<int>(i);
    put(gl, width, y, levels[i].width, levels[i].height, levels[i].rgba);
  }
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
  // No more pictures at once than there are processors: the mipmaps of each take 5 bytes a texel while they wait for their upload.
  const auto at_once = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
  for (std::size_t first = 0; first < keys.size(); first += at_once) {
    std::vector<std::vector<scene::Texels>> below(std::min(at_once, keys.size() - first));
    tbb::parallel_for(std::size_t{0}, below.size(), [&](std::size_t i) {
      const auto& [picture, space, mipmapped] = keys[first + i];
      if (mipmapped) {
        below[i] = scene::mipmaps_below(scene.pictures.at(static_cast<std::size_t>(picture)), space);
      }
    });
    for (std::size_t i = 0; i < below.size(); ++i) {
      const auto& [index, space, mipmapped] = keys[first + i];
      const scene::Picture& picture = scene.pictures[static_cast<std::size_t>(index)];
      const std::string what = scene.file + ": picture '" + picture.name + "'";
      gles::Texture texture = allocate(*gl_, what, picture.width, picture.height, mipmapped);
      put_rows(*gl_, picture, space);
      put_below(*gl_, picture.width, picture.height, below[i]);
      gles::check(*gl_, "uploading " + what);
      textures_.emplace(keys[first + i], std::move(texture));
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
  const scene::Texels& level0 = levels.front();
  gles::Texture texture = allocate(gl, what, level0.width, level0.height, true);
  put(gl, 0, 0, level0.width, level0.height, level0.rgba);
  put_below(gl, level0.width, level0.height, std::span(levels).subspan(1));
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
