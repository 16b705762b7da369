#include "golden/environment_shade.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "golden/lobe_sampling.h"
#include "golden/uniform_light.h"

namespace sheen::golden {
namespace {

using Color = brdf::Rgb<double>;

constexpr std::size_t replicas = 32;
constexpr std::uint32_t first_points = 4;  // of each strategy and replica; then as many again each time

// splitmix64 (Steele, Lea and Flood 2014).
std::uint64_t mix(std::uint64_t x) {
  x += 0x9E3779B97F4A7C15u;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
  return x ^ (x >> 31);
}

// The first two dimensions of Sobol's sequence in 32 bits (Sobol 1967): van der Corput's, and that of the polynomial x + 1.
struct Sobol {
  std::uint32_t x, y;
};

Sobol sobol(std::uint32_t index) {
  Sobol point{0, 0};
  std::uint32_t second = 1u << 31;
  for (std::uint32_t bit = 1u << 31; index != 0; index >>= 1, bit >>= 1, second ^= second >> 1) {
    if ((index & 1u) != 0) {
      point.x ^= bit;
      point.y ^= second;
    }
  }
  return point;
}

double unit(std::uint32_t bits) {
  return (static_cast<double>(bits) + 0.5) * 0x1p-32;
}

PreparedLight directional(const glm::dvec3& toward, const glm::dvec3& irradiance) {
  PreparedLight light;
  light.axis = -toward;
  light.intensity = irradiance;
  return light;
}

Color mirrored_light(const LobeView<double>& lobe, const EnvironmentLight& light) {
  const Vec3<double> d = lobe.n * (2.0 * dot(lobe.n, lobe.v)) - lobe.v;
  const glm::dvec3 radiance = light.radiance({d.x, d.y, d.z});
  return {radiance.x, radiance.y, radiance.z};
}

// What perfectly smooth layers mirror: no drawn direction meets that.
Color mirrors(const Surface<double>& surface, Layers layers, const Lighting& lighting, const EnvironmentLight& light) {
  const LobeView<double> lobe(surface.normal, surface.view);
  const LobeView<double> coat(layers.clearcoat ? surface.coat_normal : surface.normal, surface.view);
  const double k = layers.clearcoat ? brdf::clearcoat_weight(surface.clearcoat, coat.n_dot_v) * lighting.factors.coat_weight : 0.0;
  Color sum{0, 0, 0};
  if (!(surface.base.alpha > 0.0)) {
    double s = 1.0;
    if (layers.sheen) {
      const SheenLayer<double> sheen(surface, lobe, lighting);
      s = sheen.scale(sheen.e_v());
    }
    const BaseIntegrals delta{0.0, 0.0, s, s * brdf::schlick_weight(lobe.n_dot_v)};
    sum = sum + base_light(surface.base, delta) * mirrored_light(lobe, light) * ((1 - k) * lighting.factors.base);
  }
  if (layers.clearcoat && !(surface.coat_alpha > 0.0)) {
    sum = sum + mirrored_light(coat, light) * (k * lighting.factors.coat_lobe);
  }
  return sum * surface.occlusion;
}

double largest(const Color& c) {
  return std::max({c.r, c.g, c.b});
}

}  // namespace

Estimate shade_environment(const Surface<double>& surface, Layers layers, const Lighting& lighting, const EnvironmentLight& light,
                           const SamplingGoal& goal) {
  const LobeSampling sampling(surface, layers, light);
  const std::size_t strategies = sampling.strategies();
  Surface<double> dark = surface;
  dark.emission = {0, 0, 0};
  std::array<Color, replicas> sums{};
  std::vector<PreparedLight> lights;
  Lighting drawn = lighting;
  const Color mirrored = mirrors(surface, layers, lighting, light);
  Estimate out;
  std::uint32_t points = 0;
  std::uint32_t goal_points = first_points;
  do {
    for (std::size_t r = 0; r < replicas; ++r) {
      lights.clear();
      for (std::size_t strategy = 0; strategy < strategies; ++strategy) {
        const std::uint64_t shift = mix(goal.seed ^ mix(r * 8 + strategy));
        for (std::uint32_t i = points; i < goal_points; ++i) {
          const Sobol p = sobol(i);
          const glm::dvec3 direction =
              sampling.sample(strategy, unit(p.x ^ static_cast<std::uint32_t>(shift)), unit(p.y ^ static_cast<std::uint32_t>(shift >> 32)));
          const double pdf = sampling.mean_pdf(direction) * static_cast<double>(strategies);
          if (pdf > 0.0) {
            lights.push_back(directional(direction, light.radiance(direction) / pdf));
          }
        }
      }
      drawn.lights = lights.data();
      drawn.light_count = lights.size();
      sums[r] = sums[r] + shade(dark, layers, drawn, NoListener{}).radiance;
    }
    points = goal_points;
    goal_points *= 2;

    Color mean{0, 0, 0};
    for (const Color& sum : sums) {
      mean = mean + sum * (1.0 / (static_cast<double>(points) * replicas));
    }
    Color variance{0, 0, 0};  // of the mean
    for (const Color& sum : sums) {
      const Color off = sum * (1.0 / points) + mean * -1.0;
      variance = variance + off * off * (1.0 / (replicas * (replicas - 1)));
    }
    out.mean = mean * surface.occlusion + mirrored;
    out.standard_error = Color{std::sqrt(variance.r), std::sqrt(variance.g), std::sqrt(variance.b)} * surface.occlusion;
  } while (largest(out.standard_error) > goal.error * largest(out.mean) && points * strategies * replicas * 2 <= goal.samples);
  return out;
}

}  // namespace sheen::golden
