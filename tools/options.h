#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "albedo/sheen_model.h"
#include "gles/context.h"
#include "renderer/renderer.h"
#include "scene/scene.h"
#include "scene/view.h"
#include "tools/tone_map.h"

namespace sheen::tools {

/// What every command has.
struct Common {
  bool json = false;  ///< one JSON object on stdout, messages on stderr
};

/// The picture to make of a scene: shared by render, golden and explain.
struct SceneOptions : Common {
  std::filesystem::path scene;
  scene::View view;
  albedo::SheenModel sheen;
  std::vector<scene::Light> lights;   ///< --light; when given, they replace the scene's own
  std::string environment;            ///< --environment: "uniform:R,G,B" or a file; empty: none
  double environment_rotation = 0.0;  ///< degrees
  bool background = false;            ///< --background: whether pixels that show no surface show the environment
  std::int64_t seed = 0;
};

struct RenderOptions : SceneOptions {
  std::filesystem::path output;
  gles::ContextKind context = gles::ContextKind::OsMesa;
  renderer::Precision precision = renderer::Precision::Highp;
  renderer::Formulation formulation = renderer::Formulation::Stable;
  renderer::AlbedoSource albedo_source = renderer::AlbedoSource::Table;
  bool verify = false;
  ToneMap tone_map = ToneMap::None;
  double exposure = 0.0;        ///< EV: the radiance written is multiplied by 2^exposure
  int environment_samples = 0;  ///< directions drawn a pixel; 0: the image is filtered beforehand

  renderer::Settings settings(const std::optional<scene::Environment>& around) const {
    return {view,
            sheen,
            precision,
            formulation,
            albedo_source,
            around ? &*around : nullptr,
            environment_samples,
            static_cast<std::uint64_t>(seed)};
  }
};

struct GoldenOptions : SceneOptions {
  std::filesystem::path output;
  std::optional<double> error;          ///< relative standard error that 99 % of the pixels meet when sampling of an image stops
  std::optional<std::int64_t> samples;  ///< directions at most for each surface of a pixel; alone: without regard to the error
};

struct Tolerance {
  double relative = 0.0;
  double absolute = 0.0;
};

struct CompareOptions : Common {
  std::filesystem::path candidate;
  std::filesystem::path reference;
  std::filesystem::path heatmap;  ///< empty: none
  std::optional<Tolerance> tolerance;
};

enum class LutLayout { Plain, Warped };
enum class LutTable { Sheen, Ggx, All };

struct LutOptions : Common {
  std::filesystem::path output;  ///< empty: none is written, and `check` is read
  std::filesystem::path check;
  LutTable table = LutTable::Sheen;
  albedo::Visibility visibility = albedo::Visibility::Charlie;
  int size = 64;
  LutLayout layout = LutLayout::Plain;
};

struct ListOptions : Common {
  std::string suite = "core";
  std::string filter = "*";
};

struct RunOptions : ListOptions {
  std::string viewer = "sheen-cts";
  gles::ContextKind context = gles::ContextKind::OsMesa;
  renderer::Precision precision = renderer::Precision::Highp;
  std::filesystem::path report;   ///< empty: sheen-cts-report/SUITE in the current folder
  std::filesystem::path goldens;  ///< empty: those installed or, in a build tree, the source's
  bool strict = false;
  double case_limit_seconds = 30;
  int environment_samples = 4096;  ///< directions a pixel that our own viewer draws; 0: the real-time way
};

struct JoinOptions : Common {
  std::vector<std::string> runs;  ///< folders, each after NAME= or named by its last part
  std::filesystem::path output;   ///< folder of the joint report
};

struct GoldensOptions : Common {
  std::string suite = "core";
  std::filesystem::path goldens;  ///< empty: as for RunOptions
};

struct ServeOptions : Common {
  gles::ContextKind context = gles::ContextKind::OsMesa;
  renderer::Precision precision = renderer::Precision::Highp;
};

// One function a command; each returns an exit code and throws what main() maps to one. What they print is described in README.
int render(const RenderOptions& options);
int golden(const GoldenOptions& options);
int compare(const CompareOptions& options);
int lut(const LutOptions& options);
int lut_check(const LutOptions& options);
int explain(const RenderOptions& options);
int list(const ListOptions& options);
int run(const RunOptions& options);
int join(const JoinOptions& options);
int goldens_generate(const GoldensOptions& options);
int goldens_verify(const GoldensOptions& options);
int serve(const ServeOptions& options);

}  // namespace sheen::tools
