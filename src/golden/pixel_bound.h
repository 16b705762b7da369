#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include <glm/vec4.hpp>

#include "golden/bound_all.h"
#include "golden/bounded_surface.h"
#include "golden/frame.h"

namespace sheen::golden {

/// Light that punctual lights and emission bring through a pixel, and its coverage: what they are at the sample, and the most that a
/// conforming driver's picture may depart from it while its grid displaces the sample. R G B A.
struct Enclosed {
  glm::dvec4 value{0.0};
  glm::dvec4 deviation{0.0};  ///< infinite where the rules of GLSL ES promise nothing
};

/// What is needed to shade on number::Bounded, of a frame.
class PixelBound {
 public:
  /// The frame must outlive this.
  explicit PixelBound(const Frame& frame);

  /// How far a driver may displace a sample that meets these surfaces, along either axis, in pixels.
  double step(const Seen& seen) const;

  /// What a driver may take for the opacity of a surface. @param step  at least step() of it
  Bound opacity(const Hit& hit, const Ray& ray, double step) const { return reader_.opacity(hit, ray, step); }

 private:
  friend class BoundedSamples;
  const Frame& frame_;
  BoundedSurfaceReader reader_;
  std::vector<PreparedLight> lights_;                 // in view space
  std::vector<std::optional<AlbedoAround>> albedos_;  // of materials without a texture of sheen roughness
};

/// What rays see, shaded on number::Bounded, many at a time: samples are added, then all are shaded, then each can be asked for.
class BoundedSamples {
 public:
  /// The argument must outlive this.
  explicit BoundedSamples(const PixelBound& bound) : bound_(bound) {}

  void clear();
  /// Returns the sample's index. @param step  at least PixelBound::step(seen)
  std::size_t add(const Seen& seen, const Ray& ray, double step);
  std::size_t count() const { return ends_.size(); }
  void shade();
  Enclosed at(std::size_t sample) const;

 private:
  /// Surfaces that a layer may be instead of one of its surfaces, by the levels of one of its normal maps, from the least to the most.
  struct Run {
    std::size_t first, last;  // of surfaces_
    std::size_t instead_of;
  };
  struct Layer {
    Bound opacity;
    std::size_t surface;
    std::size_t first_map, first_coat_map, last_map;  // of maps_
    std::size_t first_run, last_run;                  // of runs_
  };
  std::size_t first_layer(std::size_t sample) const { return sample == 0 ? 0 : ends_[sample - 1]; }
  void add_layer(const Hit& hit, const Ray& ray, double step);
  Enclosed composed(std::size_t sample, std::size_t varied_layer, std::size_t as_surface) const;
  glm::dvec4 deviation_by_levels(std::size_t sample, std::size_t layer) const;

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
