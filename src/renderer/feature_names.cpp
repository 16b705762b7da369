#include <algorithm>

#include "renderer/features.h"
#include "renderer/texture_slots.h"

namespace sheen::renderer {

const std::vector<std::string>& feature_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all{"perspective_camera",
                                 "orthographic_camera",
                                 "directional_light",
                                 "point_light",
                                 "spot_light",
                                 "many_lights",
                                 "environment_uniform",
                                 "environment_image",
                                 "environment_prefiltered",
                                 "environment_sampled",
                                 "background",
                                 "base",
                                 "multiple_scattering",
                                 "specular",
                                 "sheen",
                                 "sheen_draft_2019",
                                 "sheen_visibility_charlie",
                                 "sheen_visibility_ashikhmin",
                                 "sheen_visibility_refined",
                                 "albedo_scaling",
                                 "sheen_albedo_table",
                                 "sheen_albedo_fit",
                                 "clearcoat",
                                 "emission",
                                 "alpha_mask",
                                 "alpha_blend",
                                 "double_sided",
                                 "vertex_color",
                                 "second_texcoord",
                                 "texture_transform"};
    for (const TextureSlot& slot : texture_slots) {
      all.emplace_back(slot.name);
    }
    return all;
  }();
  return names;
}

std::vector<std::string> texture_units(const std::vector<ShaderPlan>& plans) {
  std::vector<std::string> units;
  const auto any = [&](auto&& holds) { return std::any_of(plans.begin(), plans.end(), holds); };
  for (const TextureSlot& slot : texture_slots) {
    if (any([&](const ShaderPlan& plan) { return plan.has(slot.name); })) {
      units.emplace_back(slot.name);
    }
  }
  if (any([](const ShaderPlan& plan) { return plan.sheen_albedo_table; })) {
    units.emplace_back("sheen_albedo");
  }
  if (any([](const ShaderPlan& plan) { return plan.ggx_albedo_table; })) {
    units.emplace_back("ggx_albedo");
  }
  if (any([](const ShaderPlan& plan) { return plan.light_texture; })) {
    units.emplace_back("lights");
  }
  if (any([](const ShaderPlan& plan) { return plan.environment_image; })) {
    units.emplace_back("environment");
  }
  if (any([](const ShaderPlan& plan) { return plan.split_sum_table; })) {
    units.emplace_back("split_sum");
  }
  if (any([](const ShaderPlan& plan) { return plan.environment_points; })) {
    units.emplace_back("environment_points");
  }
  return units;
}

}  // namespace sheen::renderer
