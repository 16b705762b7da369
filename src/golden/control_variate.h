#pragma once

#include <cstddef>

#include "golden/band_limited.h"
#include "golden/shade.h"

namespace sheen::golden {

/// A function of direction near what a surface scatters toward the camera times the cosine, whose integral against an image's light needs
/// no sampling: a polynomial of degree band_degree. What is drawn need then only tell the difference, which varies less (control variates;
/// Owen, Monte Carlo theory, methods and examples, 2013, section 8.9). In the frame of N it is even across the plane of N and V, so a
/// polynomial in two coordinates serves: along V's own direction in the surface (x) and along N (z). Plain numbers.
struct ControlVariate {
  static constexpr int degree = band_degree;
  static constexpr std::size_t terms = static_cast<std::size_t>((degree + 1) * (degree + 2) / 2);

  Vec3<double> x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  double coefficients[3][terms] = {};  ///< of each channel: by falling powers of x, then of z

  /// Its value, in 1/sr, for a unit direction.
  template <class Real>
  brdf::Rgb<Real> operator()(const Vec3<Real>& d) const {
    return polynomial(d.x * Real(x.x) + d.y * Real(x.y) + d.z * Real(x.z), d.x * Real(z.x) + d.y * Real(z.y) + d.z * Real(z.z));
  }

  /// The same from the direction's coordinates along x and z.
  template <class Real>
  brdf::Rgb<Real> polynomial(const Real& along, const Real& up) const {
    brdf::Rgb<Real> out{Real(0), Real(0), Real(0)};
    std::size_t at = 0;
    for (int i = degree; i >= 0; --i) {
      brdf::Rgb<Real> inner{Real(0), Real(0), Real(0)};
      for (int j = degree - i; j >= 0; --j, ++at) {
        inner = inner * up + brdf::Rgb<Real>{Real(coefficients[0][at]), Real(coefficients[1][at]), Real(coefficients[2][at])};
      }
      out = out * along + inner;
    }
    return out;
  }
};

/// Directions above the surface where it is shaded to find its polynomial: so many, in arrays.
inline constexpr std::size_t control_nodes = 64;

/// What a surface sends toward the camera of each of control_nodes distant lights, those of `lighting`: by channel. One light at a time,
/// and in number::Batch, only where number::has_batch().
struct NodeValues {
  alignas(64) double value[3][control_nodes];
};
NodeValues node_values_scalar(const Surface<double>& surface, Layers layers, const Lighting& lighting);
NodeValues node_values_batch(const Surface<double>& surface, Layers layers, const Lighting& lighting);

/// @param surface   without emission; its highlights too narrow for the nodes are left out
/// @param lighting  with the curve of E at the surface's sheen roughness, where it has sheen
ControlVariate control_variate(const Surface<double>& surface, Layers layers, const Lighting& lighting);

/// The integral over the sphere of the polynomial times an image's light: radiance.
brdf::Rgb<double> integral(const ControlVariate& control, const BandLimited& light);

/// Points of the sphere in a ControlVariate's frame, y across, with weights that integrate the product of two polynomials exactly; in
/// arrays, with points of no weight to fill a batch.
struct SpherePoints {
  static constexpr std::size_t rows = band_degree + 1, columns = 2 * band_degree + 1, padding = 8;
  static constexpr std::size_t count = rows * columns;
  alignas(64) double x[count + padding], y[count + padding], z[count + padding], weight[count + padding];
};

/// integral() one point at a time, and in number::Batch, only where number::has_batch().
brdf::Rgb<double> integral_scalar(const ControlVariate& control, const BandLimited& light, const SpherePoints& points);
brdf::Rgb<double> integral_batch(const ControlVariate& control, const BandLimited& light, const SpherePoints& points);

/// Records what each direction sends.
template <class Real>
struct NodeListener {
  static constexpr bool wants_e_l = false;
  NodeValues* out;

  void view(const ViewPart<Real>&) {}
  void light(std::size_t i, const LightPart<Real>& part) {
    using Lanes = number::Lanes<Real>;
    const brdf::Rgb<Real> sum = part.sheen + part.base + part.coat;
    Lanes::store(out->value[0] + i * Lanes::count, sum.r);
    Lanes::store(out->value[1] + i * Lanes::count, sum.g);
    Lanes::store(out->value[2] + i * Lanes::count, sum.b);
  }
};

/// integral in any number type.
template <class Real>
brdf::Rgb<double> integral(const ControlVariate& control, const BandLimited& light, const SpherePoints& points) {
  using Lanes = number::Lanes<Real>;
  static_assert(Lanes::count <= SpherePoints::padding);
  brdf::Rgb<Real> sum{Real(0), Real(0), Real(0)};
  for (std::size_t i = 0; i < SpherePoints::count; i += Lanes::count) {
    const Real x = Lanes::load(points.x + i);
    const Real y = Lanes::load(points.y + i);
    const Real z = Lanes::load(points.z + i);
    const Vec3<Real> d{x * Real(control.x.x) + y * Real(control.y.x) + z * Real(control.z.x),
                       x * Real(control.x.y) + y * Real(control.y.y) + z * Real(control.z.y),
                       x * Real(control.x.z) + y * Real(control.y.z) + z * Real(control.z.z)};
    sum = sum + control.polynomial(x, z) * light.radiance(d) * Lanes::load(points.weight + i);
  }
  return {Lanes::sum(sum.r), Lanes::sum(sum.g), Lanes::sum(sum.b)};
}

/// node_values in any number type.
template <class Real>
NodeValues node_values(const Surface<double>& surface, Layers layers, const Lighting& lighting) {
  static_assert(control_nodes % number::Lanes<Real>::count == 0);
  Lighting all = lighting;
  all.light_count = control_nodes / number::Lanes<Real>::count;
  NodeValues out;
  shade(spread<Real>(surface), layers, all, NodeListener<Real>{&out});
  return out;
}

}  // namespace sheen::golden
