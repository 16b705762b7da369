#pragma once

#include <algorithm>
#include <array>
#include <cstring>
#include <random>
#include <vector>

#include <glm/geometric.hpp>

#include "golden/bound.h"
#include "golden/lights.h"
#include "golden/mapped_normal.h"
#include "golden/surface.h"

// Random surfaces of uncertain numbers, and what a driver may hold of them.

namespace sheen::golden::test {

/// Random surfaces in view space, uncertain and displaced as a reader's are, some of their numbers exact.
class UncertainSurfaces {
 public:
  Surface<Bound> next() {
    Surface<Bound> s{};
    s.position = {moving(0.6 * uniform() - 0.3), moving(0.6 * uniform() - 0.3), moving(-1.0 - uniform())};
    s.view = unit({0.3 * uniform(), 0.3 * uniform(), 1.0});
    s.normal = unit({uniform() - 0.5, uniform() - 0.5, uniform()});
    s.coat_normal = unit({uniform() - 0.5, uniform() - 0.5, uniform()});
    s.base = {
        color(), count_ % 3 == 0 ? Bound(0.0) : moving(uniform()), moving(uniform()), {Bound(0.04), moving(0.1), Bound(1)}, Bound(0.5)};
    s.sheen_color = color();
    s.sheen_roughness = count_ % 5 == 0 ? Bound(0.0) : Bound(0.3);
    s.clearcoat = moving(uniform());
    s.coat_alpha = count_ % 7 == 0 ? Bound(0.0) : moving(0.01 + uniform());
    s.emission = color();
    s.occlusion = Bound(1);
    ++count_;
    return s;
  }

  MappedNormal<Bound> map() {
    const bool nothing = count_++ % 9 == 0;  // certainly no direction
    const Vec3<Bound> none{Bound(0.5), Bound(0.5), Bound(0.5)};
    const Vec3<Bound> code{moving(uniform()), moving(uniform()), moving(0.5 + 0.5 * uniform())};
    return {unit({1.0, 0.2, 0.1}), unit({0.1, 0.2, 1.0}), Bound(-1.0), nothing ? none : code, moving(1.0), Bound(-1.0)};
  }

 private:
  double uniform() { return std::uniform_real_distribution<double>(0.0, 1.0)(random_); }
  // Some so wide that the usual case of arithmetic does not hold.
  Bound moving(double x) {
    const double size = uniform() < 0.1 ? 0.02 : 1e-5;
    return Bound::at_sample(x, size * (uniform() - 0.5), size * (uniform() - 0.5), 1.0, 0.3 * size);
  }
  brdf::Rgb<Bound> color() { return {moving(uniform()), moving(uniform()), moving(uniform())}; }
  Vec3<Bound> unit(const glm::dvec3& v) {
    const glm::dvec3 n = glm::normalize(v);
    return {moving(n.x), moving(n.y), moving(n.z)};
  }

  std::mt19937 random_{3};
  int count_ = 0;
};

/// One of all that an uncertain number may be. @param u, v, e  in [-1, 1]
inline double held(const Bound& x, double u, double v, double e) {
  const double at = x.center() + u * x.shift_x() + v * x.shift_y() + e * x.radius();
  return x.is_bounded() ? std::clamp(at, x.range().lower, x.range().upper) : at;
}

template <template <class> class Struct>
Struct<double> held(const Struct<Bound>& surface, std::mt19937& random) {
  // At the ends as often as in between.
  const auto side = [](std::mt19937& from) { return std::clamp(std::uniform_real_distribution<double>(-2.0, 2.0)(from), -1.0, 1.0); };
  const double u = side(random);
  const double v = side(random);
  constexpr std::size_t numbers = sizeof(Struct<double>) / sizeof(double);
  std::array<Bound, numbers> bounds;
  std::memcpy(static_cast<void*>(bounds.data()), static_cast<const void*>(&surface), sizeof(surface));
  std::array<double, numbers> values{};
  for (std::size_t i = 0; i < numbers; ++i) {
    values.at(i) = held(bounds.at(i), u, v, side(random));
  }
  Struct<double> out;
  std::memcpy(static_cast<void*>(&out), values.data(), sizeof(out));
  return out;
}

/// One along -Z, a spot and a grazing one.
inline std::vector<PreparedLight> few_lights() {
  scene::Light spot;
  spot.type = scene::LightType::Spot;
  spot.position = {0.5, 1.0, 1.0};
  spot.direction = glm::normalize(glm::dvec3(-0.5, -1.0, -2.0));
  spot.range = 9.0;
  scene::Light grazing;
  grazing.direction = glm::normalize(glm::dvec3(-1.0, 0.3, -0.2));
  return prepare_lights({scene::Light{}, spot, grazing});
}

}  // namespace sheen::golden::test
