#pragma once

// The model evaluated a second time for this room's tests: in long double, straight from the printed text (KHR_materials_sheen,
// KHR_materials_clearcoat, glTF 2.0 Appendix B), sharing no code with src/brdf but the quadrature of E.

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "albedo/directional_albedo.h"
#include "scene/scene.h"

namespace sheen::golden::test {

using Real = long double;
using Vector = std::array<Real, 3>;

inline Vector vector(const glm::dvec3& v) {
  return {v.x, v.y, v.z};
}
inline Real dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Vector plus(const Vector& a, const Vector& b, Real s = 1) {
  return {a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]};
}
inline Vector unit(const Vector& a) {
  const Real n = std::sqrt(dot(a, a));
  return {a[0] / n, a[1] / n, a[2] / n};
}

inline constexpr Real pi_l = 3.14159265358979323846264338327950288L;

/// A point to shade: unit vectors, constant material.
struct Point {
  Vector position, v, n, nc;
};

inline Real mix(Real a, Real b, Real t) {
  return a * (1 - t) + b * t;
}

// KHR_materials_sheen, "Sheen visibility": l() and lambda_sheen() as printed; the refined coefficients of the Enterprise PBR Shading Model
// 2022x.
inline Real sheen_l(Real x, Real alpha_g, albedo::Visibility visibility) {
  Real a = 0;
  Real b = 0;
  Real c = 0;
  Real d = 0;
  Real e = 0;
  if (visibility == albedo::Visibility::Refined) {
    const Real w = -1.59612L / (1 + 0.20375L * std::pow(alpha_g, -0.55825L)) + 1.32805L;
    a = mix(11.9095L, 13.7000L, w), b = mix(4.68753L, 2.92754L, w), c = mix(0.33467L, 0.28670L, w);
    d = mix(-2.22664L, -0.81757L, w), e = mix(-1.76591L, -1.22466L, w);
  } else {
    const Real t = (1 - alpha_g) * (1 - alpha_g);
    a = mix(21.5473L, 25.3245L, t), b = mix(3.82987L, 3.32435L, t), c = mix(0.19823L, 0.16801L, t);
    d = mix(-1.97760L, -1.27393L, t), e = mix(-4.32054L, -4.85967L, t);
  }
  return a / (1 + b * std::pow(x, c)) + d * x + e;
}

inline Real sheen_lambda(Real cosine, Real alpha_g, albedo::Visibility visibility) {
  if (cosine < 0.5L) {
    return std::exp(sheen_l(cosine, alpha_g, visibility));
  }
  return std::exp(2 * sheen_l(0.5L, alpha_g, visibility) - sheen_l(1 - cosine, alpha_g, visibility));
}

inline Real sheen_brdf(Real n_dot_l, Real n_dot_v, Real n_dot_h, Real roughness, albedo::Visibility visibility) {
  if (roughness == 0) {
    return 0;
  }
  const Real alpha_g = roughness * roughness;
  const Real inv_r = 1 / alpha_g;
  const Real d = (2 + inv_r) * std::pow(1 - n_dot_h * n_dot_h, inv_r * 0.5L) / (2 * pi_l);
  const Real v =
      visibility == albedo::Visibility::Ashikhmin
          ? 1 / (4 * (n_dot_l + n_dot_v - n_dot_l * n_dot_v))
          : 1 / ((1 + sheen_lambda(n_dot_v, alpha_g, visibility) + sheen_lambda(n_dot_l, alpha_g, visibility)) * (4 * n_dot_v * n_dot_l));
  return d * v;
}

// glTF 2.0, Appendix B.3.2: D and V as printed.
inline Real ggx(Real alpha, Real n_dot_l, Real n_dot_v, Real n_dot_h) {
  if (alpha == 0) {
    return 0;
  }
  const Real a2 = alpha * alpha;
  const Real f = n_dot_h * n_dot_h * (a2 - 1) + 1;
  const Real d = a2 / (pi_l * f * f);
  return d / (2 * (n_dot_v * std::sqrt(a2 + (1 - a2) * n_dot_l * n_dot_l) + n_dot_l * std::sqrt(a2 + (1 - a2) * n_dot_v * n_dot_v)));
}

/// V as a lobe about n uses it: mirrored where it lies below, its cosine floored.
inline Vector lobe_view(const Vector& n, const Vector& v, Real& n_dot_v) {
  const Vector seen = plus(v, n, -2 * std::min<Real>(dot(n, v), 0));
  n_dot_v = std::max<Real>(dot(n, seen), albedo::min_n_dot_v);
  return seen;
}

inline Real pow5(Real x) {
  return x * x * x * x * x;
}

/// Direction to a light and its irradiance before colour (KHR_lights_punctual).
inline Real arriving(const scene::Light& light, const Vector& position, Vector& l) {
  if (light.type == scene::LightType::Directional) {
    l = vector(-light.direction);
    return light.intensity;
  }
  const Vector to = plus(vector(light.position), position, -1);
  const Real d2 = dot(to, to);
  l = unit(to);
  Real e = light.intensity / d2;
  if (std::isfinite(light.range)) {
    e *= std::max<Real>(std::min<Real>(1 - std::pow(std::sqrt(d2) / light.range, 4), 1), 0);
  }
  if (light.type == scene::LightType::Spot) {
    const Real scale =
        1 / std::max<Real>(0.001L, std::cos(static_cast<Real>(light.inner_cone)) - std::cos(static_cast<Real>(light.outer_cone)));
    const Real offset = -std::cos(static_cast<Real>(light.outer_cone)) * scale;
    const Real a = std::clamp<Real>(-dot(vector(light.direction), l) * scale + offset, 0, 1);
    e *= a * a;
  }
  return e;
}

/// Sheen of the draft of 2019, "The full layer would then be" and the code after it, with sheenFactor 1: its factor on D V.
inline Real draft_factor(const scene::Material& m) {
  Real reflectance = 0;
  for (int i = 0; i < 3; ++i) {
    reflectance = std::max(reflectance, mix(0.04L, m.base_color_factor[i], m.metallic_factor));
  }
  return (1 - reflectance) * pi_l;
}

/// Outgoing radiance for a material without textures, by the ratified text or its draft.
inline Vector radiance(const Point& p, const scene::Material& m, const std::vector<scene::Light>& lights, albedo::SheenModel model) {
  const bool draft = model.model == albedo::Model::Draft2019;
  Real n_dot_v = 0;
  Real nc_dot_v = 0;
  const Vector v = lobe_view(p.n, p.v, n_dot_v);
  const Vector vc = lobe_view(p.nc, p.v, nc_dot_v);
  const Real k = m.clearcoat.factor * (0.04L + 0.96L * pow5(1 - nc_dot_v));
  const Real c = std::max({m.sheen.color_factor.x, m.sheen.color_factor.y, m.sheen.color_factor.z});
  const Real alpha = m.roughness_factor * m.roughness_factor;
  const auto e = [&](Real mu) {
    return m.sheen.roughness_factor == 0 ? 0
                                         : albedo::directional_albedo(model.visibility, static_cast<double>(mu), m.sheen.roughness_factor);
  };
  const Real f0_ior = std::pow((1 - static_cast<Real>(m.ior)) / (1 + static_cast<Real>(m.ior)), 2);
  Vector out = {m.emissive_factor.x * (1 - k), m.emissive_factor.y * (1 - k), m.emissive_factor.z * (1 - k)};
  for (const scene::Light& light : lights) {
    Vector l;
    const Real irradiance = arriving(light, p.position, l);
    const Real n_dot_l = dot(p.n, l);
    const Real nc_dot_l = dot(p.nc, l);
    Vector sum = {0, 0, 0};
    if (n_dot_l > 0) {
      const Vector h = unit(plus(l, v));
      const Real n_dot_h = dot(p.n, h);
      const Real w = pow5(1 - std::abs(dot(v, h)));
      Real s = 1;
      if (c > 0 && !draft) {
        const Real view = 1 - c * e(n_dot_v);
        const Real full = std::min(view, 1 - c * e(n_dot_l));
        switch (model.scaling) {
          case albedo::AlbedoScaling::Full:
            s = std::clamp<Real>(full, 0, 1);
            break;
          case albedo::AlbedoScaling::View:
            s = std::clamp<Real>(view, 0, 1);
            break;
          case albedo::AlbedoScaling::Literal:
            s = full;
            break;
          case albedo::AlbedoScaling::None:
            s = 1;
            break;
        }
      }
      const Real lobe = ggx(alpha, n_dot_l, n_dot_v, n_dot_h);
      const Real sheen = draft ? draft_factor(m) * sheen_brdf(n_dot_l, n_dot_v, n_dot_h, m.roughness_factor, albedo::Visibility::Ashikhmin)
                               : sheen_brdf(n_dot_l, n_dot_v, n_dot_h, m.sheen.roughness_factor, model.visibility);
      Real fr[3];
      for (int i = 0; i < 3; ++i) {
        const Real f0 = std::min<Real>(f0_ior * m.specular.color_factor[i], 1);
        fr[i] = f0 + (1 - f0) * w;
      }
      const Real fr_max = std::max({fr[0], fr[1], fr[2]});
      for (int i = 0; i < 3; ++i) {
        const Real color = m.base_color_factor[i];
        const Real dielectric = (1 - m.specular.factor * fr_max) * color / pi_l + m.specular.factor * fr[i] * lobe;
        const Real metal = (color + (1 - color) * w) * lobe;
        const Real base = mix(dielectric, metal, m.metallic_factor);
        sum[static_cast<std::size_t>(i)] = (1 - k) * (m.sheen.color_factor[i] * sheen + s * base) * n_dot_l;
      }
    }
    if (nc_dot_l > 0 && k > 0) {
      const Vector h = unit(plus(l, vc));
      const Real alpha_c = m.clearcoat.roughness_factor * m.clearcoat.roughness_factor;
      const Real coat = k * ggx(alpha_c, nc_dot_l, nc_dot_v, dot(p.nc, h)) * nc_dot_l;
      for (Real& x : sum) {
        x += coat;
      }
    }
    for (int i = 0; i < 3; ++i) {
      out[static_cast<std::size_t>(i)] += sum[static_cast<std::size_t>(i)] * irradiance * light.color[i];
    }
  }
  return out;
}

}  // namespace sheen::golden::test
