#include "golden/uniform_light.h"

#include <array>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "albedo/directional_albedo.h"
#include "albedo/ggx_albedo.h"
#include "brdf/base.h"

namespace sheen::golden {
namespace {

using Color = brdf::Rgb<double>;

/// The hemisphere of N = +Z summed by the midpoint rule over cosine and azimuth, with the formulas as they stand in brdf/.
BaseIntegrals summed_directly(double alpha, double n_dot_v, double (*scale)(double)) {
  const int rows = 3000;
  const int columns = 300;
  const glm::dvec3 v(std::sqrt(1.0 - n_dot_v * n_dot_v), 0.0, n_dot_v);
  BaseIntegrals sum;
  for (int i = 0; i < rows; ++i) {
    // Nodes gather at N.L = 0 and 1: lambda = 3 t^2 - 2 t^3.
    const double t = (i + 0.5) / rows;
    const double lambda = t * t * (3.0 - 2.0 * t);
    const double sine = std::sqrt((1.0 - lambda) * (1.0 + lambda));
    const double weight = 6.0 * t * (1.0 - t) / rows * 2.0 * brdf::pi / columns * scale(lambda) * lambda;
    for (int j = 0; j < columns; ++j) {
      const double phi = brdf::pi * (j + 0.5) / columns;
      const glm::dvec3 h = glm::normalize(glm::dvec3(sine * std::cos(phi), sine * std::sin(phi), lambda) + v);
      const double lobe = brdf::ggx_distribution(alpha, h.z, h.x * h.x + h.y * h.y) * brdf::smith_visibility(alpha, lambda, n_dot_v);
      const double w = brdf::schlick_weight(glm::dot(v, h));
      sum.diffuse += weight / brdf::pi;
      sum.diffuse_w += weight * w / brdf::pi;
      sum.specular += weight * lobe;
      sum.specular_w += weight * lobe * w;
    }
  }
  return sum;
}

TEST(BaseIntegrals, MeetTheHemisphereSummedDirectly) {
  const auto s = [](double n_dot_l) { return 0.3 + 0.5 * n_dot_l; };
  for (const double alpha : {1.0, 0.4, 0.15}) {
    for (const double mu : {1.0, 0.6, 0.15}) {
      const BaseIntegrals ours = base_integrals(alpha, mu, s);
      const BaseIntegrals direct = summed_directly(alpha, mu, s);
      EXPECT_NEAR(ours.diffuse, direct.diffuse, 1e-6) << "alpha " << alpha << " n_dot_v " << mu;
      EXPECT_NEAR(ours.diffuse_w, direct.diffuse_w, 1e-6) << "alpha " << alpha << " n_dot_v " << mu;
      EXPECT_NEAR(ours.specular, direct.specular, 1e-6) << "alpha " << alpha << " n_dot_v " << mu;
      EXPECT_NEAR(ours.specular_w, direct.specular_w, 1e-6) << "alpha " << alpha << " n_dot_v " << mu;
    }
  }
}

TEST(BaseIntegrals, KnowClosedForms) {
  const auto one = [](double) { return 1.0; };
  // w/pi over the hemisphere seen from above: V.H = cos(theta/2).
  double expected = 0.0;
  const int n = 200000;
  for (int i = 0; i < n; ++i) {
    const double l = (i + 0.5) / n;
    expected += 2.0 * l * std::pow(1.0 - std::sqrt(0.5 * (1.0 + l)), 5.0) / n;
  }
  EXPECT_NEAR(base_integrals(0.3, 1.0, one).diffuse_w, expected, 1e-10);
  // A mirror gives back what it sees, and a narrow lobe nearly so.
  EXPECT_EQ(base_integrals(0.0, 0.6, one).specular, 1.0);
  EXPECT_NEAR(base_integrals(1e-4, 0.6, one).specular, 1.0, 1e-6);
  EXPECT_NEAR(base_integrals(1e-4, 0.6, one).specular_w, std::pow(0.4, 5.0), 1e-6);
  // Of a smooth lobe seen from above next to nothing is lost, however long its tail.
  for (const double alpha : {1e-5, 1e-4, 3e-4}) {
    EXPECT_NEAR(base_integrals(alpha, 1.0, one).specular, 1.0, 1e-6) << alpha;
  }
  // Single scattering loses energy but makes none.
  for (const double mu : {1e-4, 1e-3, 0.01, 0.1, 0.5, 1.0}) {
    for (const double alpha : {1e-6, 1e-3, 0.03, 0.3, 1.0}) {
      EXPECT_LE(base_integrals(alpha, mu, one).specular, 1.0 + 1e-7) << alpha << ' ' << mu;
    }
  }
}

// Up to mirror_alpha nothing of the lobe is left to integrate, and all of it at the mirrored view.
TEST(BaseIntegrals, OfTheSmoothestAreAMirrors) {
  const auto s = [](double n_dot_l) { return 0.3 + 0.5 * n_dot_l; };
  for (const double mu : {1.0, 0.6, 0.02}) {
    const BaseIntegrals mirror = base_integrals(0, mu, s);
    EXPECT_EQ(mirror.specular, s(mu));
    for (const double alpha : {1e-76, 1e-40, 1e-14, brdf::mirror_alpha}) {
      const BaseIntegrals ours = base_integrals(alpha, mu, s);
      EXPECT_EQ(ours.specular, mirror.specular) << alpha;
      EXPECT_EQ(ours.specular_w, mirror.specular_w) << alpha;
      EXPECT_NEAR(ours.diffuse_w, mirror.diffuse_w, 1e-9) << alpha;
    }
  }
}

// Along the normal a lobe is as narrow in N.L as alpha^2: less than tells numbers near 1 apart.
TEST(BaseIntegrals, MeetTheNarrowestLobesAtEveryAngle) {
  const auto one = [](double) { return 1.0; };
  for (const double alpha : {1.01 * brdf::mirror_alpha, 3e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2}) {
    for (const double mu : {1.0, 1 - 1e-15, 1 - 1e-12, 1 - 1e-9, 1 - 1e-6, 0.999, 0.6, 0.1, 0.01, 1e-4}) {
      EXPECT_NEAR(base_integrals(alpha, mu, one).specular, 1 - albedo::ggx_loss(mu, alpha), 1e-9) << alpha << ' ' << 1 - mu;
    }
  }
}

TEST(BaseIntegrals, HaveConverged) {
  // Energy leaves a lobe of roughness 1 (alpha = 1) by D = 1/pi: integral of Vis N.L 2 dlambda, with Vis = 1 / (2 (N.L + N.V)).
  for (const double mu : {1.0, 0.3, 0.01}) {
    const double exact = 1.0 - mu * std::log((1.0 + mu) / mu);
    EXPECT_NEAR(base_integrals(1.0, mu, [](double) { return 1.0; }).specular, exact, 1e-9) << mu;
  }
}

// What a bound asks of Fast: differences of neighbours, in roughness and in angle, as Full has them.
TEST(BaseIntegrals, FewNodesTellDifferences) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const albedo::Interpolant interpolant(albedo::Visibility::Charlie);
  for (int i = 0; i < 200; ++i) {
    const double alpha = std::pow(10.0, -3.0 * unit(random));
    const double mu = unit(random) < 0.5 ? unit(random) : std::pow(10.0, -3.0 * unit(random));
    const albedo::Curve e = interpolant.at_roughness(0.3 + 0.7 * unit(random));
    const double c = 0.5 * unit(random);
    const auto four = [&](double a, double m, albedo::Effort effort) {
      const auto s = [&](double n_dot_l) { return 1.0 - c * std::max(e(m), e(n_dot_l)); };
      const BaseIntegrals in = base_integrals(a, m, s, {0.5}, effort);
      return std::array{in.diffuse, in.diffuse_w, in.specular, in.specular_w};
    };
    const double step = 0.01 * unit(random);
    const auto exact = four(alpha, mu, albedo::Effort::Full);
    const auto rough = four(alpha, mu, albedo::Effort::Fast);
    const std::pair<double, double> neighbours[] = {{alpha * (1.0 - step), mu}, {alpha, mu * (1.0 - step)}};
    for (std::size_t k = 0; k < exact.size(); ++k) {
      EXPECT_NEAR(rough[k], exact[k], 2e-4) << "integral " << k << " alpha " << alpha << " n_dot_v " << mu;
    }
    for (const auto& [a, m] : neighbours) {
      const auto exact_there = four(a, m, albedo::Effort::Full);
      const auto rough_there = four(a, m, albedo::Effort::Fast);
      for (std::size_t k = 0; k < exact.size(); ++k) {
        EXPECT_NEAR(rough_there[k] - rough[k], exact_there[k] - exact[k], 3e-3 * step)
            << "integral " << k << " alpha " << alpha << " n_dot_v " << mu << " step " << step;
      }
    }
  }
}

Surface<double> white_lambert(double n_dot_v) {
  Surface<double> s{};
  s.normal = s.coat_normal = {0.0, 0.0, 1.0};
  s.view = {std::sqrt(1.0 - n_dot_v * n_dot_v), 0.0, n_dot_v};
  s.base.color = {1.0, 1.0, 1.0};
  s.base.alpha = 0.25;
  s.base.dielectric_f0 = {0.04, 0.04, 0.04};
  s.occlusion = 1.0;
  return s;
}

TEST(UniformLight, WhiteSheenOverWhiteLambertGivesTheLawOfItsScaling) {
  for (const albedo::Visibility visibility : {albedo::Visibility::Charlie, albedo::Visibility::Ashikhmin, albedo::Visibility::Refined}) {
    const albedo::Interpolant interpolant(visibility);
    for (const double r : {0.05, 0.2, 0.5, 1.0}) {
      for (const double mu : {1e-3, 0.02, 0.3, 0.5, 0.9, 1.0}) {
        Surface<double> surface = white_lambert(mu);
        surface.sheen_color = {1.0, 1.0, 1.0};
        surface.sheen_roughness = r;
        const double e = albedo::directional_albedo(visibility, mu, r);
        const auto furnace = [&](brdf::AlbedoScaling scaling) {
          Lighting lighting;
          lighting.sheen = {visibility, scaling};
          lighting.albedo.interpolant = &interpolant;
          return UniformLight(lighting, {1.0, 1.0, 1.0}).shade(surface, {true, false}).g;
        };
        const double tolerance = 1e-6 * std::max(1.0, e);
        EXPECT_NEAR(furnace(brdf::AlbedoScaling::View), std::max(1.0, e), tolerance) << r << ' ' << mu;
        EXPECT_NEAR(furnace(brdf::AlbedoScaling::None), 1.0 + e, tolerance);
        const double full = furnace(brdf::AlbedoScaling::Full);
        EXPECT_LE(full, std::max(1.0, e) + tolerance);
        // The scale is the smaller of two: 1 - E(N.V) and, summed over L, what remains below it.
        double expected = e;
        const int n = 4000;
        for (int i = 0; i < n; ++i) {
          const double t = (i + 0.5) / n;
          const double l = t * t;  // nodes gather at grazing, where E rises
          expected += 2.0 * l * std::clamp(1.0 - std::max(e, interpolant(l, r)), 0.0, 1.0) * 2.0 * t / n;
        }
        EXPECT_NEAR(full, expected, 2e-5 * std::max(1.0, e)) << r << ' ' << mu;
      }
    }
  }
}

// Each of the numbers that integrals depend on, changed alone; and all once more.
TEST(UniformLight, KeptIntegralsAreThoseOfTheSurface) {
  const albedo::Interpolant interpolant(albedo::Visibility::Charlie);
  Lighting lighting;
  lighting.sheen = {albedo::Visibility::Charlie, brdf::AlbedoScaling::Full};
  lighting.albedo.interpolant = &interpolant;
  std::vector<Surface<double>> surfaces;
  for (std::size_t changed = 0; changed < 7; ++changed) {
    const auto one_of = [&](std::size_t k, double usual, double other) { return k == changed ? other : usual; };
    Surface<double> s = white_lambert(one_of(0, 0.4, 0.41));
    s.base.alpha = one_of(1, 0.3, 0.31);
    s.base.color.g = one_of(2, 0.5, 0.6);
    s.base.specular = 1.0;
    s.sheen_color = {one_of(3, 0.7, 0.71), 0.2, 0.2};
    s.sheen_roughness = one_of(4, 0.5, 0.51);
    s.clearcoat = 1.0;
    s.coat_alpha = one_of(5, 0.2, 0.21);
    if (changed == 6) {
      s.coat_normal = {0.0, 0.6, 0.8};
    }
    surfaces.push_back(s);
  }
  UniformLight kept(lighting, {1.0, 2.0, 3.0});
  for (int turn = 0; turn < 2; ++turn) {
    for (const Layers layers : {Layers{true, true}, Layers{false, true}, Layers{true, false}, Layers{false, false}}) {
      for (const albedo::Effort effort : {albedo::Effort::Fast, albedo::Effort::Full}) {
        for (const Surface<double>& s : surfaces) {
          const Color found = kept.shade(s, layers, effort);
          const Color alone = UniformLight(lighting, {1.0, 2.0, 3.0}).shade(s, layers, effort);
          EXPECT_EQ(found.r, alone.r);
          EXPECT_EQ(found.g, alone.g);
          EXPECT_EQ(found.b, alone.b);
        }
      }
    }
  }
}

// Below the peak of E, at a cosine of some thousandths, E(min(N.V, N.L)) is less than the larger of both.
TEST(UniformLight, AtGrazingAnglesKnowsTheScaleAndWhatASingleLookupMisses) {
  const albedo::Interpolant interpolant(albedo::Visibility::Charlie);
  const double r = 0.8;
  const double c = 0.9;
  Surface<double> surface = white_lambert(1.2e-3);
  surface.base.alpha = 0.05;
  surface.base.metallic = 1.0;
  surface.sheen_color = {c, c, c};
  surface.sheen_roughness = r;
  Lighting lighting;
  lighting.sheen = {albedo::Visibility::Charlie, brdf::AlbedoScaling::Full};
  lighting.albedo.interpolant = &interpolant;
  std::vector<double> everywhere;
  for (double kink = 1e-4; kink < 0.3; kink *= 1.1) {
    everywhere.push_back(kink);
  }
  const auto furnace_of = [&](auto scale) { return base_integrals(surface.base.alpha, 1.2e-3, scale, everywhere).specular; };
  const double e_v = interpolant(1.2e-3, r);
  const double larger = furnace_of([&](double l) { return std::clamp(1.0 - c * std::max(e_v, interpolant(l, r)), 0.0, 1.0); });
  const double single = furnace_of([&](double l) { return std::clamp(1.0 - c * interpolant(std::min(l, 1.2e-3), r), 0.0, 1.0); });
  UniformLight light(lighting, {1.0, 1.0, 1.0});
  ASSERT_GT(single, larger * 1.001);
  const Color sheen = surface.sheen_color * e_v;
  EXPECT_NEAR(light.shade(surface, {true, false}).g, larger + sheen.g, 2e-6) << "E(N.L) falls back to E(N.V) at a cosine of its own";
  EXPECT_NEAR(light.lookup(surface, {true, false}).g, single - larger, 0.02 * (single - larger));
  const Surface<double> steep = [&] {
    Surface<double> s = surface;
    s.view = {0.8, 0.0, 0.6};
    return s;
  }();
  EXPECT_EQ(light.lookup(steep, {true, false}).g, 0.0) << "there E falls";
  EXPECT_EQ(light.lookup(surface, {false, false}).g, 0.0) << "without sheen nothing is looked up";
  surface.occlusion = 0.5;
  surface.clearcoat = 1.0;
  surface.coat_normal = {1.0, 0.0, 0.0};
  const double k = 0.04 + 0.96 * std::pow(1.0 - surface.view.x, 5.0);
  EXPECT_NEAR(light.lookup(surface, {true, true}).g, 0.5 * (1.0 - k) * (single - larger), 0.02 * (single - larger));
}

TEST(UniformLight, CoatLiesAboveAndOcclusionDimsAll) {
  Surface<double> surface = white_lambert(0.7);
  surface.clearcoat = 0.8;
  surface.coat_alpha = 0.0;
  surface.occlusion = 0.5;
  const double k = 0.8 * (0.04 + 0.96 * std::pow(0.3, 5.0));
  const Color radiance = UniformLight({}, {2.0, 4.0, 6.0}).shade(surface, {false, true});
  EXPECT_NEAR(radiance.r, 1.0 * ((1.0 - k) + k), 1e-9) << "a mirror coat over white Lambert loses nothing";
  EXPECT_NEAR(radiance.b, 3.0, 1e-9);
  surface.coat_alpha = 0.25;
  EXPECT_LT(UniformLight({}, {2.0, 4.0, 6.0}).shade(surface, {false, true}).r, 1.0);
}

}  // namespace
}  // namespace sheen::golden
