#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "golden/bounded_samples.h"
#include "golden/drawn_light.h"
#include "golden/environment_shade.h"
#include "golden/frame.h"
#include "golden/shade.h"

namespace sheen::golden {

/// Why a pixel is left out of comparisons: what the rules leave open there is no matter of shading.
enum class Exclusion {
  None = 0,
  Surface = 1,  ///< another surface, or none, within the step; or one seen edge on there, of which the rules promise nothing
  Mask = 2,     ///< an alpha mask that a conforming driver may decide otherwise
  Texels = 3,   ///< under an environment, a texture without mipmaps whose texel a moved sample may choose freely
  Rules = 4,    ///< the rules of GLSL ES promise nothing for an operation there
};

/// One pixel of a golden.
struct Pixel {
  glm::dvec3 radiance{0.0};
  double coverage = 0.0;
  glm::dvec3 bound{0.0};
  double coverage_bound = 0.0;
  glm::dvec3 standard_error{0.0};  ///< of the light of an image
  glm::dvec3 direction{0.0};       ///< the most that one direction of a shader brings, see DrawnLight
  Exclusion excluded = Exclusion::None;
  bool mirrored = false;
};

/// Under an environment: texels of a texture without mipmaps by which a driver's choice may be off, for the corners of the step, which
/// alone are looked at there, to see all that it may find.
inline constexpr double most_texels_of_corners = 0.5;
/// Of texture coordinates, as LodChoice has them.
inline const std::array<glm::dvec2, 4> nudges{{{1, 1}, {-1, 1}, {1, -1}, {-1, -1}}};

/// Of triangles near a pixel's centre, not over it, that a driver may show there: where there are more it may open gaps as well.
inline constexpr std::size_t most_near_misses = 64;

/// A few pixels worked out together: first every ray is cast and every surface read, then all are shaded in batches, then composed.
class Tile {
 public:
  /// @param bound  needed if the frame's settings ask for bounds
  Tile(const Frame& frame, const PixelBound* bound);

  /// The pixels [x0, x1) x [y0, y1), row by row.
  std::vector<Pixel> render(int x0, int y0, int x1, int y1);

 private:
  struct LayerRef {
    std::uint32_t surface;
    double opacity;
  };
  struct Sample {  // layers back to front
    std::uint32_t first, count;
    glm::dvec3 background;  // what its ray meets behind everything, if that is shown
  };
  struct Plan {  // samples: the centre, the shifted ones, then a group of other levels of detail for each texture
    std::uint64_t pixel;
    std::uint32_t centre, shifted_end, first_group, last_group;
    Exclusion excluded;
    std::size_t first_bound, last_bound;  // with bounds, of bounded_: light but an environment's, and coverage
    DrawnLight::Open drawn{};             // of directions that a shader draws
  };
  struct Composed {
    glm::dvec3 radiance{0.0}, lookup{0.0}, standard_error{0.0}, largest{0.0};
    glm::dvec3 direct{0.0};  // what of the radiance is no environment's
    double coverage = 0.0;
    bool mirrored = false;
  };

  Plan plan(int x, int y);
  double look_around(int x, int y, Plan& plan);
  void look(double step, bool alone, Plan& plan);
  double look_at_near_misses(int x, int y, Plan& plan);
  bool look_at(const NearMiss& miss, bool front, Plan& plan);
  bool may_open(double step) const;
  void enclose(double step);
  Enclosed enclosed(const Plan& plan, const glm::dvec3& direct) const;
  void add_shifted();
  void add_carried_on();
  bool add_nudged(const Plan& plan);
  DrawnLight::Open open_of_drawn(const Plan& plan);
  bool seen_before(std::size_t look) const;
  bool mask_uncertain(double step) const;
  void add_sample(const Seen& seen, const Ray& ray);
  void add_varied(std::uint32_t first, std::uint32_t count, std::uint32_t varied, const Hit& hit, const Ray& ray, LodChoice lod);
  void add_layers(const Seen& seen, const Ray& ray);
  void add_layer(const Hit& hit, const Ray& ray);
  bool interrupted(const Ray& ray, const Seen& seen, std::optional<double> depths = std::nullopt) const;
  Seen extended(const Seen& centre, const Ray& ray) const;
  bool has_environment() const { return frame_.settings.environment != nullptr; }
  bool shows_background() const;
  glm::dvec3 background(const Ray& ray) const;
  void add_levels(const Seen& seen, const Ray& ray, std::uint32_t first);
  template <class Function>
  void for_centres(const std::vector<Plan>& plans, const Function& f) const;
  template <class Function>
  void for_plans(const std::vector<Plan>& plans, const Function& f) const;
  template <class Function>
  void for_surfaces(std::uint32_t begin, std::uint32_t end, const Function& f) const;
  void shade_centres(const std::vector<Plan>& plans);
  void add_environment_light(const std::vector<Plan>& plans);
  void add_uniform_light(const std::vector<Plan>& plans);
  void add_image_light(const std::vector<Plan>& plans);
  void add_coarse_light(const std::vector<Plan>& plans, const ImageLighting& lighting);
  double relative_error(const Sample& sample) const;
  static std::uint64_t stream(const Plan& plan, std::uint32_t layer);
  Composed compose(const Sample& sample, bool refined = false) const;
  Pixel finish(const Plan& plan) const;

  static constexpr std::size_t looks_around = 5;
  // What the rays through a pixel's centre, first, and the corners of the step around it see.
  struct Look {
    Ray ray;
    Seen seen;
  };

  const Frame& frame_;
  const PixelBound* bound_;
  std::optional<BoundedSamples> bounded_;
  std::optional<DrawnLight> drawn_light_;
  CurveCache curves_;
  std::deque<Look> looks_{looks_around};  // and through near misses that are seen
  std::vector<Surface<double>> surfaces_;
  std::vector<int> materials_;          // of surfaces_
  std::vector<Shaded<double>> shaded_;  // of surfaces_, those at pixel centres: what punctual lights and emission bring
  // Of an environment's light on surfaces_: with bounds, by few nodes or from few directions, the same for all surfaces of a pixel, so that
  // their differences tell what a moved sample changes; and, of those at pixel centres, what is left to the full estimate.
  std::vector<brdf::Rgb<double>> coarse_, refinement_, standard_error_, largest_;
  std::vector<LayerRef> layers_;
  std::vector<Sample> samples_;
  std::vector<std::uint32_t> lod_group_ends_;  // into samples_
};

/// Calls f with every surface that a pixel's centre shows.
template <class Function>
void Tile::for_centres(const std::vector<Plan>& plans, const Function& f) const {
  for (const Plan& plan : plans) {
    const Sample& centre = samples_[plan.centre];
    for (std::uint32_t layer = 0; layer < centre.count; ++layer) {
      f(layers_[centre.first + layer].surface);
    }
  }
}

}  // namespace sheen::golden
