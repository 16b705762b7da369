#include "golden/uniform_light.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <vector>

#include "albedo/ggx_albedo.h"
#include "brdf/fresnel.h"

namespace sheen::golden {
namespace {

// One dimension at a time, by tanh-sinh, whose nodes crowd at both ends. Over lambda = N.L: panels that end at N.V, where the GGX lobe
// peaks and the smaller of two scales changes over, and at 0.5, where Lambda changes branch. Over the azimuth phi, 0 in the mirror
// direction's, where the lobe peaks; with s the sines,
//
//   1 + V.L  = A + B sin^2(phi/2),   A = (mu + lambda)^2 / (1 + mu lambda + s_v s_l),   B = 2 s_v s_l
//   D        = alpha^2/pi (1 + (A - d) / (d + B sin^2(phi/2)))^2,   d = A (S + alpha^2 (1 - S))
//   S        = sin^2 of half the angle between L and the mirror direction = (mu - lambda)^2 / (2 (1 - mu lambda + s_v s_l))
//
// Without the Fresnel weight the azimuth has closed forms: the integrals of 1, 1/(d + B sin^2) and its square over a turn are 2 pi,
// 2 pi / sqrt(d (d+B)) and 2 pi (d + B/2) / (d (d+B))^(3/2).
struct AzimuthNode {
  double sin2, weight;  // sin^2(phi/2); of the integral over a whole turn
};

struct Nodes {
  albedo::Rule cosine;
  std::vector<AzimuthNode> azimuth;

  Nodes(int cosines, int azimuths, double reach) : cosine(albedo::make_rule(cosines, reach, 1)) {
    const albedo::Rule turn = albedo::make_rule(azimuths, reach, 1);
    for (std::size_t i = 0; i < turn.left.size(); ++i) {
      const double sine = std::sin(0.5 * brdf::pi * turn.left[i]);
      azimuth.push_back({sine * sine, 2 * brdf::pi * turn.weight[i]});
    }
  }
};

const Nodes& nodes_for(albedo::Effort effort) {
  static const Nodes full(48, 48, 3.4), fast(24, 16, 3.0);
  return effort == albedo::Effort::Full ? full : fast;
}

struct Cosine {
  double lambda, from_mu;  // the latter without cancellation: it may be less than what tells lambda and mu apart
};

// What the integrands are at one cosine, azimuth integrated, without s.
BaseIntegrals around(const std::vector<AzimuthNode>& azimuth, double alpha, double mu, const Cosine& l) {
  const double squared_sine = (1 - mu) * (1 + mu);
  const double sine_product = std::sqrt(squared_sine * std::max(1 - mu - l.from_mu, 0.0) * (1 + l.lambda));
  const double a = (mu + l.lambda) * (mu + l.lambda) / (1 + mu * l.lambda + sine_product);
  const double b = 2 * sine_product;
  const double s = std::min(l.from_mu * l.from_mu / (2 * (squared_sine - mu * l.from_mu + sine_product)), 1.0);
  const double d = a * (s + alpha * alpha * (1 - s));
  const double lobe = brdf::is_mirror(alpha) ? 0.0 : alpha * alpha / brdf::pi * brdf::smith_visibility(alpha, l.lambda, mu) * l.lambda;
  BaseIntegrals out;
  out.diffuse = 2 * l.lambda;
  const double product = d * (d + b);
  const double root = std::sqrt(product);
  if (lobe > 0) {
    out.specular = lobe * 2 * brdf::pi * (1 + 2 * (a - d) / root + (a - d) * (a - d) * (d + 0.5 * b) / (product * root));
  }
  // The weight at the peak is taken out, so that nodes meet what is left of it alone.
  const double at_peak = brdf::schlick_weight(std::min(std::sqrt(0.5 * a), 1.0));
  double rest = 0;
  for (const AzimuthNode& node : azimuth) {
    const double one_plus_vl = a + b * node.sin2;
    const double w = brdf::schlick_weight(std::min(std::sqrt(0.5 * one_plus_vl), 1.0));
    const double ratio = one_plus_vl / (d + b * node.sin2);
    out.diffuse_w += node.weight * w;
    rest += node.weight * (w - at_peak) * ratio * ratio;
  }
  out.diffuse_w *= l.lambda / brdf::pi;
  out.specular_w = lobe > 0 ? at_peak * out.specular + lobe * rest : 0.0;
  return out;
}

}  // namespace

BaseIntegrals base_integrals(double alpha, double n_dot_v, const std::function<double(double)>& scale, const std::vector<double>& kinks,
                             albedo::Effort effort) {
  const Nodes& nodes = nodes_for(effort);
  const albedo::Rule& rule = nodes.cosine;
  const double mu = n_dot_v;
  // As differences from mu.
  std::vector<double> breaks{-mu, 0.0, 1 - mu};
  for (const double kink : kinks) {
    breaks.push_back(kink - mu);
  }
  // A change of the half vector by alpha moves N.L by about this.
  const double width = brdf::is_mirror(alpha) ? 0.0 : 2 * alpha * (std::sqrt((1 - mu) * (1 + mu)) + alpha);
  // Beyond, the lobe falls like a power: at most two decades to a panel.
  for (double widths = 3; width > 0 && widths * width < 1; widths *= widths < 30 ? 10 : 100) {
    for (const double at : {-widths * width, widths * width}) {
      if (at > -mu && at < 1 - mu) {
        breaks.push_back(at);
      }
    }
  }
  std::sort(breaks.begin(), breaks.end());
  BaseIntegrals sum;
  for (std::size_t k = 0; k + 1 < breaks.size(); ++k) {
    const double a = breaks[k];
    const double b = breaks[k + 1];
    const double length = b - a;
    if (!(length > 0)) {
      continue;
    }
    for (std::size_t i = 0; i < rule.left.size(); ++i) {
      const double from_mu = rule.left[i] < 0.5 ? a + length * rule.left[i] : b - length * rule.right[i];
      const Cosine l{mu + from_mu, from_mu};
      if (!(l.lambda > 0)) {
        continue;
      }
      const BaseIntegrals f = around(nodes.azimuth, alpha, mu, l);
      const double weight = rule.weight[i] * length * scale(l.lambda);
      sum.diffuse += weight * f.diffuse;
      sum.diffuse_w += weight * f.diffuse_w;
      sum.specular += weight * f.specular;
      sum.specular_w += weight * f.specular_w;
    }
  }
  if (brdf::is_mirror(alpha)) {
    sum.specular = scale(mu);
    sum.specular_w = sum.specular * brdf::schlick_weight(mu);
  }
  return sum;
}

using Color = brdf::Rgb<double>;

Color base_light(const brdf::Base<double>& base, const BaseIntegrals& in) {
  const auto schlick = [&](const Color& f0) {
    const auto of = [&](double f) { return f * in.specular + (1 - f) * in.specular_w; };
    return Color{of(f0.r), of(f0.g), of(f0.b)};
  };
  const double f0 = brdf::max3(base.dielectric_f0);
  const Color dielectric =
      base.color * (in.diffuse - base.specular * (f0 * in.diffuse + (1 - f0) * in.diffuse_w)) + schlick(base.dielectric_f0) * base.specular;
  return dielectric * (1 - base.metallic) + schlick(base.color) * base.metallic;
}

namespace {

// Where Lambda changes branch, and where c E(N.L) passes 1 and the scale's clamp sets in; seen at grazing angles, on either side of E's
// peak, and also where E ends and where E(N.L) passes E(N.V), of which the larger counts.
std::vector<double> scale_kinks(const SheenLayer<double>& sheen, double c, double n_dot_v) {
  std::vector<double> kinks{0.5};
  const auto e = [&](double n_dot_l) { return sheen.e_l(true, n_dot_l); };
  const auto add = [&](double low, double high, double level) {
    const bool above = e(low) > level;
    if (above == (e(high) > level)) {
      return;
    }
    for (int i = 0; i < 40; ++i) {
      const double middle = 0.5 * (low + high);
      ((e(middle) > level) == above ? low : high) = middle;
    }
    kinks.push_back(low);
  };
  if (n_dot_v >= albedo::decreasing_from) {
    add(albedo::min_n_dot_v, 1.0, 1 / c);
    return kinks;
  }
  kinks.push_back(albedo::min_n_dot_v);
  const albedo::Peak peak = albedo::peak_of(e, 8);
  const double top = std::sqrt(peak.from * peak.to);
  for (const double level : {1 / c, sheen.e_v()}) {
    add(albedo::min_n_dot_v, top, level);
    add(top, 1.0, level);
  }
  return kinks;
}

}  // namespace

UniformLight::UniformLight(const Lighting& lighting, const Color& radiance) : lighting_(lighting), radiance_(radiance) {}

template <class Find>
const BaseIntegrals& UniformLight::kept(Of of, const std::array<double, 4>& numbers, albedo::Effort effort, const Find& find) {
  Key key{static_cast<std::uint64_t>(of), static_cast<std::uint64_t>(effort)};
  std::transform(numbers.begin(), numbers.end(), key.begin() + 2, [](double x) { return std::bit_cast<std::uint64_t>(x); });
  const auto place = kept_.lower_bound(key);
  return place != kept_.end() && place->first == key ? place->second : kept_.emplace_hint(place, key, find())->second;
}

Color UniformLight::reflected(const Surface<double>& surface, double n_dot_v, const BaseIntegrals& in) const {
  const Color light = lighting_.base_albedo.interpolant != nullptr
                          ? PhysicalLayer<double>(surface.base, n_dot_v, lighting_.base_albedo).base.light(in.specular, in.specular_w)
                          : base_light(surface.base, in);
  return light * lighting_.factors.base;
}

Color UniformLight::lookup(const Surface<double>& surface, Layers layers) {
  const Color none{0, 0, 0};
  if (!layers.sheen) {
    return none;
  }
  const LobeView<double> lobe(surface.normal, surface.view);
  lighting_.albedo.curve = curves_.at(lighting_.albedo.interpolant, surface.sheen_roughness);
  const SheenLayer<double> sheen(surface, lobe, lighting_);
  // E rises to one peak and falls from there: if it is not below E(N.V) at the least cosine, it is nowhere below it on that side.
  if (!sheen.two_directions() || !(sheen.e_l(true, albedo::min_n_dot_v) < sheen.e_v())) {
    return none;
  }
  const auto missed = [&](double n_dot_l) {
    const double e_l = sheen.e_l(true, n_dot_l);
    return sheen.single_lookup_scale(n_dot_l, e_l) - sheen.scale(e_l);
  };
  const BaseIntegrals in = base_integrals(surface.base.alpha, lobe.n_dot_v, missed,
                                          scale_kinks(sheen, brdf::max3(surface.sheen_color), lobe.n_dot_v), albedo::Effort::Fast);
  double k = 0.0;
  if (layers.clearcoat) {
    const LobeView<double> coat(surface.coat_normal, surface.view);
    k = brdf::clearcoat_weight(surface.clearcoat, coat.n_dot_v) * lighting_.factors.coat_weight;
  }
  return reflected(surface, lobe.n_dot_v, in) * radiance_ * (surface.occlusion * (1 - k));
}

Color UniformLight::shade(const Surface<double>& surface, Layers layers, albedo::Effort effort) {
  const TermFactors& factors = lighting_.factors;
  const LobeView<double> lobe(surface.normal, surface.view);
  const LobeView<double> coat(layers.clearcoat ? surface.coat_normal : surface.normal, surface.view);
  const double k = layers.clearcoat ? brdf::clearcoat_weight(surface.clearcoat, coat.n_dot_v) * factors.coat_weight : 0.0;
  const Color light = radiance_ * surface.occlusion;
  const double alpha = surface.base.alpha;
  const auto evenly = [&](double s) {
    const auto one = [](double) { return 1.0; };
    const BaseIntegrals& all =
        kept(Of::Base, {alpha, lobe.n_dot_v, 0, 0}, effort, [&] { return base_integrals(alpha, lobe.n_dot_v, one, {}, effort); });
    return BaseIntegrals{s * all.diffuse, s * all.diffuse_w, s * all.specular, s * all.specular_w};
  };

  Color sheen_light{0, 0, 0};
  BaseIntegrals base;
  if (layers.sheen) {
    lighting_.albedo.curve = curves_.at(lighting_.albedo.interpolant, surface.sheen_roughness);
    const SheenLayer<double> sheen(surface, lobe, lighting_);
    sheen_light = surface.sheen_color * (sheen.e_v() * factors.distribution * factors.visibility);
    if (sheen.two_directions()) {
      const double c = brdf::max3(surface.sheen_color);
      const auto scale = [&](double n_dot_l) { return sheen.scale(sheen.e_l(true, n_dot_l)); };
      base = kept(Of::BaseUnderSheen, {alpha, lobe.n_dot_v, c, surface.sheen_roughness}, effort,
                  [&] { return base_integrals(alpha, lobe.n_dot_v, scale, scale_kinks(sheen, c, lobe.n_dot_v), effort); });
    } else {
      base = evenly(sheen.scale(0.0));
    }
  } else {
    base = evenly(1.0);
  }
  Color sum = (reflected(surface, lobe.n_dot_v, base) + sheen_light) * light * (1 - k);
  if (layers.clearcoat) {
    const auto reflected_by_coat = [&] { return BaseIntegrals{0, 0, 1 - albedo::ggx_loss(coat.n_dot_v, surface.coat_alpha), 0}; };
    const BaseIntegrals& in = kept(Of::Coat, {surface.coat_alpha, coat.n_dot_v, 0, 0}, albedo::Effort::Full, reflected_by_coat);
    sum = sum + light * (k * factors.coat_lobe * in.specular);
  }
  return sum;
}

}  // namespace sheen::golden
