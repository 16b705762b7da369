#include "golden/window_triangle.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include <glm/common.hpp>

namespace sheen::golden {
namespace {

// The point at a share of the way, in the window, from a to b: weights over depth, and 1 over depth, are affine there (OpenGL ES 3.0.6,
// section 3.5.1).
WindowPoint mix(const WindowPoint& a, const WindowPoint& b, double share, bool perspective) {
  const glm::dvec2 window = glm::mix(a.window, b.window, share);
  if (!perspective) {
    return {window, glm::mix(a.weights, b.weights, share), glm::mix(a.depth, b.depth, share)};
  }
  const double depth = 1.0 / glm::mix(1.0 / a.depth, 1.0 / b.depth, share);
  return {window, depth * glm::mix(a.weights / a.depth, b.weights / b.depth, share), depth};
}

// Sutherland and Hodgman 1974, "Reentrant Polygon Clipping": keeps what has inside(point) >= 0.
template <class Point, class Inside, class Cut>
std::vector<Point> clipped(const std::vector<Point>& polygon, const Inside& inside, const Cut& cut) {
  std::vector<Point> out;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point& here = polygon[i];
    const Point& next = polygon[(i + 1) % polygon.size()];
    const double at_here = inside(here);
    const double at_next = inside(next);
    if (at_here >= 0.0) {
      out.push_back(here);
    }
    if ((at_here < 0.0) != (at_next < 0.0) && at_here != 0.0 && at_next != 0.0) {
      out.push_back(cut(here, next, at_here / (at_here - at_next)));
    }
  }
  return out;
}

struct Corner {
  glm::dvec3 weights;
  double depth;
};

}  // namespace

std::vector<WindowPoint> window_polygon(const Geometry& geometry, const RayGenerator& rays, std::uint32_t triangle) {
  const auto& v = geometry.vertices(triangle);
  const auto& positions = geometry.positions();
  std::vector<Corner> corners;
  for (int i = 0; i < 3; ++i) {
    glm::dvec3 weights(0.0);
    weights[i] = 1.0;
    corners.push_back({weights, rays.depth(positions[v.at(static_cast<std::size_t>(i))])});
  }
  const auto cut = [](const Corner& a, const Corner& b, double share) {
    return Corner{glm::mix(a.weights, b.weights, share), glm::mix(a.depth, b.depth, share)};
  };
  const scene::Camera& camera = rays.camera();
  corners = clipped(
      corners, [&](const Corner& c) { return c.depth - camera.znear; }, cut);
  if (std::isfinite(camera.zfar)) {
    corners = clipped(
        corners, [&](const Corner& c) { return camera.zfar - c.depth; }, cut);
  }
  std::vector<WindowPoint> out;
  for (const Corner& c : corners) {
    const glm::dvec3 point = positions[v[0]] * c.weights.x + positions[v[1]] * c.weights.y + positions[v[2]] * c.weights.z;
    out.push_back({rays.window(point), c.weights, c.depth});
  }
  return out;
}

std::vector<WindowPoint> between(const std::vector<WindowPoint>& polygon, int axis, double low, double high, bool perspective) {
  const auto cut = [&](const WindowPoint& a, const WindowPoint& b, double share) { return mix(a, b, share, perspective); };
  const std::vector<WindowPoint> above = clipped(
      polygon, [&](const WindowPoint& p) { return p.window[axis] - low; }, cut);
  return clipped(
      above, [&](const WindowPoint& p) { return high - p.window[axis]; }, cut);
}

std::vector<WindowPoint> around(const std::vector<WindowPoint>& polygon, const glm::dvec2& place, double reach, bool perspective) {
  const std::vector<WindowPoint> column = between(polygon, 0, place.x - reach, place.x + reach, perspective);
  return between(column, 1, place.y - reach, place.y + reach, perspective);
}

// Twice the area that the place spans with an edge changes by up to reach times the L1 distances of its ends, and 2 reach^2.
bool may_cover_turned_over(const std::vector<WindowPoint>& polygon, const glm::dvec2& place, double reach) {
  double twice_area = 0.0;
  std::vector<std::pair<double, double>> edges;  // the area spanned, and how far it may change
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec2 a = polygon[i].window - place;
    const glm::dvec2 b = polygon[(i + 1) % polygon.size()].window - place;
    const double spanned = a.x * b.y - a.y * b.x;
    edges.emplace_back(spanned, reach * (std::abs(a.x) + std::abs(a.y) + std::abs(b.x) + std::abs(b.y)) + 2.0 * reach * reach);
    twice_area += spanned;
  }
  const double side = twice_area < 0.0 ? -1.0 : 1.0;
  return std::all_of(edges.begin(), edges.end(), [side](const auto& edge) { return side * edge.first <= edge.second; });
}

}  // namespace sheen::golden
