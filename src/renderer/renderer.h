#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "albedo/sheen_model.h"
#include "gles/context.h"
#include "image/image.h"
#include "scene/environment.h"
#include "scene/scene.h"
#include "scene/view.h"

namespace sheen::renderer {

enum class Precision { Highp, Mediump };
/// The specification's printed shader code, or the same mathematics in a form that keeps its digits.
enum class Formulation { Literal, Stable };
/// Where the shader takes E from.
enum class AlbedoSource { Table, Fit };

/// Of Settings::environment_samples. Mesa's llvmpipe ends the loops of a shader after 65,535 turns in all, and what is left is not drawn.
inline constexpr int most_environment_samples = 50000;

struct Settings {
  scene::View view;
  albedo::SheenModel sheen;
  Precision precision = Precision::Highp;
  Formulation formulation = Formulation::Stable;
  AlbedoSource albedo_source = AlbedoSource::Table;
  const scene::Environment* environment = nullptr;  ///< light from everywhere; must outlive the call
  int environment_samples = 0;                      ///< directions drawn a pixel; 0: it is filtered beforehand instead
  std::uint64_t seed = 0;                           ///< of the directions drawn
  /// Texts that stand in for files of shaders/, by file name: how shaders are tried that this program was not built with. Null: none. Must
  /// outlive the call. What is made of an environment beforehand, and kept, is made without them.
  const std::map<std::string, std::string>* shader_files = nullptr;

  bool prefiltered() const { return environment != nullptr && environment_samples == 0; }
};

/// What a scene requires of the renderer, and no more: what is absent stands in `omitted` alone.
struct Requirements {
  std::vector<std::string> features;       ///< "sheen", "clearcoat", "normal_map", ...
  std::vector<std::string> defines;        ///< every macro any of the scene's shaders is compiled with
  std::vector<std::string> tables;         ///< "sheen_albedo:charlie", "ggx_albedo"
  std::vector<std::string> uniforms;       ///< active uniforms
  std::vector<std::string> texture_units;  ///< "0: base_color_texture"
  std::vector<std::string> omitted;        ///< features the renderer knows and this scene does not use
};

/// Needs no GL context: derived from the scene, by the same code that assembles the shaders.
Requirements requirements(const scene::Scene& scene, const Settings& settings);

/// The GL ES 3 renderer. Programs and tables are made when a scene first needs them and kept for the next.
class Renderer {
 public:
  /// The context must stay alive; it is made current by every call.
  /// @param cache  folder where what is made of environments is kept for the next program; empty: nowhere
  explicit Renderer(gles::Context& context, std::filesystem::path cache = {});
  ~Renderer();

  /// Draws into a 32-bit float target: channels R G B A, radiance over black, rows from the top. Throws gles::Error, scene::Error.
  image::Image render(const scene::Scene& scene, const Settings& settings);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sheen::renderer
