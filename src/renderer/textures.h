#pragma once

#include <map>
#include <string>
#include <tuple>
#include <vector>

#include <glm/vec4.hpp>

#include "albedo/ggx_table.h"
#include "albedo/table.h"
#include "gles/objects.h"
#include "renderer/features.h"

namespace sheen::renderer {

/// The pictures of one scene on the GPU as linear 32-bit floats, each decoded and uploaded once for a colour space, with mipmaps where a
/// sampler reads them. The shader filters them itself.
class Pictures {
 public:
  explicit Pictures(const gles::Functions& gl) : gl_(&gl) {}

  /// The GL texture for a use; decodes and uploads it when first asked for. Throws gles::Error for one larger than the driver takes.
  GLuint texture(const scene::Scene& scene, const TextureUse& use);

 private:
  using Key = std::tuple<int, scene::ColorSpace, bool>;  // picture, its decoding, whether it has mipmaps
  const gles::Functions* gl_;
  std::map<Key, gles::Texture> textures_;
};

/// An RGBA32F texture that nothing filters but the shader, rows from the top. `what` names it where it is too large: gles::Error.
gles::Texture upload_floats(const gles::Functions& gl, const std::string& what, int width, int height,
                            const std::vector<glm::vec4>& texels);

/// Likewise with its mipmaps beside it, as shaders/textures.glsl reads them.
gles::Texture upload_mipmapped(const gles::Functions& gl, const std::string& what, scene::Texels level0);

/// An R32F texture of a table of E.
gles::Texture upload_table(const gles::Functions& gl, const albedo::Table& table);
/// An RG32F texture of the GGX lobe's albedo.
gles::Texture upload_table(const gles::Functions& gl, const albedo::GgxTable& table);

/// The lights as a texture of 256 lights a row, four texels each.
gles::Texture upload_lights(const gles::Functions& gl, std::vector<glm::vec4> vectors);

}  // namespace sheen::renderer
