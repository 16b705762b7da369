#include <cmath>

#include "albedo/sheen_model.h"
#include "conformance/function_forms.h"
#include "conformance/function_vectors.h"
#include "renderer/feature_words.h"

// The lobes: sheen, the specular lobe, their Fresnel and coat weights.

namespace sheen::conformance {
namespace {

using brdf::Visibility;
using number::Bounded;
using renderer::Formulation;
using Values = std::vector<double>;

/// The least N.V of the caller, as far as the precision has it.
template <class P>
double least_n_dot_v() {
  return std::max(albedo::min_n_dot_v, number::smallest_normal<P>);
}

/// The form under test, with the stable one's exact value as what both stand for.
template <class P>
std::vector<Promise> of_form(Formulation formulation, const Bounded<P>& stable, const Bounded<P>& printed) {
  return {promised(formulation == Formulation::Literal ? printed : stable, stable.center())};
}

/// N and H at the angle of the second parameter and the turn of the third; H's length is the fourth.
Numbers half_vector(const Values& v) {
  const glm::dvec3 n = tilted_axis(v[2]);
  return Numbers() << n << at_angle(n, v[1], v[2]) * v[3];
}

std::vector<Parameter> half_vector_parameters(Parameter roughness, const NumberFormat& format) {
  Parameter length = operand_parameter("|H|", 1, 1, {1, 1 + format.ulp_above_1()});
  return {std::move(roughness), angle_parameter("theta_h"), turn_parameter("turn"), std::move(length)};
}

template <class P>
void add_sheen_distribution(std::vector<FunctionSpec>& all) {
  const NumberFormat format = format_of<P>();
  // The caller keeps smaller roughnesses away; mediump holds none of them.
  const double least = std::max(forms::smallest_sheen_roughness * (1 + 1e-6), number::smallest_normal<P>);
  all.push_back({"sheen_distribution", format, half_vector_parameters(roughness_parameter("sheen_roughness", format, least), format),
                 [](const Values& v) -> Values { return half_vector(v) << v[0]; }, 1, true,
                 [](const Values& a, Formulation formulation) {
                   Reader<P> in(a);
                   const auto n = in.vector();
                   const auto h = in.vector();
                   const auto r = in.scalar();
                   return of_form(formulation, forms::sheen_distribution(n, h, r), forms::printed_sheen_distribution(n, h, r));
                 }});
}

template <class P>
void add_lambda(Visibility visibility, std::vector<FunctionSpec>& all) {
  const NumberFormat format = format_of<P>();
  // The refined coefficients are held at alpha_g = 1e-9, at which no sheen is drawn any more.
  const double least = visibility == Visibility::Refined ? 1.1e-9 : 0;
  all.push_back({std::string("sheen_lambda_") + renderer::visibility_name(visibility),
                 format,
                 {alpha_parameter("alpha_g", format, least), cosine_parameter("cos_theta", format, 0, true)},
                 [](const Values& v) -> Values {
                   return {v[1], v[0]};
                 },
                 1,
                 true,
                 [visibility](const Values& a, Formulation formulation) {
                   const Bounded<P> cosine(a[0]);
                   const Bounded<P> alpha_g(a[1]);
                   return of_form(formulation, forms::sheen_lambda<forms::Guarded<P>>(visibility, cosine, alpha_g),
                                  forms::sheen_lambda<Bounded<P>>(visibility, cosine, alpha_g));
                 }});
}

template <class P>
void add_visibility(Visibility visibility, std::vector<FunctionSpec>& all) {
  const NumberFormat format = format_of<P>();
  // See add_lambda.
  const double least = visibility == Visibility::Refined ? 3.3e-5 : 0;
  all.push_back({std::string("sheen_visibility_") + renderer::visibility_name(visibility),
                 format,
                 {roughness_parameter("sheen_roughness", format, least), cosine_parameter("N.V", format, least_n_dot_v<P>()),
                  cosine_parameter("N.L", format)},
                 [](const Values& v) -> Values {
                   return {v[2], v[1], v[0]};
                 },
                 1,
                 true,
                 [visibility](const Values& a, Formulation formulation) {
                   const Bounded<P> n_dot_l(a[0]);
                   const Bounded<P> n_dot_v(a[1]);
                   const Bounded<P> r(a[2]);
                   return of_form(formulation, forms::sheen_visibility(visibility, n_dot_l, n_dot_v, r),
                                  forms::printed_sheen_visibility(visibility, n_dot_l, n_dot_v, r));
                 }});
}

template <class P>
std::vector<Promise> sheen_promises(Visibility visibility, const Values& a, Formulation formulation) {
  using B = Bounded<P>;
  Reader<P> in(a);
  const auto n = in.vector();
  const auto h = in.vector();
  const B n_dot_l = in.scalar();
  const B n_dot_v = in.scalar();
  const auto color = in.vector();
  const B r = in.scalar();
  const B stable = forms::sheen(visibility, n, h, n_dot_l, n_dot_v, r);
  const B printed = forms::printed_sheen_distribution(n, h, r) * forms::printed_sheen_visibility(visibility, n_dot_l, n_dot_v, r);
  std::vector<Promise> result;
  for (const B& channel : {color.x, color.y, color.z}) {
    result.push_back(of_form(formulation, channel * stable, channel * printed).front());
  }
  return result;
}

template <class P>
void add_sheen(Visibility visibility, std::vector<FunctionSpec>& all) {
  const NumberFormat format = format_of<P>();
  std::vector<Parameter> parameters = half_vector_parameters(roughness_parameter("sheen_roughness", format), format);
  parameters.push_back(cosine_parameter("N.L", format));
  parameters.push_back(cosine_parameter("N.V", format, least_n_dot_v<P>()));
  parameters.push_back(cosine_parameter("sheen_color", format));
  all.push_back({std::string("sheen_") + renderer::visibility_name(visibility), format, std::move(parameters),
                 [](const Values& v) -> Values { return half_vector(v) << v[4] << v[5] << v[6] << 0.5 << 1.0 << v[0]; }, 3, true,
                 [visibility](const Values& a, Formulation formulation) { return sheen_promises<P>(visibility, a, formulation); }});
  all.back().is_finite = true;
}

template <class P>
void add_specular(std::vector<FunctionSpec>& all) {
  const NumberFormat format = format_of<P>();
  // The caller keeps mirrors away.
  const double least = std::max(forms::mirror_alpha * (1 + 1e-6), number::smallest_normal<P>);
  all.push_back({"ggx_distribution", format, half_vector_parameters(alpha_parameter("alpha", format, least), format),
                 [](const Values& v) -> Values { return half_vector(v) << v[0]; }, 1, true,
                 [](const Values& a, Formulation formulation) {
                   Reader<P> in(a);
                   const auto n = in.vector();
                   const auto h = in.vector();
                   const auto alpha = in.scalar();
                   return of_form(formulation, forms::ggx_distribution(n, h, alpha), forms::printed_ggx_distribution(n, h, alpha));
                 }});
  all.push_back(
      {"smith_visibility",
       format,
       {alpha_parameter("alpha", format, least), cosine_parameter("N.V", format, least_n_dot_v<P>()), cosine_parameter("N.L", format)},
       [](const Values& v) -> Values {
         return {v[2], v[1], v[0]};
       },
       1,
       true,
       [](const Values& a, Formulation formulation) {
         const Bounded<P> n_dot_l(a[0]);
         const Bounded<P> n_dot_v(a[1]);
         const Bounded<P> alpha(a[2]);
         return of_form(formulation, brdf::smith_visibility(alpha, n_dot_l, n_dot_v) * n_dot_l,
                        brdf::printed::smith_visibility(alpha, n_dot_l, n_dot_v) * n_dot_l);
       }});
  std::vector<Parameter> parameters = half_vector_parameters(alpha_parameter("alpha", format), format);
  parameters.push_back(cosine_parameter("N.L", format, number::smallest_normal<P>));
  parameters.push_back(cosine_parameter("N.V", format, least_n_dot_v<P>()));
  all.push_back({"specular_ggx", format, std::move(parameters),
                 [](const Values& v) -> Values { return half_vector(v) << v[4] << v[5] << v[0]; }, 1, true,
                 [](const Values& a, Formulation formulation) {
                   Reader<P> in(a);
                   const auto n = in.vector();
                   const auto h = in.vector();
                   const auto n_dot_l = in.scalar();
                   const auto n_dot_v = in.scalar();
                   const auto alpha = in.scalar();
                   return of_form(formulation, forms::specular_ggx(n, h, n_dot_l, n_dot_v, alpha, false),
                                  forms::specular_ggx(n, h, n_dot_l, n_dot_v, alpha, true));
                 }});
  all.back().is_finite = true;
}

template <class P>
void add_weights(std::vector<FunctionSpec>& all) {
  using B = Bounded<P>;
  const NumberFormat format = format_of<P>();
  all.push_back({"fresnel_weight",
                 format,
                 {signed_cosine_parameter("V.H", format)},
                 [](const Values& v) { return v; },
                 1,
                 true,
                 [](const Values& a, Formulation formulation) {
                   const B cosine(a[0]);
                   return of_form(formulation, brdf::schlick_weight(cosine), brdf::printed::schlick_weight(cosine));
                 }});
  all.push_back({"clearcoat_weight",
                 format,
                 {cosine_parameter("clearcoat", format), cosine_parameter("Nc.V", format, 0, true)},
                 [](const Values& v) { return v; },
                 1,
                 true,
                 [](const Values& a, Formulation formulation) {
                   const B clearcoat(a[0]);
                   const B cosine(a[1]);
                   return of_form(formulation, brdf::clearcoat_weight(clearcoat, cosine),
                                  clearcoat * (B(0.04) + B(0.96) * brdf::printed::schlick_weight(cosine)));
                 }});
  all.back().is_finite = true;
}

template <class P>
void add_all(std::vector<FunctionSpec>& all) {
  add_sheen_distribution<P>(all);
  for (const Visibility visibility : {Visibility::Charlie, Visibility::Refined, Visibility::Ashikhmin}) {
    if (visibility != Visibility::Ashikhmin) {
      add_lambda<P>(visibility, all);
    }
    add_visibility<P>(visibility, all);
    add_sheen<P>(visibility, all);
  }
  add_specular<P>(all);
  add_weights<P>(all);
}

}  // namespace

void add_lobe_specs(renderer::Precision precision, std::vector<FunctionSpec>& all) {
  if (precision == renderer::Precision::Highp) {
    add_all<number::Highp>(all);
  } else {
    add_all<number::Mediump>(all);
  }
}

}  // namespace sheen::conformance
