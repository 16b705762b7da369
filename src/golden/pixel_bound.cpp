#include "golden/pixel_bound.h"

#include <algorithm>
#include <cmath>

#include "golden/bound_all.h"

namespace sheen::golden {
namespace {

std::vector<PreparedLight> seen_from(const RayGenerator& rays, std::vector<PreparedLight> lights) {
  for (PreparedLight& light : lights) {
    light.position = rays.in_view(light.position);
    light.axis = rays.view_from_world() * light.axis;
  }
  return lights;
}

}  // namespace

PixelBound::PixelBound(const Frame& frame)
    : frame_(frame),
      near_misses_(frame),
      reader_(frame.geometry, frame.rays, frame.reader, frame.model.model),
      lights_(seen_from(frame.rays, frame.lights)),
      albedos_(frame.scene.materials.size()) {
  if (frame.settings.environment != nullptr && frame.settings.drawn_directions > 0) {
    drawn_image_.emplace(*frame.settings.environment, frame.rays.view_from_world());
  }
}

void PixelBound::make(Albedos& albedos, const SurfaceReader::Material& material) const {
  if (material.source == nullptr) {
    return;
  }
  if (frame_.ggx && (!material.metallic_roughness.texture || material.source->roughness_factor == 0.0)) {
    const Bound roughness(material.source->roughness_factor);
    albedos.base.emplace(ggx_around(*frame_.ggx, roughness * roughness));
  }
  if (frame_.albedo && material.layers.sheen && !material.sheen_roughness.texture && frame_.model.model != brdf::Model::Draft2019) {
    albedos.sheen.emplace(*frame_.albedo, Bound(material.source->sheen.roughness_factor));
  }
}

double PixelBound::step(const Seen& seen) const {
  const double grid = std::ldexp(0.5, -frame_.settings.subpixel_bits);
  double most = displacement(frame_.settings);
  const auto include = [&](const Hit& hit) { most = std::max(most, grid + reader_.rounding(hit.triangle).in_window(frame_.rays, hit)); };
  if (seen.nearest) {
    include(*seen.nearest);
  }
  std::for_each(seen.blended.begin(), seen.blended.end(), include);
  // What is displaced by whole pixels is nothing to compare.
  return std::min(most, 1.0);
}

Lighting PixelBound::lighting(int material) const {
  Lighting lighting = frame_.lighting();
  lighting.lights = lights_.data();
  const auto m = static_cast<std::size_t>(material);
  if (m < albedos_.size()) {
    Albedos& albedos = albedos_[m];
    std::call_once(albedos.made, [&] { make(albedos, frame_.reader.material(material)); });
    lighting.albedo.around = albedos.sheen ? &*albedos.sheen : nullptr;
    lighting.base_albedo.around = albedos.base ? &*albedos.base : nullptr;
  }
  return lighting;
}

}  // namespace sheen::golden
