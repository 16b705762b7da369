#include "golden/pixel_bound.h"

#include <array>

#include <glm/geometric.hpp>

#include "golden/bounded_albedo.h"
#include "golden/shade.h"
#include "number/bounded_functions.h"

namespace sheen::golden {
namespace {

std::vector<PreparedLight> seen_from(const scene::Camera& camera, std::vector<PreparedLight> lights) {
  const glm::dmat3 view_from_world = glm::transpose(glm::dmat3(camera.world_from_camera));
  for (PreparedLight& light : lights) {
    light.position = view_from_world * (light.position - glm::dvec3(camera.world_from_camera[3]));
    light.axis = view_from_world * light.axis;
  }
  return lights;
}

}  // namespace

PixelBound::PixelBound(const Frame& frame)
    : frame_(frame),
      reader_(frame.geometry, frame.rays, frame.reader, frame.model.model, displacement(frame.settings)),
      lights_(seen_from(frame.rays.camera(), frame.lights)) {}

// a c + (1 - a) dst over black, in the order of drawing; a surface that does not blend replaces what is there.
Enclosed PixelBound::of(const Seen& seen, const Ray& ray) const {
  Lighting lighting = frame_.lighting();
  lighting.lights = lights_.data();
  std::array<Bound, 4> out{Bound(0.0), Bound(0.0), Bound(0.0), Bound(0.0)};
  const auto lay = [&](const Hit& hit) {
    const Placed& placed = frame_.geometry.placed(hit.triangle);
    const BoundedSurface read = reader_.read(hit, ray);
    const brdf::Rgb<Bound> c = shade(read.surface, frame_.reader.layers(placed.material_index), lighting, NoListener{}).radiance;
    if (placed.material->alpha_mode != scene::AlphaMode::Blend) {
      out = {c.r, c.g, c.b, Bound(1)};
      return;
    }
    const Bound rest = Bound(1) - read.opacity;
    out = {c.r * read.opacity + out[0] * rest, c.g * read.opacity + out[1] * rest, c.b * read.opacity + out[2] * rest,
           read.opacity + out[3] * rest};
  };
  if (seen.nearest) {
    lay(*seen.nearest);
  }
  for (const Hit& hit : seen.blended) {
    lay(hit);
  }
  Enclosed enclosed;
  for (int c = 0; c < 4; ++c) {
    enclosed.value[c] = out.at(static_cast<std::size_t>(c)).center();
    enclosed.deviation[c] = out.at(static_cast<std::size_t>(c)).deviation();
  }
  return enclosed;
}

}  // namespace sheen::golden
