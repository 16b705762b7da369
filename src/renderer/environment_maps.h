#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "gles/context.h"
#include "gles/objects.h"
#include "renderer/prefilter.h"
#include "scene/environment.h"

namespace sheen::renderer {

/// The textures that shaders read an environment from; each is made when first asked for and kept until another takes its place. The
/// filtered maps and the split sums are also kept in a folder, under a hash of the image.
class EnvironmentMaps {
 public:
  /// @param folder  where filtered maps outlive the program; empty: nowhere. One that cannot be written costs time alone.
  EnvironmentMaps(gles::Context& context, std::filesystem::path folder) : context_(context), folder_(std::move(folder)) {}

  /// RGBA32F: the image, below it its maps filtered by the kernels given.
  GLuint prefiltered(const scene::Environment& environment, const std::vector<Kernel>& kernels);
  /// RGBA32F: the image, in its alpha what density directions are drawn with.
  GLuint sampled(const scene::Environment& environment);
  /// RGBA32F: points of the unit square and directions drawn from the image, if the environment has one.
  GLuint points(const scene::Environment& environment, int count, std::uint64_t seed);
  /// RGBA32F: the table of split sums.
  GLuint split_sums();

 private:
  struct Kept {
    std::string key;
    std::optional<gles::Texture> texture;
  };
  template <class Make>
  static GLuint keep(Kept& kept, const std::string& key, const Make& make);
  template <class Make>
  image::Image from_folder(const std::string& name, int width, int height, const Make& make) const;

  gles::Context& context_;
  std::filesystem::path folder_;
  Kept image_, points_, split_sums_;
};

}  // namespace sheen::renderer
