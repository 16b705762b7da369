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

// The interval of running sums that holds a share of their total, which becomes how far inside it lies, in [0, 1).
std::size_t place(const double* ends, std::size_t count, double& share) {
  const double at = share * ends[count - 1];
  const auto index = static_cast<std::size_t>(std::upper_bound(ends, ends + count - 1, at) - ends);
  const double begin = index == 0 ? 0.0 : ends[index - 1];
  share = ends[index] > begin ? std::clamp((at - begin) / (ends[index] - begin), 0.0, 1.0 - 1e-12) : 0.5;
  return index;
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
  std::vector<double> sums(w * h);  // running, texel by texel
  double total = 0.0;
  for (std::size_t y = 0; y < h; ++y) {
    const double sine = std::sin(std::numbers::pi * (static_cast<double>(y) + 0.5) / static_cast<double>(h));
    double row_sum = 0.0;
    for (std::size_t x = 0; x < w; ++x) {
      double sum = 0.0;
      for (const std::size_t row : {y == 0 ? 0 : y - 1, y, y, y + 1 == h ? y : y + 1}) {
        sum += brightness((x + w - 1) % w, row) + 2.0 * brightness(x, row) + brightness((x + 1) % w, row);
      }
      row_sum += sum * sine;
      sums[y * w + x] = row_sum;
    }
    total += row_sum;
    row_ends_.push_back(total);
  }
  const double texels = static_cast<double>(w) * static_cast<double>(h);
  densities_.reserve(w * h);
  for (std::size_t i = 0; i < w * h; ++i) {
    const double share = total > 0.0 ? (sums[i] - (i % w == 0 ? 0.0 : sums[i - 1])) / total : 1.0 / texels;
    // d omega = 2 pi^2 sin(theta) du dv
    densities_.push_back(static_cast<float>(share * texels / (2.0 * std::numbers::pi * std::numbers::pi)));
  }
  column_ends_ = std::move(sums);
}

glm::dvec3 ImageSampling::direction(double u, double v) const {
  const std::size_t row = place(row_ends_.data(), row_ends_.size(), v);
  const auto w = static_cast<std::size_t>(width_);
  const std::size_t column = place(column_ends_.data() + row * w, w, u);
  const scene::Environment upright;
  return upright.direction({(static_cast<double>(column) + u) / width_, (static_cast<double>(row) + v) / height_});
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
