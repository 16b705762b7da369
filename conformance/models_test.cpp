// The renderer's shaders against the golden under each model that may be asked for: two programs written apart.

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "conformance/case_scene.h"
#include "conformance/golden_store.h"
#include "conformance/suite.h"
#include "conformance/test_folder.h"
#include "conformance/verdict.h"
#include "gles/context.h"
#include "renderer/renderer.h"
#include "scene/gltf.h"

namespace sheen::conformance {
namespace {

// Every layer over every base, lit from the front, from the side and from behind, and by what lies near.
constexpr const char* sweep = R"({
  "suite": "models",
  "description": "what a model changes",
  "defaults": {
    "shape": "sphere",
    "size": [56, 56],
    "material": {
      "pbrMetallicRoughness": {"baseColorFactor": [0.9, 0.5, 0.2, 1.0]},
      "emissiveFactor": [0.0, 0.1, 0.2],
      "extensions": {"KHR_materials_sheen": {"sheenColorFactor": [0.9, 0.6, 0.8], "sheenRoughnessFactor": 0.35}}
    },
    "lights": [
      {"type": "directional", "toward": [0.7, 0.5, 0.6], "intensity": 3.0},
      {"type": "directional", "toward": [-0.9, 0.35, -0.25], "color": [0.3, 0.5, 1.0], "intensity": 4.0},
      {"type": "point", "position": [1.3, -1.2, 1.5], "intensity": 9.0}
    ],
    "camera": {"type": "perspective", "position": [0.0, 0.6, 5.2], "target": [0.0, 0.0, 0.0], "yfov": 0.6, "znear": 0.1, "zfar": 100.0}
  },
  "groups": [
    {
      "name": "base.{metallic}.roughness_{roughness}",
      "axes": {
        "metallic": [
          {"label": "dielectric", "patch": {"material": {"pbrMetallicRoughness": {"metallicFactor": 0.0}}}},
          {"label": "mixed", "patch": {"material": {"pbrMetallicRoughness": {"metallicFactor": 0.45}}}},
          {"label": "metal", "patch": {"material": {"pbrMetallicRoughness": {"metallicFactor": 1.0}}}}
        ],
        "roughness": [
          {"label": "0", "patch": {"material": {"pbrMetallicRoughness": {"roughnessFactor": 0.0}}}},
          {"label": "8", "patch": {"material": {"pbrMetallicRoughness": {"roughnessFactor": 0.08}}}},
          {"label": "30", "patch": {"material": {"pbrMetallicRoughness": {"roughnessFactor": 0.3}}}},
          {"label": "65", "patch": {"material": {"pbrMetallicRoughness": {"roughnessFactor": 0.65}}}},
          {"label": "100", "patch": {"material": {"pbrMetallicRoughness": {"roughnessFactor": 1.0}}}}
        ]
      }
    },
    {
      "name": "with.{what}",
      "axes": {
        "what": [
          {"label": "clearcoat", "patch": {"material": {"pbrMetallicRoughness": {"roughnessFactor": 0.4},
            "extensions": {"KHR_materials_clearcoat": {"clearcoatFactor": 0.8, "clearcoatRoughnessFactor": 0.2}}}}},
          {"label": "colored_specular", "patch": {"material": {"pbrMetallicRoughness": {"metallicFactor": 0.2, "roughnessFactor": 0.5},
            "extensions": {"KHR_materials_ior": {"ior": 2.2},
                           "KHR_materials_specular": {"specularFactor": 0.7, "specularColorFactor": [1.0, 0.6, 0.3]}}}}},
          {"label": "ior_zero", "patch": {"material": {"pbrMetallicRoughness": {"metallicFactor": 0.0, "roughnessFactor": 0.5},
            "extensions": {"KHR_materials_ior": {"ior": 0.0}}}}},
          {"label": "a_smooth_metal_in_the_sun", "patch": {"material": {"pbrMetallicRoughness": {"metallicFactor": 1.0, "roughnessFactor": 0.05}},
            "lights": [{"type": "directional", "toward": [1.0, 1.0, 1.0], "intensity": 1e5}]}},
          {"label": "textures", "patch": {"shape": "cloth", "material": {
            "pbrMetallicRoughness": {"metallicRoughnessTexture": {"index": "weave/linear"}, "baseColorTexture": {"index": "channels/linear"}},
            "extensions": {"KHR_materials_sheen": {"sheenColorTexture": {"index": "weave/linear"},
                                                   "sheenRoughnessTexture": {"index": "weave/linear"}}}}}},
          {"label": "normals_bent_away", "patch": {"shape": "ring", "material": {
            "pbrMetallicRoughness": {"metallicFactor": 0.5, "roughnessFactor": 0.45},
            "normalTexture": {"index": "bumps/linear"}}}}
        ]
      }
    }
  ]
})";

class Models : public testing::TestWithParam<albedo::Model> {};

TEST_P(Models, TheRendererStaysInsideTheGoldensBound) {
  const TestFolder folder;
  const std::unique_ptr<gles::Context> context = gles::Context::create_any(gles::ContextKind::OsMesa);
  renderer::Renderer renderer(*context);
  for (const Case& one : parse_suite(sweep, "models").cases) {
    const scene::Scene scene = scene::load_gltf(write_scene(one, folder.path()));
    golden::Settings settings = golden_settings(one, {one.model.visibility, one.model.scaling, GetParam()}, context->info().subpixel_bits);
    for (const renderer::Formulation formulation : {renderer::Formulation::Stable, renderer::Formulation::Literal}) {
      // As printed, D of sheenRoughness 0 divides by zero, and that of a smooth lobe loses its digits.
      if (formulation == renderer::Formulation::Literal && !one.name.ends_with("_65")) {
        continue;
      }
      renderer::Settings drawn;
      drawn.view = settings.view;
      drawn.sheen = settings.sheen;
      drawn.formulation = formulation;
      const Verdict verdict = judge(renderer.render(scene, drawn), golden::render(scene, settings), {});
      EXPECT_EQ(verdict.status, Status::Pass) << one.name << ": " << verdict.message;
      EXPECT_GT(verdict.compared_pixels, 500) << one.name;
      RecordProperty(one.name, std::to_string(verdict.bound_ratio));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, Models, testing::Values(albedo::Model::Ratified, albedo::Model::Draft2019, albedo::Model::Physical),
                         [](const auto& one) {
                           std::string name = to_string(one.param);
                           name.erase(std::remove(name.begin(), name.end(), '-'), name.end());
                           return name;
                         });

// Each differs from the others where it should: a model that is not passed on would pass the test above.
TEST(ModelsDiffer, InWhatTheyChange) {
  const TestFolder folder;
  const Case one = parse_suite(sweep, "models").cases[3];
  const scene::Scene scene = scene::load_gltf(write_scene(one, folder.path()));
  const auto drawn = [&](albedo::Model model) {
    golden::Settings settings = golden_settings(one, {albedo::Visibility::Charlie, albedo::AlbedoScaling::Full, model}, 8);
    settings.bounds = false;
    const image::Image im = golden::render(scene, settings);
    return im.at(28, 28, 0);
  };
  EXPECT_NE(drawn(albedo::Model::Ratified), drawn(albedo::Model::Draft2019));
  EXPECT_NE(drawn(albedo::Model::Ratified), drawn(albedo::Model::Physical));
}

TEST(ModelWords, AreThoseOfTheCommandLineAndPartOfAGoldensKey) {
  for (const albedo::Model model : {albedo::Model::Ratified, albedo::Model::Draft2019, albedo::Model::Physical}) {
    EXPECT_EQ(parse_model(to_string(model)), model);
  }
  EXPECT_THROW(parse_model("draft"), std::invalid_argument);
  golden::Settings settings;
  EXPECT_EQ(settings_text(settings), "512x512 camera 0 charlie full") << "as the committed manifest has it";
  settings.sheen.model = albedo::Model::Physical;
  EXPECT_EQ(settings_text(settings), "512x512 camera 0 charlie full physical");
}

}  // namespace
}  // namespace sheen::conformance
