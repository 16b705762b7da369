#include "golden/band_limited.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <vector>

namespace sheen::golden {
namespace {

constexpr auto orders = static_cast<std::size_t>(band_degree + 1);

// Red, green and blue of a row's cosine and sine sums, by m: the integrals over azimuth of its light times cos(m azimuth), sin(m azimuth).
using Harmonics = std::array<std::array<double, 6>, orders>;

std::vector<Harmonics> harmonics_of_rows(const ImageTexels& image) {
  const auto width = static_cast<std::size_t>(image.width);
  std::vector<std::array<double, 2 * orders>> turns(width);
  for (std::size_t x = 0; x < width; ++x) {
    const double azimuth = 2.0 * brdf::pi * ((static_cast<double>(x) + 0.5) / image.width - 0.5 - image.turns);
    for (std::size_t m = 0; m < orders; ++m) {
      // Filtering along the row is convolution with a tent, whose transform is the square of a sinc.
      const double half = brdf::pi * static_cast<double>(m) / image.width;
      const double sinc = m == 0 ? 1.0 : std::sin(half) / half;
      const double scale = 2.0 * brdf::pi / image.width * sinc * sinc;
      turns[x][m] = scale * std::cos(static_cast<double>(m) * azimuth);
      turns[x][orders + m] = scale * std::sin(static_cast<double>(m) * azimuth);
    }
  }
  std::vector<Harmonics> rows(static_cast<std::size_t>(image.height));
  for (int y = std::max(image.first_row, 0); y <= image.last_row; ++y) {
    Harmonics& row = rows[static_cast<std::size_t>(y)];
    const float* texel = image.rgbw + 4 * static_cast<std::size_t>(y) * width;
    for (std::size_t x = 0; x < width; ++x, texel += 4) {
      for (std::size_t m = 0; m < orders; ++m) {
        for (std::size_t c = 0; c < 3; ++c) {
          row[m][c] += turns[x][m] * static_cast<double>(texel[c]);
          row[m][c + 3] += turns[x][orders + m] * static_cast<double>(texel[c]);
        }
      }
    }
  }
  return rows;
}

double factorial_ratio(int from, int to) {  // to! / from!
  double product = 1.0;
  for (int i = from + 1; i <= to; ++i) {
    product *= i;
  }
  return product;
}

}  // namespace

BandLimited::BandLimited(const ImageTexels& image) {
  if (image.rgbw == nullptr) {
    return;
  }
  const std::vector<Harmonics> rows = harmonics_of_rows(image);
  // Light is linear in the angle from the pole between the centres of two rows, and constant beyond the first and the last: four nodes of
  // Gauss-Legendre in each such interval, or in pieces of it where it is wide.
  constexpr double nodes[] = {0.06943184420297371, 0.33000947820757187, 0.66999052179242813, 0.93056815579702629};
  constexpr double weights[] = {0.17392742256872693, 0.32607257743127307, 0.32607257743127307, 0.17392742256872693};
  const auto pieces = static_cast<std::size_t>((31 + image.height) / image.height);
  for (int y = -1; y < image.height; ++y) {
    const Harmonics& upper = rows[static_cast<std::size_t>(std::max(y, 0))];
    const Harmonics& lower = rows[static_cast<std::size_t>(std::min(y + 1, image.height - 1))];
    const double begin = y < 0 ? 0.0 : y + 0.5;
    const double end = y + 1 < image.height ? y + 1.5 : image.height;
    const double piece = (end - begin) / static_cast<double>(pieces);
    for (std::size_t i = 0; i < pieces * std::size(nodes); ++i) {
      const std::size_t whole = i / std::size(nodes);
      const double at = begin + piece * (static_cast<double>(whole) + nodes[i % std::size(nodes)]);
      const double down = at - (y + 0.5);
      const double theta = brdf::pi * at / image.height;
      const double weight = weights[i % std::size(nodes)] * piece * brdf::pi / image.height * std::sin(theta);
      double* c = coefficients_;
      double power = 1.0;  // (2m-1)!! sin^m
      for (int m = 0; m <= band_degree; ++m) {
        double before = 0.0;
        double now = power;
        const std::array<double, 6>& u = upper[static_cast<std::size_t>(m)];
        const std::array<double, 6>& v = lower[static_cast<std::size_t>(m)];
        for (int l = m; l <= band_degree; ++l, c += 6) {
          for (std::size_t k = 0; k < 6; ++k) {
            c[k] += weight * now * ((1.0 - down) * u[k] + down * v[k]);
          }
          const double next = ((2 * l + 1) * std::cos(theta) * now - (l + m) * before) / (l + 1 - m);
          before = now;
          now = next;
        }
        power *= (2 * m + 1) * std::sin(theta);
      }
    }
  }
  // What makes the harmonics orthonormal (NIST DLMF 14.30.1), squared: once for the projection, once for its value.
  double* c = coefficients_;
  for (int m = 0; m <= band_degree; ++m) {
    for (int l = m; l <= band_degree; ++l, c += 6) {
      const double norm = (m == 0 ? 1.0 : 2.0) * (2 * l + 1) / (4.0 * brdf::pi) / factorial_ratio(l - m, l + m);
      std::for_each(c, c + 6, [norm](double& x) { x *= norm; });
    }
  }
}

}  // namespace sheen::golden
