#include "golden/bounded_samples.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <glm/common.hpp>

#include "golden/by_material.h"

namespace sheen::golden {

void BoundedSamples::clear() {
  maps_.clear();
  runs_.clear();
  surfaces_.clear();
  materials_.clear();
  layers_.clear();
  ends_.clear();
}

void BoundedSamples::add_layer(const Hit& hit, const Ray& ray, double step) {
  const BoundedSurface read = bound_.reader().read(hit, ray, step);
  const Placed& placed = bound_.frame().geometry.placed(hit.triangle);
  // A surface that does not blend replaces what is there.
  const bool blends = placed.material->alpha_mode == scene::AlphaMode::Blend;
  Layer layer{blends ? read.opacity : Bound(1), read.edge_on, surfaces_.size(), maps_.size(), 0, 0, 0, 0};
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

// Of a layer's own surface and a run of others, the one through whose coat, of weight k, most may be seen of what lies below: where |Nc.V|
// reaches farthest.
std::size_t BoundedSamples::barest(const Layer& layer, const Run& coats) const {
  const auto facing = [this](std::size_t i) { return dot(surfaces_[i].coat_normal, surfaces_[i].view).range().magnitude(); };
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
  // At the ideal levels first, which the others take the place of one by one.
  if (layer.first_map < layer.first_coat_map) {
    surfaces_[layer.surface].normal = bent_[layer.first_map];
  }
  if (layer.first_coat_map < layer.last_map) {
    surfaces_[layer.surface].coat_normal = bent_[layer.first_coat_map];
  }
  std::size_t under = layer.surface;
  const auto add = [&](std::size_t ideal_map, std::size_t last_map, Vec3<Bound> Surface<Bound>::*normal) {
    const std::size_t first = surfaces_.size();
    for (std::size_t map = ideal_map + 1; map < last_map; ++map) {
      surfaces_.push_back(surfaces_[under]);
      surfaces_.back().*normal = bent_[map];
    }
    runs_.push_back({first, surfaces_.size(), under});
  };
  if (layer.first_coat_map + 1 < layer.last_map) {
    add(layer.first_coat_map, layer.last_map, &Surface<Bound>::coat_normal);
    under = barest(layer, runs_.back());
  }
  if (layer.first_map + 1 < layer.first_coat_map) {
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
  const Frame& frame = bound_.frame();
  by_material(materials_, [&](const std::uint32_t* order, std::size_t count, int material) {
    // Those that others may be seen instead of come first; of these others it counts how far their radiance reaches, all in all.
    const std::uint32_t* others = std::lower_bound(order, order + count, layers_.size());
    const auto own = static_cast<std::size_t>(others - order);
    const Lighting lighting = bound_.lighting(material);
    const Layers layers = frame.reader.layers(material);
    bound_all({surfaces_.data(), order, own, layers, frame.settings.precision, false}, lighting, radiance_.data());
    bound_all({surfaces_.data(), others, count - own, layers, frame.settings.precision, true}, lighting, radiance_.data());
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

// How far a sample may come from what it shows of the surface that a run is instead of.
glm::dvec4 BoundedSamples::deviation_of(const Run& run, std::size_t sample, std::size_t layer) const {
  const Enclosed usual = composed(sample, layer, run.instead_of);
  // What a second run starts from is one of the first's, whose place within its bound is not known.
  const bool is_second = &run != &runs_[layers_[layer].first_run];
  const glm::dvec4 open = is_second ? usual.deviation : glm::dvec4(0.0);
  glm::dvec4 farthest = usual.deviation;
  for (std::size_t surface = run.first; surface < run.last; ++surface) {
    const Enclosed there = composed(sample, layer, surface);
    if (!there.is_bounded() || !usual.is_bounded()) {
      return glm::dvec4(std::numeric_limits<double>::infinity());
    }
    farthest = glm::max(farthest, glm::abs(there.value - usual.value) + there.deviation + open);
  }
  return farthest;
}

// Two maps of a layer, and layers, whose weights no normal changes, add what each may change; what is uncertain of the other while one
// changes is no more than in that one's own run, so that with all of it in every run none is missing.
Enclosed BoundedSamples::at(std::size_t sample) const {
  Enclosed all = composed(sample, layers_.size(), 0);
  glm::dvec4 by_levels(0.0);
  for (std::size_t layer = first_layer(sample); layer < ends_[sample]; ++layer) {
    for (std::size_t run = layers_[layer].first_run; run < layers_[layer].last_run; ++run) {
      by_levels += deviation_of(runs_[run], sample, layer);
    }
    all.edge_on = all.edge_on || layers_[layer].edge_on;
  }
  all.deviation = glm::max(all.deviation, by_levels);
  return all;
}

}  // namespace sheen::golden
