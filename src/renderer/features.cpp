#include "renderer/features.h"

#include <algorithm>
#include <stdexcept>

#include "renderer/feature_words.h"
#include "renderer/picture_texture.h"
#include "renderer/shading.h"
#include "renderer/texture_slots.h"

namespace sheen::renderer {
namespace {

using scene::LightType;
using scene::Material;
using scene::TextureInfo;

/// Makes a plan step by step.
class Planner {
 public:
  Planner(const scene::Scene& scene, const scene::Primitive& primitive, const scene::Camera& camera, const Settings& settings)
      : scene_(scene),
        primitive_(primitive),
        material_(scene.materials.at(static_cast<std::size_t>(primitive.material))),
        settings_(settings),
        punctual_(!scene.lights.empty()),
        sheen_model_(albedo::resolved(settings.sheen)),
        physical_(sheen_model_.model == albedo::Model::Physical),
        // Without a light nothing is reflected: what is left is the emission under its coat, and coverage.
        lit_(punctual_ || settings.environment != nullptr),
        emission_(material_.emissive_factor != glm::dvec3(0.0)),
        sheen_(lit_ && !physical_ && material_.sheen.enabled()),
        clearcoat_((lit_ || emission_) && !physical_ && material_.clearcoat.enabled()),
        base_color_(lit_ || material_.alpha_mode != scene::AlphaMode::Opaque) {
    plan_.normals = lit_ || clearcoat_;
    constants();
    geometry(camera);
    textures();
    if (lit_) {
      define("LIT");
    }
    if (punctual_) {
      lights();
    }
    if (settings_.environment != nullptr) {
      plan_environment(settings_, sheen_, plan_);
    }
    material();
    if (sheen_) {
      sheen();
    }
    files();
    sort_features();
  }

  ShaderPlan take() { return std::move(plan_); }

 private:
  void feature(const std::string& name) { plan_.features.push_back(name); }
  void define(const std::string& name) { plan_.defines.push_back(name); }
  void uniform(const std::string& name) { plan_.uniforms.push_back(name); }

  void constants() {
    plan_.defines = shading_limits(settings_.precision);
    if (plan_.normals) {
      define(formulation_define(settings_.formulation));
    }
  }

  void geometry(const scene::Camera& camera) {
    uniform("u_clip_from_local");
    feature(camera.perspective ? "perspective_camera" : "orthographic_camera");
    if (plan_.normals) {
      define("NORMAL");
      if (!camera.perspective) {
        define("ORTHOGRAPHIC");
      }
      uniform("u_view_from_local");
      uniform("u_normal_from_local");
    }
    if (material_.double_sided) {
      feature("double_sided");
      if (plan_.normals) {
        define("DOUBLE_SIDED");
      }
    }
    if (base_color_ && !primitive_.colors.empty()) {
      feature("vertex_color");
      define("VERTEX_COLOR");
      plan_.colors = true;
    }
  }

  /// Whether a layer that reads this texture is drawn at all.
  bool read(const std::string& name) const {
    if (name == "base_color_texture") {
      return base_color_;
    }
    if (name == "emissive_texture") {
      return emission_;
    }
    if (name == "occlusion_texture") {
      return settings_.environment != nullptr;
    }
    if (name == "specular_texture" || name == "specular_color_texture") {
      return lit_ && material_.has_ior_or_specular;
    }
    if (name == "sheen_color_texture") {
      return sheen_;
    }
    if (name == "sheen_roughness_texture") {
      return sheen_ && !draft();
    }
    if (name == "clearcoat_texture" || name == "clearcoat_normal_texture") {
      return clearcoat_;
    }
    if (name == "clearcoat_roughness_texture") {
      return lit_ && clearcoat_;
    }
    return lit_;
  }

  void textures() {
    for (const TextureSlot& slot : texture_slots) {
      const TextureInfo& info = slot.of(material_);
      if (!info.present() || !read(slot.name)) {
        continue;
      }
      texture({slot.name, &info, slot.space, info.transform != glm::dmat3(1.0)});
    }
    for (std::size_t set = 0; set < 2; ++set) {
      if (plan_.texcoords[set]) {
        define("TEXCOORD_" + std::to_string(set));
      }
    }
    if (plan_.texcoords[1]) {
      feature("second_texcoord");
    }
    if (plan_.tangents) {
      if (primitive_.tangents.empty()) {
        throw scene::Error(scene_.file, "material '" + material_.name + "'",
                           "its normal map needs a primitive with TANGENT (glTF 2.0, section 3.7.2.1)");
      }
      define("TANGENT");
    }
  }

  void texture(const TextureUse& use) {
    const std::string macro = upper(use.name);
    const std::string coordinates = "v_texcoord_" + std::to_string(use.info->texcoord);
    const scene::Texture& source = scene_.textures.at(static_cast<std::size_t>(use.info->texture));
    const scene::Sampler& sampler = source.sampler;
    const Storage storage = storage_of(scene_.pictures.at(static_cast<std::size_t>(source.picture)), use.space);
    feature(use.name);
    define(macro);
    uniform("u_" + use.name);
    uniform("u_" + use.name + "_size");
    if (use.transformed) {
      feature("texture_transform");
      define(macro + "_TRANSFORM");
      define(macro + "_UV=(u_" + use.name + "_transform * vec3(" + coordinates + ", 1.0)).xy");
      uniform("u_" + use.name + "_transform");
    } else {
      define(macro + "_UV=" + coordinates);
    }
    std::string state = "u_" + use.name + "_size";
    for (const int value : {static_cast<int>(sampler.wrap_s), static_cast<int>(sampler.wrap_t), static_cast<int>(sampler.mag),
                            static_cast<int>(sampler.min), static_cast<int>(sampler.mip), static_cast<int>(storage)}) {
      state += ", " + std::to_string(value);
    }
    define(macro + "_SAMPLER=" + state);
    plan_.texcoords[use.info->texcoord] = true;
    if (use.name == "normal_texture" || use.name == "clearcoat_normal_texture") {
      plan_.tangents = true;
      uniform(use.name == "normal_texture" ? "u_normal_scale" : "u_clearcoat_normal_scale");
    }
    if (use.name == "occlusion_texture") {
      uniform("u_occlusion_strength");
    }
    plan_.textures.push_back(use);
  }

  void lights() {
    define("LIGHTS");
    const auto any = [&](LightType type) {
      return std::any_of(scene_.lights.begin(), scene_.lights.end(), [&](const scene::Light& light) { return light.type == type; });
    };
    if (any(LightType::Directional)) {
      feature("directional_light"), define("LIGHT_DIRECTIONAL");
    }
    if (any(LightType::Point)) {
      feature("point_light"), define("LIGHT_POINT");
    }
    if (any(LightType::Spot)) {
      feature("spot_light"), define("LIGHT_SPOT");
    }
    if (scene_.lights.size() > static_cast<std::size_t>(max_uniform_lights)) {
      feature("many_lights");
      define("MANY_LIGHTS");
      plan_.light_texture = true;
    } else {
      define("MAX_UNIFORM_LIGHTS=" + std::to_string(max_uniform_lights));
    }
    uniform("u_light_count");
    uniform("u_lights");
  }

  void material() {
    if (base_color_) {
      define("BASE_COLOR");
      uniform("u_base_color_factor");
    }
    if (lit_ && physical_) {
      feature("multiple_scattering");
      define("BASE_PHYSICAL");
      plan_.ggx_albedo_table = true;
      uniform("u_ggx_albedo");
    }
    if (lit_) {
      feature("base");
      uniform("u_metallic_factor");
      uniform("u_roughness_factor");
      if (material_.has_ior_or_specular) {
        feature("specular");
        define("SPECULAR");
        for (const char* name : {"u_specular_f0", "u_specular_factor", "u_specular_color_factor"}) {
          uniform(name);
        }
      }
    }
    if (clearcoat_) {
      feature("clearcoat");
      define("CLEARCOAT");
      uniform("u_clearcoat_factor");
      if (lit_) {
        uniform("u_clearcoat_roughness_factor");
      }
    }
    if (emission_) {
      feature("emission");
      define("EMISSION");
      uniform("u_emissive_factor");
    }
    if (material_.alpha_mode == scene::AlphaMode::Mask) {
      feature("alpha_mask");
      define("ALPHA_MASK");
      uniform("u_alpha_cutoff");
    }
    if (material_.alpha_mode == scene::AlphaMode::Blend) {
      feature("alpha_blend");
      define("ALPHA_BLEND");
    }
  }

  bool draft() const { return sheen_model_.model == albedo::Model::Draft2019; }

  void sheen() {
    const std::string visibility = visibility_name(sheen_model_.visibility);
    feature("sheen");
    feature("sheen_visibility_" + visibility);
    define("SHEEN");
    define("VISIBILITY_" + upper(visibility));
    if (settings_.formulation == Formulation::Stable) {
      define(smallest_sheen_roughness_define);
    }
    uniform("u_sheen_color_factor");
    if (draft()) {
      feature("sheen_draft_2019");
      define("SHEEN_DRAFT_2019");
    } else {
      uniform("u_sheen_roughness_factor");
    }
    define("ALBEDO_SCALING_" + upper(scaling_name(sheen_model_.scaling)));
    const bool scaled = sheen_model_.scaling != albedo::AlbedoScaling::None;
    if (scaled) {
      feature("albedo_scaling");
    } else if (!settings_.prefiltered()) {
      return;
    }
    if (settings_.albedo_source == AlbedoSource::Table) {
      feature("sheen_albedo_table");
      plan_.sheen_albedo_table = true;
      uniform("u_sheen_albedo");
      return;
    }
    if (sheen_model_.visibility == albedo::Visibility::Refined) {
      throw std::invalid_argument("the refined visibility has no fit of its directional albedo; take the table");
    }
    feature("sheen_albedo_fit");
  }

  void files() {
    const auto add = [&](const std::string& name) { plan_.fragment_files.push_back(shader_file(name)); };
    add("common.glsl");
    if (!plan_.textures.empty() || plan_.environment_image) {
      add("textures.glsl");
    }
    add("material.glsl");
    if (plan_.normals) {
      add("shading_frame.glsl");
      add("layer_view.glsl");
    }
    if (punctual_) {
      add("lights.glsl");
    }
    if (plan_.normals) {
      add("fresnel.glsl");
    }
    if (lit_) {
      if (physical_) {
        add("ggx_albedo.glsl");
      }
      add("specular_ggx.glsl");
      add(physical_ ? "base_physical.glsl" : "base.glsl");
    }
    if (sheen_) {
      add("sheen_distribution.glsl");
      for (const std::string& file : sheen_visibility_files(sheen_model_.visibility)) {
        add(file);
      }
      add("sheen.glsl");
      if (draft()) {
        add("sheen_draft_2019.glsl");
      }
      if (sheen_model_.scaling != albedo::AlbedoScaling::None || settings_.prefiltered()) {
        add(plan_.sheen_albedo_table ? "sheen_albedo.glsl" : "sheen_albedo_fit.glsl");
      }
      if (sheen_model_.scaling != albedo::AlbedoScaling::None) {
        add("albedo_scaling.glsl");
      }
    }
    if (clearcoat_) {
      add("clearcoat.glsl");
    }
    if (lit_) {
      add("layers.glsl");
    }
    if (settings_.environment != nullptr) {
      if (plan_.environment_image) {
        add("equirect.glsl");
      }
      add("environment.glsl");
      add("environment_mirror.glsl");
      add(settings_.prefiltered() ? "environment_prefiltered.glsl" : "environment_sampled.glsl");
    }
    add("main.frag");
  }

  /// Features in the order of feature_names(), each once.
  void sort_features() {
    std::vector<std::string> sorted;
    for (const std::string& name : feature_names()) {
      if (plan_.has(name)) {
        sorted.push_back(name);
      }
    }
    plan_.features = std::move(sorted);
  }

  const scene::Scene& scene_;
  const scene::Primitive& primitive_;
  const Material& material_;
  const Settings& settings_;
  bool punctual_;
  albedo::SheenModel sheen_model_;
  bool physical_;
  bool lit_;
  bool emission_;
  bool sheen_;
  bool clearcoat_;
  bool base_color_;
  ShaderPlan plan_;
};

}  // namespace

bool ShaderPlan::has(const std::string& feature) const {
  return std::find(features.begin(), features.end(), feature) != features.end();
}

ShaderPlan plan_shader(const scene::Scene& scene, const scene::Primitive& primitive, const scene::Camera& camera,
                       const Settings& settings) {
  return Planner(scene, primitive, camera, settings).take();
}

}  // namespace sheen::renderer
