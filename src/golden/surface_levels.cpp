// Levels of detail that OpenGL ES leaves open to a driver, of the textures of a surface.
#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "golden/surface_reader.h"

namespace sheen::golden {

namespace {

// Both ends and multiples of `spacing`.
std::vector<double> spaced(const LodInterval& range, double spacing) {
  std::vector<double> levels{range.low};
  for (double i = std::floor(range.low / spacing) + 1.0; i < range.high / spacing; i += 1.0) {
    levels.push_back(i * spacing);
  }
  if (range.high > range.low) {
    levels.push_back(range.high);
  }
  // Where magnification ends, sample() may jump.
  for (const double threshold : {0.0, 0.5}) {
    const double beyond = std::nextafter(threshold, 1.0);
    if (beyond > range.low && beyond < range.high) {
      levels.insert(std::upper_bound(levels.begin(), levels.end(), beyond), beyond);
    }
  }
  return levels;
}

}  // namespace

std::vector<double> corners_within(const LodInterval& range) {
  return spaced(range, 1.0);
}

std::vector<double> levels_within(const LodInterval& range) {
  return spaced(range, 0.25);
}

// The levels OpenGL ES allows, less what lies below level 0 and above the last: there nothing changes.
LodInterval SurfaceReader::lod_interval(const Slot& slot, const Hit& hit, const Ray& ray) const {
  const glm::dvec2 size = slot.texture->size();
  const double last = std::log2(std::max(size.x, size.y)) + 1.0;
  glm::dvec2 texels[9];
  bool beyond = false;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      texels[3 * row + column] = texcoord(slot, hit, weights_beside(hit, ray, column - 1, row - 1, beyond)) * size;
    }
  }
  if (beyond) {
    return {-1.0, last};
  }
  const LodRange range = lod_range(texels);
  const double low = std::clamp(range.lowest, -1.0, last);
  return {low, std::clamp(range.highest, low, last)};
}

std::optional<LodInterval> SurfaceReader::lod_interval(const Hit& hit, const Ray& ray, std::size_t slot) const {
  const Slot& s = slot_of(materials_[static_cast<std::size_t>(geometry_.placed(hit.triangle).material_index)], slot);
  return s.texture && s.texture->needs_lod() ? std::optional(lod_interval(s, hit, ray)) : std::nullopt;
}

std::vector<double> SurfaceReader::levels_to_try(const Hit& hit, const Ray& ray, std::size_t slot) const {
  const std::optional<LodInterval> range = lod_interval(hit, ray, slot);
  if (!range || range->low == range->high) {
    return {};
  }
  const Material& m = materials_[static_cast<std::size_t>(geometry_.placed(hit.triangle).material_index)];
  const Slot& s = slot_of(m, slot);
  if (&s != &m.normal && &s != &m.clearcoat_normal) {
    return levels_within(*range);
  }
  const std::vector<double> levels = corners_within(*range);
  const auto normal_at = [&](double level) { return mapped_normal(hit, ray, {level, slot}); };
  const glm::dvec3 view = rays_.toward_camera(ray);
  std::vector<double> finer{levels.front()};
  glm::dvec3 before = normal_at(levels.front());
  const auto add = [&](double level, const glm::dvec3& after) {
    // Sheen's visibility has a cusp where the normal stands across the view.
    double low = finer.back();
    double high = level;
    const double side = glm::dot(before, view);
    if (side * glm::dot(after, view) < 0.0) {
      for (int halvings = 0; halvings < 16; ++halvings) {
        const double middle = 0.5 * (low + high);
        (side * glm::dot(normal_at(middle), view) > 0.0 ? low : high) = middle;
      }
      finer.push_back(low);
      finer.push_back(high);
    }
    finer.push_back(level);
    before = after;
  };
  constexpr double largest_angle = 0.01;
  constexpr double most = 256.0;  // between two whole levels: half a turn would need more
  for (std::size_t i = 1; i < levels.size(); ++i) {
    const glm::dvec3 after = normal_at(levels[i]);
    const double angle = std::atan2(glm::length(glm::cross(before, after)), glm::dot(before, after));
    const double steps = std::clamp(std::ceil(angle / largest_angle), 1.0, most);
    for (double step = 1.0; step < steps; step += 1.0) {
      const double level = levels[i - 1] + (levels[i] - levels[i - 1]) * step / steps;
      add(level, normal_at(level));
    }
    add(levels[i], after);
  }
  return finer;
}

}  // namespace sheen::golden
