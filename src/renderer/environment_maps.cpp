#include "renderer/environment_maps.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include <glm/vec4.hpp>

#include "albedo/split_sum.h"
#include "renderer/environment_points.h"
#include "renderer/textures.h"

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

/// A picture being put together of others.
struct Sheet {
  int width, height;
  std::vector<glm::vec4> texels;

  Sheet(int width_, int height_)
      : width(width_), height(height_), texels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), glm::vec4(0.0F)) {}
  glm::vec4& at(int x, int y) {
    return texels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
  }
};

Sheet sheet_with(const scene::Environment& environment, int width, int height) {
  Sheet sheet(std::max(width, environment.width), environment.height + height);
  auto texel = environment.texels.begin();
  for (int y = 0; y < environment.height; ++y) {
    for (int x = 0; x < environment.width; ++x) {
      sheet.at(x, y) = glm::vec4(*texel++, 1.0F);
    }
  }
  return sheet;
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
    Sheet sheet = sheet_with(environment, maps_width, maps_height);
    for (const Kernel kernel : kernels) {
      const FilteredPart last = filtered_parts(kernel).back();
      const int width = filtered_parts(kernel).front().width;
      const image::Image map = kept_.get(hash + "." + kernel_name(kernel), width, last.y + last.height,
                                         [&] { return prefilter(context_, environment, kernel); });
      for (int y = 0; y < map.height; ++y) {
        for (int x = 0; x < map.width; ++x) {
          sheet.at(column_of(kernel) + x, environment.height + y) = {map.at(x, y, 0), map.at(x, y, 1), map.at(x, y, 2), 1.0F};
        }
      }
    }
    return upload_floats(context_.gl(), "the environment with its maps", sheet.width, sheet.height, sheet.texels);
  });
}

GLuint EnvironmentMaps::sampled(const scene::Environment& environment) {
  return hold(image_, scene::content_hash(environment) + " sampled", [&] {
    const ImageSampling sampling(environment);
    Sheet sheet = sheet_with(environment, 0, 0);
    for (std::size_t i = 0; i < sheet.texels.size(); ++i) {
      sheet.texels[i].a = sampling.densities()[i];
    }
    return upload_floats(context_.gl(), "the environment", sheet.width, sheet.height, sheet.texels);
  });
}

GLuint EnvironmentMaps::points(const scene::Environment& environment, int count, std::uint64_t seed) {
  const std::string key = scene::content_hash(environment) + " " + std::to_string(count) + " " + std::to_string(seed);
  return hold(points_, key, [&] {
    std::optional<ImageSampling> sampling;
    if (environment.is_image()) {
      sampling.emplace(environment);
    }
    // However few are asked for, shaders/environment_sampled.glsl draws one of each lobe and two of the image.
    const PointRows rows = point_rows(std::max(count, 2), seed, sampling ? &*sampling : nullptr);
    return upload_floats(context_.gl(), "the points to draw directions with", rows.columns, rows.rows, rows.texels);
  });
}

GLuint EnvironmentMaps::split_sums() {
  return hold(split_sums_, "split sums", [&] {
    const image::Image table = kept_.get("split-sums", split_sum_nodes, split_sum_nodes, build_split_sums);
    Sheet sheet(table.width, table.height);
    for (int y = 0; y < table.height; ++y) {
      for (int x = 0; x < table.width; ++x) {
        sheet.at(x, y) = {table.at(x, y, 0), table.at(x, y, 1), table.at(x, y, 2), 1.0F};
      }
    }
    return upload_floats(context_.gl(), "the table of split sums", sheet.width, sheet.height, sheet.texels);
  });
}

}  // namespace sheen::renderer
