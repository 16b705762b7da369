#include "golden/bounded_samples.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "golden/by_material.h"

namespace sheen::golden {
namespace {

/// Of surfaces that are not shaded as they are.
constexpr int no_material = -1;

/// All that some numbers may be.
struct Hull {
  number::Range range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};

  void include(const Bound& x) {
    range.lower = std::min(range.lower, x.range().lower);
    range.upper = std::max(range.upper, x.range().upper);
  }
  Bound bound() const {
    const double middle = 0.5 * (range.lower + range.upper);
    const double radius = std::max(range.upper - middle, middle - range.lower);
    return std::isfinite(radius) ? Bound::within(middle, radius) : Bound::unbounded(0.0);
  }
};

}  // namespace

void BoundedSamples::clear() {
  closed_.read.clear();
  open_.read.clear();
  surfaces_.clear();
  materials_.clear();
  layers_.clear();
  shown_.clear();
  ends_.clear();
}

void BoundedSamples::begin(const Ray& ray, double step) {
  ray_ = ray;
  step_ = step;
  hits_.clear();
  first_of_ray_ = layers_.size();
}

BoundedSamples::Interval BoundedSamples::Maps::add(const std::vector<MappedNormal<Bound>>& maps) {
  const std::size_t first = read.size();
  read.insert(read.end(), maps.begin(), maps.end());
  return {first, read.size()};
}

void BoundedSamples::add_layer(const Hit& hit) {
  bound_.reader().read(triangles_.at(hit.triangle), hit, ray_, step_, read_);
  const Placed& placed = bound_.frame().geometry.placed(hit.triangle);
  // A surface that does not blend replaces what is there.
  const bool blends = placed.material->alpha_mode == scene::AlphaMode::Blend;
  const bool has_coat = bound_.frame().reader.layers(placed.material_index).clearcoat;
  const bool is_open = read_.normals.is_open || (has_coat && read_.coat_normals.is_open);
  Maps& maps = is_open ? open_ : closed_;
  const Interval base = maps.add(read_.normals.normal);
  const Interval coat = has_coat ? maps.add(read_.coat_normals.normal) : Interval{};
  layers_.push_back(
      {blends ? read_.opacity : Bound(1), read_.edge_on, placed.material_index, surfaces_.size(), is_open, base, coat, {}, {}});
  surfaces_.push_back(read_.surface);
}

void BoundedSamples::show(const Hit& hit) {
  // Of a triangle carried on, the first weight is what the others leave.
  const auto is_it = [&hit](const Hit& known) {
    return known.triangle == hit.triangle && known.front == hit.front && known.weights.y == hit.weights.y &&
           known.weights.z == hit.weights.z;
  };
  const auto known = std::find_if(hits_.begin(), hits_.end(), is_it);
  shown_.push_back(static_cast<std::uint32_t>(first_of_ray_ + static_cast<std::size_t>(known - hits_.begin())));
  if (known == hits_.end()) {
    hits_.push_back(hit);
    add_layer(hit);
  }
}

std::size_t BoundedSamples::add(const Seen& seen) {
  seen.for_layers([this](const Hit& hit) { show(hit); });
  ends_.push_back(shown_.size());
  return ends_.size() - 1;
}

void BoundedSamples::shade() {
  closed_.bent.resize(closed_.read.size());
  bend_all(closed_.read.data(), closed_.read.size(), closed_.bent.data());
  open_.bent.resize(open_.read.size());
  bend_ranges(open_.read.data(), open_.read.size(), open_.bent.data());
  shade_closed();
  shade_open();
}

// Layers of which no normal is open, as they are.
void BoundedSamples::shade_closed() {
  materials_.clear();
  for (const Layer& layer : layers_) {
    materials_.push_back(layer.is_open ? no_material : layer.material);
    Surface<Bound>& surface = surfaces_[layer.surface];
    if (!layer.is_open && layer.maps.count() > 0) {
      surface.normal = closed_.bent[layer.maps.first];
    }
    if (!layer.is_open && layer.coat_maps.count() > 0) {
      surface.coat_normal = closed_.bent[layer.coat_maps.first];
    }
  }
  radiance_.resize(surfaces_.size());
  by_material(materials_, [&](const std::uint32_t* order, std::size_t count, int material) {
    if (material != no_material) {
      bound_all({surfaces_.data(), order, count, bound_.frame().reader.layers(material), bound_.frame().settings.precision},
                bound_.lighting(material), radiance_.data());
    }
  });
}

/// f(normal) of each that an open layer may have.
template <class Function>
void BoundedSamples::for_normals(const Interval& maps, const Vec3<Bound>& unmapped, const Function& f) const {
  if (maps.count() == 0) {
    f(unmapped);
  }
  for (std::size_t map = maps.first; map < maps.last; ++map) {
    f(open_.bent[map]);
  }
}

// With base normals N_i and coat normals Nc_j the radiance is (1 - k(Nc_j)) B(N_i) + C(Nc_j): what lies below for each N_i, under all that
// k may be, and the coat for each Nc_j.
void BoundedSamples::shade_open() {
  coats_.clear();
  below_.clear();
  surface_of_.clear();
  materials_.clear();
  const Frame& frame = bound_.frame();
  for (Layer& layer : layers_) {
    layer.coats.first = coats_.size();
    if (layer.is_open && frame.reader.layers(layer.material).clearcoat) {
      const Surface<Bound>& s = surfaces_[layer.surface];
      for_normals(layer.coat_maps, s.coat_normal, [&](const Vec3<Bound>& normal) {
        coats_.push_back({s.position, s.view, normal, s.clearcoat, s.coat_alpha});
        materials_.push_back(layer.material);
      });
    }
    layer.coats.last = coats_.size();
  }
  coat_sums_.resize(coats_.size());
  by_material(materials_, [&](const std::uint32_t* order, std::size_t count, int material) {
    bound_coats({coats_.data(), order, count, frame.settings.precision}, bound_.lighting(material), coat_sums_.data());
  });
  materials_.clear();
  for (Layer& layer : layers_) {
    layer.below.first = below_.size();
    if (layer.is_open) {
      Hull weight;
      for (std::size_t i = layer.coats.first; i < layer.coats.last; ++i) {
        weight.include(coat_sums_[i].weight);
      }
      const Bound coat_weight = layer.coats.count() > 0 ? weight.bound() : Bound(0.0);
      for_normals(layer.maps, surfaces_[layer.surface].normal, [&](const Vec3<Bound>& normal) {
        below_.push_back({normal, coat_weight});
        surface_of_.push_back(static_cast<std::uint32_t>(layer.surface));
        materials_.push_back(layer.material);
      });
    }
    layer.below.last = below_.size();
  }
  below_sums_.resize(below_.size());
  by_material(materials_, [&](const std::uint32_t* order, std::size_t count, int material) {
    bound_below(
        {surfaces_.data(), below_.data(), surface_of_.data(), order, count, frame.reader.layers(material), frame.settings.precision},
        bound_.lighting(material), below_sums_.data());
  });
}

number::Range BoundedSamples::together(const number::Range& coat, const number::Range& below, double size, std::size_t lights) {
  const auto additions = static_cast<double>(3 * lights);  // of sheen, base and coat
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (additions * epsilon > 0.5) {
    return {-infinity, infinity};
  }
  const double relative = additions * epsilon / (1.0 - additions * epsilon);
  const double room = relative * (size + coat.upper) + additions * number::smallest_normal<number::Highp>;
  return {below.lower + coat.lower - room, below.upper + coat.upper + room};
}

// Of an open layer, any of its coats over any of what may lie below.
Bound BoundedSamples::shown(const Layer& layer, Bound brdf::Rgb<Bound>::*channel) const {
  if (!layer.is_open) {
    return radiance_[layer.surface].*channel;
  }
  Hull coat, below, size;
  for (std::size_t i = layer.below.first; i < layer.below.last; ++i) {
    below.include(below_sums_[i].radiance.*channel);
    size.include(below_sums_[i].size.*channel);
  }
  for (std::size_t i = layer.coats.first; i < layer.coats.last; ++i) {
    coat.include(coat_sums_[i].radiance.*channel);
  }
  return layer.coats.count() == 0 ? below.bound()
                                  : Hull{together(coat.range, below.range, size.range.upper, bound_.frame().lights.size())}.bound();
}

// a c + (1 - a) dst over black, in the order of drawing.
Enclosed BoundedSamples::at(std::size_t sample) const {
  Enclosed enclosed;
  std::array<Bound, 4> out{Bound(0.0), Bound(0.0), Bound(0.0), Bound(0.0)};
  for (std::size_t i = first_shown(sample); i < ends_[sample]; ++i) {
    const Layer& layer = layers_[shown_[i]];
    const Bound& opacity = layer.opacity;
    const brdf::Rgb<Bound> c{shown(layer, &brdf::Rgb<Bound>::r), shown(layer, &brdf::Rgb<Bound>::g), shown(layer, &brdf::Rgb<Bound>::b)};
    enclosed.edge_on = enclosed.edge_on || layer.edge_on;
    if (opacity.is_exact() && opacity.center() == 1.0) {
      out = {c.r, c.g, c.b, opacity};
      continue;
    }
    const Bound rest = Bound(1) - opacity;
    out = {c.r * opacity + out[0] * rest, c.g * opacity + out[1] * rest, c.b * opacity + out[2] * rest, opacity + out[3] * rest};
  }
  for (int c = 0; c < 4; ++c) {
    enclosed.value[c] = out.at(static_cast<std::size_t>(c)).center();
    enclosed.deviation[c] = out.at(static_cast<std::size_t>(c)).deviation();
  }
  return enclosed;
}

}  // namespace sheen::golden
