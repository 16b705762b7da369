#include "renderer/environment_maps.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <glm/vec4.hpp>

#include "albedo/split_sum.h"
#include "renderer/environment_points.h"
#include "renderer/textures.h"
#include "renderer/unfiltered_texture.h"

namespace sheen::renderer {
namespace {

// shaders/environment_prefiltered.glsl: where the kernels' maps stand below the image, and how much room they take.
constexpr int sheen_column = 256;
constexpr int diffuse_column = 320;
constexpr int maps_width = 384;
constexpr int maps_height = 384;

constexpr int split_sum_nodes = 64;  // along each axis

int column_of(Kernel kernel) {
  switch (kernel) {
    case Kernel::Ggx:
      return 0;
    case Kernel::Diffuse:
      return diffuse_column;
    default:
      return sheen_column;
  }
}

/// An RGBA32F texture that is put together of pictures.
class Sheet {
 public:
  Sheet(const gles::Functions& gl, std::string what, int width, int height)
      : gl_(gl), what_(std::move(what)), texture_(unfiltered_texture(gl, what_, GL_RGBA32F, GL_RGBA, GL_FLOAT, width, height, nullptr)) {}

  /// The texels that texel(x, y) gives, from (left, top) on.
  template <class Texel>
  void put(int left, int top, int width, int height, const Texel& texel) {
    constexpr int band = 32;  // rows: of an image of 4,096 columns, two megabytes
    std::vector<glm::vec4> texels;
    for (int first = 0; first < height; first += band) {
      const int rows = std::min(band, height - first);
      texels.clear();
      for (int y = first; y < first + rows; ++y) {
        for (int x = 0; x < width; ++x) {
          texels.push_back(texel(x, y));
        }
      }
      gl_.TexSubImage2D(GL_TEXTURE_2D, 0, left, top + first, width, rows, GL_RGBA, GL_FLOAT, texels.data());
    }
  }

  /// The first three channels of a picture.
  void put(int left, int top, const image::Image& picture) {
    put(left, top, picture.width, picture.height,
        [&](int x, int y) { return glm::vec4(picture.at(x, y, 0), picture.at(x, y, 1), picture.at(x, y, 2), 1.0F); });
  }

  /// Throws gles::Error where anything went wrong.
  gles::Texture take() {
    gles::check(gl_, "uploading " + what_);
    return std::move(texture_);
  }

 private:
  const gles::Functions& gl_;
  std::string what_;
  gles::Texture texture_;  // stays bound
};

std::size_t texel_index(const scene::Environment& environment, int x, int y) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(environment.width) + static_cast<std::size_t>(x);
}

image::Image build_split_sums() {
  std::vector<double> cosines;
  std::vector<double> roughness;
  for (int i = 0; i < split_sum_nodes; ++i) {
    const double at = static_cast<double>(i) / (split_sum_nodes - 1);
    cosines.push_back(at * at);
    roughness.push_back(at);
  }
  const std::vector<albedo::SplitSum> sums = albedo::evaluate_split_sum_grid(cosines, roughness);
  image::Image picture(split_sum_nodes, split_sum_nodes, {"R", "G", "B"});
  for (int x = 0; x < split_sum_nodes; ++x) {
    const double diffuse = albedo::diffuse_fresnel(cosines[static_cast<std::size_t>(x)]);
    for (int y = 0; y < split_sum_nodes; ++y) {
      const albedo::SplitSum& sum = sums[static_cast<std::size_t>(y * split_sum_nodes + x)];
      picture.at(x, y, 0) = static_cast<float>(sum.scale);
      picture.at(x, y, 1) = static_cast<float>(sum.bias);
      picture.at(x, y, 2) = static_cast<float>(diffuse);
    }
  }
  return picture;
}

}  // namespace

template <class Make>
GLuint EnvironmentMaps::hold(Held& held, const std::string& key, const Make& make) {
  if (!held.texture || held.key != key) {
    held.texture.reset();
    held.texture.emplace(make());
    held.key = key;
  }
  return held.texture->name();
}

GLuint EnvironmentMaps::prefiltered(const scene::Environment& environment, const std::vector<Kernel>& kernels) {
  const std::string hash = scene::content_hash(environment);
  std::string key = hash;
  for (const Kernel kernel : kernels) {
    key += std::string(" ") + kernel_name(kernel);
  }
  return hold(image_, key, [&] {
    std::vector<image::Image> maps;  // filtering binds textures of its own
    for (const Kernel kernel : kernels) {
      const FilteredPart last = filtered_parts(kernel).back();
      maps.push_back(kept_.get(hash + "." + kernel_name(kernel), filtered_parts(kernel).front().width, last.y + last.height,
                               [&] { return prefilter(context_, environment, kernel); }));
    }
    Sheet sheet(context_.gl(), "the environment with its maps", std::max(maps_width, environment.width), environment.height + maps_height);
    sheet.put(0, 0, environment.width, environment.height,
              [&](int x, int y) { return glm::vec4(environment.texels[texel_index(environment, x, y)], 1.0F); });
    for (std::size_t i = 0; i < maps.size(); ++i) {
      sheet.put(column_of(kernels[i]), environment.height, maps[i]);
    }
    return sheet.take();
  });
}

GLuint EnvironmentMaps::sampled(const scene::Environment& environment) {
  return hold(image_, scene::content_hash(environment) + " sampled", [&] {
    const ImageSampling sampling(environment);
    Sheet sheet(context_.gl(), "the environment", environment.width, environment.height);
    sheet.put(0, 0, environment.width, environment.height, [&](int x, int y) {
      const std::size_t i = texel_index(environment, x, y);
      return glm::vec4(environment.texels[i], sampling.densities()[i]);
    });
    return sheet.take();
  });
}

GLuint EnvironmentMaps::points(const scene::Environment& environment, int count, std::uint64_t seed) {
  const std::string key = scene::content_hash(environment) + " " + std::to_string(count) + " " + std::to_string(seed);
  return hold(points_, key, [&] {
    std::optional<ImageSampling> sampling;
    if (environment.is_image()) {
      sampling.emplace(environment);
    }
    const PointRows rows = point_rows(count, seed, sampling ? &*sampling : nullptr);
    return upload_floats(context_.gl(), "the points to draw directions with", rows.columns, rows.rows, rows.texels);
  });
}

GLuint EnvironmentMaps::split_sums() {
  return hold(split_sums_, "split sums", [&] {
    const image::Image table = kept_.get("split-sums", split_sum_nodes, split_sum_nodes, build_split_sums);
    Sheet sheet(context_.gl(), "the table of split sums", table.width, table.height);
    sheet.put(0, 0, table);
    return sheet.take();
  });
}

}  // namespace sheen::renderer
