#pragma once

#include <cstddef>
#include <vector>

#include "golden/bound_all.h"
#include "golden/pixel_bound.h"

namespace sheen::golden {

/// What rays see, shaded on number::Bounded, many at a time: samples are added, then all are shaded, then each can be asked for.
class BoundedSamples {
 public:
  /// The argument must outlive this.
  explicit BoundedSamples(const PixelBound& bound) : bound_(bound) {}

  void clear();
  /// Returns the sample's index. @param step  at least PixelBound::step(seen)
  std::size_t add(const Seen& seen, const Ray& ray, double step);
  std::size_t count() const { return ends_.size(); }
  /// Once after all are added.
  void shade();
  Enclosed at(std::size_t sample) const;

 private:
  /// Surfaces that a layer may be instead of one of its surfaces, by the levels of one of its normal maps.
  struct Run {
    std::size_t first, last;  // of surfaces_
    std::size_t instead_of;
  };
  struct Layer {
    Bound opacity;
    bool edge_on;
    std::size_t surface;
    std::size_t first_map, first_coat_map, last_map;  // of maps_
    std::size_t first_run, last_run;                  // of runs_
  };
  std::size_t first_layer(std::size_t sample) const { return sample == 0 ? 0 : ends_[sample - 1]; }
  void add_layer(const Hit& hit, const Ray& ray, double step);
  Enclosed composed(std::size_t sample, std::size_t varied_layer, std::size_t as_surface) const;
  glm::dvec4 deviation_of(const Run& run, std::size_t sample, std::size_t layer) const;

  void add_runs(Layer& layer);
  std::size_t barest(const Layer& layer, const Run& coats) const;

  const PixelBound& bound_;
  std::vector<MappedNormal<Bound>> maps_;
  std::vector<Vec3<Bound>> bent_;  // of maps_
  std::vector<Run> runs_;
  std::vector<Surface<Bound>> surfaces_;
  std::vector<int> materials_;  // of surfaces_
  std::vector<brdf::Rgb<Bound>> radiance_;
  std::vector<Layer> layers_;      // a sample's back to front
  std::vector<std::size_t> ends_;  // of samples, among layers_
};

}  // namespace sheen::golden
