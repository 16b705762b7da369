#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gles/context.h"
#include "gles/objects.h"
#include "renderer/kept_images.h"
#include "renderer/prefilter.h"
#include "scene/environment.h"

namespace sheen::renderer {

/// The textures that shaders read an environment from; each is made when first asked for and kept until another takes its place. The
/// filtered maps and the split sums are also kept on disk, under a hash of the image.
class EnvironmentMaps {
 public:
  /// @param kept  where filtered maps outlive the program; must outlive this.
  EnvironmentMaps(gles::Context& context, const KeptImages& kept) : context_(context), kept_(kept) {}

  /// RGBA32F: the image, below it its maps filtered by the kernels given.
  GLuint prefiltered(const scene::Environment& environment, const std::vector<Kernel>& kernels);
  /// RGBA32F: the image, in its alpha what density directions are drawn with.
  GLuint sampled(const scene::Environment& environment);
  /// RGBA32F: points of the unit square and directions drawn from the image, if the environment has one.
  GLuint points(const scene::Environment& environment, int count, std::uint64_t seed);
  /// RGBA32F: the table of split sums.
  GLuint split_sums();

 private:
  struct Held {
    std::string key;
    std::optional<gles::Texture> texture;
  };
  template <class Make>
  static GLuint hold(Held& held, const std::string& key, const Make& make);

  gles::Context& context_;
  const KeptImages& kept_;
  Held image_, points_, split_sums_;
};

}  // namespace sheen::renderer
