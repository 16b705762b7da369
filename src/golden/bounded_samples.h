#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "golden/bound_all.h"
#include "golden/pixel_bound.h"
#include "golden/triangle_in_view.h"

namespace sheen::golden {

/// What rays see, shaded on uncertain numbers, many at a time: samples are added, then all are shaded, then each can be asked for.
class BoundedSamples {
 public:
  /// The argument must outlive this.
  explicit BoundedSamples(const PixelBound& bound) : bound_(bound), triangles_(bound.frame().geometry, bound.frame().rays) {}

  void clear();
  /// What is added from now on is seen by this ray. @param step  at least PixelBound::step() of all that is
  void begin(const Ray& ray, double step);
  /// Returns the sample's index. A surface that several samples show is shaded once.
  std::size_t add(const Seen& seen);
  std::size_t count() const { return ends_.size(); }
  /// Once after all are added.
  void shade();
  Enclosed at(std::size_t sample) const;

  /// What a shader adds up light by light of what a coat and what lies below add up to, each for itself: at each addition it rounds all
  /// that it has so far.
  /// @param size  of the terms below, their sizes added up
  static number::Range together(const number::Range& coat, const number::Range& below, double size, std::size_t lights);

 private:
  struct Interval {
    std::size_t first = 0, last = 0;
    std::size_t count() const { return last - first; }
  };
  struct Layer {
    Bound opacity;
    bool edge_on;
    int material;
    std::size_t surface;
    bool is_open;              // whether a driver may choose from several normals
    Interval maps, coat_maps;  // of Maps; as many as it may choose from, none where no map is read
    Interval coats, below;     // of an open one, of coats_ and below_: what it may be
  };
  struct Maps {
    std::vector<MappedNormal<Bound>> read;
    std::vector<Vec3<Bound>> bent;

    Interval add(const std::vector<MappedNormal<Bound>>& maps);
  };
  std::size_t first_shown(std::size_t sample) const { return sample == 0 ? 0 : ends_[sample - 1]; }
  void show(const Hit& hit);
  void add_layer(const Hit& hit);
  template <class Function>
  void for_normals(const Interval& maps, const Vec3<Bound>& unmapped, const Function& f) const;
  void shade_closed();
  void shade_open();
  Bound shown(const Layer& layer, Bound brdf::Rgb<Bound>::*channel) const;

  const PixelBound& bound_;
  TrianglesInView triangles_;
  BoundedSurface read_;  // the last
  Maps closed_, open_;   // of layers that are not open and of those that are
  std::vector<Surface<Bound>> surfaces_;
  std::vector<int> materials_;              // of what is shaded
  std::vector<brdf::Rgb<Bound>> radiance_;  // of surfaces_
  std::vector<CoatSurface<Bound>> coats_;
  std::vector<CoatSum<Bound>> coat_sums_;
  std::vector<BelowSurface<Bound>> below_;
  std::vector<std::uint32_t> surface_of_;  // of below_
  std::vector<BelowSum<Bound>> below_sums_;
  Ray ray_;
  double step_ = 0.0;
  std::vector<Hit> hits_;  // on layers_ from first_of_ray_ on
  std::size_t first_of_ray_ = 0;
  std::vector<Layer> layers_;
  std::vector<std::uint32_t> shown_;  // of layers_, a sample's back to front
  std::vector<std::size_t> ends_;     // of samples, among shown_
};

}  // namespace sheen::golden
