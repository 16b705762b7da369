#include "golden/environment_shade.h"

#include <algorithm>
#include <cmath>

#include "golden/controlled_mean.h"
#include "golden/sampling_goal.h"
#include "golden/uniform_light.h"

namespace sheen::golden {
namespace {

using Color = brdf::Rgb<double>;

Color mirrored_light(const LobeView<double>& lobe, const EnvironmentLight& light) {
  const Vec3<double> d = lobe.n * (2.0 * dot(lobe.n, lobe.v)) - lobe.v;
  const glm::dvec3 radiance = light.radiance({d.x, d.y, d.z});
  return {radiance.x, radiance.y, radiance.z};
}

// What perfectly smooth layers mirror: no drawn direction meets that.
Color mirrors(const Surface<double>& surface, Layers layers, const ImageLighting& all) {
  const Lighting& lighting = all.lighting;
  const LobeView<double> lobe(surface.normal, surface.view);
  const LobeView<double> coat(layers.clearcoat ? surface.coat_normal : surface.normal, surface.view);
  const double k = layers.clearcoat ? brdf::clearcoat_weight(surface.clearcoat, coat.n_dot_v) * lighting.factors.coat_weight : 0.0;
  Color sum{0, 0, 0};
  if (brdf::is_mirror(surface.base.alpha)) {
    double s = 1.0;
    if (layers.sheen) {
      const SheenLayer<double> sheen(surface, lobe, lighting);
      s = sheen.scale(sheen.e_v());
    }
    const BaseIntegrals delta{0.0, 0.0, s, s * brdf::schlick_weight(lobe.n_dot_v)};
    sum = sum + base_light(surface.base, delta) * mirrored_light(lobe, *all.light) * ((1 - k) * lighting.factors.base);
  }
  if (layers.clearcoat && brdf::is_mirror(surface.coat_alpha)) {
    sum = sum + mirrored_light(coat, *all.light) * (k * lighting.factors.coat_lobe);
  }
  return sum * surface.occlusion;
}

bool bright_reaches(const Surface<double>& surface, Layers layers, const EnvironmentLight& light) {
  return !light.bright().dark() && !(light.bright_below(surface.normal) && (!layers.clearcoat || light.bright_below(surface.coat_normal)));
}

LobeSampling sampling_of(const Surface<double>& surface, Layers layers, const EnvironmentLight& light) {
  // Of many lamps each must be met; where the sun lies, few directions tell.
  const unsigned bright = light.bright_scattered() ? 4 : 1;
  return lobe_sampling(surface, layers, !light.soft().dark(), bright_reaches(surface, layers, light) ? bright : 0);
}

// Each strategy of each replica draws its weight at least once.
static_assert(EnvironmentEstimate::replicas * LobeSampling::largest_total_weight <= least_samples);

// Which sequence a strategy of a replica takes: all of a stream's differ, since an odd stride meets every one of 2^8 before any again.
static_assert(EnvironmentEstimate::replicas * strategy_count <= DirectionPool::sequences);
std::uint32_t sequence(std::uint64_t stream, std::uint32_t replica, std::size_t strategy) {
  const std::uint64_t place = replica * strategy_count + strategy;
  return static_cast<std::uint32_t>((stream >> 32) + place * ((stream & 0xFFFFu) | 1u)) % DirectionPool::sequences;
}

// What the points [begin, end) of each strategy, times its weight, add up to in one replica.
ImageSums replica_sum(const ImageSumTask& task, const DirectionPool& pool, std::uint64_t stream, std::uint32_t replica, std::uint32_t begin,
                      std::uint32_t end) {
  DirectionPool::LightBlock light[first_lobe];
  DirectionPool::LobeBlock lobe[strategy_count];
  std::uint32_t at[strategy_count];
  for (std::size_t k = 0; k < strategy_count; ++k) {
    at[k] = begin * task.sampling->weights[k];
  }
  ImageSums sum;
  for (bool more = true; more;) {
    StrategyPoints points;
    more = false;
    for (std::size_t k = 0; k < strategy_count; ++k) {
      const std::uint32_t last = end * task.sampling->weights[k];
      if (at[k] == last) {
        continue;
      }
      const std::uint32_t count = std::min(last - at[k], DirectionPool::block - at[k] % DirectionPool::block);
      const std::uint32_t id = sequence(stream, replica, k);
      points.count[k] = count;
      if (k == index_of(Strategy::Soft)) {
        points.light[k] = pool.soft(id, at[k], light[k]);
      } else if (k == index_of(Strategy::Bright)) {
        points.light[k] = pool.bright(id, at[k], light[k]);
      } else {
        points.lobe[k] = pool.lobe(id, at[k], lobe[k]);
      }
      at[k] += count;
      more = more || at[k] < last;
    }
    const ImageSums block = image_sum(task, points);
    sum.radiance = sum.radiance + block.radiance;
    sum.control = sum.control + block.control;
  }
  return sum;
}

// The most that one direction toward the brightest of the image adds to a sum.
Color largest_of(const ImageSumTask& task, const EnvironmentLight& light) {
  Color largest{0, 0, 0};
  for (const Strategy strategy : {Strategy::Soft, Strategy::Bright}) {
    const std::size_t k = index_of(strategy);
    if (task.sampling->weights[k] == 0) {
      continue;
    }
    for (const LightPoint& point : strategy == Strategy::Soft ? light.soft_brightest() : light.bright_brightest()) {
      StrategyPoints points;
      points.count[k] = 1;
      points.light[k] = &point;
      const Color added = image_sum_scalar(task, points).radiance;
      largest = {std::max(largest.r, added.r), std::max(largest.g, added.g), std::max(largest.b, added.b)};
    }
  }
  return largest;
}

struct Task {
  Surface<double> dark;
  ImageSumTask sum;

  Task(const Surface<double>& surface, Layers layers, const ImageLighting& lighting, const LobeSampling& sampling, CurveCache& curves)
      : dark(surface),
        sum{&dark, layers, lighting.lighting, &sampling, lighting.light->soft().texels(), lighting.light->bright().texels()} {
    dark.emission = {0, 0, 0};
    if (layers.sheen) {
      sum.lighting.albedo.curve = curves.at(lighting.lighting.albedo.interpolant, surface.sheen_roughness);
    }
  }
  Task(const Task&) = delete;
  Task& operator=(const Task&) = delete;
};

}  // namespace

EnvironmentEstimate::EnvironmentEstimate(const Surface<double>& surface, Layers layers, const ImageLighting& lighting, std::uint64_t stream)
    : lighting_(&lighting),
      layers_(layers),
      sampling_(sampling_of(surface, layers, *lighting.light)),
      mirrored_(mirrors(surface, layers, lighting)),
      occlusion_(surface.occlusion),
      stream_(mix(stream)),
      directions_a_point_(replicas * sampling_.total_weight()) {}

bool EnvironmentEstimate::refine(const Surface<double>& surface, CurveCache& curves, std::uint32_t most_directions) {
  const std::uint32_t most_points = most_directions / directions_a_point_;
  std::uint32_t end = points_ * 2;
  for (std::uint32_t first = first_points; points_ == 0 && end == 0 && first > 0; first /= 2) {
    end = first <= most_points ? first : 0;
  }
  if (end == 0 || end > most_points) {
    return false;
  }
  Task task(surface, layers_, *lighting_, sampling_, curves);
  if (points_ == 0) {
    largest_ = largest_of(task.sum, *lighting_->light);
  }
  if (points_ == 0 && sampling_.weights[index_of(Strategy::Soft)] > 0) {
    control_ = control_variate(task.dark, layers_, task.sum.lighting);
    known_ = integral(control_, lighting_->light->slow());
  }
  task.sum.control = sampling_.weights[index_of(Strategy::Soft)] > 0 ? &control_ : nullptr;
  for (std::uint32_t r = 0; r < replicas; ++r) {
    const ImageSums drawn = replica_sum(task.sum, *lighting_->pool, stream_, r, points_, end);
    sums_[r].radiance = sums_[r].radiance + drawn.radiance;
    sums_[r].control = sums_[r].control + drawn.control;
  }
  points_ = end;
  return true;
}

Estimate EnvironmentEstimate::value() const {
  constexpr double student = 4.195 / 3.0;
  Estimate out{mirrored_, {0, 0, 0}};
  if (points_ == 0) {
    return out;
  }
  for (double Color::*channel : {&Color::r, &Color::g, &Color::b}) {
    std::array<ControlledMean::Pair, replicas> means;
    for (std::uint32_t r = 0; r < replicas; ++r) {
      means[r] = {sums_[r].radiance.*channel / points_, sums_[r].control.*channel / points_};
    }
    const ControlledMean mean(means, known_.*channel);
    out.mean.*channel += mean.value * occlusion_;
    out.standard_error.*channel = mean.standard_error * student * occlusion_;
    out.largest.*channel = largest_.*channel / (static_cast<double>(points_) * replicas) * occlusion_;
  }
  return out;
}

Color coarse_environment(const Surface<double>& surface, Layers layers, const ImageLighting& lighting, std::uint64_t stream,
                         CurveCache& curves) {
  constexpr std::uint32_t coarse_replicas = 1;
  constexpr std::uint32_t coarse_points = 4;
  const LobeSampling sampling = sampling_of(surface, layers, *lighting.light);
  const Task task(surface, layers, lighting, sampling, curves);
  Color sum{0, 0, 0};
  for (std::uint32_t r = 0; r < coarse_replicas; ++r) {
    sum = sum + replica_sum(task.sum, *lighting.pool, mix(stream), r, 0, coarse_points).radiance;
  }
  return sum * (surface.occlusion / (coarse_replicas * coarse_points)) + mirrors(surface, layers, lighting);
}

}  // namespace sheen::golden
