#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "golden/geometry.h"
#include "golden/rays.h"

namespace sheen::golden {

/// A point of a triangle as the picture shows it.
struct WindowPoint {
  glm::dvec2 window;   ///< pixels from the top left corner
  glm::dvec3 weights;  ///< barycentrics in world space
  double depth;        ///< along the viewing axis
};

/// The part of a triangle that a picture may show, between the clip planes: the corners of a convex polygon, in order. It may have no area,
/// where the triangle has none or is seen edge on; empty where nothing lies between the planes.
std::vector<WindowPoint> window_polygon(const Geometry& geometry, const RayGenerator& rays, std::uint32_t triangle);

/// The part of a polygon with low <= x and x <= high, along either axis of the window. Its corners' weights hold those of all its points
/// between them.
std::vector<WindowPoint> between(const std::vector<WindowPoint>& polygon, int axis, double low, double high, bool perspective);

/// The part of a polygon within `reach` of a place along both axes. A driver that moves every vertex by up to `reach` and then finds that
/// the triangle covers a sample there shades it with the weights of one of these points: each vertex's share of the sample's place is its
/// share of that point's.
std::vector<WindowPoint> around(const std::vector<WindowPoint>& polygon, const glm::dvec2& place, double reach, bool perspective);

/// Whether a driver that moves every corner of a polygon by up to `reach` along both axes may find that it covers a place the other way
/// round: whether the place may come to lie on the other side of all its edges.
bool may_cover_turned_over(const std::vector<WindowPoint>& polygon, const glm::dvec2& place, double reach);

}  // namespace sheen::golden
