#include "golden/environment_light.h"

#include <algorithm>
#include <cmath>

#include "brdf/math.h"

namespace sheen::golden {
namespace {

// Where u falls among cumulative shares, and how far into its interval.
std::size_t find(const double* cdf, std::size_t count, double u, double& within) {
  const double* above = std::upper_bound(cdf + 1, cdf + count, u);
  const auto index = static_cast<std::size_t>(above - cdf - 1);
  const double share = cdf[index + 1] - cdf[index];
  within = share > 0.0 ? std::clamp((u - cdf[index]) / share, 0.0, 1.0 - 1e-12) : 0.5;
  return index;
}

}  // namespace

EnvironmentLight::EnvironmentLight(const scene::Environment& environment) : environment_(environment) {
  const int w = environment.width;
  const int h = environment.height;
  const auto brightness = [&](int x, int y) {
    const glm::vec3& t = environment.texels[static_cast<std::size_t>(std::clamp(y, 0, h - 1)) * static_cast<std::size_t>(w) +
                                            static_cast<std::size_t>((x + w) % w)];
    return std::max(static_cast<double>(t.x + t.y + t.z), 0.0);
  };
  row_cdf_.assign(1, 0.0);
  column_cdf_.reserve(static_cast<std::size_t>(h) * (static_cast<std::size_t>(w) + 1));
  for (int y = 0; y < h; ++y) {
    const std::size_t first = column_cdf_.size();
    column_cdf_.push_back(0.0);
    for (int x = 0; x < w; ++x) {
      // The mean over the cell of the bilinear filter, which reaches half way into the neighbours: weights 1 6 1 over 8 along each axis.
      double mean = 0.0;
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          mean += (dx == 0 ? 6.0 : 1.0) * (dy == 0 ? 6.0 : 1.0) / 64.0 * brightness(x + dx, y + dy);
        }
      }
      column_cdf_.push_back(column_cdf_.back() + mean);
    }
    const double total = column_cdf_.back();
    for (std::size_t i = first; i < column_cdf_.size(); ++i) {
      column_cdf_[i] = total > 0.0 ? column_cdf_[i] / total : static_cast<double>(i - first) / w;
    }
    row_cdf_.push_back(row_cdf_.back() + total * std::sin(brdf::pi * (y + 0.5) / h));
  }
  const double total = row_cdf_.back();
  for (std::size_t i = 0; i < row_cdf_.size(); ++i) {
    row_cdf_[i] = total > 0.0 ? row_cdf_[i] / total : static_cast<double>(i) / h;
  }
}

glm::dvec3 EnvironmentLight::sample(double u, double v) const {
  const auto w = static_cast<std::size_t>(environment_.width);
  double in_row = 0.0;
  double in_column = 0.0;
  const std::size_t row = find(row_cdf_.data(), row_cdf_.size() - 1, v, in_row);
  const std::size_t column = find(column_cdf_.data() + row * (w + 1), w, u, in_column);
  return environment_.direction({(static_cast<double>(column) + in_column) / environment_.width,  //
                                 (static_cast<double>(row) + in_row) / environment_.height});
}

double EnvironmentLight::pdf(const glm::dvec3& direction) const {
  const auto w = static_cast<std::size_t>(environment_.width);
  const glm::dvec2 uv = environment_.coordinates(direction);
  const auto column = std::min(static_cast<std::size_t>(uv.x * environment_.width), w - 1);
  const auto row = std::min(static_cast<std::size_t>(uv.y * environment_.height), static_cast<std::size_t>(environment_.height) - 1);
  const double share =
      (row_cdf_[row + 1] - row_cdf_[row]) * (column_cdf_[row * (w + 1) + column + 1] - column_cdf_[row * (w + 1) + column]);
  // d omega = sin(theta) d theta d phi = 2 pi^2 sin(theta) du dv
  const double sine = std::sqrt(std::max(1.0 - direction.y * direction.y, 1e-300));
  return share * environment_.width * environment_.height / (2.0 * brdf::pi * brdf::pi * sine);
}

}  // namespace sheen::golden
