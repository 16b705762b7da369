#pragma once

#include <cmath>

namespace sheen::image {

/// Three coordinates of a colour, in the space its function names.
struct Color {
  float x = 0, y = 0, z = 0;
};

/// A 3 x 3 matrix of doubles, for constants worked out at compile time.
struct Matrix {
  double m[3][3];

  constexpr Matrix inverse() const {
    const auto minor = [this](int r0, int c0, int r1, int c1) { return m[r0][c0] * m[r1][c1] - m[r0][c1] * m[r1][c0]; };
    const double determinant = m[0][0] * minor(1, 1, 2, 2) - m[0][1] * minor(1, 0, 2, 2) + m[0][2] * minor(1, 0, 2, 1);
    return {{{minor(1, 1, 2, 2) / determinant, -minor(0, 1, 2, 2) / determinant, minor(0, 1, 1, 2) / determinant},
             {-minor(1, 0, 2, 2) / determinant, minor(0, 0, 2, 2) / determinant, -minor(0, 0, 1, 2) / determinant},
             {minor(1, 0, 2, 1) / determinant, -minor(0, 0, 2, 1) / determinant, minor(0, 0, 1, 1) / determinant}}};
  }
  /// Each row divided by its sum: XYZ relative to the white of the matrix.
  constexpr Matrix relative_to_white() const {
    Matrix out{};
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) {
        out.m[r][c] = m[r][c] / (m[r][0] + m[r][1] + m[r][2]);
      }
    }
    return out;
  }
};

/// Linear sRGB to XYZ under D65, in the rationals that FLIP's authors compute with (Image Engineering, technical note 958); its row sums
/// are the reference white (0.950428545, 1, 1.088900371) of their program.
inline constexpr Matrix rgb_to_xyz = {{{10135552.0 / 24577794.0, 8788810.0 / 24577794.0, 4435075.0 / 24577794.0},
                                       {2613072.0 / 12288897.0, 8788810.0 / 12288897.0, 887015.0 / 12288897.0},
                                       {1425312.0 / 73733382.0, 8788810.0 / 73733382.0, 70074185.0 / 73733382.0}}};

/// Linear sRGB to X/Xn, Y/Yn, Z/Zn, and back.
inline constexpr Matrix rgb_to_relative_xyz = rgb_to_xyz.relative_to_white();
inline constexpr Matrix relative_xyz_to_rgb = rgb_to_relative_xyz.inverse();

inline Color transform(const Matrix& matrix, Color c) {
  const auto row = [&](int r) {
    return static_cast<float>(matrix.m[r][0]) * c.x + static_cast<float>(matrix.m[r][1]) * c.y + static_cast<float>(matrix.m[r][2]) * c.z;
  };
  return {row(0), row(1), row(2)};
}

/// YyCxCz, the linearised L*a*b* of Flohr et al. 1993: Andersson et al. 2020, section 4.1.1.
inline Color rgb_to_ycxcz(Color rgb) {
  const Color t = transform(rgb_to_relative_xyz, rgb);
  return {116 * t.y - 16, 500 * (t.x - t.y), 200 * (t.y - t.z)};
}

inline Color ycxcz_to_rgb(Color ycxcz) {
  const float y = (ycxcz.x + 16) / 116;
  return transform(relative_xyz_to_rgb, {y + ycxcz.y / 500, y, y - ycxcz.z / 200});
}

/// L*a*b* (CIE 15:2004, section 8.2.1) with a* and b* scaled by L*/100, the Hunt effect: Andersson et al. 2020, section 4.1.2, equation 4.
inline Color rgb_to_hunt_lab(Color rgb) {
  const auto f = [](float t) {
    constexpr float delta = 6.0f / 29.0f;
    return t > delta * delta * delta ? std::cbrt(t) : t / (3 * delta * delta) + 4.0f / 29.0f;
  };
  const Color t = transform(rgb_to_relative_xyz, rgb);
  const float fx = f(t.x), fy = f(t.y), fz = f(t.z);
  const float lightness = 116 * fy - 16;
  return {lightness, 0.01f * lightness * 500 * (fx - fy), 0.01f * lightness * 200 * (fy - fz)};
}

/// HyAB distance of Abasi et al. 2020: Andersson et al. 2020, section 4.1.3, equation 5.
inline float hyab(Color p, Color q) {
  const float a = p.y - q.y, b = p.z - q.z;
  return std::abs(p.x - q.x) + std::sqrt(a * a + b * b);
}

}  // namespace sheen::image
