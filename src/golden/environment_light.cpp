#include "golden/environment_light.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "brdf/math.h"
#include "golden/image_lookup.h"

namespace sheen::golden {
namespace {

double brightness(const glm::vec3& t) {
  return static_cast<double>(t.x) + t.y + t.z;
}

// R + G + B beyond which a texel's light counts as bright: this many times the mean over the sphere of what does not. A value far below
// the sun's and above what clouds and sky vary by; it moves the noise, never the mean.
constexpr double bright_multiple = 16.0;

double threshold(const scene::Environment& environment) {
  double limit = HUGE_VAL;
  // Each pass lowers the limit toward its fixed point; where it stops only moves the noise.
  for (int pass = 0; pass < 4; ++pass) {
    double sum = 0.0;
    double solid_angle = 0.0;
    auto texel = environment.texels.begin();
    for (int y = 0; y < environment.height; ++y) {
      const double sine = std::sin(brdf::pi * (y + 0.5) / environment.height);
      for (int x = 0; x < environment.width; ++x) {
        sum += sine * std::min(brightness(*texel++), limit);
        solid_angle += sine;
      }
    }
    limit = bright_multiple * sum / solid_angle;
  }
  return limit;
}

// What of each texel lies within the limit, or beyond it, in the texel's own colour.
std::vector<glm::vec3> part(const scene::Environment& environment, double limit, bool beyond) {
  std::vector<glm::vec3> texels = environment.texels;
  for (glm::vec3& t : texels) {
    const double b = brightness(t);
    const glm::vec3 within = b > limit ? t * static_cast<float>(limit / b) : t;
    t = beyond ? t - within : within;
  }
  return texels;
}

// What a part of the light holds in a direction.
LightPoint held(const ImageTexels& part, const glm::dvec3& d) {
  const Arrived<double> there = look_up(part, ImagePlace<double>(part, Vec3<double>{d.x, d.y, d.z}));
  return {d.x, d.y, d.z, there.radiance.r, there.radiance.g, there.radiance.b, there.density};
}

}  // namespace

std::vector<glm::dvec3> brightest_directions(const scene::Environment& environment) {
  constexpr std::size_t most = 16;
  std::vector<std::size_t> order(environment.texels.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const std::size_t count = std::min(most, order.size());
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count), order.end(),
                    [&](std::size_t a, std::size_t b) { return brightness(environment.texels[a]) > brightness(environment.texels[b]); });
  std::vector<glm::dvec3> directions;
  const auto width = static_cast<std::size_t>(environment.width);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t row = order[i] / width;
    const auto x = static_cast<double>(order[i] - row * width);
    const auto y = static_cast<double>(row);
    directions.push_back(environment.direction({(x + 0.5) / environment.width, (y + 0.5) / environment.height}));
  }
  return directions;
}

EnvironmentLight::EnvironmentLight(const scene::Environment& environment)
    : environment_(environment),
      soft_(environment.width, environment.height, part(environment, threshold(environment), false), environment.rotation),
      bright_(environment.width, environment.height, part(environment, threshold(environment), true), environment.rotation),
      slow_(soft_.texels()) {
  for (const glm::dvec3& direction : brightest_directions(environment)) {
    for (const auto& [part, points] : {std::pair(&soft_, &soft_brightest_), std::pair(&bright_, &bright_brightest_)}) {
      if (!part->dark()) {
        points->push_back(held(part->texels(), direction));
      }
    }
  }
  if (bright_.dark()) {
    return;
  }
  std::vector<glm::dvec3> directions;
  glm::dvec3 sum(0.0);
  for (int y = 0; y < environment.height; ++y) {
    for (int x = 0; x < environment.width; ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * static_cast<std::size_t>(environment.width) + static_cast<std::size_t>(x);
      const double weight = bright_.texels().rgbw[4 * i + 3];
      if (weight > 0.0) {
        directions.push_back(environment.direction({(x + 0.5) / environment.width, (y + 0.5) / environment.height}));
        sum += directions.back() * weight;
      }
    }
  }
  if (!(glm::length(sum) > 0.0)) {
    return;
  }
  const glm::dvec3 axis = glm::normalize(sum);
  double cosine = 1.0;
  for (const glm::dvec3& d : directions) {
    cosine = std::min(cosine, glm::dot(axis, d));
  }
  // A tent reaches one texel beyond its own centre along either axis.
  const double reach = brdf::pi * (2.0 / environment.width + 1.0 / environment.height);
  const double half_angle = std::acos(std::max(cosine, -1.0)) + 1.01 * reach;
  if (half_angle < 0.5 * brdf::pi) {
    bright_axis_ = {axis.x, axis.y, axis.z};
    bright_sine_ = std::sin(half_angle);
  }
}

bool EnvironmentLight::bright_below(const Vec3<double>& normal) const {
  return dot(normal, bright_axis_) < -bright_sine_;
}

}  // namespace sheen::golden
