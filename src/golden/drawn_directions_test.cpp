// The directions that our shaders draw toward an environment: how densely they fall, and what a shader makes of each.
#include "golden/drawn_directions.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "albedo/interpolant.h"
#include "golden/bounded_albedo.h"
#include "golden/drawn_fixture_test.h"
#include "golden/ggx_range.h"
#include "golden/perturbed_shading_test.h"
#include "golden/sheen_range.h"
#include "number/bounded_functions.h"

namespace sheen::golden {
namespace {

using test::Random;

using Shader = number::test::Perturbed<number::Highp>;

TEST(DrawnDirections, DirectionsFallAsDenselyAsTheyAreToldTo) {
  // Divided by the density, everything counts alike: 1 gives the sphere, the direction nothing, its first squares a third.
  const Layers layers{true, true, false};
  for (const double cosine : {0.15, 0.7}) {
    const Surface<double> s = test::lacquered_cloth(cosine, 0.1, 0.5);
    WayCounts counts = drawn_counts(s, layers, false, 200);
    EXPECT_EQ(counts[index_of(Way::Image)], 0);
    for (int& count : counts) {
      count *= 1500;
    }
    const DrawnDirections<double> directions(s, layers, counts);
    Random random;
    double sphere = 0;
    glm::dvec3 first(0.0), second(0.0);
    for (std::size_t way = 0; way < way_count; ++way) {
      for (int i = 0; i < counts[way]; ++i) {
        const double phi = 2 * brdf::pi * random.number();
        const Vec3<double> d = directions.draw(static_cast<Way>(way), {random.number(), std::cos(phi), std::sin(phi)});
        EXPECT_NEAR(dot(d, d), 1, 3e-7);
        const double weight = 1 / directions.density(d);
        const glm::dvec3 v(d.x, d.y, d.z);
        sphere += weight;
        first += weight * v;
        second += weight * v * v;
      }
    }
    // Where the sphere's way alone draws, each counts for a hundred others.
    EXPECT_NEAR(sphere, 4 * brdf::pi, 0.15);
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(first[k], 0, 0.1) << k;
      EXPECT_NEAR(second[k], 4 * brdf::pi / 3, 0.1) << k;
    }
  }
}

TEST(DrawnDirections, WaysDrawAsTheMaterialAsks) {
  Surface<double> s = test::lacquered_cloth(0.8, 0.0, 0.0);
  const auto counts = [&s](Layers layers, bool image) { return drawn_counts(s, layers, image, 1000); };
  WayCounts plain = counts({}, false);
  EXPECT_EQ(plain[index_of(Way::Ggx)], 0) << "no drawn direction meets a mirror";
  EXPECT_GT(plain[index_of(Way::Cosine)], 900);
  EXPECT_EQ(counts({true, false, false}, false)[index_of(Way::Sheen)], 0) << "there is no sheen at roughness 0";
  s = test::lacquered_cloth(0.8, 0.3, 0.4);
  plain = counts({true, true, false}, true);
  for (const int count : plain) {
    EXPECT_GT(count, 0);
  }
  EXPECT_NEAR(plain[index_of(Way::Image)], 500, 5) << "as many as all others";
}

/// f / p of one direction under light of 1, in any arithmetic.
template <class Real>
brdf::Rgb<Real> term(const Shading<Real, Real>& shading, Layers layers, const Vec3<Real>& direction, const Real& density) {
  const Real one(1), zero(0);
  brdf::Rgb<Real> lookup{zero, zero, zero};
  const LightPart<Real> part = shading.light({direction, {one, one, one}}, false, lookup);
  const brdf::Rgb<Real> f = with_light<Real>({zero, zero, zero}, layers, part.sheen, part.base, part.coat);
  return {f.r / density, f.g / density, f.b / density};
}

TEST(DrawnDirections, ADisplacedDirectionIsEveryOneThatMayBeDrawn) {
  Random random;
  for (int i = 0; i < 2000; ++i) {
    const glm::dvec3 d = glm::normalize(glm::dvec3(random.number() - 0.5, random.number() - 0.5, random.number() - 0.5));
    const double off = std::pow(10.0, -7.0 + 4.0 * random.number());
    const Vec3<Bound> moved = displaced({Bound::within(d.x, off), Bound::within(d.y, off), Bound::within(d.z, off)});
    const glm::dvec3 across(moved.x.shift_x(), moved.y.shift_x(), moved.z.shift_x());
    const glm::dvec3 along(moved.x.shift_y(), moved.y.shift_y(), moved.z.shift_y());
    // The farthest corner of the box, brought back to length 1 but for roundings.
    const glm::dvec3 corner(random.number() < 0.5 ? -off : off, random.number() < 0.5 ? -off : off, random.number() < 0.5 ? -off : off);
    const glm::dvec3 one = (d + corner - glm::dot(corner, d) * d) / std::sqrt(1 + glm::dot(corner, corner)) * (1 + 4 * epsilon);
    const glm::dvec3 by = one - d;
    const double u = glm::dot(by, across) / glm::dot(across, across);
    const double v = glm::dot(by, along) / glm::dot(along, along);
    EXPECT_LE(std::abs(u), 1);
    EXPECT_LE(std::abs(v), 1);
    const glm::dvec3 rest = by - u * across - v * along;
    EXPECT_LE(std::abs(rest.x), moved.x.radius());
    EXPECT_LE(std::abs(rest.y), moved.y.radius());
    EXPECT_LE(std::abs(rest.z), moved.z.radius());
  }
}

TEST(DrawnDirections, HoldsWhatAShaderMakesOfADirection) {
  const albedo::Interpolant interpolant(albedo::Visibility::Charlie);
  Lighting lighting;
  lighting.albedo.interpolant = &interpolant;
  number::test::Decisions::current().seed(4);
  Random random;
  long evaluations = 0;
  long escapes = 0;
  std::vector<double> relative;
  std::vector<double> reached;
  for (const Layers layers : {Layers{}, Layers{true, false, false}, Layers{true, true, false}}) {
    for (const double cosine : {0.02, 0.3, 0.9}) {
      for (const double alpha : {0.02, 0.3}) {
        const Surface<double> s = test::lacquered_cloth(cosine, alpha, 0.25 + alpha);
        const WayCounts counts = drawn_counts(s, layers, false, 60);
        const Surface<Bound> uncertain = spread<Bound>(s);
        const Surface<Shader> held = spread<Shader>(s);
        const DrawnDirections<Bound> bounds(uncertain, layers, counts);
        const Shading<Bound, Bound> bounded(uncertain, layers, lighting);
        for (std::size_t way = 0; way < index_of(Way::Image); ++way) {
          for (int i = 0; i < counts[way]; ++i) {
            const double x = random.inside();
            const double phi = 2 * brdf::pi * random.number();
            const double c = static_cast<float>(std::cos(phi));
            const double sine = static_cast<float>(std::sin(phi));
            const Vec3<Bound> direction = displaced(bounds.draw(static_cast<Way>(way), {Bound(x), Bound(c), Bound(sine)}));
            const Bound bound = term(bounded, layers, direction, bounds.density(direction)).r;
            ASSERT_TRUE(bound.is_bounded()) << way << " " << x << " at " << cosine << " " << alpha;
            if (bound.center() > 0) {
              relative.push_back(bound.deviation() / bound.center());
            }
            const auto drawn_light = [&] {
              const DrawnDirections<Shader> drawn(held, layers, counts);
              const Shading<Shader, Shader> shading(held, layers, lighting);
              const Vec3<Shader> there = drawn.draw(static_cast<Way>(way), {Shader(x), Shader(c), Shader(sine)});
              return term(shading, layers, there, drawn.density(there)).r.value();
            };
            const double worst = number::test::worst_of(i % 8 == 0 ? 600 : 30, drawn_light, [&](double value) {
              ++evaluations;
              escapes += std::abs(value - bound.center()) <= bound.deviation() ? 0 : 1;
              return std::abs(value - bound.center());
            });
            if (bound.deviation() > 0 && bound.center() > 0 && i % 8 == 0) {
              reached.push_back(worst / bound.deviation());
            }
          }
        }
      }
    }
  }
  EXPECT_EQ(escapes, 0) << "of " << evaluations;
  EXPECT_GT(evaluations, 30000);
  const auto median = [](std::vector<double>& values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
  };
  EXPECT_LT(median(relative), 2e-4) << "what f and p are off by together cancels";
  // Roundings of the half vector, which f and p share, count twice.
  EXPECT_GT(median(reached), 0.03) << "of the bound, by the worst that was found";
  std::cout << "relative bound " << median(relative) << ", the worst reaches " << median(reached) << " of it\n";
}

}  // namespace
}  // namespace sheen::golden
