// Levels of detail that OpenGL ES leaves open to a driver, of the textures of a surface.
#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "golden/bound.h"
#include "golden/surface_reader.h"

namespace sheen::golden {

namespace {

constexpr std::size_t centre = 4, right_of_it = 5, below_it = 7;  // of the 3 x 3 pixels
constexpr int most_halvings = 10;  // of what lies between two corners: half a turn needs 9, if the map keeps its length

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

std::vector<LodInterval> straight_pieces(const Texture& texture, const LodInterval& range) {
  const double magnified = magnified_up_to(texture.sampler);
  std::vector<LodInterval> pieces;
  if (range.low <= magnified) {
    pieces.push_back({range.low, range.low});
  }
  if (range.high <= magnified) {
    return pieces;
  }
  // Just above a switch at a half, a sum with a half may still round to level 0.
  const double low = std::max(range.low, std::nextafter(magnified, 1.0));
  if (texture.sampler.mip == scene::MipFilter::Nearest) {
    for (double level = nearest_level(texture, low); level <= nearest_level(texture, range.high); level += 1.0) {
      pieces.push_back({std::max(low, level), std::max(low, level)});
    }
    return pieces;
  }
  const bool mixes = texture.sampler.mip == scene::MipFilter::Linear;
  const double high = mixes ? std::min(range.high, static_cast<double>(texture.levels->size() - 1)) : low;
  double from = low;
  do {
    const double to = std::max(low, std::min(std::floor(from) + 1.0, high));
    pieces.push_back({from, to});
    from = to;
  } while (from < high);
  return pieces;
}

// The stretch is what the snapping of vertices stretches a triangle by, whose weights change the faster the smaller it is.
SurfaceReader::Neighbourhood SurfaceReader::neighbourhood(const Hit& hit, const EdgeFunctions& edges) const {
  Neighbourhood out;
  out.stretch = 8.0 * epsilon;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      const auto i = static_cast<std::size_t>(3 * row + column);
      if (i == centre) {
        out.weights[i] = hit.weights;
        continue;
      }
      const EdgeFunctions::Beside beside = edges.beside(column - 1, row - 1);
      out.weights[i] = beside.weights;
      out.beyond = out.beyond || !beside.is_met;
      out.ideal_beyond = out.ideal_beyond || (!beside.is_met && (i == right_of_it || i == below_it));
      const glm::dvec3 change = glm::abs(beside.weights - hit.weights);
      out.stretch = std::max(out.stretch, 2.0 * step_ * (change.x + change.y + change.z));
    }
  }
  return out;
}

// The levels OpenGL ES allows, less what lies below level 0 and above the last: there nothing changes. Wider by what a shader that takes
// log2 of the coordinates' differences is off: two roundings of the coordinates, three more of the length and 4 ulp or 2^-21 of the
// logarithm; and by the stretch.
SurfaceReader::Lod SurfaceReader::lod(const Slot& slot, const Hit& hit, const Neighbourhood& beside) const {
  const glm::dvec2 size = slot.texture->size();
  const double last = std::log2(std::max(size.x, size.y)) + 1.0;
  const Placed& placed = geometry_.placed(hit.triangle);
  const auto& coordinates = placed.primitive->texcoords[static_cast<std::size_t>(slot.texcoord)];
  const auto vertices = geometry_.local_vertices(hit.triangle);
  glm::dvec2 at_vertices[3];
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec2 uv = coordinates.empty() ? glm::dvec2(0.0) : glm::dvec2(coordinates[vertices[i]]);
    at_vertices[i] = glm::dvec2(slot.transform * glm::dvec3(uv, 1.0)) * size;
  }
  glm::dvec2 texels[9];
  for (std::size_t i = 0; i < 9; ++i) {
    const glm::dvec3& w = beside.weights[i];
    texels[i] = at_vertices[0] * w.x + at_vertices[1] * w.y + at_vertices[2] * w.z;
  }
  const TexelSpans spans = texel_spans(texels);
  Lod out{beside.ideal_beyond ? coarsest_level : level_of(spans.ideal), {-1.0, last}};
  if (beside.beyond || !(beside.stretch < 1.0)) {
    return out;
  }
  const glm::dvec2 off = 2.0 * coordinate_rounding(slot, hit) * size;
  const auto widened = [&](double texels_spanned, double side) {
    const double spanned = texels_spanned * (1.0 + side * beside.stretch) + side * (off.x + off.y);
    const double level = spanned > 0.0 ? std::log2(spanned) : -1.0;
    return level + side * std::max(4.0 * epsilon * std::abs(level), 0x1p-21);
  };
  out.allowed.low = std::clamp(widened(spans.least, -1.0), -1.0, last);
  out.allowed.high = std::clamp(widened(spans.most, 1.0), out.allowed.low, last);
  return out;
}

std::optional<LodInterval> SurfaceReader::lod_interval(const Hit& hit, const Ray& ray, std::size_t slot) const {
  const Slot& s = slot_of(materials_[static_cast<std::size_t>(geometry_.placed(hit.triangle).material_index)], slot);
  if (!s.texture || !s.texture->needs_lod()) {
    return std::nullopt;
  }
  return lod(s, hit, neighbourhood(hit, TriangleEdges(geometry_, rays_, hit.triangle).at(geometry_, ray))).allowed;
}

std::vector<double> SurfaceReader::levels_to_try(const Hit& hit, const Ray& ray, std::size_t slot, double largest_angle) const {
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
  for (std::size_t i = 1; i < levels.size(); ++i) {
    const glm::dvec3 after = normal_at(levels[i]);
    // Halved until the normals are close; a map that shortens toward its coarser levels turns faster at one end.
    const auto reach = [&](const auto& self, double low, const glm::dvec3& at_low, double high, const glm::dvec3& at_high,
                           int depth) -> void {
      const double angle = std::atan2(glm::length(glm::cross(at_low, at_high)), glm::dot(at_low, at_high));
      if (angle > largest_angle && depth < most_halvings) {
        const double middle = 0.5 * (low + high);
        const glm::dvec3 at_middle = normal_at(middle);
        self(self, low, at_low, middle, at_middle, depth + 1);
        self(self, middle, at_middle, high, at_high, depth + 1);
      } else {
        add(high, at_high);
      }
    };
    reach(reach, levels[i - 1], before, levels[i], after, 0);
  }
  return finer;
}

}  // namespace sheen::golden
