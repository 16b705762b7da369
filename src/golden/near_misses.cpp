#include "golden/near_misses.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <tbb/parallel_for.h>

#include "golden/vertex_rounding.h"
#include "golden/window_triangle.h"

namespace sheen::golden {
namespace {

RayGenerator between_farther_planes(const Frame& frame) {
  scene::Camera camera = frame.rays.camera();
  camera.znear -= 2.0 * frame.tracer.depth_tolerance(camera.znear);
  if (std::isfinite(camera.zfar)) {
    camera.zfar += 2.0 * frame.tracer.depth_tolerance(camera.zfar);
  }
  return {camera, frame.rays.width(), frame.rays.height()};
}

// Whether some depth of a range may be at a clip plane, within what a depth buffer tells: beyond a plane by a difference that grows more
// slowly than the tolerance, which at very great depths exceeds it again.
bool may_be_at_clip_plane(const Frame& frame, double nearest, double farthest) {
  const scene::Camera& camera = frame.rays.camera();
  const auto is_within = [&](double depth, double plane) { return std::abs(depth - plane) <= frame.tracer.depth_tolerance(depth); };
  const bool reaches_near = farthest >= camera.znear || is_within(farthest, camera.znear);
  const bool at_near = reaches_near && (nearest <= camera.znear || is_within(nearest, camera.znear) || is_within(farthest, camera.znear));
  return at_near || farthest >= camera.zfar || is_within(farthest, camera.zfar);
}

// Of a pixel, what triangles do, which are gone through side by side.
constexpr std::uint8_t missed = 1;
constexpr std::uint8_t covered_once = 2;
constexpr std::uint8_t covered_again = 4;

struct Interval {
  double low, high;
};

Interval extent(const std::vector<WindowPoint>& polygon, int axis) {
  const auto [low, high] = std::minmax_element(
      polygon.begin(), polygon.end(), [axis](const WindowPoint& a, const WindowPoint& b) { return a.window[axis] < b.window[axis]; });
  return {low->window[axis], high->window[axis]};
}

// How far the part of a convex polygon between two rows reaches across: its corners there, and where its edges meet the rows. Low is above
// high where there is no such part.
Interval extent_between(const std::vector<WindowPoint>& polygon, double low, double high) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Interval across{infinity, -infinity};
  const auto include = [&across](double x) { across = {std::min(across.low, x), std::max(across.high, x)}; };
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec2& a = polygon[i].window;
    const glm::dvec2& b = polygon[i + 1 < polygon.size() ? i + 1 : 0].window;
    if (a.y >= low && a.y <= high) {
      include(a.x);
    }
    for (const double row : {low, high}) {
      if ((a.y < row && b.y > row) || (a.y > row && b.y < row)) {
        include(a.x + (b.x - a.x) * ((row - a.y) / (b.y - a.y)));
      }
    }
  }
  return across;
}

// Pixels whose centres lie within `reach` of an interval: [first, last).
std::pair<int, int> pixels(const Interval& interval, double reach, int size) {
  const double first = std::clamp(std::ceil(interval.low - reach - 0.5), 0.0, static_cast<double>(size));
  const double last = std::clamp(std::floor(interval.high + reach - 0.5) + 1.0, first, static_cast<double>(size));
  return {static_cast<int>(first), static_cast<int>(last)};
}

// Whether moving every corner by up to `reach` along both axes may change the sign of the area.
bool may_turn_over(const std::vector<WindowPoint>& polygon, double reach) {
  double twice_area = 0.0;
  double around = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec2 a = polygon[i].window - polygon[0].window;
    const glm::dvec2 b = polygon[(i + 1) % polygon.size()].window - polygon[0].window;
    twice_area += a.x * b.y - a.y * b.x;
    around += std::abs(b.x - a.x) + std::abs(b.y - a.y);
  }
  // Of a triangle, to first order, the reach times the way around; of a triangle that a clip plane cuts, at most twice that.
  return std::abs(twice_area) <= 2.0 * reach * around + 2.0 * static_cast<double>(polygon.size()) * reach * reach;
}

// How far along either axis a driver may move the points of a triangle: its grid, and the roundings of its vertices. Of these a point has,
// relative to its depth, a mean: a corner of the polygon has the most. What moves by whole pixels is nothing to compare.
double reach_of(const Frame& frame, std::uint32_t triangle, const std::vector<WindowPoint>& polygon) {
  const double grid = std::ldexp(0.5, -frame.settings.subpixel_bits);
  double most = displacement(frame.settings);
  const VertexRounding rounding(frame.geometry, frame.rays, triangle);
  for (const WindowPoint& corner : polygon) {
    const Hit hit{triangle, corner.weights, corner.depth, true};
    most = std::max(most, grid + rounding.in_window(frame.rays, hit));
  }
  return std::min(most, 1.0);
}

std::uint64_t pixel_at(int x, int y, int width) {
  return static_cast<std::uint64_t>(y) * static_cast<std::uint64_t>(width) + static_cast<std::uint64_t>(x);
}

}  // namespace

void NearMisses::add(const Frame& frame, std::uint32_t triangle, std::vector<NearMiss>& misses) {
  // Two corners in one place stay there.
  const auto& positions = frame.geometry.placed(triangle).primitive->positions;
  const std::array<std::uint32_t, 3> corners = frame.geometry.local_vertices(triangle);
  const glm::vec3& a = positions[corners[0]];
  const glm::vec3& b = positions[corners[1]];
  const glm::vec3& c = positions[corners[2]];
  if (a == b || b == c || c == a) {
    return;
  }
  const bool is_noted = note_at_clip_plane(frame, triangle);
  const std::vector<WindowPoint> polygon = window_polygon(frame.geometry, frame.rays, triangle);
  if (polygon.empty()) {
    return;
  }
  const Interval across = extent(polygon, 0);
  const Interval along = extent(polygon, 1);
  const int width = frame.rays.width();
  const int height = frame.rays.height();
  const auto none = [](const std::pair<int, int>& range) { return range.first >= range.second; };
  if (none(pixels(across, 1.0, width)) || none(pixels(along, 1.0, height))) {
    return;
  }
  const double reach = reach_of(frame, triangle, polygon);
  const double near = std::max(reach, near_steps * displacement(frame.settings));
  const std::pair<int, int> rows = pixels(along, near, height);
  if (none(rows) || none(pixels(across, near, width))) {
    return;
  }
  const bool turns = may_turn_over(polygon, reach);
  if (!turns && !frame.geometry.placed(triangle).material->double_sided) {
    const glm::dvec2 middle = (polygon[0].window + polygon[1].window + polygon[2].window) / 3.0;
    const std::optional<Hit> met = frame.geometry.meet(triangle, frame.rays.through(middle.x, middle.y));
    if (met && !met->front) {
      return;
    }
  }
  // Of a row, the pixels that some point within so much of their centres' line comes so near to.
  const auto touched = [&](int y, double within) {
    const Interval strip = extent_between(polygon, y + 0.5 - within, y + 0.5 + within);
    return strip.low > strip.high ? std::pair(0, 0) : pixels(strip, within, width);
  };
  for (int y = rows.first; y < rows.second; ++y) {
    // Of a triangle that may turn over, what it covers is missed as well.
    const std::pair<int, int> covered = turns ? std::pair(0, 0) : touched(y, 0.0);
    const auto is_covered = [&covered](int x) { return x >= covered.first && x < covered.second; };
    const std::pair<int, int> neared = touched(y, near);
    if (!is_noted) {
      const auto [first, last] = covered.first < covered.second ? covered : std::pair(neared.second, neared.second);
      note_missed(y, neared.first, first);
      note_covered(y, first, last);
      note_missed(y, last, neared.second);
    }
    if (neared == covered) {
      continue;
    }
    const std::pair<int, int> reached = touched(y, reach);
    for (int x = reached.first; x < reached.second; ++x) {
      if (!is_covered(x)) {
        misses.push_back({pixel_at(x, y, width), triangle, reach});
      }
    }
  }
}

// A triangle that may be at a clip plane is missed wherever it would be seen without: whether it is there is not its edges' matter alone.
bool NearMisses::note_at_clip_plane(const Frame& frame, std::uint32_t triangle) {
  double nearest = std::numeric_limits<double>::infinity();
  double farthest = -nearest;
  for (const std::uint32_t vertex : frame.geometry.vertices(triangle)) {
    const double depth = frame.rays.depth(frame.geometry.positions()[vertex]);
    nearest = std::min(nearest, depth);
    farthest = std::max(farthest, depth);
  }
  if (!may_be_at_clip_plane(frame, nearest, farthest)) {
    return false;
  }
  const std::vector<WindowPoint> polygon = window_polygon(frame.geometry, beyond_, triangle);
  if (!polygon.empty()) {
    const double within = std::max(1.0, near_steps * displacement(frame.settings));
    const std::pair<int, int> columns = pixels(extent(polygon, 0), within, beyond_.width());
    const std::pair<int, int> rows = pixels(extent(polygon, 1), within, beyond_.height());
    for (int y = rows.first; y < rows.second; ++y) {
      note_missed(y, columns.first, columns.second);
    }
  }
  return true;
}

// The pixels [first, last) of a row. To read costs less than to write, and most of what lies behind much else is noted already.
void NearMisses::note_missed(int y, int first, int last) {
  for (int x = first; x < last; ++x) {
    std::atomic<std::uint8_t>& seen = seen_[pixel_at(x, y, width_)];
    if ((seen.load(std::memory_order_relaxed) & missed) == 0) {
      seen.fetch_or(missed, std::memory_order_relaxed);
    }
  }
}

// Returns whether another triangle that covers it would change nothing.
bool NearMisses::note_covered(std::uint64_t pixel) {
  std::atomic<std::uint8_t>& seen = seen_[pixel];
  if ((seen.load(std::memory_order_relaxed) & (missed | covered_again)) != 0) {
    return true;
  }
  if ((seen.fetch_or(covered_once, std::memory_order_relaxed) & covered_once) == 0) {
    return false;
  }
  seen.fetch_or(covered_again, std::memory_order_relaxed);
  return true;
}

// The pixels [first, last) of a row.
void NearMisses::note_covered(int y, int first, int last) {
  for (int x = first; x < last;) {
    const int end = std::min(last, (x / block + 1) * block);
    const bool is_whole = end - x == block;
    std::atomic<bool>& settled = settled_[pixel_at(x / block, y, blocks_)];
    if (is_whole && settled.load(std::memory_order_relaxed)) {
      x = end;
      continue;
    }
    bool all = is_whole;
    for (; x < end; ++x) {
      all = note_covered(pixel_at(x, y, width_)) && all;
    }
    if (all) {
      settled.store(true, std::memory_order_relaxed);
    }
  }
}

NearMisses::NearMisses(const Frame& frame)
    : width_(frame.rays.width()),
      beyond_(between_farther_planes(frame)),
      blocks_((frame.rays.width() + block - 1) / block),
      seen_(static_cast<std::size_t>(frame.rays.width()) * static_cast<std::size_t>(frame.rays.height())),
      settled_(static_cast<std::size_t>(blocks_) * static_cast<std::size_t>(frame.rays.height())) {
  constexpr std::size_t at_once = 1024;  // triangles
  const std::size_t count = frame.geometry.triangle_count();
  std::vector<std::vector<NearMiss>> parts((count + at_once - 1) / at_once);
  tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t part) {
    for (std::size_t i = part * at_once; i < std::min(count, (part + 1) * at_once); ++i) {
      add(frame, static_cast<std::uint32_t>(i), parts[part]);
    }
  });
  for (const std::vector<NearMiss>& part : parts) {
    misses_.insert(misses_.end(), part.begin(), part.end());
  }
  std::stable_sort(misses_.begin(), misses_.end(), [](const NearMiss& a, const NearMiss& b) { return a.pixel < b.pixel; });
}

NearMisses::Range NearMisses::at(int x, int y) const {
  const std::uint64_t pixel = pixel_at(x, y, width_);
  if ((seen_[pixel].load(std::memory_order_relaxed) & missed) == 0) {
    return {misses_.data(), misses_.data()};
  }
  const auto before = [](const NearMiss& miss, std::uint64_t other) { return miss.pixel < other; };
  const auto first = std::lower_bound(misses_.begin(), misses_.end(), pixel, before);
  const auto last = std::lower_bound(first, misses_.end(), pixel + 1, before);
  return {misses_.data() + (first - misses_.begin()), misses_.data() + (last - misses_.begin())};
}

bool NearMisses::has_one_triangle(int x, int y) const {
  return (seen_[pixel_at(x, y, width_)].load(std::memory_order_relaxed) & (missed | covered_again)) == 0;
}

}  // namespace sheen::golden
