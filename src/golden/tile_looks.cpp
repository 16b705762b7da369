// What rays around a pixel's centre see, and what follows from it: whether the pixel is left out, and what encloses its value.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <glm/common.hpp>

#include "golden/tile.h"
#include "golden/window_triangle.h"

namespace sheen::golden {

// Whether another surface, or none, is met within the step: another number of layers, or a depth that neither triangle's slope explains.
// Across an edge that two triangles share, their planes meet within the step, so the gap between them is at most what both depths change.
// @param depths  how far apart those of the other triangle are within the step, where it is too narrow to have a slope
bool Tile::interrupted(const Ray& ray, const Seen& seen, std::optional<double> depths) const {
  const Seen& centre = looks_[0].seen;
  if (centre.nearest.has_value() != seen.nearest.has_value() || centre.blended.size() != seen.blended.size()) {
    return true;
  }
  if (!centre.nearest || centre.nearest->triangle == seen.nearest->triangle) {
    return false;
  }
  const std::optional<Hit> ours_there = frame_.geometry.meet(centre.nearest->triangle, ray);
  if (!depths) {
    if (const std::optional<Hit> theirs_here = frame_.geometry.meet(seen.nearest->triangle, looks_[0].ray)) {
      depths = std::abs(seen.nearest->t - theirs_here->t);
    }
  }
  if (!ours_there || !depths) {
    return true;
  }
  const double change = std::abs(ours_there->t - centre.nearest->t) + *depths;
  // Twice: several small triangles may lie between the two.
  return std::abs(seen.nearest->t - ours_there->t) > 2.0 * change + 1e-7 * std::abs(centre.nearest->t);
}

// The centre's own triangles, carried on to where another ray meets their planes.
Seen Tile::extended(const Seen& centre, const Ray& ray) const {
  const auto carry_on = [&](const Hit& hit) {
    Hit carried = hit;
    if (const std::optional<Hit> met = frame_.geometry.meet(hit.triangle, ray)) {
      // A sliver's weights grow without limit; beyond its own size it is no longer what a rasteriser could show.
      const glm::dvec3 w = glm::clamp(met->weights, -1.0, 2.0);
      carried.weights = {1.0 - w.y - w.z, w.y, w.z};
    }
    return carried;
  };
  Seen out;
  if (centre.nearest) {
    out.nearest = carry_on(*centre.nearest);
  }
  for (const Hit& hit : centre.blended) {
    out.blended.push_back(carry_on(hit));
  }
  return out;
}

// What the corners of the step see, which is returned: as far as the surfaces that are seen may be displaced. And what comes near besides.
double Tile::look_around(int x, int y, Plan& plan) {
  const Seen& centre = looks_[0].seen;
  const bool alone = centre.nearest && bound_->near_misses().has_one_triangle(x, y);
  double step = bound_->step(centre);
  while (true) {
    look(step, alone && step <= NearMisses::near_steps * displacement(frame_.settings), plan);
    double farther = step;
    for (const Look& look : looks_) {
      farther = std::max(farther, bound_->step(look.seen));
    }
    // Neighbours on one surface differ by less than this; a nearer surface may be displaced farther.
    const bool is_enough = farther <= 1.05 * step || plan.excluded != Exclusion::None;
    step = farther;
    if (is_enough) {
      break;
    }
  }
  step = std::max(step, look_at_near_misses(x, y, plan));
  if (plan.excluded == Exclusion::None && may_open(step)) {
    plan.excluded = Exclusion::Surface;
  }
  return step;
}

// @param alone  whether there is no triangle but the centre's within the step
void Tile::look(double step, bool alone, Plan& plan) {
  const Look& centre = looks_[0];
  for (std::size_t corner = 0; corner < 4; ++corner) {
    const double dx = (corner & 1u) != 0 ? step : -step;
    const double dy = (corner & 2u) != 0 ? step : -step;
    Look& look = looks_[corner + 1];
    look.ray = frame_.rays.through(centre.ray.x + dx, centre.ray.y + dy);
    if (const std::optional<Hit> hit = alone ? frame_.tracer.trace_alone(centre.seen.nearest->triangle, look.ray) : std::nullopt) {
      look.seen.clear();
      look.seen.nearest = hit;
      continue;
    }
    frame_.tracer.trace(look.ray, true, look.seen);
    if (look.seen.tie || look.seen.ambiguous || interrupted(look.ray, look.seen)) {
      plan.excluded = Exclusion::Surface;
    }
  }
}

// What the looks around the centre passed by, and a driver may show. Returns how far it may be displaced, at most.
double Tile::look_at_near_misses(int x, int y, Plan& plan) {
  double farthest = 0.0;
  for (const NearMiss& miss : bound_->near_misses().at(x, y)) {
    const Placed& placed = frame_.geometry.placed(miss.triangle);
    for (const bool front : {true, false}) {
      const bool met = std::any_of(looks_.begin(), looks_.end(), [&](const Look& look) { return look.seen.shows(miss.triangle, front); });
      if (plan.excluded == Exclusion::None && !met && (front || placed.material->double_sided) && look_at(miss, front, plan)) {
        farthest = std::max(farthest, miss.reach);
        if (looks_.size() > looks_around + most_near_misses) {
          plan.excluded = Exclusion::Surface;
        }
      }
    }
  }
  return farthest;
}

// Whether a side of a near miss may be seen; then it is among the looks.
bool Tile::look_at(const NearMiss& miss, bool front, Plan& plan) {
  const glm::dvec2 place(looks_[0].ray.x, looks_[0].ray.y);
  const std::vector<WindowPoint> polygon = window_polygon(frame_.geometry, frame_.rays, miss.triangle);
  const std::vector<WindowPoint> part = around(polygon, place, miss.reach, frame_.rays.camera().perspective);
  if (part.empty()) {
    return false;
  }
  WindowPoint middle{glm::dvec2(0.0), glm::dvec3(0.0), 0.0};
  double nearest = part.front().depth;
  double farthest = nearest;
  for (const WindowPoint& corner : part) {
    const double share = 1.0 / static_cast<double>(part.size());
    middle.window += share * corner.window;
    middle.weights += share * corner.weights;
    nearest = std::min(nearest, corner.depth);
    farthest = std::max(farthest, corner.depth);
  }
  Look look;
  look.ray = frame_.rays.through(middle.window.x, middle.window.y);
  Hit hit{miss.triangle, middle.weights, 0.5 * (nearest + farthest), front};
  if (const std::optional<Hit> met = frame_.geometry.meet(miss.triangle, look.ray)) {
    if (met->front != front && !may_cover_turned_over(polygon, place, miss.reach)) {
      return false;
    }
    if (met->smallest_weight() >= 0.0) {
      hit = {miss.triangle, met->weights, met->t, front};
    }
  }
  frame_.tracer.trace(look.ray, true, look.seen, &hit);
  if (!look.seen.shows(miss.triangle, front)) {
    return false;
  }
  const bool in_front = look.seen.nearest && look.seen.nearest->triangle == miss.triangle;
  const std::optional<double> depths = in_front ? std::optional(farthest - nearest) : std::nullopt;
  if (look.seen.tie || look.seen.ambiguous || interrupted(look.ray, look.seen, depths)) {
    plan.excluded = Exclusion::Surface;
  }
  looks_.push_back(std::move(look));
  return true;
}

// Whether a surface that is seen may open within the step, and let what lies behind it be seen: along an edge that no other triangle seen
// there shares from corner to corner. Triangles that do share both are moved alike, and leave no gap (OpenGL ES 3.0.6, section 3.6.1); the
// corners of others, of T-junctions and of meshes that merely touch, may be moved apart.
bool Tile::may_open(double step) const {
  std::vector<std::uint32_t> seen;
  const auto note = [&seen](const Hit& hit) {
    if (std::find(seen.begin(), seen.end(), hit.triangle) == seen.end()) {
      seen.push_back(hit.triangle);
    }
  };
  for (const Look& look : looks_) {
    if (look.seen.nearest) {
      note(*look.seen.nearest);
    }
    std::for_each(look.seen.blended.begin(), look.seen.blended.end(), note);
  }
  if (looks_.size() == looks_around && seen.size() == looks_[0].seen.blended.size() + (looks_[0].seen.nearest ? 1 : 0)) {
    return false;  // each covers the whole step
  }
  const glm::dvec2 place(looks_[0].ray.x, looks_[0].ray.y);
  return std::any_of(seen.begin(), seen.end(), [&](std::uint32_t triangle) {
    const std::vector<WindowPoint> polygon = window_polygon(frame_.geometry, frame_.rays, triangle);
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const WindowPoint& a = polygon[i];
      const WindowPoint& b = polygon[(i + 1) % polygon.size()];
      for (int opposite = 0; opposite < 3; ++opposite) {
        if (a.weights[opposite] != 0.0 || b.weights[opposite] != 0.0 ||
            around({a, b}, place, step, frame_.rays.camera().perspective).empty()) {
          continue;
        }
        const auto shares = [&](std::uint32_t other) { return frame_.geometry.share_edge(triangle, opposite, other); };
        if (std::none_of(seen.begin(), seen.end(), shares)) {
          return true;
        }
      }
    }
    return false;
  });
}

// A driver whose grid moves an edge past a sample shades that sample with the triangles of the other side, carried on beyond the edge: with
// all that any of the looks meets. The centre's own are the first.
void Tile::enclose(double step) {
  const Look& centre = looks_[0];
  bounded_->begin(centre.ray, step);
  for (std::size_t k = 0; k < looks_.size(); ++k) {
    if (!seen_before(k)) {
      bounded_->add(k == 0 ? centre.seen : extended(looks_[k].seen, centre.ray));
    }
  }
}

// @param direct  what encloses lies about: the bounds' own values are not as exact
Enclosed Tile::enclosed(const Plan& plan, const glm::dvec3& direct) const {
  Enclosed all = bounded_->at(plan.first_bound);
  for (std::size_t i = plan.first_bound + 1; i < plan.last_bound; ++i) {
    const Enclosed other = bounded_->at(i);
    // Where nothing is promised the value may be NaN.
    const glm::dvec4 off = other.is_bounded() ? glm::abs(other.value - all.value) + other.deviation : other.deviation;
    all.deviation = glm::max(all.deviation, off);
    all.edge_on = all.edge_on || other.edge_on;
  }
  if (all.is_bounded()) {
    all.deviation += glm::dvec4(glm::abs(direct - glm::dvec3(all.value)), 0.0);
  }
  all.value = glm::dvec4(direct, all.value.w);
  return all;
}

// Whether an earlier look meets the same triangles.
bool Tile::seen_before(std::size_t look) const {
  const auto last = looks_.begin() + static_cast<std::ptrdiff_t>(look);
  return std::any_of(looks_.begin(), last, [&](const Look& earlier) { return earlier.seen.same_triangles(looks_[look].seen); });
}

// Whether a MASK surface in front, or its triangle carried on, may be kept or discarded.
bool Tile::mask_uncertain(double step) const {
  const Ray& ray = looks_[0].ray;
  std::vector<std::uint32_t> judged;
  for (const Look& met : looks_) {
    for (const Hit& hit : met.seen.masked) {
      if (std::find(judged.begin(), judged.end(), hit.triangle) != judged.end()) {
        continue;
      }
      judged.push_back(hit.triangle);
      Seen alone;
      alone.nearest = hit;
      const auto cutoff = static_cast<float>(frame_.geometry.placed(hit.triangle).material->alpha_cutoff);  // as a shader is given it
      if ((bound_->opacity(*extended(alone, ray).nearest, ray, step) >= Bound(cutoff)).is_either()) {
        return true;
      }
    }
  }
  return false;
}

}  // namespace sheen::golden
