// What our shaders may be off by where they integrate an environment from drawn directions.
#include "golden/drawn_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "albedo/interpolant.h"
#include "golden/bounded_albedo.h"
#include "golden/ggx_range.h"
#include "golden/perturbed_shading_test.h"
#include "golden/sheen_range.h"
#include "golden/test_scenes.h"
#include "number/bounded_functions.h"

namespace sheen::golden {
namespace {

using Shader = number::test::Perturbed<number::Highp>;

/// Numbers that floats hold, so that a shader holds the same.
Surface<double> in_floats(const Surface<double>& surface) {
  constexpr std::size_t numbers = sizeof(Surface<double>) / sizeof(double);
  std::array<double, numbers> each;
  std::memcpy(each.data(), &surface, sizeof(surface));
  std::transform(each.begin(), each.end(), each.begin(), [](double x) { return static_cast<double>(static_cast<float>(x)); });
  Surface<double> out;
  std::memcpy(&out, each.data(), sizeof(out));
  return out;
}

Surface<double> lacquered_cloth(double cosine, double alpha, double sheen_roughness) {
  Surface<double> s{};
  s.view = {0, 0, 1};
  s.normal = {std::sqrt(1 - cosine * cosine), 0, cosine};
  s.coat_normal = {0.1 * std::sqrt(1 - cosine * cosine), std::sqrt(0.99 * (1 - cosine * cosine)), cosine};
  s.base = {{0.4, 0.3, 0.2}, 0.5, alpha, {0.04, 0.04, 0.04}, 1.0};
  s.sheen_color = {0.8, 0.6, 0.7};
  s.sheen_roughness = sheen_roughness;
  s.clearcoat = 1;
  s.coat_alpha = 0.05;
  s.occlusion = 1;
  return in_floats(s);
}

struct Random {
  std::mt19937_64 source{11};

  double number() { return std::uniform_real_distribution<double>(0.0, 1.0)(source); }
  float inside() { return std::clamp(static_cast<float>(number()), 0x1p-32F, 1.0F - 0x1p-24F); }
};

TEST(DrawnLight, DirectionsFallAsDenselyAsTheyAreToldTo) {
  // Divided by the density, everything counts alike: 1 gives the sphere, the direction nothing, its first squares a third.
  const Layers layers{true, true, false};
  for (const double cosine : {0.15, 0.7}) {
    const Surface<double> s = lacquered_cloth(cosine, 0.1, 0.5);
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

TEST(DrawnLight, WaysDrawAsTheMaterialAsks) {
  Surface<double> s = lacquered_cloth(0.8, 0.0, 0.0);
  const auto counts = [&s](Layers layers, bool image) { return drawn_counts(s, layers, image, 1000); };
  WayCounts plain = counts({}, false);
  EXPECT_EQ(plain[index_of(Way::Ggx)], 0) << "no drawn direction meets a mirror";
  EXPECT_GT(plain[index_of(Way::Cosine)], 900);
  EXPECT_EQ(counts({true, false, false}, false)[index_of(Way::Sheen)], 0) << "there is no sheen at roughness 0";
  s = lacquered_cloth(0.8, 0.3, 0.4);
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

TEST(DrawnLight, ADisplacedDirectionIsEveryOneThatMayBeDrawn) {
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

TEST(DrawnLight, HoldsWhatAShaderMakesOfADirection) {
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
        const Surface<double> s = lacquered_cloth(cosine, alpha, 0.25 + alpha);
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

TEST(DrawnLight, AnglesAreThoseOfAnArcTangent) {
  EXPECT_EQ(angle_of(0.0, 0.0), 0);
  double worst = 0;
  for (int i = -20000; i <= 20000; ++i) {
    const double angle = brdf::pi * i / 20000.5;
    worst = std::max(worst, std::abs(angle_of(std::sin(angle), std::cos(angle)) - angle));
  }
  EXPECT_LT(worst, angle_error);
  EXPECT_GT(worst, 0.5 * angle_error);
}

scene::Environment lamps() {
  scene::Environment sky;
  sky.width = 16;
  sky.height = 8;
  std::mt19937 random(5);
  for (int i = 0; i < sky.width * sky.height; ++i) {
    sky.texels.emplace_back(std::uniform_real_distribution<float>(0.1F, 1.0F)(random) * (i % 17 == 0 ? 50.0F : 1.0F));
  }
  sky.rotation = 0.7;
  return sky;
}

TEST(DrawnLight, AnImageIsDrawnAsDenselyAsItIsToldAndSeenAsItIs) {
  const scene::Environment sky = lamps();
  const glm::dmat3 view_from_world(glm::rotate(glm::dmat4(1.0), 0.4, glm::normalize(glm::dvec3(1.0, 2.0, 3.0))));
  const DrawnImage image(sky, view_from_world);
  Random random;
  double sphere = 0;
  std::vector<double> off;
  constexpr int count = 40000;
  for (int i = 0; i < count; ++i) {
    const DrawnImage::Drawn drawn = image.draw(random.number(), random.number());
    sphere += 1 / drawn.density.center() / count;
    if (i % 20 != 0) {
      continue;
    }
    // Any other way finds the same density, and a direction that is a little off the same light but for its slope.
    const DrawnImage::Seen there = image.look_up(displaced(drawn.direction));
    EXPECT_NEAR(there.density.center(), drawn.density.center(), there.density.deviation() + drawn.density.deviation());
    const glm::dvec3 in_view(drawn.direction.x.center(), drawn.direction.y.center(), drawn.direction.z.center());
    const glm::dvec3 aside =
        glm::normalize(in_view + 2e-7 * glm::dvec3(random.number() - 0.5, random.number() - 0.5, random.number() - 0.5));
    const double radiance = sky.radiance(glm::transpose(view_from_world) * aside).x;
    EXPECT_NEAR(there.radiance.r.center(), radiance, there.radiance.r.deviation());
    off.push_back(there.radiance.r.deviation() / std::max(radiance, 1.0));
  }
  std::sort(off.begin(), off.end());
  EXPECT_LT(off[off.size() / 2], 1e-4);
  EXPECT_LT(off.back(), 0.1) << "near a pole";
  EXPECT_NEAR(sphere, 4 * brdf::pi, 0.1);
}

TEST(DrawnLight, ABoundGrowsByALittleAndOnlyWhereDirectionsAreDrawn) {
  scene::Environment white;
  white.uniform = glm::dvec3(1.0);
  const scene::Environment sky = lamps();
  scene::Scene s = test::scene_with(test::sphere(24, 12), test::cloth(0.4), test::orthographic_at(5.0, 1.1), {});
  golden::Settings settings = test::settings_for(12, 12, true);
  settings.sampling.error = 0.05;
  for (const scene::Environment* environment : {&std::as_const(white), &sky}) {
    settings.environment = environment;
    settings.drawn_directions = 0;
    const image::Image without = render(s, settings);
    settings.drawn_directions = 256;
    const image::Image with = render(s, settings);
    const int bound = with.channel("bound.R");
    std::vector<double> grown;
    for (int y = 0; y < 12; ++y) {
      for (int x = 0; x < 12; ++x) {
        EXPECT_EQ(with.at(x, y, 0), without.at(x, y, 0)) << "the golden is the same";
        if (with.at(x, y, 3) > 0 && with.at(x, y, with.channel("excluded")) == 0) {
          grown.push_back((with.at(x, y, bound) - without.at(x, y, bound)) / with.at(x, y, 0));
          EXPECT_GT(grown.back(), 256 * 0x1p-24) << "additions alone round as much";
        }
      }
    }
    ASSERT_GT(grown.size(), 60U);
    std::sort(grown.begin(), grown.end());
    EXPECT_LT(grown[grown.size() / 2], 1e-3);
    EXPECT_LT(grown[grown.size() * 9 / 10], 1e-2);
  }
}

class Open {
 public:
  Open() { white_.uniform = glm::dvec3(1.0); }

  template <class Lobe = Bound>
  double of(const Surface<double>& s, Layers layers, albedo::AlbedoScaling scaling = albedo::AlbedoScaling::Full, int drawn = 256) const {
    Lighting lighting;
    lighting.albedo.interpolant = &interpolant_;
    lighting.sheen.scaling = scaling;
    const DrawnImage image(white_, glm::dmat3(1.0));
    return DrawnLight::open<Lobe>(spread<Bound>(s), layers, lighting, image, drawn_counts(s, layers, false, 64), drawn, 5).off.x;
  }

 private:
  scene::Environment white_;
  albedo::Interpolant interpolant_{albedo::Visibility::Charlie};
};

TEST(DrawnLight, HoldsWhatReadingEOnceMisses) {
  const Open open;
  const Layers cloth{true, false, false};
  Surface<double> s = lacquered_cloth(1.2e-3, 0.05, 0.8);
  s.base.metallic = 1;
  const double both = open.of(s, cloth);
  EXPECT_GT(both, 3e-3) << "seen so flat E(N.V) is below E of most lights";
  EXPECT_LT(open.of(s, cloth, albedo::AlbedoScaling::View), 0.3 * both) << "one look-up is all there is";
  s = lacquered_cloth(0.2, 0.05, 0.8);
  s.base.metallic = 1;
  EXPECT_LT(open.of(s, cloth), 1e-3);
}

TEST(DrawnLight, EachDirectionThatIsAddedRoundsTheSum) {
  const Open open;
  Surface<double> white = lacquered_cloth(0.8, 0.5, 0.3);
  white.base = {{1, 1, 1}, 0, 0.5, {0.04, 0.04, 0.04}, 0};
  const auto of = [&](int drawn) { return open.of(white, {}, albedo::AlbedoScaling::Full, drawn); };
  // A white Lambertian shows 1, as 64 directions have it to some hundredths.
  EXPECT_NEAR(of(4096 + 1000) - of(4096), 1000 * epsilon, 0.1 * 1000 * epsilon);
}

TEST(DrawnLight, OneDirectionBringsItsShareAndTowardALampAllOfIt) {
  // Of a white Lambertian under white light each of n directions brings near 1 / n.
  scene::Environment sky;
  sky.uniform = glm::dvec3(1.0);
  Surface<double> white = lacquered_cloth(0.8, 0.5, 0.3);
  white.base = {{1, 1, 1}, 0, 0.5, {0.04, 0.04, 0.04}, 0};
  const Lighting lighting{};
  const auto largest = [&](bool has_image, int drawn) {
    const DrawnImage image(sky, glm::dmat3(1.0));
    return DrawnLight::open<Bound>(spread<Bound>(white), {}, lighting, image, drawn_counts(white, {}, has_image, 64), drawn, 5).largest.x;
  };
  EXPECT_GT(largest(false, 256), 1.0 / 256);
  EXPECT_LT(largest(false, 256), 1.5 / 256);
  EXPECT_NEAR(largest(false, 1024), 0.25 * largest(false, 256), 1e-12);
  // A lamp before the surface, and one of a hundred times its light behind: next to no direction meets the one that is all there is.
  sky.width = 64;
  sky.height = 32;
  sky.texels.assign(64 * 32, glm::vec3(0.0F));
  const auto at = [&sky](const glm::dvec3& d) -> glm::vec3& {
    const glm::dvec2 uv = sky.coordinates(glm::normalize(d));
    return sky.texels[static_cast<std::size_t>(uv.y * 32) * 64 + static_cast<std::size_t>(uv.x * 64)];
  };
  at({0.3, 0.3, 1.0}) = glm::vec3(1.0F);
  at({0.3, 0.3, -1.0}) = glm::vec3(100.0F);
  const double cosine = dot(white.normal, Vec3<double>{0.276, 0.276, 0.92});
  const double shown = cosine / brdf::pi * 2 * brdf::pi * brdf::pi / (64 * 32) * 0.96;  // of one texel's solid angle
  EXPECT_GT(largest(true, 256), 0.3 * shown) << "a hundredth of half of 256 directions";
  EXPECT_LT(largest(true, 256), 3 * shown);
}

TEST(DrawnLight, OcclusionDimsWhatItIsOffByToo) {
  const Open open;
  Surface<double> s = lacquered_cloth(0.8, 0.3, 0.4);
  const double whole = open.of(s, {true, true, false});
  s.occlusion = 0.25;
  EXPECT_NEAR(open.of(s, {true, true, false}), 0.25 * whole, 1e-6 * whole);
}

TEST(DrawnLight, LobesOfMediumpAreOffByMore) {
  const Open open;
  const Surface<double> s = lacquered_cloth(0.8, 0.3, 0.4);
  EXPECT_GT(open.of<number::Bounded<number::Mediump>>(s, {true, true, false}), 30 * open.of(s, {true, true, false}));
}

TEST(DrawnLight, TheEnvironmentItselfIsLookedUpWithAnError) {
  scene::Environment sky = lamps();
  sky.background = true;
  const scene::Scene s = test::scene_with(test::square(0.3), test::cloth(0.4), test::orthographic_at(5.0, 1.0), {});
  golden::Settings settings = test::settings_for(4, 4, true);
  settings.environment = &sky;
  settings.sampling.error = 0.05;
  const image::Image without = render(s, settings);
  settings.drawn_directions = 256;
  const image::Image with = render(s, settings);
  const int bound = with.channel("bound.G");
  EXPECT_LT(without.at(0, 0, bound), 1e-6F * without.at(0, 0, 1)) << "one direction of all rays";
  EXPECT_GT(with.at(0, 0, bound), 1e-6F * without.at(0, 0, 1));
  EXPECT_LT(with.at(0, 0, bound), 1e-3F * without.at(0, 0, 1));
}

TEST(DrawnLight, OfAMirrorIsWhatItsLookupRounds) {
  const scene::Environment sky = lamps();
  const DrawnImage image(sky, glm::dmat3(1.0));
  Surface<double> s = lacquered_cloth(0.8, 0.0, 0.3);
  s.base.metallic = 1;
  s.base.color = {1, 1, 1};
  const Lighting lighting{};
  const WayCounts counts = drawn_counts(s, {}, true, 64);
  const glm::dvec3 off = DrawnLight::open<Bound>(spread<Bound>(s), {}, lighting, image, counts, 256, 1).off;
  const Vec3<double> mirrored = s.normal * (2 * dot(s.normal, s.view)) - s.view;
  const double shown = sky.radiance({mirrored.x, mirrored.y, mirrored.z}).x;
  EXPECT_GT(off.x, 2e-6 * shown);
  EXPECT_LT(off.x, 2e-4 * shown);
}

}  // namespace
}  // namespace sheen::golden
