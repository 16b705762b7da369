#include "renderer/environment_points.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

namespace sheen::renderer {
namespace {

constexpr int widest_row = 4096;

double radical_inverse(std::uint32_t index, std::uint32_t base) {
  double value = 0.0;
  double digit = 1.0;
  for (; index != 0; index /= base) {
    digit /= base;
    value += digit * (index % base);
  }
  return value;
}

// A number in [0, 1) for each seed and axis, 0 or 1, those of different seeds as if at random: SplitMix64's finalizer (Steele et al. 2014,
// "Fast Splittable Pseudorandom Number Generators"). None for seed 0.
double shift(std::uint64_t seed, std::uint64_t axis) {
  if (seed == 0) {
    return 0.0;
  }
  std::uint64_t z = (2 * seed + axis) * 0x9E3779B97F4A7C15u;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
  return std::ldexp(static_cast<double>((z ^ (z >> 31)) >> 11), -53);
}

// A split of an interval at a share of its weight: whether x in [0, 1) falls into the first part, and where inside its part it lies.
bool in_first_part(double share, double& x) {
  const bool first = x < share;
  x = std::clamp(first ? x / share : (x - share) / (1.0 - share), 0.0, 1.0 - 1e-12);
  return first;
}

// Where under the tent of a texel, which falls from its centre to those of its neighbours, a number in [0, 1) lies: from the centre.
double under_tent(double x) {
  return x < 0.5 ? std::sqrt(2.0 * x) - 1.0 : 1.0 - std::sqrt(2.0 - 2.0 * x);
}

// The same of a row in [0, rows), from the top: the outer half of the first and of the last has but its own.
double under_tent_of_row(int row, int rows, double x) {
  const bool own = (row == 0 && x < 0.5) || (row == rows - 1 && x >= 0.5);
  return row + (own ? x : 0.5 + under_tent(x));
}

double around(double x) {
  return std::min(x - std::floor(x), 1.0 - 1e-12);
}

// The float in (0, 1) that a shader gets of it: neither it nor what it leaves of 1 is 0.
float inside(double x) {
  return static_cast<float>(std::clamp(x, 0x1p-32, 1.0 - 0x1p-24));
}

}  // namespace

ImageSampling::ImageSampling(const scene::Environment& environment) : width_(environment.width), height_(environment.height) {
  const auto w = static_cast<std::size_t>(width_);
  const auto h = static_cast<std::size_t>(height_);
  const auto brightness = [&](std::size_t x, std::size_t y) {
    const glm::vec3& texel = environment.texels[y * w + x];
    return static_cast<double>(texel.x) + static_cast<double>(texel.y) + static_cast<double>(texel.z);
  };
  std::vector<double> weights;
  weights.reserve(w * h);
  sums_.assign((w + 1) * (h + 1), 0.0);
  for (std::size_t y = 0; y < h; ++y) {
    const double sine = std::sin(std::numbers::pi * (static_cast<double>(y) + 0.5) / static_cast<double>(h));
    double row_sum = 0.0;
    for (std::size_t x = 0; x < w; ++x) {
      weights.push_back(brightness(x, y) * sine);
      row_sum += weights.back();
      sums_[(y + 1) * (w + 1) + x + 1] = sums_[y * (w + 1) + x + 1] + row_sum;
    }
  }
  const double total = sums_.back();
  const double texels = static_cast<double>(w) * static_cast<double>(h);
  densities_.reserve(w * h);
  for (const double weight : weights) {
    const double share = total > 0.0 ? weight / total : 1.0 / texels;
    // d omega = 2 pi^2 sin(theta) du dv
    densities_.push_back(static_cast<float>(share * texels / (2.0 * std::numbers::pi * std::numbers::pi)));
  }
}

double ImageSampling::weight(int left, int top, int right, int bottom) const {
  const auto before = [&](int x, int y) {
    return sums_[static_cast<std::size_t>(y) * (static_cast<std::size_t>(width_) + 1) + static_cast<std::size_t>(x)];
  };
  return (before(right, bottom) - before(left, bottom)) - (before(right, top) - before(left, top));
}

ImageSampling::Drawn ImageSampling::draw(double u, double v) const {
  int left = 0;
  int top = 0;
  int right = width_;
  int bottom = height_;
  while (right - left > 1 || bottom - top > 1) {
    const double sine = std::sin(std::numbers::pi * 0.5 * (top + bottom) / height_);
    const double across = 2.0 * (right - left) / width_ * sine;  // in units of pi
    const double down = static_cast<double>(bottom - top) / height_;
    const double all = weight(left, top, right, bottom);
    const bool by_columns = bottom - top == 1 || (right - left > 1 && across >= down);
    int& begin = by_columns ? left : top;
    int& end = by_columns ? right : bottom;
    const int middle = begin + (end - begin) / 2;
    const double first = by_columns ? weight(left, top, middle, bottom) : weight(left, top, right, middle);
    const double even = static_cast<double>(middle - begin) / (end - begin);
    const double share = all > 0.0 ? std::clamp(first / all, 0.0, 1.0) : even;
    (in_first_part(share, by_columns ? u : v) ? end : begin) = middle;
  }
  const scene::Environment upright;
  const double x = left + 0.5 + under_tent(u);
  const double y = under_tent_of_row(top, height_, v);
  const glm::dvec3 direction = upright.direction({x / width_, y / height_});
  // As the shader has it of any direction, which does not come nearer to a pole.
  return {direction, density_at(x, y) / std::max(std::sin(std::numbers::pi * y / height_), 1e-6)};
}

double ImageSampling::density_at(double x, double y) const {
  const double left = std::floor(x - 0.5);
  const double top = std::floor(y - 0.5);
  const auto texel = [&](double column, double row) {
    const int i = (static_cast<int>(column) + width_) % width_;
    const int j = std::clamp(static_cast<int>(row), 0, height_ - 1);
    return static_cast<double>(densities_[static_cast<std::size_t>(j) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(i)]);
  };
  const double across = x - 0.5 - left;
  const double down = y - 0.5 - top;
  const double upper = (1.0 - across) * texel(left, top) + across * texel(left + 1.0, top);
  const double lower = (1.0 - across) * texel(left, top + 1.0) + across * texel(left + 1.0, top + 1.0);
  return (1.0 - down) * upper + down * lower;
}

PointRows point_rows(int count, std::uint64_t seed, const ImageSampling* image) {
  PointRows out;
  out.columns = std::clamp(count, 1, widest_row);
  const int pairs = (std::max(count, 1) + out.columns - 1) / out.columns;
  out.rows = 2 * pairs;
  out.texels.assign(static_cast<std::size_t>(out.columns) * static_cast<std::size_t>(out.rows), glm::vec4(0.0F));
  for (int i = 0; i < pairs * out.columns; ++i) {
    const double u = around(radical_inverse(static_cast<std::uint32_t>(i + 1), 2) + shift(seed, 0));
    const double v = around(radical_inverse(static_cast<std::uint32_t>(i + 1), 3) + shift(seed, 1));
    const auto at = static_cast<std::size_t>(2 * (i / out.columns) * out.columns + i % out.columns);
    out.texels[at] = glm::vec4(inside(u), std::cos(2.0 * std::numbers::pi * v), std::sin(2.0 * std::numbers::pi * v), 0.0);
    if (image != nullptr) {
      const ImageSampling::Drawn drawn = image->draw(u, v);
      out.texels[at + static_cast<std::size_t>(out.columns)] = glm::vec4(glm::vec3(drawn.direction), static_cast<float>(drawn.density));
    }
  }
  return out;
}

}  // namespace sheen::renderer
