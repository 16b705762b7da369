#include "golden/lobe_sampling.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace sheen::golden {
namespace {

glm::dvec3 to_glm(const Vec3<double>& v) {
  return {v.x, v.y, v.z};
}

// Height-correlated or not, VNDF sampling weighs D with G1 (Heitz 2018, "Sampling the GGX Distribution of Visible Normals", equation 2).
double smith_g1(double alpha, double cosine) {
  const double a2 = alpha * alpha;
  return 2.0 * cosine / (cosine + std::sqrt(a2 + (1.0 - a2) * cosine * cosine));
}

// Heitz 2018, listing 1, for one alpha; v in the frame of the normal.
glm::dvec3 visible_normal(const glm::dvec3& v, double alpha, double u1, double u2) {
  const glm::dvec3 stretched = glm::normalize(glm::dvec3(alpha * v.x, alpha * v.y, v.z));
  const double across = stretched.x * stretched.x + stretched.y * stretched.y;
  const glm::dvec3 t1 = across > 0.0 ? glm::dvec3(-stretched.y, stretched.x, 0.0) / std::sqrt(across) : glm::dvec3(1.0, 0.0, 0.0);
  const glm::dvec3 t2 = glm::cross(stretched, t1);
  const double r = std::sqrt(u1);
  const double phi = 2.0 * brdf::pi * u2;
  const double p1 = r * std::cos(phi);
  const double s = 0.5 * (1.0 + stretched.z);
  const double p2 = (1.0 - s) * std::sqrt(std::max(1.0 - p1 * p1, 0.0)) + s * r * std::sin(phi);
  const glm::dvec3 h = t1 * p1 + t2 * p2 + stretched * std::sqrt(std::max(1.0 - p1 * p1 - p2 * p2, 0.0));
  return glm::normalize(glm::dvec3(alpha * h.x, alpha * h.y, std::max(h.z, 0.0)));
}

double sine_squared(const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 c = glm::cross(a, b);
  return std::min(glm::dot(c, c), 1.0);
}

}  // namespace

LobeSampling::Frame LobeSampling::frame(const LobeView<double>& lobe) {
  const glm::dvec3 n = to_glm(lobe.n);
  const glm::dvec3 axis = std::abs(n.x) < 0.7 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
  const glm::dvec3 t = glm::normalize(glm::cross(axis, n));
  return {t, glm::cross(n, t), n, to_glm(lobe.v)};
}

LobeSampling::LobeSampling(const Surface<double>& surface, Layers layers, const EnvironmentLight& light)
    : light_(light),
      base_(frame(LobeView<double>(surface.normal, surface.view))),
      coat_(frame(LobeView<double>(layers.clearcoat ? surface.coat_normal : surface.normal, surface.view))),
      alpha_(surface.base.alpha),
      coat_alpha_(surface.coat_alpha) {
  const auto add = [this](Kind kind) { kinds_[count_++] = kind; };
  add(Kind::Image);
  add(Kind::Cosine);
  if (alpha_ > 0.0) {
    add(Kind::Ggx);
  }
  if (layers.clearcoat && coat_alpha_ > 0.0 && surface.clearcoat > 0.0) {
    add(Kind::CoatGgx);
  }
  if (layers.sheen && surface.sheen_roughness > 0.0) {
    sheen_exponent_ = 1.0 / (surface.sheen_roughness * surface.sheen_roughness);
    add(Kind::Sheen);
  }
}

glm::dvec3 LobeSampling::sample(std::size_t strategy, double u, double v) const {
  const Kind kind = kinds_[strategy];
  if (kind == Kind::Image) {
    return light_.sample(u, v);
  }
  const Frame& f = kind == Kind::CoatGgx ? coat_ : base_;
  const auto world = [&f](const glm::dvec3& local) { return f.t * local.x + f.b * local.y + f.n * local.z; };
  const double phi = 2.0 * brdf::pi * v;
  if (kind == Kind::Cosine) {
    const double r = std::sqrt(u);
    return world({r * std::cos(phi), r * std::sin(phi), std::sqrt(1.0 - u)});
  }
  glm::dvec3 h;
  if (kind == Kind::Sheen) {
    // D cos(theta_h) integrates to 1 over the hemisphere, to sin^(n+2) up to theta_h.
    const double sine = std::pow(u, 1.0 / (sheen_exponent_ + 2.0));
    h = world({sine * std::cos(phi), sine * std::sin(phi), std::sqrt(std::max(1.0 - sine * sine, 0.0))});
  } else {
    const glm::dvec3 local(glm::dot(f.v, f.t), glm::dot(f.v, f.b), std::max(glm::dot(f.v, f.n), albedo::min_n_dot_v));
    h = world(visible_normal(glm::normalize(local), kind == Kind::Ggx ? alpha_ : coat_alpha_, u, v));
  }
  return glm::normalize(h * (2.0 * glm::dot(f.v, h)) - f.v);
}

double LobeSampling::pdf(Kind kind, const glm::dvec3& direction) const {
  if (kind == Kind::Image) {
    return light_.pdf(direction);
  }
  const Frame& f = kind == Kind::CoatGgx ? coat_ : base_;
  const double n_dot_l = glm::dot(f.n, direction);
  if (kind == Kind::Cosine) {
    return std::max(n_dot_l, 0.0) / brdf::pi;
  }
  const glm::dvec3 sum = direction + f.v;
  const double length = glm::length(sum);
  if (!(length > 0.0)) {
    return 0.0;
  }
  const glm::dvec3 h = sum / length;
  const double n_dot_h = glm::dot(f.n, h);
  const double v_dot_h = glm::dot(f.v, h);
  const double sin2 = sine_squared(f.n, h);
  if (kind == Kind::Sheen) {
    // A half vector drawn on the far side of V mirrors it as its opposite does.
    return (sheen_exponent_ + 2.0) / (2.0 * brdf::pi) * std::pow(sin2, 0.5 * sheen_exponent_) * std::abs(n_dot_h) /
           (4.0 * std::max(v_dot_h, 1e-300));
  }
  if (n_dot_h <= 0.0 || v_dot_h <= 0.0) {
    return 0.0;
  }
  const double alpha = kind == Kind::Ggx ? alpha_ : coat_alpha_;
  const double n_dot_v = std::max(glm::dot(f.n, f.v), albedo::min_n_dot_v);
  return brdf::ggx_distribution(alpha, std::min(n_dot_h, 1.0), sin2) * smith_g1(alpha, n_dot_v) / (4.0 * n_dot_v);
}

double LobeSampling::mean_pdf(const glm::dvec3& direction) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < count_; ++i) {
    sum += pdf(kinds_[i], direction);
  }
  return sum / static_cast<double>(count_);
}

}  // namespace sheen::golden
