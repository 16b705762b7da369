#include "golden/drawn_directions.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace sheen::golden {
namespace {

/// Below it the sheen's lobe is drawn from by the other ways alone, as in the shaders; so are these shares.
constexpr double smallest_drawn_sheen_roughness = 1e-3;
constexpr double smallest_weight = 0.05;
constexpr double weight_of_white_sheen = 0.15;
constexpr double weight_of_sphere = 0.01;

/// What the base would reflect as a mirror (glTF 2.0, Appendix B.3.5).
brdf::Rgb<double> mirrored_share(const brdf::Base<double>& base, double n_dot_v) {
  const double w = brdf::schlick_weight(n_dot_v);
  const auto share = [&](double f0, double color) {
    const double dielectric = base.specular * (f0 + (1 - f0) * w);
    return dielectric + (color + (1 - color) * w - dielectric) * base.metallic;
  };
  const brdf::Rgb<double>& f0 = base.dielectric_f0;
  return {share(f0.r, base.color.r), share(f0.g, base.color.g), share(f0.b, base.color.b)};
}

}  // namespace

Vec3<Bound> displaced(const Vec3<Bound>& drawn) {
  const glm::dvec3 center(drawn.x.center(), drawn.y.center(), drawn.z.center());
  const double off = glm::length(glm::dvec3(drawn.x.deviation(), drawn.y.deviation(), drawn.z.deviation()));
  const glm::dvec3 other = std::abs(center.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 t = glm::normalize(glm::cross(other, center));
  const glm::dvec3 b = glm::cross(center, t);
  const auto axis = [&](int k) { return Bound::at_sample(center[k], t[k], b[k], off, 8 * epsilon + off * off); };
  return {axis(0), axis(1), axis(2)};
}

WayCounts drawn_counts(const Surface<double>& surface, Layers layers, bool has_image, int directions) {
  const LobeView<double> base(surface.normal, surface.view);
  const double k =
      layers.clearcoat ? brdf::clearcoat_weight(surface.clearcoat, LobeView<double>(surface.coat_normal, surface.view).n_dot_v) : 0.0;
  std::array<double, way_count> weights{};
  const auto set = [&weights](Way way, double weight) { weights.at(index_of(way)) = std::max(weight, smallest_weight); };
  weights[index_of(Way::Sphere)] = weight_of_sphere;
  set(Way::Cosine, (1 - k) * brdf::max3(surface.base.color) * (1 - surface.base.metallic));
  if (!brdf::is_mirror(surface.base.alpha)) {
    set(Way::Ggx, (1 - k) * brdf::max3(mirrored_share(surface.base, base.n_dot_v)));
  }
  if (layers.clearcoat && !brdf::is_mirror(surface.coat_alpha) && k > 0) {
    set(Way::Coat, k);
  }
  if (layers.sheen && surface.sheen_roughness > smallest_drawn_sheen_roughness) {
    set(Way::Sheen, (1 - k) * weight_of_white_sheen * brdf::max3(surface.sheen_color));
    set(Way::Rim, (1 - k) * weight_of_white_sheen * brdf::max3(surface.sheen_color));
  }
  const auto sum = [&weights] { return std::accumulate(weights.begin(), weights.end(), 0.0); };
  if (has_image) {
    set(Way::Image, sum());
  }
  const double all = sum();
  WayCounts counts{};
  for (std::size_t way = 0; way < way_count; ++way) {
    counts.at(way) = weights.at(way) > 0 ? std::max(static_cast<int>(directions * weights.at(way) / all), 1) : 0;
  }
  return counts;
}

}  // namespace sheen::golden
