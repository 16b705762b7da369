#pragma once

#include <map>
#include <string>
#include <tuple>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include "albedo/ggx_table.h"
#include "albedo/table.h"
#include "gles/objects.h"
#include "renderer/features.h"

namespace sheen::renderer {

/// The pictures of one scene on the GPU, each uploaded once for a colour space, with mipmaps where a sampler reads them; pictures of equal
/// texels are one (exporters write occlusion twice). The shader filters them itself.
class Pictures {
 public:
  explicit Pictures(const gles::Functions& gl) : gl_(&gl) {}

  /// Uploads what these uses need, while the mipmaps of others are made. Throws gles::Error for one larger than the driver takes.
  void prepare(const scene::Scene& scene, const std::vector<TextureUse>& uses);

  /// The GL texture for a use that was prepared.
  GLuint texture(const scene::Scene& scene, const TextureUse& use) const;
  /// Columns and rows of its picture.
  static glm::ivec2 size(const scene::Scene& scene, const TextureUse& use);

 private:
  using Key = std::tuple<int, scene::ColorSpace, bool>;  // picture, its decoding, whether it has mipmaps
  Key key_of(const scene::Scene& scene, const TextureUse& use) const;
  int first_equal(const scene::Scene& scene, int picture) const;

  const gles::Functions* gl_;
  std::map<Key, gles::Texture> textures_;
  std::map<int, int> same_as_;  ///< of each picture in use, the first in use whose texels are the same
};

/// An RGBA32F texture that nothing filters but the shader, rows from the top. `what` names it where it is too large: gles::Error.
gles::Texture upload_floats(const gles::Functions& gl, const std::string& what, int width, int height,
                            const std::vector<glm::vec4>& texels);

/// An R32F texture of a table of E.
gles::Texture upload_table(const gles::Functions& gl, const albedo::Table& table);
/// An RG32F texture of the GGX lobe's albedo.
gles::Texture upload_table(const gles::Functions& gl, const albedo::GgxTable& table);

/// The lights as a texture of 256 lights a row, four texels each.
gles::Texture upload_lights(const gles::Functions& gl, std::vector<glm::vec4> vectors);

}  // namespace sheen::renderer
