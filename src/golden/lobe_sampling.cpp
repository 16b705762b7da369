#include "golden/lobe_sampling.h"

#include <cmath>

namespace sheen::golden {
namespace {

LobeFrame frame_of(const LobeView<double>& lobe) {
  const Vec3<double> axis = std::abs(lobe.n.x) < 0.7 ? Vec3<double>{1, 0, 0} : Vec3<double>{0, 1, 0};
  const Vec3<double> across = cross(axis, lobe.n);
  const Vec3<double> t = across * (1.0 / std::sqrt(dot(across, across)));
  return {t, cross(lobe.n, t), lobe.n, lobe.v, lobe.n_dot_v};
}

}  // namespace

LobeSampling lobe_sampling(const Surface<double>& surface, Layers layers, bool soft, unsigned bright) {
  LobeSampling s;
  s.base = frame_of(LobeView<double>(surface.normal, surface.view));
  s.coat = frame_of(LobeView<double>(layers.clearcoat ? surface.coat_normal : surface.normal, surface.view));
  s.alpha = surface.base.alpha;
  s.coat_alpha = surface.coat_alpha;
  const auto draw = [&s](Strategy strategy, unsigned weight) { s.weights[index_of(strategy)] = weight; };
  // Found best, by the time to 1 %, over skies with and without a sun and over rough, smooth, metal and cloth spheres; a flat optimum. The
  // base's lobe is worth more the more of the base it is: of a dielectric it is a few hundredths.
  draw(Strategy::Soft, soft ? 8 : 0);
  draw(Strategy::Bright, bright);
  draw(Strategy::Cosine, 1);
  if (!brdf::is_mirror(s.alpha)) {
    draw(Strategy::Ggx, surface.base.metallic < 0.25 ? 1 : surface.base.metallic < 0.75 ? 2 : 4);
  }
  if (layers.clearcoat && !brdf::is_mirror(s.coat_alpha) && surface.clearcoat > 0.0) {
    draw(Strategy::CoatGgx, 1);
  }
  if (layers.sheen && surface.sheen_roughness > 0.0) {
    s.sheen_exponent = 1.0 / (surface.sheen_roughness * surface.sheen_roughness);
    draw(Strategy::Sheen, 1);
  }
  return s;
}

}  // namespace sheen::golden
