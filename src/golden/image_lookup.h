#pragma once

#include <cmath>
#include <cstddef>

#include "golden/vec3.h"
#include "number/lanes.h"

namespace sheen::golden {

/// An equirect whose texels hold R, G, B and a density; plain numbers, so that the batched translation unit instantiates no container.
struct ImageTexels {
  const float* rgbw = nullptr;  ///< null: an image without light
  int width = 0, height = 0;
  double turns = 0.0;  ///< the rotation, in turns
  // Texels outside these hold 0.
  int first_row = 0, last_row = 0, first_column = 0, last_column = 0;
};

/// Which texels a direction lies between, and where.
template <class Real>
struct ImagePlace {
  static constexpr std::size_t lanes = number::Lanes<Real>::count;
  double column[lanes];  // of the upper left texel; -1 is the last
  double row[lanes];
  double across[lanes];  // [0, 1)
  double down[lanes];
  Real inverse_sine;  // of the angle from the pole

  ImagePlace(const ImageTexels& image, const Vec3<Real>& d) {
    using brdf::max;
    using brdf::min;
    using brdf::select;
    using brdf::sqrt;
    using std::acos;
    using std::atan2;
    using std::floor;
    using Lanes = number::Lanes<Real>;
    // As scene::Environment::coordinates and radiance. At a pole, where a batch's atan2 is NaN, any azimuth serves.
    const Real across2 = d.x * d.x + d.z * d.z;
    const Real turns = atan2(d.z, select(across2 > Real(0), d.x, Real(1))) * Real(0.5 / brdf::pi) + Real(0.5 + image.turns);
    const Real x = (turns - floor(turns)) * Real(image.width) - Real(0.5);
    const Real y = acos(min(max(d.y, Real(-1)), Real(1))) * Real(image.height / brdf::pi) - Real(0.5);
    const Real left = floor(x);
    const Real top = floor(y);
    Lanes::store(column, left);
    Lanes::store(row, top);
    Lanes::store(across, x - left);
    Lanes::store(down, y - top);
    inverse_sine = Real(1) / sqrt(max(across2, Real(1e-300)));
  }
};

template <class Real>
struct Arrived {
  brdf::Rgb<Real> radiance;
  Real density;  ///< of ImageLight::sample, 1/sr
};

/// Whether the image may light any of the directions at a place.
template <class Real>
bool lights(const ImageTexels& image, const ImagePlace<Real>& place) {
  bool any = false;
  for (std::size_t lane = 0; lane < ImagePlace<Real>::lanes; ++lane) {
    const bool rows = place.row[lane] >= image.first_row - 1 && place.row[lane] <= image.last_row;
    const bool columns = place.column[lane] >= image.first_column - 1 && place.column[lane] <= image.last_column;
    // Across the seam the last column lies left of the first.
    const bool seam =
        place.column[lane] < 0 ? image.last_column == image.width - 1 : place.column[lane] >= image.width - 1 && image.first_column == 0;
    any = any || (rows && (columns || seam));
  }
  return any;
}

/// What arrives and how densely it is drawn, from the directions at a place; not of an image without light.
template <class Real>
Arrived<Real> look_up(const ImageTexels& image, const ImagePlace<Real>& place) {
  using Lanes = number::Lanes<Real>;
  double found[4][Lanes::count] = {};
  for (std::size_t lane = 0; lane < Lanes::count; ++lane) {
    int left = static_cast<int>(place.column[lane]);
    left = left < 0 ? left + image.width : left;
    left = left >= image.width ? left - image.width : left;
    const int right = left + 1 < image.width ? left + 1 : 0;
    const int row = static_cast<int>(place.row[lane]);
    const int top = row > 0 ? row : 0;
    const int bottom = row + 1 < image.height ? row + 1 : image.height - 1;
    const auto texel = [&](int i, int j) {
      return image.rgbw + 4 * (static_cast<std::size_t>(j) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(i));
    };
    const float* top_left = texel(left, top);
    const float* top_right = texel(right, top);
    const float* bottom_left = texel(left, bottom);
    const float* bottom_right = texel(right, bottom);
    const double across = place.across[lane];
    const double down = place.down[lane];
    double mixed[4];
    for (std::size_t c = 0; c < 4; ++c) {
      const double upper = (1.0 - across) * static_cast<double>(top_left[c]) + across * static_cast<double>(top_right[c]);
      const double lower = (1.0 - across) * static_cast<double>(bottom_left[c]) + across * static_cast<double>(bottom_right[c]);
      mixed[c] = (1.0 - down) * upper + down * lower;
    }
    for (std::size_t c = 0; c < 4; ++c) {
      found[c][lane] = mixed[c];
    }
  }
  return {{Lanes::load(found[0]), Lanes::load(found[1]), Lanes::load(found[2])}, Lanes::load(found[3]) * place.inverse_sine};
}

}  // namespace sheen::golden
