#include "image/flip.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

#include <tbb/blocked_range2d.h>
#include <tbb/parallel_for.h>

#include "image/flip_color.h"
#include "image/flip_filters.h"

namespace sheen::image {
namespace {

// Andersson et al. 2020, section 4.1.3: exponent, and the point (p_c of the largest error, p_t of the range) of the error's remapping.
constexpr float q_c = 0.7f;
constexpr float p_c = 0.4f;
constexpr float p_t = 0.95f;
// Section 4.2, equation 8: exponent of the feature difference, 0.5, taken as a square root where it is used.

/// Rows and columns of a picture that one task computes: small enough for a core's cache, large enough that the border the filters reach
/// into costs little.
constexpr int tile_width = 128, tile_height = 64;

/// A tile of the picture, with the border of `reach` pixels around it that the filters need, clamped to the picture (replicated edges).
struct Tile {
  int x0, y0, width, height, reach;
};

/// Pixel of the padded tile, replicated at the picture's edge.
const float* pixel(const LinearRgb& picture, const Tile& tile, int x, int y) {
  const int px = std::clamp(tile.x0 - tile.reach + x, 0, picture.width - 1);
  const int py = std::clamp(tile.y0 - tile.reach + y, 0, picture.height - 1);
  return picture.values.data() +
         3 * (static_cast<std::size_t>(py) * static_cast<std::size_t>(picture.width) + static_cast<std::size_t>(px));
}

/// Whether all that a tile's FLIP depends on is equal: then it is 0 exactly, whatever the exposure.
bool equal_around(const LinearRgb& a, const LinearRgb& b, const Tile& tile) {
  const int left = std::max(tile.x0 - tile.reach, 0);
  const int right = std::min(tile.x0 + tile.width + tile.reach, a.width);
  for (int y = std::max(tile.y0 - tile.reach, 0); y < std::min(tile.y0 + tile.height + tile.reach, a.height); ++y) {
    const std::size_t row = static_cast<std::size_t>(y) * static_cast<std::size_t>(a.width);
    const auto begin = static_cast<std::ptrdiff_t>(3 * (row + static_cast<std::size_t>(left)));
    const auto end = static_cast<std::ptrdiff_t>(3 * (row + static_cast<std::size_t>(right)));
    if (!std::equal(a.values.begin() + begin, a.values.begin() + end, b.values.begin() + begin)) {
      return false;
    }
  }
  return true;
}

/// The part of `plane` that a filter of `radius` needs, out of one padded by `reach`.
Plane trimmed(const Plane& plane, int reach, int radius) {
  const int margin = reach - radius;
  Plane out(plane.width - 2 * margin, plane.height - 2 * margin);
  for (int y = 0; y < out.height; ++y) {
    std::copy_n(plane.row(y + margin) + margin, out.width, out.row(y));
  }
  return out;
}

Plane filtered(const Plane& plane, const SeparableGaussians& filter) {
  Plane sum;
  for (std::size_t i = 0; i < filter.kernels.size(); ++i) {
    Plane part = correlate_columns(correlate_rows(plane, filter.kernels[i]), filter.kernels[i]);
    for (float& value : part.values) {
      value *= filter.weights[i];
    }
    if (i == 0) {
      sum = std::move(part);
    } else {
      for (std::size_t j = 0; j < sum.values.size(); ++j) {
        sum.values[j] += part.values[j];
      }
    }
  }
  return sum;
}

/// What FLIP sees of one picture in one tile.
struct Seen {
  std::vector<Color> lab;  ///< filtered, in Hunt-adjusted L*a*b*
  Plane edge, point;       ///< magnitudes of the feature detectors
};

Plane magnitude(const Plane& a, const Plane& b) {
  Plane out(a.width, a.height);
  for (std::size_t i = 0; i < out.values.size(); ++i) {
    out.values[i] = std::sqrt(a.values[i] * a.values[i] + b.values[i] * b.values[i]);
  }
  return out;
}

/// Andersson et al. 2020, section 4.2: the detectors run on Yy mapped to [0, 1].
void detect_features(const Plane& lightness, const FlipFilters& filters, Seen& seen) {
  Plane y = trimmed(lightness, filters.reach(), filters.feature_radius);
  for (float& value : y.values) {
    value = (value + 16) / 116;
  }
  const Plane blurred = correlate_rows(y, filters.feature_blur);
  seen.edge = magnitude(correlate_columns(correlate_rows(y, filters.feature_edge), filters.feature_blur),
                        correlate_columns(blurred, filters.feature_edge));
  seen.point = magnitude(correlate_columns(correlate_rows(y, filters.feature_point), filters.feature_blur),
                         correlate_columns(blurred, filters.feature_point));
}

Seen look(const LinearRgb& picture, const Tile& tile, const FlipFilters& filters, const std::function<float(float)>& display) {
  Plane yy(tile.width + 2 * tile.reach, tile.height + 2 * tile.reach);
  Plane cx(yy.width, yy.height);
  Plane cz(yy.width, yy.height);
  for (int y = 0; y < yy.height; ++y) {
    for (int x = 0; x < yy.width; ++x) {
      const float* rgb = pixel(picture, tile, x, y);
      const Color ycxcz = rgb_to_ycxcz({display(rgb[0]), display(rgb[1]), display(rgb[2])});
      yy.row(y)[x] = ycxcz.x;
      cx.row(y)[x] = ycxcz.y;
      cz.row(y)[x] = ycxcz.z;
    }
  }
  Seen seen;
  detect_features(yy, filters, seen);
  const Plane a = filtered(trimmed(yy, tile.reach, filters.spatial_radius), filters.achromatic);
  const Plane rg = filtered(trimmed(cx, tile.reach, filters.spatial_radius), filters.red_green);
  const Plane by = filtered(trimmed(cz, tile.reach, filters.spatial_radius), filters.blue_yellow);
  seen.lab.reserve(a.values.size());
  for (std::size_t i = 0; i < a.values.size(); ++i) {
    const Color rgb = ycxcz_to_rgb({a.values[i], rg.values[i], by.values[i]});
    // Section 4.1.1: colours are clamped to the display's cube after filtering.
    seen.lab.push_back(rgb_to_hunt_lab({std::clamp(rgb.x, 0.0f, 1.0f), std::clamp(rgb.y, 0.0f, 1.0f), std::clamp(rgb.z, 0.0f, 1.0f)}));
  }
  return seen;
}

/// Section 4.1.3: c_max is the error between the two colours of the cube that lie farthest apart, green and blue.
float largest_color_error() {
  return std::pow(hyab(rgb_to_hunt_lab({0, 1, 0}), rgb_to_hunt_lab({0, 0, 1})), q_c);
}

float color_error(Color reference, Color test, float largest) {
  const float error = std::pow(hyab(reference, test), q_c);
  const float knee = p_c * largest;
  return error < knee ? p_t / knee * error : p_t + (error - knee) / (largest - knee) * (1 - p_t);
}

/// Raises `map` to the tile's LDR-FLIP where that is larger. Section 4.3, equation 9: color error ^ (1 - feature error).
void add_tile(const Seen& reference, const Seen& test, const Tile& tile, float largest, int width, std::vector<float>& map) {
  constexpr float inverse_root_2 = 0.70710678f;  // equation 8: the detectors' magnitudes reach sqrt(2)
  for (int y = 0; y < tile.height; ++y) {
    for (int x = 0; x < tile.width; ++x) {
      const auto i = static_cast<std::size_t>(y) * static_cast<std::size_t>(tile.width) + static_cast<std::size_t>(x);
      const float edge = std::abs(reference.edge.values[i] - test.edge.values[i]);
      const float point = std::abs(reference.point.values[i] - test.point.values[i]);
      const float feature = std::sqrt(inverse_root_2 * std::max(edge, point));
      const float color = color_error(reference.lab[i], test.lab[i], largest);
      const float flip = std::pow(color, 1 - std::min(feature, 1.0f));
      float& value = map[static_cast<std::size_t>(tile.y0 + y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(tile.x0 + x)];
      value = std::max(value, std::min(flip, 1.0f));
    }
  }
}

/// The largest FLIP per pixel over the ways of displaying the pictures.
std::vector<float> largest_flip(const LinearRgb& reference, const LinearRgb& test, const std::vector<std::function<float(float)>>& displays,
                                double pixels_per_degree) {
  const FlipFilters filters = flip_filters(pixels_per_degree);
  const float largest = largest_color_error();
  std::vector<float> map(static_cast<std::size_t>(reference.width) * static_cast<std::size_t>(reference.height), 0.0f);
  const int columns = (reference.width + tile_width - 1) / tile_width;
  const int rows = (reference.height + tile_height - 1) / tile_height;
  tbb::parallel_for(tbb::blocked_range2d<int>(0, rows, 1, 0, columns, 1), [&](const tbb::blocked_range2d<int>& range) {
    for (int row = range.rows().begin(); row != range.rows().end(); ++row) {
      for (int column = range.cols().begin(); column != range.cols().end(); ++column) {
        const int x0 = column * tile_width, y0 = row * tile_height;
        const Tile tile{x0, y0, std::min(tile_width, reference.width - x0), std::min(tile_height, reference.height - y0), filters.reach()};
        if (equal_around(reference, test, tile)) {
          continue;
        }
        for (const auto& display : displays) {
          add_tile(look(reference, tile, filters, display), look(test, tile, filters, display), tile, largest, reference.width, map);
        }
      }
    }
  });
  return map;
}

}  // namespace

std::vector<float> ldr_flip(const LinearRgb& reference, const LinearRgb& test, double pixels_per_degree) {
  return largest_flip(reference, test, {[](float value) { return std::clamp(value, 0.0f, 1.0f); }}, pixels_per_degree);
}

std::vector<float> hdr_flip(const LinearRgb& reference, const LinearRgb& test, const Exposures& exposures, double pixels_per_degree) {
  std::vector<std::function<float(float)>> displays;
  for (int i = 0; i < exposures.count; ++i) {
    const auto factor = static_cast<float>(std::min(std::exp2(exposures.at(i)), 1e30));  // finite, so that black stays black
    displays.emplace_back([factor](float value) { return aces_tone_map(factor * std::max(value, 0.0f)); });
  }
  return largest_flip(reference, test, displays, pixels_per_degree);
}

}  // namespace sheen::image
