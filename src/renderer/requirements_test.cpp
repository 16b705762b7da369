#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "gles/context.h"
#include "renderer/assembly.h"
#include "renderer/features.h"
#include "renderer/program.h"
#include "renderer/test_scene.h"

namespace sheen::renderer {
namespace {

bool has(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// A material with every layer and every texture.
scene::Scene everything() {
  scene::Scene made = test::square_scene();
  scene::Material& material = made.materials[0];
  material = {};
  material.name = "everything";
  material.has_ior_or_specular = true;
  material.emissive_factor = glm::dvec3(0.5);
  material.sheen.color_factor = glm::dvec3(0.5);
  material.sheen.roughness_factor = 0.5;
  material.clearcoat.factor = 0.5;
  material.clearcoat.roughness_factor = 0.5;
  material.alpha_mode = scene::AlphaMode::Mask;
  material.double_sided = true;
  made.primitives[0].colors.assign(4, {1, 1, 1, 1});
  int number = 0;
  for (scene::TextureInfo* info : {&material.base_color_texture, &material.metallic_roughness_texture, &material.normal_texture,
                                   &material.emissive_texture, &material.specular.factor_texture, &material.specular.color_texture,
                                   &material.sheen.color_texture, &material.sheen.roughness_texture, &material.clearcoat.factor_texture,
                                   &material.clearcoat.roughness_texture, &material.clearcoat.normal_texture}) {
    // One is filtered with mipmaps; the others as cheaply as can be, or compiling takes most of a minute.
    scene::Sampler sampler;
    if (number > 0) {
      sampler = {scene::Wrap::ClampToEdge, scene::Wrap::ClampToEdge, scene::Filter::Nearest, scene::Filter::Nearest,
                 scene::MipFilter::None};
    }
    *info = test::add_texture(made, test::picture(1, 1, {128, 128, 255, 255}), sampler);
    info->texcoord = number % 2;
    if (number % 3 == 0) {
      info->transform[2][0] = 0.25;
    }
    ++number;
  }
  for (const scene::LightType type : {scene::LightType::Point, scene::LightType::Spot}) {
    made.lights.emplace_back();
    made.lights.back().type = type;
  }
  return made;
}

/// Scenes that together switch every feature on and off.
std::vector<scene::Scene> scenes() {
  std::vector<scene::Scene> all{test::square_scene(), everything()};
  const auto add = [&](auto&& change) {
    all.push_back(everything());
    change(all.back());
  };
  add([](scene::Scene& s) { s.cameras[0].perspective = true; });
  add([](scene::Scene& s) { s.materials[0].sheen.color_factor = glm::dvec3(0.0); });
  add([](scene::Scene& s) { s.materials[0].clearcoat.factor = 0.0; });
  add([](scene::Scene& s) { s.materials[0].emissive_factor = glm::dvec3(0.0); });
  add([](scene::Scene& s) { s.materials[0].has_ior_or_specular = false; });
  add([](scene::Scene& s) { s.materials[0].normal_texture = {}; });
  add([](scene::Scene& s) { s.materials[0].clearcoat.normal_texture = {}; });
  add([](scene::Scene& s) { s.materials[0].alpha_mode = scene::AlphaMode::Blend; });
  add([](scene::Scene& s) { s.materials[0].alpha_mode = scene::AlphaMode::Opaque; });
  add([](scene::Scene& s) { s.lights.clear(); });
  add([](scene::Scene& s) { s.lights.clear(), s.materials[0].emissive_factor = glm::dvec3(0.0); });
  add([](scene::Scene& s) { s.lights.resize(1), s.materials[0].double_sided = false, s.primitives[0].colors.clear(); });
  add([](scene::Scene& s) { s.lights.resize(2); });
  add([](scene::Scene& s) { s.lights.erase(s.lights.begin(), s.lights.begin() + 2); });
  add([](scene::Scene& s) { s.lights.resize(static_cast<std::size_t>(max_uniform_lights) + 1); });
  add([](scene::Scene& s) {
    s.textures[1].sampler = {scene::Wrap::MirroredRepeat, scene::Wrap::Repeat, scene::Filter::Linear, scene::Filter::Nearest,
                             scene::MipFilter::Nearest};
  });
  return all;
}

/// Every choice of settings a shader depends on.
std::vector<Settings> every_setting() {
  std::vector<Settings> all;
  using albedo::AlbedoScaling;
  using albedo::Visibility;
  for (const Visibility visibility : brdf::visibilities) {
    for (const AlbedoScaling scaling : {AlbedoScaling::Full, AlbedoScaling::View, AlbedoScaling::None, AlbedoScaling::Literal}) {
      for (const Formulation formulation : {Formulation::Literal, Formulation::Stable}) {
        for (const AlbedoSource source : {AlbedoSource::Table, AlbedoSource::Fit}) {
          if (source == AlbedoSource::Fit && visibility == Visibility::Refined) {
            continue;
          }
          Settings settings;
          settings.sheen = {visibility, scaling};
          settings.formulation = formulation;
          settings.albedo_source = source;
          settings.precision = formulation == Formulation::Stable && source == AlbedoSource::Table ? Precision::Mediump : Precision::Highp;
          all.push_back(settings);
        }
      }
    }
  }
  for (const albedo::Model model : {albedo::Model::Draft2019, albedo::Model::Physical}) {
    for (const Formulation formulation : {Formulation::Literal, Formulation::Stable}) {
      Settings settings;
      settings.sheen.model = model;
      settings.formulation = formulation;
      settings.precision = formulation == Formulation::Stable ? Precision::Mediump : Precision::Highp;
      all.push_back(settings);
    }
  }
  return all;
}

/// Compiles the scene's shader and holds its active uniforms to what requirements() says.
void expect_truth(const gles::Functions& gl, const scene::Scene& scene, const Settings& settings) {
  const ShaderPlan plan = plan_shader(scene, scene.primitives[0], scene.cameras[0], settings);
  const ShaderText text = assemble(plan, settings);
  const Program program(gl, text);
  const Requirements needed = requirements(scene, settings);
  const std::vector<std::string> active = program.active_uniforms();
  EXPECT_EQ(std::set<std::string>(active.begin(), active.end()), std::set<std::string>(needed.uniforms.begin(), needed.uniforms.end()))
      << text.fragment;
  std::set<std::string> named;
  for (const std::string& unit : needed.texture_units) {
    const std::string uniform = "u_" + unit.substr(unit.find(": ") + 2);
    EXPECT_TRUE(has(active, uniform)) << uniform;
    EXPECT_TRUE(named.insert(uniform).second) << uniform << " twice";
  }
  for (const std::string& feature : feature_names()) {
    EXPECT_NE(has(needed.features, feature), has(needed.omitted, feature)) << feature << " is either used or omitted";
  }
}

class EveryShader : public testing::Test {
 protected:
  std::unique_ptr<gles::Context> context_ = gles::Context::create_any(gles::ContextKind::OsMesa);
  gles::CurrentScope scope_{*context_};
};

TEST_F(EveryShader, CompilesForEverySettingAndHasTheUniformsThatRequirementsNames) {
  scene::Scene scene = test::square_scene({});
  scene.materials[0].sheen.color_factor = glm::dvec3(0.5);
  scene.materials[0].clearcoat.factor = 0.5;
  for (const Settings& settings : every_setting()) {
    expect_truth(context_->gl(), scene, settings);
  }
}

TEST_F(EveryShader, CompilesForEveryFeatureAndHasTheUniformsThatRequirementsNames) {
  for (const scene::Scene& scene : scenes()) {
    expect_truth(context_->gl(), scene, Settings{});
  }
  Settings mediump;
  mediump.precision = Precision::Mediump;
  expect_truth(context_->gl(), everything(), mediump);
  for (const albedo::Model model : {albedo::Model::Draft2019, albedo::Model::Physical}) {
    Settings other;
    other.sheen.model = model;
    expect_truth(context_->gl(), everything(), other);
  }
}

TEST_F(EveryShader, CompilesUnderEveryEnvironmentAndHasTheUniformsThatRequirementsNames) {
  scene::Environment uniform;
  uniform.uniform = glm::dvec3(1.0);
  scene::Environment image;
  image.width = 2;
  image.height = 1;
  image.texels.assign(2, glm::vec3(1.0F));
  scene::Scene bare = test::square_scene({});
  bare.lights.clear();
  scene::Scene cloth = bare;
  cloth.materials[0].sheen.color_factor = glm::dvec3(0.5);
  scene::Scene coated = cloth;
  coated.materials[0].clearcoat.factor = 0.5;
  scene::Scene occluded = test::square_scene({});
  occluded.materials[0].occlusion_texture = test::add_texture(occluded, test::picture(1, 1, {128, 128, 255, 255}));
  for (const scene::Environment* environment : {&uniform, &image}) {
    for (const int samples : {0, 16}) {
      Settings settings;
      settings.environment = environment;
      settings.environment_samples = samples;
      for (const scene::Scene* scene : {&bare, &cloth, &coated, &occluded}) {
        expect_truth(context_->gl(), *scene, settings);
      }
      for (const albedo::AlbedoScaling scaling :
           {albedo::AlbedoScaling::View, albedo::AlbedoScaling::None, albedo::AlbedoScaling::Literal}) {
        settings.sheen.scaling = scaling;
        expect_truth(context_->gl(), coated, settings);
      }
    }
  }
}

TEST(Requirements, OnlyTheLobesOfTheSceneAreFilteredOutOfAnEnvironment) {
  scene::Environment image;
  image.width = 2;
  image.height = 1;
  image.texels.assign(2, glm::vec3(1.0F));
  Settings settings;
  settings.environment = &image;
  scene::Scene scene = test::square_scene({});
  const std::vector<std::string> base{"split_sum:ggx", "environment:diffuse", "environment:ggx"};
  EXPECT_EQ(requirements(scene, settings).tables, base);
  scene.materials[0].sheen.color_factor = glm::dvec3(0.5);
  settings.sheen.visibility = albedo::Visibility::Ashikhmin;
  EXPECT_EQ(requirements(scene, settings).tables.back(), "environment:sheen_ashikhmin");
  settings.environment_samples = 64;
  EXPECT_EQ(requirements(scene, settings).tables, std::vector<std::string>{"sheen_albedo:ashikhmin"});
  EXPECT_FALSE(has(requirements(scene, settings).features, "background"));
  image.background = true;
  EXPECT_TRUE(has(requirements(scene, settings).features, "background"));
}

TEST(Requirements, WithoutSheenThereIsNoSheenCodeNoTableAndNoSampler) {
  scene::Scene scene = everything();
  scene.materials[0].sheen.color_factor = glm::dvec3(0.0);
  const Requirements needed = requirements(scene, Settings{});
  EXPECT_TRUE(has(needed.omitted, "sheen"));
  EXPECT_TRUE(needed.tables.empty());
  const ShaderText text = assemble(plan_shader(scene, scene.primitives[0], scene.cameras[0], {}), {});
  for (const auto& list :
       {needed.features, needed.defines, needed.tables, needed.uniforms, needed.texture_units, std::vector{text.vertex}}) {
    for (const std::string& entry : list) {
      EXPECT_EQ(entry.find("heen"), std::string::npos) << entry;
    }
  }
  // material.glsl and main.frag speak of sheen only under #ifdef SHEEN, so the word's absence is looked for in what was assembled beside
  // them.
  for (const ShaderFile& file : plan_shader(scene, scene.primitives[0], scene.cameras[0], {}).fragment_files) {
    EXPECT_EQ(file.name.find("sheen"), std::string::npos) << file.name;
    EXPECT_EQ(file.name.find("albedo"), std::string::npos) << file.name;
  }
}

TEST(Requirements, ATableIsNeededOnlyWhereTheScalingReadsOne) {
  const scene::Scene scene = everything();
  Settings settings;
  EXPECT_EQ(requirements(scene, settings).tables, std::vector<std::string>{"sheen_albedo:charlie"});
  settings.sheen.visibility = albedo::Visibility::Ashikhmin;
  EXPECT_EQ(requirements(scene, settings).tables, std::vector<std::string>{"sheen_albedo:ashikhmin"});
  settings.albedo_source = AlbedoSource::Fit;
  EXPECT_TRUE(requirements(scene, settings).tables.empty());
  settings = {};
  settings.sheen.scaling = albedo::AlbedoScaling::None;
  EXPECT_TRUE(requirements(scene, settings).tables.empty());
}

TEST(Requirements, ThePhysicalModelNeedsItsTableWhereALightIsAndLeavesOutTheLayers) {
  scene::Scene scene = everything();
  Settings settings;
  settings.sheen.model = albedo::Model::Physical;
  const Requirements needed = requirements(scene, settings);
  EXPECT_EQ(needed.tables, std::vector<std::string>{"ggx_albedo"});
  EXPECT_TRUE(has(needed.features, "multiple_scattering"));
  for (const char* name : {"sheen", "clearcoat", "sheen_color_texture", "sheen_roughness_texture", "clearcoat_texture"}) {
    EXPECT_TRUE(has(needed.omitted, name)) << name;
  }
  EXPECT_FALSE(has(requirements(scene, {}).features, "multiple_scattering"));
  scene.lights.clear();
  EXPECT_TRUE(requirements(scene, settings).tables.empty());
}

TEST(Requirements, TheDraftOf2019HasOneVisibilityNoTableAndNoRoughnessOfItsOwn) {
  const scene::Scene scene = everything();
  Settings settings;
  settings.sheen.model = albedo::Model::Draft2019;
  const Requirements needed = requirements(scene, settings);
  EXPECT_TRUE(needed.tables.empty());
  for (const char* name : {"sheen", "sheen_draft_2019", "sheen_visibility_ashikhmin", "sheen_color_texture", "clearcoat"}) {
    EXPECT_TRUE(has(needed.features, name)) << name;
  }
  for (const char* name : {"albedo_scaling", "sheen_visibility_charlie", "sheen_roughness_texture"}) {
    EXPECT_TRUE(has(needed.omitted, name)) << name;
  }
  EXPECT_FALSE(has(needed.uniforms, "u_sheen_roughness_factor"));
  EXPECT_FALSE(has(requirements(scene, {}).features, "sheen_draft_2019"));
}

TEST(Requirements, AMaterialThatNothingDrawsAsksForNothing) {
  scene::Scene scene = everything();
  scene.instances.clear();
  const Requirements needed = requirements(scene, Settings{});
  EXPECT_TRUE(needed.features.empty());
  EXPECT_TRUE(needed.defines.empty());
  EXPECT_TRUE(needed.uniforms.empty());
}

TEST(Requirements, TheRefinedVisibilityHasNoFit) {
  Settings settings;
  settings.sheen.visibility = albedo::Visibility::Refined;
  settings.albedo_source = AlbedoSource::Fit;
  EXPECT_THROW(requirements(everything(), settings), std::invalid_argument);
}

TEST(Requirements, ANormalMapWithoutTangentsIsAnErrorThatNamesTheMaterial) {
  scene::Scene scene = everything();
  scene.primitives[0].tangents.clear();
  try {
    requirements(scene, {});
    FAIL() << "nothing thrown";
  } catch (const scene::Error& why) {
    EXPECT_NE(std::string(why.what()).find("everything"), std::string::npos) << why.what();
  }
}

}  // namespace
}  // namespace sheen::renderer
