#include "golden/frame.h"

#include <algorithm>
#include <cmath>

#include "number/precision.h"

namespace sheen::golden {
namespace {

RayGenerator make_rays(const scene::Scene& scene, const scene::View& view) {
  if (view.width < 1 || view.height < 1) {
    throw scene::Error(scene.file, "view", "width and height must be at least 1");
  }
  return {scene::resolve_camera(scene, view), view.width, view.height};
}

}  // namespace

double displacement(const Settings& settings) {
  return std::ldexp(0.5, -settings.subpixel_bits) +
         8 * number::epsilon<number::Highp> * std::max(settings.view.width, settings.view.height);
}

Frame::Frame(const scene::Scene& scene_in, const Settings& settings_in)
    : scene(scene_in),
      settings(settings_in),
      rays(make_rays(scene_in, settings_in.view)),
      geometry(scene_in),
      reader(scene_in, geometry, rays, settings_in.environment != nullptr, settings_in.sheen.model, displacement(settings_in)),
      tracer(scene_in, geometry, reader, rays),
      lights(prepare_lights(scene_in.lights)),
      model(albedo::resolved(settings_in.sheen)) {
  const bool has_sheen = std::any_of(scene.instances.begin(), scene.instances.end(), [&](const scene::Instance& instance) {
    return reader.layers(scene.primitives[static_cast<std::size_t>(instance.primitive)].material).sheen;
  });
  if (settings.environment != nullptr && settings.environment->is_image()) {
    environment.emplace(*settings.environment);
    directions.emplace(*environment, settings.sampling.seed);
  }
  if (has_sheen) {
    albedo.emplace(model.visibility);
  }
  if (model.model == albedo::Model::Physical) {
    ggx.emplace();
  }
}

Lighting Frame::lighting(const TermFactors& factors) const {
  Lighting lighting;
  lighting.lights = lights.data();
  lighting.light_count = lights.size();
  lighting.sheen = model;
  lighting.albedo.interpolant = albedo ? &*albedo : nullptr;
  lighting.factors = factors;
  lighting.base_albedo.interpolant = ggx ? &*ggx : nullptr;
  return lighting;
}

}  // namespace sheen::golden
