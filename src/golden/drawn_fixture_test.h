#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <random>

#include "golden/surface.h"

// Surfaces that directions are drawn at.

namespace sheen::golden::test {

/// Numbers that floats hold, so that a shader holds the same.
inline Surface<double> in_floats(const Surface<double>& surface) {
  constexpr std::size_t numbers = sizeof(Surface<double>) / sizeof(double);
  std::array<double, numbers> each;
  std::memcpy(each.data(), &surface, sizeof(surface));
  std::transform(each.begin(), each.end(), each.begin(), [](double x) { return static_cast<double>(static_cast<float>(x)); });
  Surface<double> out;
  std::memcpy(&out, each.data(), sizeof(out));
  return out;
}

inline Surface<double> lacquered_cloth(double cosine, double alpha, double sheen_roughness) {
  Surface<double> s{};
  s.view = {0, 0, 1};
  s.normal = {std::sqrt(1 - cosine * cosine), 0, cosine};
  s.coat_normal = {0.1 * std::sqrt(1 - cosine * cosine), std::sqrt(0.99 * (1 - cosine * cosine)), cosine};
  s.base = {{0.4, 0.3, 0.2}, 0.5, alpha, {0.04, 0.04, 0.04}, 1.0};
  s.sheen_color = {0.8, 0.6, 0.7};
  s.sheen_roughness = sheen_roughness;
  s.clearcoat = 1;
  s.coat_alpha = 0.05;
  s.occlusion = 1;
  return in_floats(s);
}

struct Random {
  std::mt19937_64 source{11};

  double number() { return std::uniform_real_distribution<double>(0.0, 1.0)(source); }
  float inside() { return std::clamp(static_cast<float>(number()), 0x1p-32F, 1.0F - 0x1p-24F); }
};

}  // namespace sheen::golden::test
