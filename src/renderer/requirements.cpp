#include <algorithm>
#include <set>

#include "renderer/features.h"

namespace sheen::renderer {
namespace {

void unite(std::set<std::string>& all, const std::vector<std::string>& some) {
  all.insert(some.begin(), some.end());
}

std::vector<std::string> listed(const std::set<std::string>& all) {
  return {all.begin(), all.end()};
}

const char* table_name(albedo::Visibility visibility) {
  switch (visibility) {
    case albedo::Visibility::Charlie:
      return "sheen_albedo:charlie";
    case albedo::Visibility::Ashikhmin:
      return "sheen_albedo:ashikhmin";
    case albedo::Visibility::Refined:
      return "sheen_albedo:refined";
  }
  return "";
}

}  // namespace

Requirements requirements(const scene::Scene& scene, const Settings& settings) {
  const scene::Camera camera = scene::resolve_camera(scene, settings.view);
  std::vector<ShaderPlan> plans;
  std::set<int> seen;
  for (const scene::Instance& instance : scene.instances) {
    if (!seen.insert(instance.primitive).second) {
      continue;
    }
    plans.push_back(plan_shader(scene, scene.primitives.at(static_cast<std::size_t>(instance.primitive)), camera, settings));
  }
  if (settings.environment != nullptr && settings.environment->background) {
    plans.push_back(plan_background(settings));
  }
  std::set<std::string> defines;
  std::set<std::string> uniforms;
  Requirements needed;
  for (const ShaderPlan& plan : plans) {
    unite(defines, plan.defines);
    unite(uniforms, plan.uniforms);
  }
  for (const std::string& name : feature_names()) {
    const bool used = std::any_of(plans.begin(), plans.end(), [&](const ShaderPlan& plan) { return plan.has(name); });
    (used ? needed.features : needed.omitted).push_back(name);
  }
  needed.defines = listed(defines);
  needed.uniforms = listed(uniforms);
  const std::vector<std::string> units = texture_units(plans);
  for (std::size_t unit = 0; unit < units.size(); ++unit) {
    needed.texture_units.push_back(std::to_string(unit) + ": " + units[unit]);
    if (units[unit] == "sheen_albedo") {
      needed.tables.emplace_back(table_name(settings.sheen.visibility));
    } else if (units[unit] == "ggx_albedo") {
      needed.tables.emplace_back("ggx_albedo");
    }
    if (units[unit] == "split_sum") {
      needed.tables.emplace_back("split_sum:ggx");
    }
  }
  for (const Kernel kernel : kernels_of(plans)) {
    needed.tables.push_back(std::string("environment:") + kernel_name(kernel));
  }
  return needed;
}

}  // namespace sheen::renderer
