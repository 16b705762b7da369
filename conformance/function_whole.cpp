#include <algorithm>
#include <cmath>

#include "conformance/albedo_forms.h"
#include "conformance/function_forms.h"
#include "conformance/function_vectors.h"

// A point with every layer under one light: layers.glsl, whose sums are highp over lobes in the shading's precision.

namespace sheen::conformance {
namespace {

using forms::as;
using golden::Vec3;
using number::Bounded;
using number::Highp;
using Values = std::vector<double>;
using H = Bounded<Highp>;

/// What reflected_light reads of the surface, in the order of its arguments.
struct Point {
  Vec3<H> n, v, l, color;
  H metallic, roughness;
  Vec3<H> sheen_color;
  H sheen_roughness, clearcoat, clearcoat_roughness;

  explicit Point(Reader<Highp> in)
      : n(in.vector()),
        v(in.vector()),
        l(in.vector()),
        color(in.vector()),
        metallic(in.scalar()),
        roughness(in.scalar()),
        sheen_color(in.vector()),
        sheen_roughness(in.scalar()),
        clearcoat(in.scalar()),
        clearcoat_roughness(in.scalar()) {}
};

/// layer_view(): V mirrored to the normal's side, and its cosine.
struct View {
  Vec3<H> v;
  H n_dot_v;

  View(const Vec3<H>& n, const Vec3<H>& toward_eye) {
    const H cosine = forms::dot_in_any_order(n, toward_eye);
    v = toward_eye - n * (H(2) * min(cosine, H(0)));
    n_dot_v = min(max(abs(cosine), H(static_cast<float>(albedo::min_n_dot_v))), H(1));
  }
};

/// normalize_or(v, n).
Vec3<H> direction(const Vec3<H>& v, const Vec3<H>& n) {
  const auto has_direction = forms::squared_length(v) > H(1e-30);
  if (has_direction.is_false()) {
    return n;
  }
  const Vec3<H> unit = forms::normalized(v);
  return {select(has_direction, unit.x, n.x), select(has_direction, unit.y, n.y), select(has_direction, unit.z, n.z)};
}

template <class P>
std::vector<Promise> reflected(const Values& a) {
  const Point point{Reader<Highp>(a)};
  const View view(point.n, point.v);
  const H n_dot_l = min(forms::dot_in_any_order(point.n, point.l), H(1));
  const auto lit = n_dot_l > H(0);
  const Vec3<H> half = direction(point.l + view.v, point.n);

  const auto n = as<P>(point.n);
  const auto h = as<P>(half);
  const auto nl = as<P>(n_dot_l);
  const auto nv = as<P>(view.n_dot_v);
  const auto base =
      forms::base(n, as<P>(view.v), h, nl, nv, as<P>(point.color), as<P>(point.metallic), as<P>(point.roughness * point.roughness));
  const double color = std::max({point.sheen_color.x.center(), point.sheen_color.y.center(), point.sheen_color.z.center()});
  const H scale = forms::read_albedo_scale(brdf::AlbedoScaling::Full, forms::shared_table<brdf::Visibility::Charlie>(), color,
                                           point.sheen_roughness.center(), max(n_dot_l, H(0)), view.n_dot_v);
  const auto sheen = forms::sheen(brdf::Visibility::Charlie, n, h, nl, nv, as<P>(point.sheen_roughness));
  const auto coat_color = as<P>(point.sheen_color);
  const H k = as<Highp>(brdf::clearcoat_weight(as<P>(point.clearcoat), nv));
  const H coat = as<Highp>(forms::specular_ggx(n, h, nl, nv, as<P>(point.clearcoat_roughness * point.clearcoat_roughness), false));

  const auto channel = [&](const Bounded<P>& of_base, const Bounded<P>& of_sheen) {
    const H below = (as<Highp>(of_base) * scale + as<Highp>(of_sheen * sheen)) * (H(1) - k);
    const H light = lit.is_false() ? H(0) : select(lit, below + k * coat, H(0));
    return promised(light, light.center());
  };
  return {channel(base.r, coat_color.x), channel(base.g, coat_color.y), channel(base.b, coat_color.z)};
}

template <class P>
void add(std::vector<FunctionSpec>& all) {
  const NumberFormat format = format_of<P>();
  const auto roughness = [&](const char* name) { return roughness_parameter(name, format); };
  const auto factor = [&](const char* name) { return cosine_parameter(name, format); };
  all.push_back({"reflected_light",
                 format,
                 {roughness("sheen_roughness"), angle_parameter("angle of L"), angle_parameter("angle of V"), turn_parameter("turn"),
                  factor("base_color"), factor("metallic"), roughness("roughness"), factor("sheen_color"), factor("clearcoat"),
                  roughness("clearcoat_roughness")},
                 [](const Values& p) -> Values {
                   const glm::dvec3 n = tilted_axis(p[3]);
                   return Numbers() << n << at_angle(n, p[2], p[3]) << at_angle(n, p[1], 2 * p[3]) << p[4] << 0.5 << 0.0 << p[5] << p[6]
                                    << 0.5 * p[7] << p[7] << 0.0 << p[0] << p[8] << p[9];
                 },
                 3,
                 false,
                 [](const Values& a, renderer::Formulation) { return reflected<P>(a); }});
  all.back().is_finite = true;
}

}  // namespace

void add_whole_specs(renderer::Precision precision, std::vector<FunctionSpec>& all) {
  if (precision == renderer::Precision::Highp) {
    add<Highp>(all);
  } else {
    add<number::Mediump>(all);
  }
}

}  // namespace sheen::conformance
