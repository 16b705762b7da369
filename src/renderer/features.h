#pragma once

#include <string>
#include <vector>

#include "renderer/prefilter.h"
#include "renderer/renderer.h"
#include "scene/scene.h"
#include "scene/texels.h"

namespace sheen::renderer {

/// Lights up to this number stand in a uniform array: 64 of the 224 fragment vectors that OpenGL ES 3.0.6, table 6.33, promises. More of
/// them stand in a texture.
inline constexpr int max_uniform_lights = 16;

/// A texture a shader reads.
struct TextureUse {
  std::string name;                          ///< "base_color_texture"; the sampler is u_NAME, its matrix u_NAME_transform
  const scene::TextureInfo* info = nullptr;  ///< in the scene the plan was made of
  scene::ColorSpace space = scene::ColorSpace::Linear;
  bool transformed = false;  ///< whether KHR_texture_transform is anything but the identity
};

/// A shader file and the default precision it is compiled with.
struct ShaderFile {
  std::string name;
  bool shading = false;  ///< its floats follow Settings::precision; all else is highp
};

/// What one primitive needs of a shader, and no more. Everything that draws it or tells of it goes by this.
struct ShaderPlan {
  std::vector<std::string> features;  ///< of feature_names(), in their order
  std::vector<std::string> defines;   ///< "NAME" or "NAME=VALUE"
  std::string vertex_file = "main.vert";
  std::vector<ShaderFile> fragment_files;
  std::vector<std::string> uniforms;  ///< every active uniform, of both stages, without samplers
  std::vector<TextureUse> textures;
  bool sheen_albedo_table = false;  ///< reads u_sheen_albedo
  bool ggx_albedo_table = false;    ///< reads u_ggx_albedo
  bool light_texture = false;       ///< reads the lights from a texture
  bool split_sum_table = false;     ///< reads u_split_sum
  bool environment_image = false;   ///< reads u_environment
  bool environment_points = false;  ///< reads u_environment_points
  std::vector<Kernel> kernels;      ///< the filtered maps of u_environment that it reads
  bool normals = false, tangents = false, colors = false;
  bool texcoords[2] = {false, false};

  bool has(const std::string& feature) const;
};

/// Every feature the renderer knows.
const std::vector<std::string>& feature_names();

/// What a primitive of a scene, seen by a camera, needs. Throws scene::Error where a normal map meets a primitive without tangents, and
/// std::invalid_argument for a fit of the refined visibility, which nobody has published.
ShaderPlan plan_shader(const scene::Scene& scene, const scene::Primitive& primitive, const scene::Camera& camera, const Settings& settings);

/// Adds what light from everywhere needs of a shader, but for the material's own inputs. `sheen`: the material has that layer.
void plan_environment(const Settings& settings, bool sheen, ShaderPlan& plan);

/// The shader that fills a picture with the environment.
ShaderPlan plan_background(const Settings& settings);

/// The textures a scene's plans read, each name once, in the order of their texture units: the materials' first.
std::vector<std::string> texture_units(const std::vector<ShaderPlan>& plans);

/// The filtered maps that any of the plans reads, each once.
std::vector<Kernel> kernels_of(const std::vector<ShaderPlan>& plans);

}  // namespace sheen::renderer
