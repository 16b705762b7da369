#include "golden/pixel_bound.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>

#include "golden/bounded_albedo.h"
#include "golden/bounded_mediump.h"
#include "golden/shade.h"
#include "golden/vertex_rounding.h"
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
      reader_(frame.geometry, frame.rays, frame.reader, frame.model.model),
      lights_(seen_from(frame.rays.camera(), frame.lights)) {}

double PixelBound::step(const Seen& seen) const {
  const double grid = std::ldexp(0.5, -frame_.settings.subpixel_bits);
  double most = displacement(frame_.settings);
  const auto include = [&](const Hit& hit) { most = std::max(most, grid + window_rounding(frame_.geometry, frame_.rays, hit)); };
  if (seen.nearest) {
    include(*seen.nearest);
  }
  std::for_each(seen.blended.begin(), seen.blended.end(), include);
  // What is displaced by whole pixels is nothing to compare.
  return std::min(most, 1.0);
}

// a c + (1 - a) dst over black, in the order of drawing; a surface that does not blend replaces what is there.
Enclosed PixelBound::of(const Seen& seen, const Ray& ray, double step) const {
  Lighting lighting = frame_.lighting();
  lighting.lights = lights_.data();
  std::array<Bound, 4> out{Bound(0.0), Bound(0.0), Bound(0.0), Bound(0.0)};
  const auto lay = [&](const Hit& hit) {
    const Placed& placed = frame_.geometry.placed(hit.triangle);
    const BoundedSurface read = reader_.read(hit, ray, step);
    const Layers layers = frame_.reader.layers(placed.material_index);
    const brdf::Rgb<Bound> c = (frame_.settings.precision == Precision::Mediump
                                    ? shade_with<number::Bounded<number::Mediump>>(read.surface, layers, lighting, NoListener{})
                                    : shade(read.surface, layers, lighting, NoListener{}))
                                   .radiance;
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
