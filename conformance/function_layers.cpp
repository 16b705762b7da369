#include <algorithm>
#include <cmath>

#include "conformance/albedo_forms.h"
#include "conformance/function_forms.h"
#include "conformance/function_vectors.h"
#include "renderer/feature_words.h"

// The directional albedo, the scale it puts on the base, the base and the whole of a point under one light.

namespace sheen::conformance {
namespace {

using albedo::AlbedoScaling;
using brdf::Visibility;
using number::Bounded;
using number::Highp;
using renderer::Formulation;
using Values = std::vector<double>;
using H = Bounded<Highp>;

Promise about(double truth, double error) {
  return {truth, {truth - error, truth + error}, truth};
}

template <Visibility visibility>
void add_albedo(std::vector<FunctionSpec>& all) {
  const NumberFormat format = format_of<Highp>();
  const std::string name = renderer::visibility_name(visibility);
  all.push_back({"sheen_albedo_" + name,
                 format,
                 {roughness_parameter("sheen_roughness", format), cosine_parameter("N.X", format, 0, true)},
                 [](const Values& v) -> Values {
                   return {v[1], v[0]};
                 },
                 1,
                 false,
                 [](const Values& a, Formulation) {
                   const forms::TableAlbedo read = forms::table_albedo(forms::shared_table<visibility>(), a[0], a[1]);
                   return std::vector<Promise>{about(read.truth, read.error)};
                 }});
  all.back().is_finite = true;
  if (visibility == Visibility::Refined) {
    return;
  }
  // Where the fit is stated to hold.
  all.push_back({"sheen_albedo_fit_" + name,
                 format,
                 {roughness_parameter("sheen_roughness", format, 0.1), cosine_parameter("N.X", format, 0.005)},
                 [](const Values& v) -> Values {
                   return {v[1], v[0]};
                 },
                 1,
                 false,
                 [](const Values& a, Formulation) {
                   const double stated = visibility == Visibility::Charlie ? forms::charlie_fit_error : forms::ashikhmin_fit_error;
                   const double truth = std::min(albedo::directional_albedo(visibility, a[0], a[1]), 1.0);
                   return std::vector<Promise>{about(truth, stated + forms::fitted_albedo(visibility, a[0], a[1]).deviation())};
                 }});
}

std::vector<Promise> scale_promises(AlbedoScaling scaling, const Values& a) {
  const H scale =
      forms::read_albedo_scale(scaling, forms::shared_table<Visibility::Charlie>(), std::max({a[0], a[1], a[2]}), a[3], H(a[4]), H(a[5]));
  return promises(scale);
}

void add_scaling(AlbedoScaling scaling, std::vector<FunctionSpec>& all) {
  const NumberFormat format = format_of<Highp>();
  all.push_back({std::string("albedo_scaling_") + renderer::scaling_name(scaling),
                 format,
                 {roughness_parameter("sheen_roughness", format), cosine_parameter("N.V", format), cosine_parameter("N.L", format),
                  cosine_parameter("sheen_color", format)},
                 [](const Values& v) -> Values { return {0.5 * v[3], v[3], 0.0, v[0], v[2], v[1]}; },
                 1,
                 false,
                 [scaling](const Values& a, Formulation) { return scale_promises(scaling, a); }});
  all.back().is_finite = true;
}

template <class P>
void add_base(std::vector<FunctionSpec>& all) {
  const NumberFormat format = format_of<P>();
  const double least = std::max(forms::mirror_alpha * (1 + 1e-6), number::smallest_normal<P>);
  const double least_v = std::max(albedo::min_n_dot_v, number::smallest_normal<P>);
  all.push_back(
      {"base",
       format,
       {alpha_parameter("alpha", format, least), angle_parameter("theta_h"), angle_parameter("angle of V and H"), turn_parameter("turn"),
        cosine_parameter("N.L", format, number::smallest_normal<P>), cosine_parameter("N.V", format, least_v),
        cosine_parameter("base_color", format), cosine_parameter("metallic", format)},
       [](const Values& v) -> Values {
         const glm::dvec3 n = tilted_axis(v[3]);
         const glm::dvec3 h = at_angle(n, v[1], v[3]);
         return Numbers() << n << at_angle(h, v[2], 2 * v[3]) << h << v[4] << v[5] << v[6] << 0.5 << 0.0 << v[7] << v[0];
       },
       3,
       false,
       [](const Values& a, Formulation) {
         Reader<P> in(a);
         const auto n = in.vector();
         const auto v = in.vector();
         const auto h = in.vector();
         const auto n_dot_l = in.scalar();
         const auto n_dot_v = in.scalar();
         const auto c = in.vector();
         const auto metallic = in.scalar();
         const auto lit = forms::base(n, v, h, n_dot_l, n_dot_v, c, metallic, in.scalar());
         return std::vector<Promise>{promised(lit.r, lit.r.center()), promised(lit.g, lit.g.center()), promised(lit.b, lit.b.center())};
       }});
  all.back().is_finite = true;
}

void add_normalize_or(std::vector<FunctionSpec>& all) {
  const NumberFormat format = format_of<Highp>();
  all.push_back(
      {"normalize_or",
       format,
       {magnitude_parameter("|v|", std::exp2(-60), std::exp2(60), false, {0, std::exp2(-49), std::exp2(-51), 1, 3, std::exp2(60)}),
        turn_parameter("turn"), angle_parameter("angle")},
       [](const Values& v) -> Values { return Numbers() << at_angle(tilted_axis(v[1]), v[2], v[1]) * v[0]; },
       3,
       false,
       [](const Values& a, Formulation) {
         const auto v = Reader<Highp>(a).vector();
         const auto has_direction = forms::squared_length(v) > H(1e-30);
         const auto unit = forms::normalized(v);
         const auto one = [&](const H& x, double fallback) {
           const H held = has_direction.is_false() ? H(fallback) : select(has_direction, x, H(fallback));
           return promised(held, held.center());
         };
         return std::vector<Promise>{one(unit.x, 0), one(unit.y, 0), one(unit.z, 1)};
       }});
  all.back().is_finite = true;
}

}  // namespace

void add_layer_specs(renderer::Precision precision, std::vector<FunctionSpec>& all) {
  add_albedo<Visibility::Charlie>(all);
  add_albedo<Visibility::Refined>(all);
  add_albedo<Visibility::Ashikhmin>(all);
  for (const AlbedoScaling scaling : {AlbedoScaling::Full, AlbedoScaling::View, AlbedoScaling::Literal}) {
    add_scaling(scaling, all);
  }
  add_normalize_or(all);
  if (precision == renderer::Precision::Highp) {
    add_base<Highp>(all);
  } else {
    add_base<number::Mediump>(all);
  }
}

}  // namespace sheen::conformance
