#include "golden/tile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <glm/common.hpp>

#include "golden/by_material.h"
#include "golden/shade_all.h"

namespace sheen::golden {
namespace {

// Between the normals of two levels that are tried, see SurfaceReader::levels_to_try. An image may have a sun; uniform light changes with
// N.V alone.
constexpr double largest_angle_under_image = 0.01, largest_angle_under_uniform_light = 0.04;

}  // namespace

Tile::Tile(const Frame& frame, const PixelBound* bound) : frame_(frame), bound_(bound) {
  if (bound != nullptr) {
    bounded_.emplace(*bound);
    if (has_environment() && frame.settings.drawn_directions > 0) {
      drawn_light_.emplace(*bound);
    }
  }
}

void Tile::add_layer(const Hit& hit, const Ray& ray) {
  const Placed& placed = frame_.geometry.placed(hit.triangle);
  const bool blends = placed.material->alpha_mode == scene::AlphaMode::Blend;
  layers_.push_back({static_cast<std::uint32_t>(surfaces_.size()), blends ? frame_.reader.opacity(hit, ray) : 1.0});
  surfaces_.push_back(frame_.reader.surface(hit, ray));
  materials_.push_back(placed.material_index);
}

void Tile::add_layers(const Seen& seen, const Ray& ray) {
  seen.for_layers([&](const Hit& hit) { add_layer(hit, ray); });
}

void Tile::add_sample(const Seen& seen, const Ray& ray) {
  const auto first = static_cast<std::uint32_t>(layers_.size());
  add_layers(seen, ray);
  samples_.push_back({first, static_cast<std::uint32_t>(layers_.size()) - first, background(ray)});
}

// The layers that begin at `first`, of which one is read otherwise.
void Tile::add_varied(std::uint32_t first, std::uint32_t count, std::uint32_t varied, const Hit& hit, const Ray& ray, LodChoice lod) {
  const auto begin = static_cast<std::uint32_t>(layers_.size());
  samples_.push_back({begin, count, background(ray)});
  for (std::uint32_t layer = 0; layer < count; ++layer) {
    const LayerRef same = layers_[first + layer];
    layers_.push_back(same);
  }
  LayerRef& other = layers_[begin + varied];
  const Placed& placed = frame_.geometry.placed(hit.triangle);
  if (placed.material->alpha_mode == scene::AlphaMode::Blend && (!lod.level || lod.slot == SurfaceReader::base_color_slot)) {
    other.opacity = frame_.reader.opacity(hit, ray, lod);
  }
  const Surface<double> usual = surfaces_[other.surface];
  other.surface = static_cast<std::uint32_t>(surfaces_.size());
  surfaces_.push_back(frame_.reader.varied(usual, hit, ray, lod));
  materials_.push_back(placed.material_index);
}

bool Tile::shows_background() const {
  return frame_.settings.environment != nullptr && frame_.settings.environment->background;
}

glm::dvec3 Tile::background(const Ray& ray) const {
  return shows_background() ? frame_.settings.environment->radiance(-frame_.rays.toward_camera(ray)) : glm::dvec3(0.0);
}

// What is seen at the levels of detail that OpenGL ES allows each texture of each layer, for the light of an environment: bounded surfaces
// hold what punctual lights bring.
// @param first  of the layers of `seen`, as they are without such a choice
void Tile::add_levels(const Seen& seen, const Ray& ray, std::uint32_t first) {
  const std::uint32_t count = seen.layers();
  const double largest_angle = frame_.environment ? largest_angle_under_image : largest_angle_under_uniform_light;
  std::uint32_t layer = 0;
  seen.for_layers([&](const Hit& hit) {
    const bool needed = frame_.reader.needs_lod(frame_.geometry.placed(hit.triangle).material_index);
    for (std::size_t slot = 0; needed && slot < SurfaceReader::slot_count; ++slot) {
      const std::vector<double> levels = frame_.reader.levels_to_try(hit, ray, slot, largest_angle);
      if (levels.empty()) {
        continue;
      }
      for (const double level : levels) {
        add_varied(first, count, layer, hit, ray, {level, slot});
      }
      lod_group_ends_.push_back(static_cast<std::uint32_t>(samples_.size()));
    }
    ++layer;
  });
}

void Tile::add_shifted() {
  for (std::size_t corner = 1; corner < looks_.size(); ++corner) {
    Look& look = looks_[corner];
    if (!looks_[0].seen.empty() || !look.seen.empty() || shows_background()) {
      add_sample(look.seen, look.ray);
    }
  }
}

// The same triangles for the light of an environment, of which only samples tell what it is: at every look.
void Tile::add_carried_on() {
  for (std::size_t k = 0; k < looks_.size(); ++k) {
    const Seen& seen = looks_[k].seen;
    if (seen.empty() || seen_before(k)) {
      continue;
    }
    for (const Look& look : looks_) {
      if (!look.seen.same_triangles(seen)) {
        add_sample(extended(seen, look.ray), look.ray);
      }
    }
  }
}

// What is seen where the rounding of texture coordinates leads, if that is farther than the corners of the step. False where coordinates
// may lie so far off that corners show but some of the texels between them: a texture without mipmaps seen from far.
bool Tile::add_nudged(const Plan& plan) {
  const Look& centre = looks_[0];
  const Sample base = samples_[plan.centre];
  bool sampled = true;
  std::uint32_t layer = 0;
  centre.seen.for_layers([&](const Hit& hit) {
    const TextureReach reach = frame_.reader.texture_reach(hit, centre.ray);
    if (reach.beyond_the_step) {
      for (const glm::dvec2& nudge : nudges) {
        add_varied(base.first, base.count, layer, hit, centre.ray, {std::nullopt, 0, nudge});
      }
    }
    sampled = sampled && reach.texels <= most_texels_of_corners;
    ++layer;
  });
  return sampled;
}

Tile::Plan Tile::plan(int x, int y) {
  looks_.resize(looks_around);
  Look& centre = looks_[0];
  centre.ray = frame_.rays.through(x + 0.5, y + 0.5);
  const bool bounds = frame_.settings.bounds;
  frame_.tracer.trace(centre.ray, bounds, centre.seen);
  const auto groups = static_cast<std::uint32_t>(lod_group_ends_.size());
  const auto pixel = static_cast<std::uint64_t>(y) * static_cast<std::uint64_t>(frame_.settings.view.width) + static_cast<std::uint64_t>(x);
  const Exclusion tied = centre.seen.tie || centre.seen.ambiguous ? Exclusion::Surface : Exclusion::None;
  Plan plan{pixel, static_cast<std::uint32_t>(samples_.size()), 0, groups, groups, tied, 0, 0};
  const double step = bounds && tied == Exclusion::None ? look_around(x, y, plan) : 0.0;
  // What another surface may show in its place is not looked for: nobody compares the pixel.
  if (!bounds || plan.excluded != Exclusion::None) {
    add_sample(centre.seen, centre.ray);
    plan.shifted_end = static_cast<std::uint32_t>(samples_.size());
    return plan;
  }
  plan.first_bound = bounded_->count();
  enclose(step);
  plan.last_bound = bounded_->count();
  bool sampled = true;
  if (has_environment()) {
    add_sample(centre.seen, centre.ray);
    add_shifted();
    add_carried_on();
    sampled = add_nudged(plan);
  } else {
    add_sample(centre.seen, centre.ray);
  }
  plan.shifted_end = static_cast<std::uint32_t>(samples_.size());
  plan.excluded = mask_uncertain(step) ? Exclusion::Mask : sampled ? Exclusion::None : Exclusion::Texels;
  for (std::size_t k = 0; k < looks_.size() && has_environment(); ++k) {
    if (k == 0) {
      add_levels(centre.seen, centre.ray, samples_[plan.centre].first);
    } else if (!seen_before(k)) {
      const Seen carried_on = extended(looks_[k].seen, centre.ray);
      const auto first = static_cast<std::uint32_t>(layers_.size());
      add_layers(carried_on, centre.ray);
      add_levels(carried_on, centre.ray, first);
    }
  }
  plan.last_group = static_cast<std::uint32_t>(lod_group_ends_.size());
  if (drawn_light_ && plan.excluded == Exclusion::None) {
    plan.drawn = open_of_drawn(plan);
  }
  return plan;
}

// By punctual lights: what other samples than the centres show of those, the bounds know.
void Tile::shade_centres(const std::vector<Plan>& plans) {
  const brdf::Rgb<double> black{0, 0, 0};
  shaded_.assign(surfaces_.size(), {black, black, 0.0});
  std::vector<std::uint32_t> surfaces;
  std::vector<int> materials;
  for_centres(plans, [&](std::uint32_t surface) {
    surfaces.push_back(surface);
    materials.push_back(materials_[surface]);
  });
  const Lighting lighting = frame_.lighting();
  by_material(materials, [&](const std::uint32_t* order, std::size_t count, int material) {
    std::vector<std::uint32_t> of(count);
    std::transform(order, order + count, of.begin(), [&](std::uint32_t i) { return surfaces[i]; });
    shade_all(surfaces_.data(), of.data(), count, frame_.reader.layers(material), lighting, shaded_.data());
  });
}

// rgb = a c + (1 - a) dst over black, coverage likewise. Refined: with the full estimate of an environment's light.
Tile::Composed Tile::compose(const Sample& sample, bool refined) const {
  Composed out;
  if (shows_background()) {
    out.radiance = sample.background;
    out.coverage = 1.0;
  }
  for (std::uint32_t i = sample.first; i < sample.first + sample.count; ++i) {
    const Shaded<double>& s = shaded_[layers_[i].surface];
    const double a = layers_[i].opacity;
    glm::dvec3 from_environment(0.0);
    if (has_environment()) {
      const std::uint32_t surface = layers_[i].surface;
      from_environment = dvec3(coarse_[surface]) + (refined ? dvec3(refinement_[surface]) : glm::dvec3(0.0));
      out.standard_error = dvec3(standard_error_[surface]) * a + out.standard_error * (1.0 - a);
      out.largest = dvec3(largest_[surface]) * a + out.largest * (1.0 - a);
    }
    out.radiance = (dvec3(s.radiance) + from_environment) * a + out.radiance * (1.0 - a);
    out.direct = dvec3(s.radiance) * a + out.direct * (1.0 - a);
    out.lookup = dvec3(s.lookup) * a + out.lookup * (1.0 - a);
    out.coverage = a + out.coverage * (1.0 - a);
    out.mirrored = out.mirrored || s.mirrored > 0.0;
  }
  return out;
}

Pixel Tile::finish(const Plan& plan) const {
  const Composed centre = compose(samples_[plan.centre]);
  const glm::dvec3 here = centre.radiance - centre.direct;
  // The most that an environment's light changes, and the most between a sample and the one before.
  struct Change {
    glm::dvec3 from_here{0.0}, from_before{0.0};
  };
  const auto largest_change = [&](std::uint32_t begin, std::uint32_t end) {
    Change largest;
    glm::dvec3 before(0.0);
    for (std::uint32_t i = begin; i < end; ++i) {
      const Composed there = compose(samples_[i]);
      const glm::dvec3 light = there.radiance - there.direct;
      largest.from_here = glm::max(largest.from_here, glm::abs(light - here));
      largest.from_before = i > begin ? glm::max(largest.from_before, glm::abs(light - before)) : largest.from_before;
      before = light;
    }
    return largest;
  };
  glm::dvec3 change = largest_change(plan.centre + 1, plan.shifted_end).from_here;
  // Each texture's level is the driver's to choose, whatever the others': their largest changes add. What may come between two levels that
  // were tried: beyond the nearer one by half of what they differ.
  std::uint32_t begin = plan.shifted_end;
  for (std::uint32_t group = plan.first_group; group < plan.last_group; ++group) {
    const Change of_level = largest_change(begin, lod_group_ends_[group]);
    change += of_level.from_here + 0.5 * of_level.from_before;
    begin = lod_group_ends_[group];
  }
  Pixel pixel;
  const Composed full = compose(samples_[plan.centre], true);
  pixel.radiance = full.radiance;
  pixel.coverage = centre.coverage;
  pixel.standard_error = full.standard_error;
  pixel.direction = plan.drawn.largest;
  const Enclosed bounded = plan.first_bound < plan.last_bound ? enclosed(plan, centre.direct) : Enclosed{};
  const glm::dvec4 open = bounded.deviation + glm::dvec4(change + plan.drawn.off, 0.0);
  pixel.bound = glm::dvec3(open) + centre.lookup + standard_errors * full.standard_error + missed_directions * full.largest;
  pixel.coverage_bound = shows_background() ? 0.0 : open.w;
  pixel.excluded = plan.excluded;
  const bool promised = std::isfinite(open.x) && std::isfinite(open.y) && std::isfinite(open.z) && std::isfinite(open.w);
  if (!promised && pixel.excluded == Exclusion::None) {
    pixel.excluded = bounded.edge_on ? Exclusion::Surface : Exclusion::Rules;
  }
  pixel.mirrored = centre.mirrored;
  return pixel;
}

std::vector<Pixel> Tile::render(int x0, int y0, int x1, int y1) {
  surfaces_.clear();
  materials_.clear();
  layers_.clear();
  samples_.clear();
  lod_group_ends_.clear();
  if (bounded_) {
    bounded_->clear();
  }
  std::vector<Plan> plans;
  plans.reserve(static_cast<std::size_t>(x1 - x0) * static_cast<std::size_t>(y1 - y0));
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x) {
      plans.push_back(plan(x, y));
    }
  }
  shade_centres(plans);
  if (bounded_) {
    bounded_->shade();
  }
  if (has_environment()) {
    add_environment_light(plans);
  }
  std::vector<Pixel> pixels;
  pixels.reserve(plans.size());
  for (const Plan& p : plans) {
    pixels.push_back(finish(p));
  }
  return pixels;
}

}  // namespace sheen::golden
