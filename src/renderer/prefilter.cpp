#include "renderer/prefilter.h"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>

#include <glm/vec2.hpp>

#include "renderer/assembly.h"
#include "renderer/environment_points.h"
#include "renderer/picture_texture.h"
#include "renderer/program.h"
#include "renderer/shading.h"
#include "renderer/target.h"
#include "renderer/textures.h"

namespace sheen::renderer {
namespace {

constexpr int points = 1024;  // a lobe that directions are drawn from
// Lobes wider than this are summed over every texel of a level at most so wide: 2.8 degrees, against their 16 and more.
constexpr double narrow_roughness = 0.3;
constexpr int summed_width = 128;
constexpr int levels = 8;

std::optional<albedo::Visibility> visibility_of(Kernel kernel) {
  switch (kernel) {
    case Kernel::SheenCharlie:
      return albedo::Visibility::Charlie;
    case Kernel::SheenAshikhmin:
      return albedo::Visibility::Ashikhmin;
    case Kernel::SheenRefined:
      return albedo::Visibility::Refined;
    default:
      return std::nullopt;
  }
}

std::vector<ShaderFile> files(Kernel kernel) {
  std::vector<ShaderFile> list{{"common.glsl"}, {"textures.glsl"}, {"equirect.glsl"}};
  if (const auto visibility = visibility_of(kernel)) {
    for (const std::string& file : sheen_visibility_files(*visibility)) {
      list.push_back({file});
    }
  }
  list.push_back({"prefilter.frag"});
  return list;
}

ShaderPlan plan(Kernel kernel, bool narrow) {
  ShaderPlan made;
  made.vertex_file = "fullscreen.vert";
  made.fragment_files = files(kernel);
  made.defines = {kernel == Kernel::Diffuse ? "KERNEL_DIFFUSE" : kernel == Kernel::Ggx ? "KERNEL_GGX" : "KERNEL_SHEEN"};
  if (narrow) {
    made.defines.emplace_back("NARROW");
  }
  return made;
}

scene::Texels texels_of(const scene::Environment& environment) {
  scene::Texels texels{environment.width, environment.height, {}};
  texels.rgba.reserve(environment.texels.size());
  for (const glm::vec3& texel : environment.texels) {
    texels.rgba.emplace_back(texel, 1.0F);
  }
  return texels;
}

}  // namespace

const char* kernel_name(Kernel kernel) {
  switch (kernel) {
    case Kernel::Diffuse:
      return "diffuse";
    case Kernel::Ggx:
      return "ggx";
    case Kernel::SheenCharlie:
      return "sheen_charlie";
    case Kernel::SheenAshikhmin:
      return "sheen_ashikhmin";
    case Kernel::SheenRefined:
      return "sheen_refined";
  }
  throw std::invalid_argument("unknown kernel");
}

Kernel sheen_kernel(albedo::Visibility visibility) {
  switch (visibility) {
    case albedo::Visibility::Charlie:
      return Kernel::SheenCharlie;
    case albedo::Visibility::Ashikhmin:
      return Kernel::SheenAshikhmin;
    case albedo::Visibility::Refined:
      return Kernel::SheenRefined;
  }
  throw std::invalid_argument("unknown visibility");
}

std::vector<FilteredPart> filtered_parts(Kernel kernel) {
  if (kernel == Kernel::Diffuse) {
    return {{1.0, 0, 64, 32}};
  }
  std::vector<FilteredPart> parts;
  int y = 0;
  for (int level = 1; level <= levels; ++level) {
    const int height = kernel == Kernel::Ggx ? std::max(256 >> level, 32) : 32;
    parts.push_back({static_cast<double>(level) / levels, y, 2 * height, height});
    y += height;
  }
  return parts;
}

image::Image prefilter(gles::Context& context, const scene::Environment& environment, Kernel kernel) {
  const gles::Functions& gl = context.gl();
  const std::vector<FilteredPart> parts = filtered_parts(kernel);
  const int width = parts.front().width;
  const int height = parts.back().y + parts.back().height;
  int level = 0;
  while (environment.width >> level > summed_width) {
    ++level;
  }
  const PointRows rows = point_rows(points, 0, nullptr);
  const gles::Texture point_texture = upload_floats(gl, "points", rows.columns, rows.rows, rows.texels);
  const gles::Texture picture = upload_mipmapped(gl, "the environment's image", scene::mipmaps(texels_of(environment)));
  const Target target(context, width, height);
  target.begin();
  gl.Disable(GL_DEPTH_TEST);
  gl.Disable(GL_CULL_FACE);
  gl.Disable(GL_BLEND);
  gl.ActiveTexture(GL_TEXTURE0);
  gl.BindTexture(GL_TEXTURE_2D, picture.name());
  gl.ActiveTexture(GL_TEXTURE0 + 1);
  gl.BindTexture(GL_TEXTURE_2D, point_texture.name());
  const gles::VertexArray nothing(gl);
  gl.BindVertexArray(nothing.name());
  for (const bool narrow : {true, false}) {
    const auto is_asked = [&](const FilteredPart& part) { return (kernel == Kernel::Ggx && part.roughness < narrow_roughness) == narrow; };
    if (std::none_of(parts.begin(), parts.end(), is_asked)) {
      continue;
    }
    const Program program(gl, assemble(plan(kernel, narrow), Settings()));
    program.use();
    program.set("u_image", 0);
    program.set("u_image_size", glm::ivec2(environment.width, environment.height));
    program.set("u_points", 1);
    program.set("u_point_count", points);
    program.set("u_level", level);
    program.set("u_rows", height);
    for (const FilteredPart& part : parts) {
      if (!is_asked(part)) {
        continue;
      }
      gl.Viewport(0, height - part.y - part.height, part.width, part.height);
      program.set("u_origin", glm::ivec2(0, part.y));
      program.set("u_size", glm::ivec2(part.width, part.height));
      program.set("u_roughness", part.roughness);
      gl.DrawArrays(GL_TRIANGLES, 0, 3);
    }
  }
  gles::check(gl, std::string("filtering the environment by the lobe ") + kernel_name(kernel));
  return target.read();
}

}  // namespace sheen::renderer
