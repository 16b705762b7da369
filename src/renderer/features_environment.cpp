#include <set>
#include <vector>

#include "renderer/features.h"

namespace sheen::renderer {
namespace {

/// What any shader that looks at the environment itself reads.
void plan_radiance(const scene::Environment& environment, ShaderPlan& plan) {
  plan.defines.emplace_back(environment.is_image() ? "ENVIRONMENT_IMAGE" : "ENVIRONMENT_UNIFORM");
  if (!environment.is_image()) {
    plan.uniforms.emplace_back("u_environment_uniform");
    return;
  }
  plan.environment_image = true;
  for (const char* uniform : {"u_environment", "u_environment_size", "u_environment_from_view"}) {
    plan.uniforms.emplace_back(uniform);
  }
}

}  // namespace

void plan_environment(const Settings& settings, bool sheen, ShaderPlan& plan) {
  plan.defines.emplace_back("ENVIRONMENT");
  plan.features.emplace_back(settings.environment->is_image() ? "environment_image" : "environment_uniform");
  plan.features.emplace_back(settings.prefiltered() ? "environment_prefiltered" : "environment_sampled");
  plan_radiance(*settings.environment, plan);
  const albedo::SheenModel model = albedo::resolved(settings.sheen);
  if (settings.prefiltered()) {
    // The physical base has sums of its own, and no coat.
    if (model.model != albedo::Model::Physical) {
      plan.split_sum_table = true;
      plan.uniforms.emplace_back("u_split_sum");
    }
    if (plan.environment_image) {
      plan.kernels = {Kernel::Diffuse, Kernel::Ggx};
      if (sheen) {
        plan.kernels.push_back(sheen_kernel(model.visibility));
      }
    }
    return;
  }
  plan.environment_points = true;
  plan.uniforms.emplace_back("u_environment_points");
  plan.uniforms.emplace_back("u_environment_samples");
}

std::vector<Kernel> kernels_of(const std::vector<ShaderPlan>& plans) {
  std::set<Kernel> kernels;
  for (const ShaderPlan& plan : plans) {
    kernels.insert(plan.kernels.begin(), plan.kernels.end());
  }
  return {kernels.begin(), kernels.end()};
}

ShaderPlan plan_background(const Settings& settings) {
  ShaderPlan plan;
  plan.vertex_file = "fullscreen.vert";
  plan.features = {"background"};
  if (settings.environment->is_image()) {
    plan.uniforms = {"u_viewport", "u_view_extent"};
  }
  plan_radiance(*settings.environment, plan);
  plan.fragment_files = {{"common.glsl"}, {"environment.glsl"}, {"background.frag"}};
  if (settings.environment->is_image()) {
    plan.fragment_files = {{"common.glsl"}, {"textures.glsl"}, {"equirect.glsl"}, {"environment.glsl"}, {"background.frag"}};
  }
  return plan;
}

}  // namespace sheen::renderer
