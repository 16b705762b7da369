#include "renderer/textures.h"

#include <algorithm>
#include <functional>
#include <future>
#include <string>
#include <tuple>
#include <utility>

#include <tbb/task_arena.h>

#include "renderer/picture_texture.h"
#include "renderer/unfiltered_texture.h"

namespace sheen::renderer {
namespace {

constexpr std::size_t light_texels_a_row = 1024;

gles::Texture upload_floats(const gles::Functions& gl, const std::string& what, GLint internal, GLenum format, int width, int height,
                            const std::vector<float>& values) {
  return unfiltered_texture(gl, what, internal, format, GL_FLOAT, width, height, values.data());
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
  // No more at once than there are processors: the mipmaps of each take 5 bytes a texel while they wait for their upload.
  const auto at_once = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
  std::vector<std::future<std::vector<scene::Texels>>> below(keys.size());
  const auto start = [&](std::size_t i) {
    if (i < keys.size() && std::get<bool>(keys[i])) {
      const auto& [picture, space, mipmapped] = keys[i];
      below[i] = std::async(std::launch::async, levels_below, std::cref(scene.pictures[static_cast<std::size_t>(picture)]), space);
    }
  };
  for (std::size_t i = 0; i < at_once; ++i) {
    start(i);
  }
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const auto& [index, space, mipmapped] = keys[i];
    const scene::Picture& picture = scene.pictures[static_cast<std::size_t>(index)];
    PictureTexture texture(*gl_, scene.file + ": picture '" + picture.name + "'", picture.width, picture.height, storage_of(picture, space),
                           mipmapped);
    texture.put_level0(picture, space);
    if (mipmapped) {
      int level = 1;
      for (const scene::Texels& texels : below[i].get()) {
        texture.put_level(level++, texels);
      }
    }
    start(i + at_once);
    textures_.emplace(keys[i], texture.take());
  }
}

GLuint Pictures::texture(const scene::Scene& scene, const TextureUse& use) const {
  return textures_.at(key_of(scene, use)).name();
}

glm::ivec2 Pictures::size(const scene::Scene& scene, const TextureUse& use) {
  const int index = scene.textures.at(static_cast<std::size_t>(use.info->texture)).picture;
  const scene::Picture& picture = scene.pictures.at(static_cast<std::size_t>(index));
  return {picture.width, picture.height};
}

gles::Texture upload_floats(const gles::Functions& gl, const std::string& what, int width, int height,
                            const std::vector<glm::vec4>& texels) {
  return unfiltered_texture(gl, what, GL_RGBA32F, GL_RGBA, GL_FLOAT, width, height, texels.data());
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
