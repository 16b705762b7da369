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

// A number in [0, 1) for each seed and axis: the fractional parts of multiples of two irrational numbers. None for seed 0.
double shift(std::uint64_t seed, double irrational) {
  const double turns = static_cast<double>(seed % 1000003) * irrational;
  return turns - std::floor(turns);
}

// A split of an interval at a share of its weight: whether x in [0, 1) falls into the first part, and where inside its part it lies.
bool in_first_part(double share, double& x) {
  const bool first = x < share;
  x = std::clamp(first ? x / share : (x - share) / (1.0 - share), 0.0, 1.0 - 1e-12);
  return first;
}

double around(double x) {
  return std::min(x - std::floor(x), 1.0 - 1e-12);
}

}  // namespace

ImageSampling::ImageSampling(const scene::Environment& environment) : width_(environment.width), height_(environment.height) {
  const auto w = static_cast<std::size_t>(width_);
  const auto h = static_cast<std::size_t>(height_);
  const auto brightness = [&](std::size_t x, std::size_t y) {
    const glm::vec3& texel = environment.texels[y * w + x];
    return static_cast<double>(texel.x) + static_cast<double>(texel.y) + static_cast<double>(texel.z);
  };
  // The filter reaches into the neighbours, so they count: 1 2 1 along each axis. Where there is no light at all, none is missed.
  std::vector<double> weights;
  weights.reserve(w * h);
  sums_.assign((w + 1) * (h + 1), 0.0);
  for (std::size_t y = 0; y < h; ++y) {
    const double sine = std::sin(std::numbers::pi * (static_cast<double>(y) + 0.5) / static_cast<double>(h));
    double row_sum = 0.0;
    for (std::size_t x = 0; x < w; ++x) {
      double sum = 0.0;
      for (const std::size_t row : {y == 0 ? 0 : y - 1, y, y, y + 1 == h ? y : y + 1}) {
        sum += brightness((x + w - 1) % w, row) + 2.0 * brightness(x, row) + brightness((x + 1) % w, row);
      }
      weights.push_back(sum * sine);
      row_sum += sum * sine;
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

glm::dvec3 ImageSampling::direction(double u, double v) const {
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
  return upright.direction({(static_cast<double>(left) + u) / width_, (static_cast<double>(top) + v) / height_});
}

PointRows point_rows(int count, std::uint64_t seed, const ImageSampling* image) {
  PointRows out;
  out.columns = std::clamp(count, 1, widest_row);
  const int pairs = (std::max(count, 1) + out.columns - 1) / out.columns;
  out.rows = 2 * pairs;
  out.texels.assign(static_cast<std::size_t>(out.columns) * static_cast<std::size_t>(out.rows), glm::vec4(0.0F));
  for (int i = 0; i < pairs * out.columns; ++i) {
    const double u = around(radical_inverse(static_cast<std::uint32_t>(i + 1), 2) + shift(seed, std::numbers::sqrt2));
    const double v = around(radical_inverse(static_cast<std::uint32_t>(i + 1), 3) + shift(seed, std::numbers::sqrt3));
    const auto at = static_cast<std::size_t>(2 * (i / out.columns) * out.columns + i % out.columns);
    out.texels[at] = glm::vec4(u, v, 0.0, 0.0);
    if (image != nullptr) {
      out.texels[at + static_cast<std::size_t>(out.columns)] = glm::vec4(glm::vec3(image->direction(u, v)), 0.0F);
    }
  }
  return out;
}

}  // namespace sheen::renderer
