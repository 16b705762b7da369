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
      lights_(seen_from(frame.rays, frame.lights)) {
  if (frame.settings.environment != nullptr && frame.settings.drawn_directions > 0) {
    drawn_image_.emplace(*frame.settings.environment, frame.rays.view_from_world());
  }
  for (std::size_t i = 0; frame.ggx && i < frame.scene.materials.size(); ++i) {
    const SurfaceReader::Material& m = frame.reader.material(static_cast<int>(i));
    std::optional<GgxAround>& around = base_albedos_.emplace_back();
    if (m.source != nullptr && (!m.metallic_roughness.texture || m.source->roughness_factor == 0.0)) {
      const Bound roughness(m.source->roughness_factor);
      around.emplace(ggx_around(*frame.ggx, roughness * roughness));
    }
  }
  if (!frame.albedo) {
    return;
  }
  for (std::size_t i = 0; i < frame.scene.materials.size(); ++i) {
    const SurfaceReader::Material& m = frame.reader.material(static_cast<int>(i));
    std::optional<AlbedoAround>& around = albedos_.emplace_back();
    if (m.layers.sheen && !m.sheen_roughness.texture && frame.model.model != brdf::Model::Draft2019) {
      around.emplace(albedo_around(*frame.albedo, Bound(m.source->sheen.roughness_factor)));
    }
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
  lighting.albedo.around = m < albedos_.size() && albedos_[m] ? &*albedos_[m] : nullptr;
  lighting.base_albedo.around = m < base_albedos_.size() && base_albedos_[m] ? &*base_albedos_[m] : nullptr;
  return lighting;
}

}  // namespace sheen::golden
