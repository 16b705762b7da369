// What rays around a pixel's centre see, and what follows from it: whether the pixel is left out, and what encloses its value.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <glm/common.hpp>

#include "golden/tile.h"

namespace sheen::golden {

// Whether another surface, or none, is met within the step: another number of layers, or a depth that neither triangle's slope explains.
// Across an edge that two triangles share, their planes meet within the step, so the gap between them is at most what both depths change.
bool Tile::interrupted(const Ray& centre_ray, const Seen& centre, const Ray& ray, const Seen& seen) const {
  if (centre.nearest.has_value() != seen.nearest.has_value() || centre.blended.size() != seen.blended.size()) {
    return true;
  }
  if (!centre.nearest || centre.nearest->triangle == seen.nearest->triangle) {
    return false;
  }
  const std::optional<Hit> ours_there = frame_.geometry.meet(centre.nearest->triangle, ray);
  const std::optional<Hit> theirs_here = frame_.geometry.meet(seen.nearest->triangle, centre_ray);
  if (!ours_there || !theirs_here) {
    return true;
  }
  const double change = std::abs(ours_there->t - centre.nearest->t) + std::abs(seen.nearest->t - theirs_here->t);
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

// What the corners of the step see, which is returned: as far as the surfaces that are seen may be displaced.
double Tile::look_around(Plan& plan) {
  double step = bound_->step(looks_[0].seen);
  while (true) {
    look(step, plan);
    double farther = step;
    for (const Look& look : looks_) {
      farther = std::max(farther, bound_->step(look.seen));
    }
    // Neighbours on one surface differ by less than this; a nearer surface may be displaced farther.
    if (farther <= 1.05 * step) {
      return farther;
    }
    step = farther;
  }
}

void Tile::look(double step, Plan& plan) {
  const Look& centre = looks_[0];
  for (std::size_t corner = 0; corner < 4; ++corner) {
    const double dx = (corner & 1u) != 0 ? step : -step;
    const double dy = (corner & 2u) != 0 ? step : -step;
    Look& look = looks_[corner + 1];
    look.ray = frame_.rays.through(centre.ray.x + dx, centre.ray.y + dy);
    frame_.tracer.trace(look.ray, true, look.seen);
    if (look.seen.tie || look.seen.ambiguous || interrupted(centre.ray, centre.seen, look.ray, look.seen)) {
      plan.excluded = Exclusion::Surface;
    }
  }
}

// A driver whose grid moves an edge past a sample shades that sample with the triangles of the other side, carried on beyond the edge: with
// all that any of the looks meets, and the other of two surfaces at one depth. The centre's own are the first.
void Tile::enclose(double step) {
  const Look& centre = looks_[0];
  for (std::size_t k = 0; k < looks_.size(); ++k) {
    const Seen& seen = looks_[k].seen;
    if (!seen_before(k)) {
      bounded_->add(k == 0 ? seen : extended(seen, centre.ray), centre.ray, step);
    }
    if (seen.tie) {
      Seen tied = seen;
      tied.nearest = seen.tie;
      bounded_->add(extended(tied, centre.ray), centre.ray, step);
    }
  }
}

Enclosed Tile::enclosed(const Plan& plan) const {
  Enclosed all = bounded_->at(plan.first_bound);
  for (std::size_t i = plan.first_bound + 1; i < plan.last_bound; ++i) {
    const Enclosed other = bounded_->at(i);
    // Where nothing is promised the value may be NaN.
    const glm::dvec4 off = other.is_bounded() ? glm::abs(other.value - all.value) + other.deviation : other.deviation;
    all.deviation = glm::max(all.deviation, off);
    all.edge_on = all.edge_on || other.edge_on;
  }
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
