#include "image/flip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

namespace sheen::image {
namespace {

/// FLIP straight from the papers, in double, by sums over two-dimensional windows and colour matrices solved here: slow, and shares no code
/// with what it tests.
namespace direct {

using Vec = std::array<double, 3>;
constexpr double pi = std::numbers::pi;
constexpr double m[3][3] = {{10135552.0 / 24577794, 8788810.0 / 24577794, 4435075.0 / 24577794},
                            {2613072.0 / 12288897, 8788810.0 / 12288897, 887015.0 / 12288897},
                            {1425312.0 / 73733382, 8788810.0 / 73733382, 70074185.0 / 73733382}};

Vec to_xyz(Vec rgb) {
  Vec out{};
  for (std::size_t r = 0; r < 3; ++r) {
    out[r] = m[r][0] * rgb[0] + m[r][1] * rgb[1] + m[r][2] * rgb[2];
  }
  return out;
}

const Vec white = to_xyz({1, 1, 1});

/// Solves to_xyz(rgb) = xyz by Cramer's rule.
Vec to_rgb(Vec xyz) {
  const auto det = [](const std::array<Vec, 3>& c) {
    return c[0][0] * (c[1][1] * c[2][2] - c[1][2] * c[2][1]) - c[1][0] * (c[0][1] * c[2][2] - c[0][2] * c[2][1]) +
           c[2][0] * (c[0][1] * c[1][2] - c[0][2] * c[1][1]);
  };
  std::array<Vec, 3> columns{};
  for (std::size_t c = 0; c < 3; ++c) {
    columns[c] = {m[0][c], m[1][c], m[2][c]};
  }
  const double whole = det(columns);
  Vec out{};
  for (std::size_t c = 0; c < 3; ++c) {
    auto replaced = columns;
    replaced[c] = xyz;
    out[c] = det(replaced) / whole;
  }
  return out;
}

Vec to_ycxcz(Vec rgb) {
  const Vec t = to_xyz(rgb);
  const double x = t[0] / white[0], y = t[1] / white[1], z = t[2] / white[2];
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

Vec to_hunt(Vec rgb) {
  const Vec t = to_xyz(rgb);
  const auto f = [](double v) { return v > std::pow(6.0 / 29, 3) ? std::cbrt(v) : v * 841 / 108 + 4.0 / 29; };
  const double x = f(t[0] / white[0]), y = f(t[1] / white[1]), z = f(t[2] / white[2]);
  const double lightness = 116 * y - 16;
  return {lightness, lightness / 100 * 500 * (x - y), lightness / 100 * 200 * (y - z)};
}

double hyab(Vec p, Vec q) {
  return std::abs(p[0] - q[0]) + std::hypot(p[1] - q[1], p[2] - q[2]);
}

struct Window {
  int radius;
  std::vector<double> weights;
};

Window window(int radius, const std::function<double(int, int)>& weight) {
  Window w{radius, {}};
  for (int y = -radius; y <= radius; ++y) {
    for (int x = -radius; x <= radius; ++x) {
      w.weights.push_back(weight(x, y));
    }
  }
  double positive = 0, negative = 0;
  for (const double value : w.weights) {
    (value > 0 ? positive : negative) += std::abs(value);
  }
  for (double& value : w.weights) {
    value /= value > 0 ? positive : std::max(negative, 1e-300);
  }
  return w;
}

Window csf(double ppd, double a1, double b1, double a2, double b2) {
  const int radius = static_cast<int>(std::ceil(3 * std::sqrt(0.04 / (2 * pi * pi)) * ppd));
  return window(radius, [=](int x, int y) {
    const double d2 = (x * x + y * y) / (ppd * ppd);
    return a1 * std::sqrt(pi / b1) * std::exp(-pi * pi * d2 / b1) + a2 * std::sqrt(pi / b2) * std::exp(-pi * pi * d2 / b2);
  });
}

Window feature(double ppd, bool edge, bool vertical) {
  const double deviation = 0.5 * 0.082 * ppd;
  return window(static_cast<int>(std::ceil(3 * deviation)), [=](int x, int y) {
    const double g = std::exp(-(x * x + y * y) / (2 * deviation * deviation));
    const int along = vertical ? y : x;
    return edge ? -along * g : (along * along / (deviation * deviation) - 1) * g;
  });
}

struct Picture {
  int width, height;
  std::vector<Vec> values;  ///< displayed linear RGB in [0, 1]
  Vec at(int x, int y) const {
    const int px = std::min(std::max(x, 0), width - 1), py = std::min(std::max(y, 0), height - 1);
    return values[static_cast<std::size_t>(py) * static_cast<std::size_t>(width) + static_cast<std::size_t>(px)];
  }
};

double gather(const Picture& p, int x, int y, const Window& w, const std::function<double(Vec)>& value) {
  double sum = 0;
  std::size_t i = 0;
  for (int dy = -w.radius; dy <= w.radius; ++dy) {
    for (int dx = -w.radius; dx <= w.radius; ++dx) {
      sum += w.weights[i++] * value(p.at(x + dx, y + dy));
    }
  }
  return sum;
}

double flip(const Picture& reference, const Picture& test, int x, int y, double ppd) {
  const auto seen = [&](const Picture& p) {
    const Vec filtered = {gather(p, x, y, csf(ppd, 1, 0.0047, 0, 1e-5), [](Vec v) { return to_ycxcz(v)[0]; }),
                          gather(p, x, y, csf(ppd, 1, 0.0053, 0, 1e-5), [](Vec v) { return to_ycxcz(v)[1]; }),
                          gather(p, x, y, csf(ppd, 34.1, 0.04, 13.5, 0.025), [](Vec v) { return to_ycxcz(v)[2]; })};
    const double yy = (filtered[0] + 16) / 116;
    Vec rgb = to_rgb({(yy + filtered[1] / 500) * white[0], yy * white[1], (yy - filtered[2] / 200) * white[2]});
    for (double& c : rgb) {
      c = std::min(std::max(c, 0.0), 1.0);
    }
    return to_hunt(rgb);
  };
  const auto strength = [&](const Picture& p, bool edge) {
    const auto lightness = [](Vec v) { return (to_ycxcz(v)[0] + 16) / 116; };
    return std::hypot(gather(p, x, y, feature(ppd, edge, false), lightness), gather(p, x, y, feature(ppd, edge, true), lightness));
  };
  const double most = std::pow(hyab(to_hunt({0, 1, 0}), to_hunt({0, 0, 1})), 0.7);
  const double error = std::pow(hyab(seen(reference), seen(test)), 0.7);
  const double color = error < 0.4 * most ? 0.95 / (0.4 * most) * error : 0.95 + (error - 0.4 * most) / (0.6 * most) * 0.05;
  const double features =
      std::max(std::abs(strength(reference, true) - strength(test, true)), std::abs(strength(reference, false) - strength(test, false)));
  return std::pow(color, 1 - std::sqrt(features / std::sqrt(2.0)));
}

double aces(double x) {
  return std::min((0.9036 * x * x + 0.018 * x) / (0.8748 * x * x + 0.354 * x + 0.14), 1.0);
}

}  // namespace direct

LinearRgb uniform(int width, int height, std::array<float, 3> color) {
  LinearRgb out{width, height, {}};
  for (int i = 0; i < width * height; ++i) {
    out.values.insert(out.values.end(), color.begin(), color.end());
  }
  return out;
}

/// Smooth colours with a hard edge and a few single bright points, up to `top`.
LinearRgb scene(int width, int height, float top, float change) {
  LinearRgb out{width, height, {}};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const bool disc = (x - 20) * (x - 20) + (y - 14) * (y - 14) < 90;
      const bool point = (x * 31 + y * 17) % 97 == 0;
      const auto fx = static_cast<float>(x), fy = static_cast<float>(y);
      out.values.push_back(top * (disc ? 0.8f - change : 0.1f + 0.005f * fx));
      out.values.push_back(top * (point ? 1.0f - change : 0.3f + 0.2f * std::sin(0.3f * fy + change)));
      out.values.push_back(top * (disc ? 0.1f : 0.5f + 0.4f * std::cos(0.2f * fx) * (1 - change)));
    }
  }
  return out;
}

direct::Picture displayed(const LinearRgb& rgb, const std::function<double(double)>& display) {
  direct::Picture out{rgb.width, rgb.height, {}};
  for (std::size_t i = 0; i < rgb.values.size(); i += 3) {
    out.values.push_back({display(static_cast<double>(rgb.values[i])), display(static_cast<double>(rgb.values[i + 1])),
                          display(static_cast<double>(rgb.values[i + 2]))});
  }
  return out;
}

constexpr std::array<std::array<int, 2>, 7> probes = {{{0, 0}, {149, 69}, {20, 14}, {29, 14}, {127, 63}, {128, 64}, {70, 3}}};

// The tiles end at column 128 and row 64, so the probes stand in corners, on an edge of the scene and on either side of a seam.
TEST(Flip, AgreesWithDirectConvolutionInDouble) {
  const LinearRgb reference = scene(150, 70, 1, 0), test = scene(150, 70, 1, 0.25f);
  for (const double ppd : {default_pixels_per_degree, 30.0}) {
    const auto map = ldr_flip(reference, test, ppd);
    const auto same = [](double v) { return v; };
    for (const auto& [x, y] : probes) {
      const double expected = direct::flip(displayed(reference, same), displayed(test, same), x, y, ppd);
      EXPECT_NEAR(map[static_cast<std::size_t>(y * 150 + x)], expected, 2e-5) << "pixel " << x << ", " << y << " at " << ppd;
    }
  }
}

TEST(Flip, HdrIsTheLargestOverTheExposures) {
  const LinearRgb reference = scene(150, 70, 40, 0), test = scene(150, 70, 40, 0.2f);
  const Exposures exposures = hdr_exposures(reference, std::vector<std::uint8_t>(150 * 70, 1));
  ASSERT_GE(exposures.count, 2);
  const auto map = hdr_flip(reference, test, exposures);
  for (const auto& [x, y] : probes) {
    double expected = 0;
    for (int i = 0; i < exposures.count; ++i) {
      const double factor = std::exp2(exposures.start + (exposures.stop - exposures.start) * i / (exposures.count - 1));
      const auto display = [factor](double v) { return direct::aces(factor * std::max(v, 0.0)); };
      expected = std::max(expected, direct::flip(displayed(reference, display), displayed(test, display), x, y, default_pixels_per_degree));
    }
    EXPECT_NEAR(map[static_cast<std::size_t>(y * 150 + x)], expected, 2e-5) << "pixel " << x << ", " << y;
  }
}

TEST(Flip, IdenticalPicturesAreZeroEverywhere) {
  const LinearRgb picture = scene(60, 40, 1, 0);
  for (const float value : ldr_flip(picture, picture)) {
    EXPECT_EQ(value, 0);
  }
  for (const float value : hdr_flip(picture, picture, {-3, 3, 4})) {
    EXPECT_EQ(value, 0);
  }
}

// Flat pictures have no features and the filters leave them as they are: HyAB = 100 between black and white, so only the remapping remains.
TEST(Flip, BlackAgainstWhiteIsTheRemappedHundred) {
  const double most = std::pow(direct::hyab(direct::to_hunt({0, 1, 0}), direct::to_hunt({0, 0, 1})), 0.7);
  const double expected = 0.95 + 0.05 * (std::pow(100.0, 0.7) - 0.4 * most) / (0.6 * most);
  EXPECT_NEAR(expected, 0.967, 1e-3) << "about what the authors' program gives";
  for (const float value : ldr_flip(uniform(5, 5, {0, 0, 0}), uniform(5, 5, {1, 1, 1}))) {
    EXPECT_NEAR(value, expected, 1e-5);
  }
}

TEST(Flip, GreenAgainstBlueIsOne) {
  for (const float value : ldr_flip(uniform(3, 3, {0, 1, 0}), uniform(3, 3, {0, 0, 1}))) {
    EXPECT_NEAR(value, 1, 1e-5);
  }
}

TEST(Flip, LdrIsSymmetric) {
  const LinearRgb a = scene(60, 40, 1, 0), b = scene(60, 40, 1, 0.4f);
  EXPECT_EQ(ldr_flip(a, b), ldr_flip(b, a));
}

TEST(Flip, ADifferenceReachesNoFartherThanItsFilters) {
  const LinearRgb a = uniform(64, 64, {0.5f, 0.5f, 0.5f});
  LinearRgb b = a;
  b.values[3 * (32 * 64 + 32)] = 1;
  const auto map = ldr_flip(a, b);
  EXPECT_GT(map[32 * 64 + 32], 0.01f);
  EXPECT_GT(map[32 * 64 + 42], 0.0f);
  EXPECT_LT(map[32 * 64 + 44], 1e-3f);
}

// Narkowicz' curve at x / 0.6 is 0.85 where 0.6 x = 0.6 * inverse: checked by putting the exposed luminance back through the curve.
TEST(FlipExposures, MapBrightestAndMedianToEightyFivePercent) {
  LinearRgb reference = uniform(5, 1, {1, 1, 1});
  const std::array<float, 5> levels = {0.01f, 0.5f, 2.0f, 8.0f, 400.0f};
  for (std::size_t i = 0; i < 15; ++i) {
    reference.values[i] = levels[i / 3];
  }
  const Exposures e = hdr_exposures(reference, std::vector<std::uint8_t>(5, 1));
  EXPECT_NEAR(direct::aces(std::exp2(e.start) * 400), 0.85, 1e-9);
  EXPECT_NEAR(direct::aces(std::exp2(e.stop) * 2), 0.85, 1e-9);
  EXPECT_EQ(e.count, 8) << "log2(200) = 7.64 stops";
  EXPECT_NEAR(e.at(0), e.start, 1e-12);
  EXPECT_NEAR(e.at(7), e.stop, 1e-12);
}

TEST(FlipExposures, AnEvenCountTakesTheMeanOfTheTwoMiddleLuminances) {
  LinearRgb reference = uniform(4, 1, {1, 1, 1});
  const std::array<float, 4> levels = {1.0f, 2.0f, 4.0f, 16.0f};
  for (std::size_t i = 0; i < 12; ++i) {
    reference.values[i] = levels[i / 3];
  }
  const Exposures e = hdr_exposures(reference, std::vector<std::uint8_t>(4, 1));
  EXPECT_NEAR(e.stop - e.start, std::log2(16.0 / 3.0), 1e-9);
}

TEST(FlipExposures, BackgroundIsLeftOutAndDarknessIsFinite) {
  LinearRgb reference = uniform(5, 1, {0, 0, 0});
  for (std::size_t i = 12; i < 15; ++i) {
    reference.values[i] = 2;
  }
  const Exposures masked = hdr_exposures(reference, {0, 0, 0, 0, 1});
  EXPECT_NEAR(masked.stop, masked.start, 1e-12);
  EXPECT_EQ(masked.count, 2) << "never fewer than two";
  const Exposures whole = hdr_exposures(reference, {1, 1, 1, 1, 1});
  EXPECT_NEAR(whole.stop, masked.stop, 1e-12) << "the median of what is lit where the median is black";
  const Exposures dark = hdr_exposures(uniform(2, 2, {0, 0, 0}), {1, 1, 1, 1});
  EXPECT_EQ(dark.count, 1);
  EXPECT_EQ(dark.start, 0);
}

TEST(Flip, ExtremeValuesGiveFiniteResults) {
  const LinearRgb bright = uniform(4, 4, {3e38f, 1e-38f, 0}), other = uniform(4, 4, {1, 3e38f, -5});
  const auto map = hdr_flip(bright, other, hdr_exposures(bright, std::vector<std::uint8_t>(16, 1)));
  for (const float value : map) {
    EXPECT_GE(value, 0);
    EXPECT_LE(value, 1);
  }
}

}  // namespace
}  // namespace sheen::image
