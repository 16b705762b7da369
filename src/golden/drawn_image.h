#pragma once

#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec4.hpp>

#include "golden/bound.h"
#include "golden/lights.h"
#include "scene/environment.h"

namespace sheen::golden {

/// The angle from (1, 0) to (x, y), as shaders/equirect.glsl finds it.
template <class Real>
Real angle_of(const Real& y, const Real& x) {
  using brdf::abs;
  using brdf::max;
  using brdf::min;
  using brdf::select;
  const Real across = abs(x);
  const Real up = abs(y);
  const Real a = min(across, up) / max(max(across, up), Real(1e-30));
  const Real s = a * a;
  Real sum(0.002622222483);
  for (const double c : {-0.01513244611, 0.04112170934, -0.07366692888, 0.1057392559, -0.1418597354, 0.1999039639, -0.3333298705, 1.0}) {
    sum = Real(c) + s * sum;
  }
  Real angle = a * sum;
  angle = select(up > across, Real(0.5 * brdf::pi) - angle, angle);
  angle = select(x < Real(0), Real(brdf::pi) - angle, angle);
  return select(y < Real(0), Real(0) - angle, angle);
}
/// What its polynomial leaves, in radians.
inline constexpr double angle_error = 1e-8;

/// An environment as our shaders look it up and draw from it, in view space, with all that the rules of GLSL ES leave open.
class DrawnImage {
 public:
  /// The environment must outlive this; it need not have an image.
  DrawnImage(const scene::Environment& environment, const glm::dmat3& view_from_world);

  bool has_image() const { return environment_.is_image(); }

  /// A direction that the image's way of drawing meets, for (u, v) in [0, 1)^2: of a texel in proportion to its radiance and the sine of
  /// its row's polar angle, at a place under the tent that bilinear filtering makes of it.
  struct Drawn {
    Vec3<Bound> direction;
    Bound density;  ///< 1/sr
  };
  Drawn draw(double u, double v) const;

  /// What arrives from a unit direction of view space.
  brdf::Rgb<Bound> radiance(const Vec3<Bound>& direction) const { return look_up(direction).radiance; }
  struct Seen {
    brdf::Rgb<Bound> radiance;
    Bound density;  ///< of draw(), 1/sr; 0 without an image
  };
  Seen look_up(const Vec3<Bound>& direction) const;

  /// Directions of view space to the brightest texels.
  const std::vector<Vec3<double>>& brightest() const { return brightest_; }

 private:
  /// Where a direction falls, in texels, and how far off a shader may find it.
  struct Place {
    double x, y, dx, dy;
  };
  Place place(const Vec3<Bound>& in_image) const;
  /// Radiance and, but for the sine of the polar angle, density; columns go around, beyond the first and last row is that row.
  glm::dvec4 texel(long x, long y) const;
  glm::dvec4 bilinear(double x, double y) const;

  const scene::Environment& environment_;
  glm::dmat3 image_from_view_{1.0};
  std::vector<double> densities_;   // of each texel, times the sine of the polar angle
  std::vector<double> row_sums_;    // of weights of the rows before, one more than there are
  std::vector<double> texel_sums_;  // in each row likewise
  std::vector<Vec3<double>> brightest_;
};

}  // namespace sheen::golden
