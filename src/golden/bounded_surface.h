#pragma once

#include <cstdint>
#include <vector>

#include "golden/bound.h"
#include "golden/geometry.h"
#include "golden/mapped_normal.h"
#include "golden/rays.h"
#include "golden/surface.h"
#include "golden/surface_reader.h"
#include "golden/triangle_in_view.h"
#include "golden/vertex_rounding.h"

namespace sheen::golden {

/// A surface with all that a conforming rasteriser and shader may find in its place while the sample is displaced within the step.
struct BoundedSurface {
  Surface<Bound> surface;  ///< position and directions in view space, where a shader's roundings happen
  Bound opacity{1};
  bool edge_on = false;  ///< see Interpolation
  /// What a normal map makes of a normal, which bent() finds.
  struct Maps {
    bool is_open = false;                     ///< see NormalLevels
    std::vector<MappedNormal<Bound>> normal;  ///< any of these; none where no map is read: then the surface has its normal
  };
  Maps normals, coat_normals;
};

/// Reads surfaces as SurfaceReader does, on number::Bounded: the vertex shader's and the interpolation's roundings (varying.h), textures at
/// all coordinates that these and the displacement reach (texture_box.h), and every operation after.
class BoundedSurfaceReader {
 public:
  /// The references must outlive this.
  BoundedSurfaceReader(const Geometry& geometry, const RayGenerator& rays, const SurfaceReader& reader, brdf::Model model);

  /// At a hit of a ray; see Interpolation. Where a normal may or may not have a direction, it is unbounded.
  /// @param triangle  the hit's
  /// @param step  of the sample's displacement along either axis, pixels
  /// @param out  whatever it was; its memory is made use of
  void read(const TriangleInView& triangle, const Hit& hit, const Ray& ray, double step, BoundedSurface& out) const;

  /// Its opacity alone, in [0, 1].
  Bound opacity(const Hit& hit, const Ray& ray, double step) const;

  const VertexRounding& rounding(std::uint32_t triangle) const { return roundings_[triangle]; }

 private:
  class At;
  const Geometry& geometry_;
  const RayGenerator& rays_;
  const SurfaceReader& reader_;
  brdf::Model model_;
  std::vector<VertexRounding> roundings_;  // by triangle
};

}  // namespace sheen::golden
