#pragma once

#include <cstddef>

#include "golden/image_lookup.h"

namespace sheen::golden {

/// Degree of the polynomials in direction that an image's light is integrated against without sampling.
inline constexpr int band_degree = 6;

/// What of an image's light spherical harmonics up to band_degree hold: its product with a polynomial of that degree in direction has the
/// same integral over the sphere as the image's own.
class BandLimited {
 public:
  /// No light.
  BandLimited() = default;
  /// The projection of what look_up() makes of the image, to 1e-7 of its mean.
  explicit BandLimited(const ImageTexels& image);

  /// Radiance of the projection from unit directions; may be negative.
  template <class Real>
  brdf::Rgb<Real> radiance(const Vec3<Real>& d) const {
    brdf::Rgb<Real> sum{Real(0), Real(0), Real(0)};
    const double* c = coefficients_;
    // sin^m(theta) cos(m azimuth) and sin^m(theta) sin(m azimuth).
    Real cosine(1);
    Real sine(0);
    double diagonal = 1.0;
    for (int m = 0; m <= band_degree; ++m) {
      // P_l^m / sin^m by its recurrence in l, without the sign of Condon and Shortley (NIST DLMF 14.10.3).
      Real before(0);
      Real now(diagonal);
      for (int l = m; l <= band_degree; ++l, c += 6) {
        const Real even = now * cosine;
        const Real odd = now * sine;
        sum.r = sum.r + even * Real(c[0]) + odd * Real(c[3]);
        sum.g = sum.g + even * Real(c[1]) + odd * Real(c[4]);
        sum.b = sum.b + even * Real(c[2]) + odd * Real(c[5]);
        const Real next = (d.y * now * Real(2 * l + 1) - before * Real(l + m)) * Real(1.0 / (l + 1 - m));
        before = now;
        now = next;
      }
      diagonal *= 2 * m + 1;
      const Real turned = cosine * d.x - sine * d.z;
      sine = sine * d.x + cosine * d.z;
      cosine = turned;
    }
    return sum;
  }

 private:
  static constexpr std::size_t pairs = static_cast<std::size_t>((band_degree + 1) * (band_degree + 2) / 2);
  // By m, then l: red, green and blue of the cosine, then of the sine.
  double coefficients_[6 * pairs] = {};
};

}  // namespace sheen::golden
