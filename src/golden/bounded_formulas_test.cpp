#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iostream>
#include <random>
#include <string>
#include <type_traits>
#include <vector>

#include <gtest/gtest.h>

#include "brdf/albedo_scaling.h"
#include "brdf/base.h"
#include "brdf/clearcoat.h"
#include "brdf/physical_base.h"
#include "brdf/sheen.h"
#include "number/bounded_functions.h"
#include "number/perturbed_test.h"

// The formulas of a shader on number::Bounded: nothing that the rules of GLSL ES allow leaves the bound, and the bound is not much more
// than what they allow.

namespace sheen::number {
namespace {

using brdf::Rgb;
using brdf::Visibility;
using test::Decisions;
using test::Perturbed;

/// Everything that the formulas take, each in its legal range.
template <class Real>
struct Arguments {
  Real sheen_roughness, n_dot_v, n_dot_l, n_dot_h, sin2_theta_h, v_dot_h, alpha, color, metallic, clearcoat, sheen_color, e_v, e_l;

  template <class Convert>
  auto each(const Convert& to) const {
    using Other = decltype(to(sheen_roughness));
    return Arguments<Other>{to(sheen_roughness), to(n_dot_v),  to(n_dot_l),   to(n_dot_h),     to(sin2_theta_h), to(v_dot_h), to(alpha),
                            to(color),           to(metallic), to(clearcoat), to(sheen_color), to(e_v),          to(e_l)};
  }
};

/// What f makes of a point and of how its arguments move.
template <class Function>
auto joined(const Arguments<double>& p, const Arguments<double>& x, const Arguments<double>& y, const Function& f) {
  using Real = decltype(f(0, 0, 0));
  const auto of = [&](double Arguments<double>::*m) { return f(p.*m, x.*m, y.*m); };
  using A = Arguments<double>;
  return Arguments<Real>{of(&A::sheen_roughness), of(&A::n_dot_v), of(&A::n_dot_l), of(&A::n_dot_h),  of(&A::sin2_theta_h),
                         of(&A::v_dot_h),         of(&A::alpha),   of(&A::color),   of(&A::metallic), of(&A::clearcoat),
                         of(&A::sheen_color),     of(&A::e_v),     of(&A::e_l)};
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<long>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

template <class Real>
Real sheen(Visibility visibility, const Arguments<Real>& a) {
  return brdf::SheenLobe<Real>(visibility, a.sheen_roughness, a.n_dot_v).value_times_n_dot_l(a.n_dot_l, a.n_dot_h, a.sin2_theta_h);
}

template <class Real>
Real base(const Arguments<Real>& a) {
  const Rgb<Real> white{Real(1), Real(1), Real(1)};
  const brdf::Base<Real> material{{a.color, a.clearcoat, Real(0)}, a.metallic, a.alpha, brdf::dielectric_f0(Real(1.5), white), Real(1)};
  return brdf::base_brdf(material, a.n_dot_l, a.n_dot_v, a.n_dot_h, a.sin2_theta_h, a.v_dot_h).r;
}

template <class Real>
Real physical_base(const Arguments<Real>& a) {
  const Rgb<Real> white{Real(1), Real(1), Real(1)};
  const brdf::Base<Real> material{{a.color, a.clearcoat, Real(0)}, a.metallic, a.alpha, brdf::dielectric_f0(Real(1.5), white), Real(1)};
  // Losses and biases whose sum stays below 1.
  const auto albedo = [](const Real& x, const Real& y) { return brdf::LobeAlbedo<Real>{x * Real(0.25), y * Real(0.25)}; };
  const brdf::PhysicalBase<Real> base(material, albedo(a.e_v, a.e_l), albedo(a.sheen_color, a.v_dot_h));
  return base.brdf(albedo(a.e_l, a.e_v), a.n_dot_l, a.n_dot_v, a.n_dot_h, a.sin2_theta_h, a.v_dot_h).r;
}

template <class Real>
Real layers(const Arguments<Real>& a) {
  const Real k = brdf::clearcoat_weight(a.clearcoat, a.n_dot_v);
  const Real s = brdf::albedo_scale(brdf::AlbedoScaling::Full, a.sheen_color, a.e_v, a.e_l);
  const Real coat = brdf::ClearcoatLobe<Real>(a.alpha, a.n_dot_v).value(a.n_dot_l, a.n_dot_h, a.sin2_theta_h) * a.n_dot_l;
  return (Real(1) - k) * (a.sheen_color * sheen(Visibility::Charlie, a) + s * base(a) * a.n_dot_l) + k * coat;
}

struct Formula {
  std::string name;
  std::function<Bounded<Highp>(const Arguments<Bounded<Highp>>&)> highp;
  std::function<Bounded<Mediump>(const Arguments<Bounded<Mediump>>&)> mediump;
  std::function<Perturbed<Highp>(const Arguments<Perturbed<Highp>>&)> highp_perturbed;
  std::function<Perturbed<Mediump>(const Arguments<Perturbed<Mediump>>&)> mediump_perturbed;
};

template <class Function>
Formula formula(const char* name, Function f) {
  return {name, f, f, f, f};
}

std::vector<Formula> formulas() {
  const auto curve = [](const auto& a) { return brdf::charlie_lambda_curve(a.sheen_roughness * a.sheen_roughness); };
  return {
      formula("D",
              [](const auto& a) { return brdf::charlie_distribution(a.sheen_roughness * a.sheen_roughness, a.n_dot_h, a.sin2_theta_h); }),
      formula("Lambda", [curve](const auto& a) { return curve(a).lambda(a.n_dot_l); }),
      formula("Charlie V N.L",
              [curve](const auto& a) {
                return brdf::charlie_visibility_times_n_dot_l(curve(a).lambda(a.n_dot_v), curve(a).lambda(a.n_dot_l), a.n_dot_v);
              }),
      formula("Charlie D V N.L", [](const auto& a) { return sheen(Visibility::Charlie, a); }),
      formula("refined D V N.L", [](const auto& a) { return sheen(Visibility::Refined, a); }),
      formula("Ashikhmin V N.L", [](const auto& a) { return brdf::ashikhmin_visibility(a.n_dot_l, a.n_dot_v) * a.n_dot_l; }),
      formula("GGX D", [](const auto& a) { return brdf::ggx_distribution(a.alpha, a.n_dot_h, a.sin2_theta_h); }),
      formula("Smith V", [](const auto& a) { return brdf::smith_visibility(a.alpha, a.n_dot_l, a.n_dot_v); }),
      formula("Schlick's weight", [](const auto& a) { return brdf::schlick_weight(a.v_dot_h); }),
      formula("coat weight", [](const auto& a) { return brdf::clearcoat_weight(a.clearcoat, a.n_dot_v); }),
      formula("albedo scale", [](const auto& a) { return brdf::albedo_scale(brdf::AlbedoScaling::Full, a.sheen_color, a.e_v, a.e_l); }),
      formula("base", [](const auto& a) { return base(a); }),
      formula("physical base", [](const auto& a) { return physical_base(a); }),
      formula("layers", [](const auto& a) { return layers(a); }),
  };
}

/// Arguments over the whole legal range, numbers of the precision. Half of the half vectors are chosen so that sheen_roughness leaves
/// something of D to see, cosines are as often small as not.
template <class Precision>
class Points {
 public:
  Arguments<double> next() {
    const double sheen_roughness = std::max(0.01, std::pow(10, -2 * uniform()));
    const double p = 0.5 / (sheen_roughness * sheen_roughness);
    const double sin2 = uniform() < 0.5 ? std::exp(-80 * uniform() / p) : uniform();
    const Arguments<double> a{
        sheen_roughness, cosine(),  cosine(),  std::sqrt(1 - sin2), sin2,          cosine(), std::pow(10, -3 * uniform()),
        uniform(),       uniform(), uniform(), uniform(),           2 * uniform(), uniform()};
    const test::Grid grid{Precision::fraction_bits, Precision::min_exponent};
    return a.each([&](double x) { return grid.down(x); });
  }

  double uniform() { return std::uniform_real_distribution<double>(0, 1)(random_); }
  double cosine() { return uniform() < 0.5 ? std::pow(10, -6 * uniform()) : uniform(); }

 private:
  std::mt19937_64 random_{20240501};
};

template <class Precision>
const auto& bounded_form(const Formula& f) {
  if constexpr (std::is_same_v<Precision, Highp>) {
    return f.highp;
  } else {
    return f.mediump;
  }
}
template <class Precision>
const auto& perturbed_form(const Formula& f) {
  if constexpr (std::is_same_v<Precision, Highp>) {
    return f.highp_perturbed;
  } else {
    return f.mediump_perturbed;
  }
}

struct Survey {
  long evaluations = 0;
  long escapes = 0;
  int bounded_points = 0;
  std::vector<double> reached;  ///< by the worst evaluation of each point, as a share of its bound
  std::string first_escape;
};

/// Holds evaluations of one formula against its bounds, `tries` at each of `points`.
template <class Precision>
Survey survey(const Formula& f, int points, int tries) {
  Survey s;
  Points<Precision> source;
  Decisions::current().seed(1);
  for (int i = 0; i < points; ++i) {
    const Arguments<double> point = source.next();
    const auto bound = bounded_form<Precision>(f)(point.each([](double x) { return Bounded<Precision>(x); }));
    if (!bound.is_bounded()) continue;
    ++s.bounded_points;
    const auto arguments = point.each([](double x) { return Perturbed<Precision>::held(x); });
    const double worst = test::worst_of(
        tries, [&] { return perturbed_form<Precision>(f)(arguments); },
        [&](const Perturbed<Precision>& result) {
          ++s.evaluations;
          const double x = result.value();
          const bool inside = x >= bound.range().lower && x <= bound.range().upper && std::abs(x - bound.center()) <= bound.radius();
          if (!inside && s.escapes++ == 0) {
            s.first_escape = f.name + ": " + std::to_string(x - bound.center()) + " of " + std::to_string(bound.radius()) +
                             " at sheen_roughness " + std::to_string(point.sheen_roughness);
          }
          return std::abs(x - bound.center());
        });
    // Of exact arguments both descriptions of the bound are to be narrow.
    const double widest = std::max(bound.deviation(), bound.radius());
    if (widest > 0) s.reached.push_back(worst / widest);
  }
  return s;
}

TEST(BoundedFormulas, HoldEveryHighpEvaluationAndAreReachedByAQuarter) {
  long evaluations = 0;
  for (const Formula& f : formulas()) {
    Survey s = survey<Highp>(f, 300, 280);
    evaluations += s.evaluations;
    EXPECT_EQ(s.escapes, 0) << s.first_escape;
    EXPECT_GT(s.bounded_points, 270) << f.name << " is unbounded where it need not be";
    ASSERT_FALSE(s.reached.empty()) << f.name;
    const double reached = median(s.reached);
    EXPECT_GT(reached, 0.25) << f.name << " has too wide a bound";
    std::cout << f.name << ": the worst evaluation reaches " << reached << " of the bound\n";
  }
  EXPECT_GE(evaluations, 1000000);
}

TEST(BoundedFormulas, HoldEveryMediumpEvaluation) {
  for (const Formula& f : formulas()) {
    Survey s = survey<Mediump>(f, 400, 60);
    EXPECT_EQ(s.escapes, 0) << s.first_escape;
    EXPECT_GT(s.bounded_points, 150) << f.name << " is unbounded where it need not be";
    ASSERT_FALSE(s.reached.empty()) << f.name;
    EXPECT_GT(median(s.reached), 0.1) << f.name << " has too wide a bound";
  }
}

/// Arguments that move with the sample, each by its own share, all together by up to one step.
struct Motion {
  Arguments<double> x, y;

  Motion(const Arguments<double>& point, double size, Points<Highp>& random)
      : x(moved(point, size, random)), y(moved(point, size, random)) {}

  static Arguments<double> moved(const Arguments<double>& point, double size, Points<Highp>& random) {
    // Cosines and colours alike stay within their ranges: what is near 1 moves as little as what is near 0.
    return point.each([&](double value) { return size * (random.uniform() - 0.5) * std::min(value, std::abs(1 - value)); });
  }
};

TEST(BoundedFormulas, HoldWhatADisplacedSampleGives) {
  for (const Formula& f : formulas()) {
    Points<Highp> source;
    Decisions::current().seed(2);
    long escapes = 0;
    std::vector<double> reached;
    for (int i = 0; i < 300; ++i) {
      const Arguments<double> point = source.next();
      const Motion motion(point, std::pow(10, -1 - 4 * source.uniform()), source);
      // Each argument is rounded after it has moved.
      const auto radius = [](double x) { return ulp<Highp>(1.5 * x); };
      const auto arguments = joined(point, motion.x, motion.y, [&](double value, double x, double y) {
        return Bounded<Highp>::at_sample(value, x, y, 1, radius(value));
      });
      const Bounded<Highp> bound = f.highp(arguments);
      if (!bound.is_bounded()) continue;
      double worst = 0;
      for (int k = 0; k < 40; ++k) {
        const double u = k < 4 ? (k % 2 == 0 ? -1 : 1) : 2 * source.uniform() - 1;
        const double v = k < 4 ? (k < 2 ? -1 : 1) : 2 * source.uniform() - 1;
        Decisions::current().start_anew(0.5);
        const auto held = joined(point, motion.x, motion.y,
                                 [&](double value, double x, double y) { return Perturbed<Highp>::rounded(value + u * x + v * y); });
        const double x = f.highp_perturbed(held).value();
        const double moved = bound.center() + u * bound.shift_x() + v * bound.shift_y();
        const bool holds = std::abs(x - moved) <= bound.radius() && x >= bound.range().lower && x <= bound.range().upper;
        escapes += holds ? 0 : 1;
        worst = std::max(worst, std::abs(x - bound.center()));
      }
      reached.push_back(worst / bound.deviation());
    }
    EXPECT_EQ(escapes, 0) << f.name;
    ASSERT_GT(reached.size(), 200U) << f.name;
    EXPECT_GT(median(reached), 0.5) << f.name << ": the displacement is counted more than once";
    std::cout << f.name << ": a displaced sample reaches " << median(reached) << " of the bound\n";
  }
}

/// Median relative bound of D V N.L over directions, for exact inputs and exponents p ln sin^2 down to -80.
double median_relative_bound(double sheen_roughness, bool by_logarithm_alone) {
  using Real = Bounded<Highp>;
  Points<Highp> source;
  std::vector<double> relative;
  for (int i = 0; i < 2000; ++i) {
    Arguments<double> point = source.next();
    const double sin2 = std::exp(-160 * source.uniform() * sheen_roughness * sheen_roughness);
    point.sheen_roughness = static_cast<float>(sheen_roughness);
    point.sin2_theta_h = static_cast<float>(sin2);
    point.n_dot_h = static_cast<float>(std::sqrt(1 - sin2));
    const auto a = point.each([](double x) { return Real(x); });
    const brdf::SheenLobe<Real> lobe(Visibility::Charlie, a.sheen_roughness, a.n_dot_v);
    const Real p = Real(0.5) / (a.sheen_roughness * a.sheen_roughness);
    const Real d = by_logarithm_alone ? (Real(1) + p) * exp(p * log(a.sin2_theta_h)) * Real(1 / brdf::pi)
                                      : lobe.distribution(a.n_dot_h, a.sin2_theta_h);
    const Real value = d * lobe.visibility_times_n_dot_l(a.n_dot_l);
    relative.push_back(value.deviation() / value.center());
  }
  return median(relative);
}

TEST(BoundedFormulas, OfSheenAreFarBelowWhatItsExponentMagnifies) {
  // Largest or typical bounds of an interval evaluation by the same rules, made apart. At small roughness the logarithm's 2^-21 times
  // 1 / (2 r^2) leads, elsewhere the (3 + 2 |x|) ulp of the exponential.
  struct Figure {
    double sheen_roughness, expected;
  };
  for (const Figure& figure : {Figure{0.01, 2.3e-3}, Figure{0.03, 3.2e-4}, Figure{0.1, 9.2e-5}, Figure{0.5, 6.7e-5}}) {
    const double literal = median_relative_bound(figure.sheen_roughness, true);
    const double stable = median_relative_bound(figure.sheen_roughness, false);
    std::cout << "sheen_roughness " << figure.sheen_roughness << ": " << literal << " by log, " << stable << " by log1p\n";
    EXPECT_LT(literal, 1.1 * figure.expected) << "sheen_roughness " << figure.sheen_roughness;
    EXPECT_GT(literal, 0.6 * figure.expected) << "sheen_roughness " << figure.sheen_roughness;
    EXPECT_LE(stable, 1.01 * literal);
    EXPECT_LT(stable, 1e-4) << "log1p keeps the digits that the exponent magnifies";
  }
}

}  // namespace
}  // namespace sheen::number
