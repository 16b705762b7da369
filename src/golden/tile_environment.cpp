// An environment's light in a tile: a full estimate at pixel centres, a coarse one at every sample that the bound compares them with.
#include <algorithm>
#include <cstddef>
#include <utility>

#include "golden/tile.h"
#include "golden/uniform_light.h"

namespace sheen::golden {

/// Calls f with each plan and the end of its samples.
template <class Function>
void Tile::for_plans(const std::vector<Plan>& plans, const Function& f) const {
  for (std::size_t p = 0; p < plans.size(); ++p) {
    f(plans[p], p + 1 < plans.size() ? plans[p + 1].centre : static_cast<std::uint32_t>(samples_.size()));
  }
}

/// Calls f with every surface of the samples [begin, end) of a pixel, once, and its place among a sample's layers.
template <class Function>
void Tile::for_surfaces(std::uint32_t begin, std::uint32_t end, const Function& f) const {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> found;
  for (std::uint32_t s = begin; s < end; ++s) {
    for (std::uint32_t layer = 0; layer < samples_[s].count; ++layer) {
      found.emplace_back(layers_[samples_[s].first + layer].surface, layer);
    }
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  for (const auto& [surface, layer] : found) {
    f(surface, layer);
  }
}

// Of the surfaces that a pixel's centre shows, and of the look-up of what is behind them.
DrawnLight::Open Tile::open_of_drawn(const Plan& plan) {
  const Look& look = looks_[0];
  const DrawnLight::Open behind = shows_background() ? drawn_light_->open_background(look.ray) : DrawnLight::Open{};
  const Sample& centre = samples_[plan.centre];
  if (centre.count == 0) {
    return behind;
  }
  std::vector<double> opacities;
  for (std::uint32_t layer = 0; layer < centre.count; ++layer) {
    opacities.push_back(layers_[centre.first + layer].opacity);
  }
  return drawn_light_->open(look.seen, look.ray, &surfaces_[layers_[centre.first].surface], opacities.data(), behind, plan.pixel);
}

void Tile::add_environment_light(const std::vector<Plan>& plans) {
  const brdf::Rgb<double> zero{0, 0, 0};
  coarse_.assign(surfaces_.size(), zero);
  refinement_.assign(surfaces_.size(), zero);
  standard_error_.assign(surfaces_.size(), zero);
  largest_.assign(surfaces_.size(), zero);
  if (frame_.environment) {
    add_image_light(plans);
  } else {
    add_uniform_light(plans);
  }
}

// Integrals are kept for one pixel, whose samples share them; other pixels hardly ever do.
void Tile::add_uniform_light(const std::vector<Plan>& plans) {
  const glm::dvec3& radiance = frame_.settings.environment->uniform;
  UniformLight light(frame_.lighting(), {radiance.x, radiance.y, radiance.z});
  const auto shade = [&](std::uint32_t surface, albedo::Effort effort) {
    return light.shade(surfaces_[surface], frame_.reader.layers(materials_[surface]), effort);
  };
  for_plans(plans, [&](const Plan& plan, std::uint32_t end) {
    light.forget();
    if (frame_.settings.bounds) {
      for_surfaces(plan.centre, end,
                   [&](std::uint32_t surface, std::uint32_t) { coarse_[surface] = shade(surface, albedo::Effort::Fast); });
    }
    for_surfaces(plan.centre, plan.centre + 1, [&](std::uint32_t surface, std::uint32_t) {
      refinement_[surface] = shade(surface, albedo::Effort::Full) + coarse_[surface] * -1.0;
      if (frame_.settings.bounds) {
        brdf::Rgb<double>& lookup = shaded_[surface].lookup;
        lookup = lookup + light.lookup(surfaces_[surface], frame_.reader.layers(materials_[surface]));
      }
    });
  });
}

// Each pixel and layer has a stream of its own, wherever the tiles lie and whoever draws them.
std::uint64_t Tile::stream(const Plan& plan, std::uint32_t layer) {
  return plan.pixel * 64u + layer;
}

void Tile::add_coarse_light(const std::vector<Plan>& plans, const ImageLighting& lighting) {
  for_plans(plans, [&](const Plan& plan, std::uint32_t end) {
    for_surfaces(plan.centre, end, [&](std::uint32_t surface, std::uint32_t layer) {
      coarse_[surface] =
          coarse_environment(surfaces_[surface], frame_.reader.layers(materials_[surface]), lighting, stream(plan, layer), curves_);
    });
  });
}

// Of the channel where it is largest. A channel that is dark beside the others counts as a thousandth of them. What one direction brings
// counts as an error: as long as that is much, all may have missed as much, and show none.
double Tile::relative_error(const Sample& sample) const {
  const Composed full = compose(sample, true);
  const double brightest = std::max({full.radiance.r, full.radiance.g, full.radiance.b});
  double largest = 0.0;
  for (int c = 0; c < 3; ++c) {
    const double error = std::max(full.standard_error[c], full.largest[c]);
    if (error > 0.0) {
      largest = std::max(largest, error / std::max(full.radiance[c], 1e-3 * brightest));
    }
  }
  return largest;
}

// Directions are doubled wherever the error is still above the goal, until that is so at no more than one pixel in a hundred of the tile:
// then the whole picture's 99th percentile meets it. Decided tile by tile, so that it does not depend on the order of tiles.
void Tile::add_image_light(const std::vector<Plan>& plans) {
  const ImageLighting lighting{frame_.lighting(), &*frame_.environment, &*frame_.directions};
  if (frame_.settings.bounds) {
    add_coarse_light(plans, lighting);
  }
  struct Open {
    Sample sample;
    std::size_t first;  // of estimates, one a layer
  };
  std::vector<EnvironmentEstimate> estimates;
  std::vector<Open> open;
  for (const Plan& plan : plans) {
    const Sample& sample = samples_[plan.centre];
    if (sample.count > 0) {
      open.push_back({sample, estimates.size()});
    }
    for (std::uint32_t layer = 0; layer < sample.count; ++layer) {
      const std::uint32_t surface = layers_[sample.first + layer].surface;
      estimates.emplace_back(surfaces_[surface], frame_.reader.layers(materials_[surface]), lighting, stream(plan, layer));
    }
  }
  const SamplingGoal& goal = frame_.settings.sampling;
  const std::size_t allowed = open.size() / 100;
  std::size_t exhausted = 0;
  while (open.size() + exhausted > allowed && !open.empty()) {
    std::vector<Open> still_open;
    for (const Open& pixel : open) {
      bool drew = false;
      for (std::uint32_t layer = 0; layer < pixel.sample.count; ++layer) {
        const std::uint32_t surface = layers_[pixel.sample.first + layer].surface;
        EnvironmentEstimate& estimate = estimates[pixel.first + layer];
        drew = estimate.refine(surfaces_[surface], curves_, goal.samples) || drew;
        const Estimate now = estimate.value();
        refinement_[surface] = now.mean + coarse_[surface] * -1.0;
        standard_error_[surface] = now.standard_error;
        largest_[surface] = now.largest;
      }
      if (!drew) {
        ++exhausted;
      } else if (relative_error(pixel.sample) > goal.error) {
        still_open.push_back(pixel);
      }
    }
    open = std::move(still_open);
  }
}

}  // namespace sheen::golden
