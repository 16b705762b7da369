#include "conformance/function_forms.h"

#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "brdf/base.h"
#include "number/perturbed_test.h"

namespace sheen::conformance::forms {
namespace {

using brdf::Visibility;
using number::Truth;
using number::test::Decisions;
using number::test::Perturbed;

/// A printed formula of three numbers in (0, 1): a roughness or alpha, and two cosines.
template <class Real>
using Printed = std::function<Real(const Real&, const Real&, const Real&)>;

struct Formula {
  std::string name;
  Printed<Bounded<Highp>> highp;
  Printed<Bounded<Mediump>> mediump;
  Printed<Perturbed<Highp>> highp_perturbed;
  Printed<Perturbed<Mediump>> mediump_perturbed;
};

template <class Function>
Formula formula(const char* name, Function f) {
  return {name, f, f, f, f};
}

std::vector<Formula> printed_formulas() {
  namespace printed = brdf::printed;
  return {
      formula("sheen D", [](const auto& r, const auto& h, const auto&) { return printed::sheen_distribution(r, h); }),
      formula("sheen V N.L",
              [](const auto& r, const auto& v, const auto& l) {
                const auto curve = brdf::charlie_lambda_curve(r * r);
                return printed::sheen_visibility(curve.lambda(v), curve.lambda(l), v, l) * l;
              }),
      formula("Ashikhmin V N.L", [](const auto&, const auto& v, const auto& l) { return printed::sheen_visibility_ashikhmin(l, v) * l; }),
      formula("GGX D", [](const auto& alpha, const auto& h, const auto&) { return printed::ggx_distribution(alpha, h); }),
      formula("Smith V N.L", [](const auto& alpha, const auto& v, const auto& l) { return printed::smith_visibility(alpha, l, v) * l; }),
      formula("Schlick's weight", [](const auto&, const auto& v, const auto&) { return printed::schlick_weight(v); }),
  };
}

/// Evaluations of one formula that err within the rules, held to its bounds.
template <class P, class Bound, class Evaluation>
void expect_held(const std::string& name, const Bound& bound_of, const Evaluation& evaluate, int least_bounded) {
  std::mt19937_64 random(7);
  const number::test::Grid grid{P::fraction_bits, P::min_exponent};
  const auto share = [&] { return grid.down(std::uniform_real_distribution<double>(0.02, 1)(random)); };
  Decisions::current().seed(1);
  int bounded = 0;
  std::vector<double> reached;
  for (int i = 0; i < 120; ++i) {
    const double a = share();
    const double b = share();
    const double c = share();
    const auto bound = bound_of(Bounded<P>(a), Bounded<P>(b), Bounded<P>(c));
    if (!bound.is_bounded()) {
      continue;
    }
    ++bounded;
    using X = Perturbed<P>;
    const double worst = number::test::worst_of(
        80, [&] { return evaluate(X::held(a), X::held(b), X::held(c)); },
        [&](const X& result) {
          EXPECT_GE(result.value(), bound.range().lower) << name << " " << a << " " << b << " " << c;
          EXPECT_LE(result.value(), bound.range().upper) << name << " " << a << " " << b << " " << c;
          return std::abs(result.value() - bound.center());
        });
    reached.push_back(bound.deviation() > 0 ? worst / bound.deviation() : 1);
  }
  EXPECT_GE(bounded, least_bounded) << name;
  std::sort(reached.begin(), reached.end());
  EXPECT_GT(reached.at(reached.size() / 2), 0.1) << name << " has too wide a bound";
}

TEST(FunctionForms, PrintedFormulasHoldEveryEvaluationWithinTheRules) {
  for (const Formula& f : printed_formulas()) {
    expect_held<Highp>(f.name, f.highp, f.highp_perturbed, 110);
    // In mediump an exponent of 1 / (2 r^2) overflows what exp2 promises, and small divisors promise nothing.
    expect_held<Mediump>(f.name, f.mediump, f.mediump_perturbed, 40);
  }
}

template <class Real>
Vec3<Real> vector(double x, double y, double z) {
  return {Real(x), Real(y), Real(z)};
}

using H = Bounded<Highp>;

TEST(FunctionForms, PowersOf0AndLogarithmsOf0AreWhatTheShadersGuardsMakeThem) {
  const Guarded<Highp> zero(0);
  const H power = pow(zero, Guarded<Highp>(0.19823));
  EXPECT_EQ(power.center(), 0);
  EXPECT_TRUE(power.is_exact());
  EXPECT_FALSE(pow(H(0), H(0.19823)).is_bounded()) << "without the guard the rules promise nothing";
  // A number that may be 0 or a little more has a power that may be 0 or up to that of the most it may be.
  const H about = pow(Guarded<Highp>(H::within(0, 0x1p-20)), Guarded<Highp>(0.5));
  ASSERT_TRUE(about.is_bounded());
  EXPECT_LE(about.range().lower, 0);
  EXPECT_NEAR(about.range().upper, 0x1p-10, 1e-6);
  EXPECT_NEAR(log(zero).center(), std::log(1e-30), 1e-6);
}

TEST(FunctionForms, LambdaIsPromisedAtBothEndsInTheStableFormAlone) {
  for (const double cosine : {0.0, 1.0}) {
    const H stable = sheen_lambda<Guarded<Highp>>(Visibility::Charlie, H(cosine), H(0.25));
    ASSERT_TRUE(stable.is_bounded());
    EXPECT_NEAR(stable.center(), brdf::charlie_lambda_curve(0.25).lambda(cosine), 1e-9 * stable.center());
    EXPECT_FALSE((sheen_lambda<H>(Visibility::Charlie, H(cosine), H(0.25)).is_bounded()));
  }
  const double beyond = 1 + 0x1p-23;
  const H held = sheen_lambda<Guarded<Highp>>(Visibility::Charlie, H(beyond), H(0.25));
  EXPECT_NEAR(held.center(), brdf::charlie_lambda_curve(0.25).lambda(1.0), 1e-6 * held.center());
}

TEST(FunctionForms, WhatTheGuardsOfDChangeIsNothing) {
  const auto n = vector<H>(0, 0, 1);
  for (const double r : {3.1e-5, 0.01, 0.5, 1.0}) {
    const H at_normal = sheen_distribution(n, n, H(static_cast<float>(r)));
    ASSERT_TRUE(at_normal.is_bounded()) << r;
    EXPECT_LT(at_normal.range().upper, 1e-15) << "the limit is 0, at sheen_roughness " << r;
    const auto h = vector<H>(0.6F, 0, 0.8F);
    const double sin2 = static_cast<double>(0.6F) * 0.6F;
    const double exact = brdf::charlie_distribution<double>(static_cast<float>(r) * static_cast<double>(static_cast<float>(r)), 0.8F, sin2);
    EXPECT_NEAR(sheen_distribution(n, h, H(static_cast<float>(r))).center(), exact, 1e-12 * exact + 1e-29) << r;
  }
}

TEST(FunctionForms, SheenBelowTheSmallestRoughnessIs0ButAtTheHorizon) {
  const auto n = vector<H>(0, 0, 1);
  const auto of = [&](const Vec3<H>& h, float r) { return sheen(Visibility::Charlie, n, h, H(0.5), H(0.5), H(r)); };
  EXPECT_TRUE(of(vector<H>(0.6F, 0, 0.8F), 0).is_exact());
  EXPECT_EQ(of(vector<H>(0.6F, 0, 0.8F), 1e-7F).center(), 0);
  EXPECT_FALSE(of(vector<H>(1, 0, 0), 0).is_bounded());
  EXPECT_FALSE(of(vector<H>(1, 0, 1e-5F), 2e-5F).is_bounded());
  EXPECT_TRUE(of(vector<H>(1, 0, 1e-2F), 4e-5F).is_bounded());
}

TEST(FunctionForms, BaseIsThatOfAppendixB) {
  const auto n = vector<H>(0, 0, 1);
  const auto h = vector<H>(0.28F, 0, 0.96F);
  const auto v = vector<H>(0.6F, 0, 0.8F);
  const auto form = base(n, v, h, H(0.75), H(0.5), vector<H>(0.25, 0.5, 0), H(0.375), H(0.125));
  const double n_dot_h = 0.96F;
  const double sin2 = static_cast<double>(0.28F) * 0.28F;
  const double v_dot_h = static_cast<double>(0.6F) * 0.28F + static_cast<double>(0.8F) * 0.96F;
  const brdf::Base<double> material{{0.25, 0.5, 0}, 0.375, 0.125, {0.04, 0.04, 0.04}, 1};
  const auto exact = brdf::base_brdf(material, 0.75, 0.5, n_dot_h, sin2, v_dot_h) * 0.75;
  EXPECT_NEAR(form.r.center(), exact.r, 1e-12);
  EXPECT_NEAR(form.g.center(), exact.g, 1e-12);
  EXPECT_NEAR(form.b.center(), exact.b, 1e-12);
  // X(N.H): a half vector behind the surface has no lobe.
  const auto behind = base(n, v, vector<H>(0.6F, 0, -0.8F), H(0.75), H(0.5), vector<H>(0, 0, 0), H(1), H(0.125));
  EXPECT_EQ(behind.r.center(), 0);
}

TEST(FunctionForms, MixIsEitherOfItsTwoForms) {
  const H x(-1);
  const H y(0x1p-30F * 1.25F);
  const H kept = mix(x, y, H(1));
  EXPECT_LE(kept.range().lower, y.center());
  EXPECT_GE(kept.range().upper, y.center());
  // x + (y - x) a loses of y what does not fit beside x.
  EXPECT_GE(kept.range().upper - kept.range().lower, 0x1p-24);
  EXPECT_LT(kept.deviation(), 0x1p-20);
  const auto printed = lambda_curve<H>(Visibility::Charlie, H(0.25));
  const auto stable = lambda_curve<Guarded<Highp>>(Visibility::Charlie, H(0.25));
  EXPECT_NEAR(printed.a.center(), stable.a.center(), 1e-14);
  EXPECT_GE(printed.c.deviation(), stable.c.deviation());
}

}  // namespace
}  // namespace sheen::conformance::forms
