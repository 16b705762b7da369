#include "golden/pixel_bound.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <glm/common.hpp>

#include "golden/by_material.h"
#include "golden/vertex_rounding.h"

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

bool is_bounded(const Enclosed& e) {
  return std::isfinite(e.deviation.x + e.deviation.y + e.deviation.z + e.deviation.w);
}

}  // namespace

PixelBound::PixelBound(const Frame& frame)
    : frame_(frame),
      reader_(frame.geometry, frame.rays, frame.reader, frame.model.model),
      lights_(seen_from(frame.rays.camera(), frame.lights)) {
  if (!frame.albedo) {
    return;
  }
  for (std::size_t i = 0; i < frame.scene.materials.size(); ++i) {
    const SurfaceReader::Material& m = frame.reader.material(static_cast<int>(i));
    std::optional<AlbedoAround>& around = albedos_.emplace_back();
    if (m.layers.sheen && !m.sheen_roughness.texture && frame.model.model != brdf::Model::Draft2019) {
      const Bound roughness(m.source->sheen.roughness_factor);
      const auto at = [&](double r) { return frame.albedo->at_roughness(r); };
      around.emplace(AlbedoAround{at(roughness.range().lower), at(roughness.center()), at(roughness.range().upper)});
    }
  }
}

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

void BoundedSamples::clear() {
  maps_.clear();
  runs_.clear();
  surfaces_.clear();
  materials_.clear();
  layers_.clear();
  ends_.clear();
}

void BoundedSamples::add_layer(const Hit& hit, const Ray& ray, double step) {
  const BoundedSurface read = bound_.reader_.read(hit, ray, step);
  const Placed& placed = bound_.frame_.geometry.placed(hit.triangle);
  // A surface that does not blend replaces what is there.
  const bool blends = placed.material->alpha_mode == scene::AlphaMode::Blend;
  Layer layer{blends ? read.opacity : Bound(1), surfaces_.size(), maps_.size(), 0, 0, 0, 0};
  maps_.insert(maps_.end(), read.normals.begin(), read.normals.end());
  layer.first_coat_map = maps_.size();
  maps_.insert(maps_.end(), read.coat_normals.begin(), read.coat_normals.end());
  layer.last_map = maps_.size();
  layers_.push_back(layer);
  surfaces_.push_back(read.surface);
  materials_.push_back(placed.material_index);
}

std::size_t BoundedSamples::add(const Seen& seen, const Ray& ray, double step) {
  if (seen.nearest) {
    add_layer(*seen.nearest, ray, step);
  }
  for (const Hit& hit : seen.blended) {
    add_layer(hit, ray, step);
  }
  ends_.push_back(layers_.size());
  return ends_.size() - 1;
}

// Of a layer's own surface and a run of others, the one through whose coat, of weight k, most is seen of what lies below: that whose coat
// faces the view most.
std::size_t BoundedSamples::barest(const Layer& layer, const Run& coats) const {
  const auto facing = [this](std::size_t i) { return dot(surfaces_[i].coat_normal, surfaces_[i].view).center(); };
  std::size_t best = layer.surface;
  for (std::size_t i = coats.first; i < coats.last; ++i) {
    best = facing(i) > facing(best) ? i : best;
  }
  return best;
}

// With base normals N_i and coat normals Nc_j the radiance is (1 - k(Nc_j)) B(N_i) + C(Nc_j), so
//   L(i, j) - L(0, 0) = (1 - k_j) (B_i - B_0) + (L(0, j) - L(0, 0)):
// no more than what the coat's normals change over the base's ideal one and what the base's change under the barest coat.
void BoundedSamples::add_runs(Layer& layer) {
  layer.first_run = runs_.size();
  std::size_t under = layer.surface;
  const auto add = [&](std::size_t first_map, std::size_t last_map, Vec3<Bound> Surface<Bound>::*normal) {
    const std::size_t first = surfaces_.size();
    for (std::size_t map = first_map; map < last_map; ++map) {
      surfaces_.push_back(surfaces_[under]);
      surfaces_.back().*normal = bent_[map];
    }
    runs_.push_back({first, surfaces_.size(), under});
  };
  if (layer.first_coat_map < layer.last_map) {
    add(layer.first_coat_map, layer.last_map, &Surface<Bound>::coat_normal);
    under = barest(layer, runs_.back());
  }
  if (layer.first_map < layer.first_coat_map) {
    add(layer.first_map, layer.first_coat_map, &Surface<Bound>::normal);
  }
  layer.last_run = runs_.size();
  materials_.resize(surfaces_.size(), materials_[layer.surface]);
}

void BoundedSamples::shade() {
  bent_.resize(maps_.size());
  bend_all(maps_.data(), maps_.size(), bent_.data());
  for (Layer& layer : layers_) {
    add_runs(layer);
  }
  radiance_.resize(surfaces_.size());
  const Frame& frame = bound_.frame_;
  Lighting lighting = frame.lighting();
  lighting.lights = bound_.lights_.data();
  by_material(materials_, [&](const std::uint32_t* order, std::size_t count, int material) {
    const auto m = static_cast<std::size_t>(material);
    lighting.albedo.around = m < bound_.albedos_.size() && bound_.albedos_[m] ? &*bound_.albedos_[m] : nullptr;
    bound_all({surfaces_.data(), order, count, frame.reader.layers(material), frame.settings.precision}, lighting, radiance_.data());
  });
}

// a c + (1 - a) dst over black, in the order of drawing; one layer as another of its surfaces.
Enclosed BoundedSamples::composed(std::size_t sample, std::size_t varied_layer, std::size_t as_surface) const {
  std::array<Bound, 4> out{Bound(0.0), Bound(0.0), Bound(0.0), Bound(0.0)};
  for (std::size_t i = first_layer(sample); i < ends_[sample]; ++i) {
    const Bound& opacity = layers_[i].opacity;
    const brdf::Rgb<Bound>& c = radiance_[i == varied_layer ? as_surface : layers_[i].surface];
    if (opacity.is_exact() && opacity.center() == 1.0) {
      out = {c.r, c.g, c.b, opacity};
      continue;
    }
    const Bound rest = Bound(1) - opacity;
    out = {c.r * opacity + out[0] * rest, c.g * opacity + out[1] * rest, c.b * opacity + out[2] * rest, opacity + out[3] * rest};
  }
  Enclosed enclosed;
  for (int c = 0; c < 4; ++c) {
    enclosed.value[c] = out.at(static_cast<std::size_t>(c)).center();
    enclosed.deviation[c] = out.at(static_cast<std::size_t>(c)).deviation();
  }
  return enclosed;
}

// By how much more a sample may deviate for the levels of a layer's normal maps: at those that were tried, and between two of them, beyond
// the nearer one, by half of what they differ.
glm::dvec4 BoundedSamples::deviation_by_levels(std::size_t sample, std::size_t layer) const {
  glm::dvec4 sum(0.0);
  for (std::size_t r = layers_[layer].first_run; r < layers_[layer].last_run; ++r) {
    const Run& run = runs_[r];
    const Enclosed usual = composed(sample, layer, run.instead_of);
    glm::dvec4 beyond(0.0);
    glm::dvec4 between(0.0);
    glm::dvec4 before = usual.value;
    for (std::size_t surface = run.first; surface < run.last; ++surface) {
      const Enclosed there = composed(sample, layer, surface);
      if (!is_bounded(there) || !is_bounded(usual)) {
        return glm::dvec4(std::numeric_limits<double>::infinity());
      }
      beyond = glm::max(beyond, glm::abs(there.value - usual.value) + there.deviation - usual.deviation);
      between = surface > run.first ? glm::max(between, 0.5 * glm::abs(there.value - before)) : between;
      before = there.value;
    }
    sum += beyond + between;
  }
  return sum;
}

// Each layer enters the sum with a weight that no normal changes: what their levels may change adds.
Enclosed BoundedSamples::at(std::size_t sample) const {
  Enclosed all = composed(sample, layers_.size(), 0);
  for (std::size_t layer = first_layer(sample); layer < ends_[sample]; ++layer) {
    all.deviation += deviation_by_levels(sample, layer);
  }
  return all;
}

}  // namespace sheen::golden
