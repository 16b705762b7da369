#include "golden/image_light.h"

#include <algorithm>
#include <cmath>

namespace sheen::golden {
namespace {

// Where u falls among cumulative shares, and how far into its interval.
std::size_t find(const double* cdf, std::size_t count, double u, double& within) {
  const double* above = std::upper_bound(cdf + 1, cdf + count, u);
  const auto index = static_cast<std::size_t>(above - cdf - 1);
  const double share = cdf[index + 1] - cdf[index];
  within = share > 0.0 ? std::clamp((u - cdf[index]) / share, 0.0, 1.0) : 0.5;
  return index;
}

// The inverse of the distribution of density 1 - |t| on [-1, 1].
double under_tent(double u) {
  return u < 0.5 ? std::sqrt(2.0 * u) - 1.0 : 1.0 - std::sqrt(2.0 - 2.0 * u);
}

}  // namespace

ImageLight::ImageLight(int width, int height, const std::vector<glm::vec3>& texels, double rotation) {
  const auto w = static_cast<std::size_t>(width);
  const auto h = static_cast<std::size_t>(height);
  rgbw_.resize(4 * w * h);
  for (std::size_t y = 0; y < h; ++y) {
    const double sine = std::sin(brdf::pi * (static_cast<double>(y) + 0.5) / height);
    for (std::size_t x = 0; x < w; ++x) {
      const glm::vec3& t = texels[y * w + x];
      float* out = rgbw_.data() + 4 * (y * w + x);
      out[0] = t.x;
      out[1] = t.y;
      out[2] = t.z;
      out[3] = static_cast<float>((static_cast<double>(t.x) + t.y + t.z) * sine);
      total_ += out[3];
    }
  }
  lookup_ = {nullptr, width, height, rotation / (2.0 * brdf::pi), height, -1, width, -1};
  if (dark()) {
    return;
  }
  // A tent's integral over the image's (u, v) is one texel's share of it, and d omega = 2 pi^2 sin(theta) du dv.
  const double scale = static_cast<double>(w * h) / (2.0 * brdf::pi * brdf::pi * total_);
  row_cdf_.assign(1, 0.0);
  column_cdf_.reserve(h * (w + 1));
  for (std::size_t y = 0; y < h; ++y) {
    const std::size_t first = column_cdf_.size();
    column_cdf_.push_back(0.0);
    for (std::size_t x = 0; x < w; ++x) {
      float& weight = rgbw_[4 * (y * w + x) + 3];
      weight = static_cast<float>(weight * scale);
      column_cdf_.push_back(column_cdf_.back() + static_cast<double>(weight));
      if (weight > 0.0F) {
        lookup_.first_row = std::min(lookup_.first_row, static_cast<int>(y));
        lookup_.last_row = static_cast<int>(y);
        lookup_.first_column = std::min(lookup_.first_column, static_cast<int>(x));
        lookup_.last_column = std::max(lookup_.last_column, static_cast<int>(x));
      }
    }
    const double total = column_cdf_.back();
    for (std::size_t i = first; i < column_cdf_.size(); ++i) {
      column_cdf_[i] = total > 0.0 ? column_cdf_[i] / total : static_cast<double>(i - first) / width;
    }
    row_cdf_.push_back(row_cdf_.back() + total);
  }
  for (double& share : row_cdf_) {
    share /= row_cdf_.back();
  }
  lookup_.rgbw = rgbw_.data();
}

LightPoint ImageLight::sample(double u, double v) const {
  const auto w = static_cast<std::size_t>(lookup_.width);
  double in_row = 0.0;
  double in_column = 0.0;
  const std::size_t row = find(row_cdf_.data(), row_cdf_.size() - 1, v, in_row);
  const std::size_t column = find(column_cdf_.data() + row * (w + 1), w, u, in_column);
  // The first and the last row reach to the pole: there the tent's outer half is folded back, which makes it a constant.
  const double height = lookup_.height;
  double y = static_cast<double>(row) + 0.5 + under_tent(in_row);
  y = y < 0.0 ? -y : y > height ? 2.0 * height - y : y;
  const double x = static_cast<double>(column) + 0.5 + under_tent(in_column);
  const double azimuth = 2.0 * brdf::pi * (x / lookup_.width - 0.5 - lookup_.turns);
  const double theta = brdf::pi * y / height;
  const Vec3<double> d{std::sin(theta) * std::cos(azimuth), std::cos(theta), std::sin(theta) * std::sin(azimuth)};
  const Arrived<double> arrived = look_up(lookup_, ImagePlace<double>(lookup_, d));
  return {d.x, d.y, d.z, arrived.radiance.r, arrived.radiance.g, arrived.radiance.b, arrived.density};
}

}  // namespace sheen::golden
