// The golden against a second evaluation of the model in long double.

#include <cmath>
#include <optional>
#include <string>

#include <gtest/gtest.h>

#include "golden/long_double_model.h"
#include "golden/test_scenes.h"

namespace sheen::golden {
namespace {

using test::Point;

// The largest relative error over the pixels of a bent square: position and normal are known exactly in each.
double worst_error(const scene::Scene& s, const Settings& settings, double bend, double floor = 1e-4) {
  const image::Image im = render(s, settings);
  const scene::Camera& camera = s.cameras.front();
  double worst = 0.0;
  int compared = 0;
  for (int y = 0; y < im.height; ++y) {
    for (int x = 0; x < im.width; ++x) {
      const double ndc_x = 2.0 * (x + 0.5) / im.width - 1.0;
      const double ndc_y = 1.0 - 2.0 * (y + 0.5) / im.height;
      const double distance = camera.world_from_camera[3].z;
      const double reach = camera.perspective ? std::tan(0.5 * camera.yfov) * distance : camera.ymag;
      Point p;
      p.position = {ndc_x * reach * im.width / im.height, ndc_y * reach, 0.0L};
      p.v = camera.perspective ? test::unit(test::plus({0.0L, 0.0L, distance}, p.position, -1)) : test::Vector{0.0L, 0.0L, 1.0L};
      p.n = p.nc = test::unit({bend * p.position[0], bend * p.position[1], 1.0L});
      const test::Vector want = test::radiance(p, s.materials.front(), s.lights, settings.sheen);
      for (int c = 0; c < 3; ++c) {
        const auto expected = static_cast<double>(want[static_cast<std::size_t>(c)]);
        if (std::abs(expected) <= floor) {
          continue;
        }
        ++compared;
        worst = std::max(worst, std::abs(im.at(x, y, c) - expected) / std::abs(expected));
      }
    }
  }
  EXPECT_GT(compared, im.width * im.height) << "most of the picture must be lit for the figure to mean anything";
  return worst;
}

scene::Material velvet(double sheen_roughness) {
  scene::Material m;
  m.base_color_factor = {0.6, 0.3, 0.1, 1.0};
  m.metallic_factor = 0.0;
  m.roughness_factor = 0.7;
  m.sheen.color_factor = {0.9, 0.7, 0.4};
  m.sheen.roughness_factor = sheen_roughness;
  return m;
}

std::vector<scene::Light> three_lights() {
  scene::Light point;
  point.type = scene::LightType::Point;
  point.position = {1.0, 0.8, 1.5};
  point.intensity = 4.0;
  point.color = {1.0, 0.5, 0.25};
  point.range = 4.0;
  scene::Light spot = point;
  spot.type = scene::LightType::Spot;
  spot.position = {-1.0, 0.5, 2.0};
  spot.direction = glm::normalize(glm::dvec3(1.0, -0.5, -2.0));
  spot.inner_cone = 0.1;
  spot.outer_cone = 0.5;
  spot.range = std::numeric_limits<double>::infinity();
  return {test::directional({0.4, 0.3, 1.0}, {0.9, 1.0, 0.8}, 2.0), point, spot};
}

// Stored as float: half an ulp is 6e-8; E is known to 1e-6.
constexpr double tolerance = 3e-6;

TEST(Model, SheenOfEveryVisibilityAndScalingMeetsTheLongDoubleEvaluation) {
  for (const auto visibility : {albedo::Visibility::Charlie, albedo::Visibility::Ashikhmin, albedo::Visibility::Refined}) {
    for (const auto scaling :
         {albedo::AlbedoScaling::Full, albedo::AlbedoScaling::View, albedo::AlbedoScaling::None, albedo::AlbedoScaling::Literal}) {
      // The roughnesses matter to the lobe, the scalings to what lies below it: every pair would test no more.
      for (const double r : scaling == albedo::AlbedoScaling::Full ? std::vector<double>{0.07, 0.3, 0.5, 1.0} : std::vector<double>{0.5}) {
        const scene::Scene s = test::scene_with(test::square(2.0, 0.0, 1.0), velvet(r), test::camera_at(2.0, 1.2), three_lights());
        Settings settings = test::settings_for(10, 8);
        settings.sheen = {visibility, scaling};
        EXPECT_LT(worst_error(s, settings, 1.0), tolerance)
            << "visibility " << static_cast<int>(visibility) << " scaling " << static_cast<int>(scaling) << " sheenRoughness " << r;
      }
    }
  }
}

TEST(Model, BaseMixesTwoBrdfsByMetallic) {
  for (const double metallic : {0.0, 0.35, 1.0}) {
    for (const double roughness : {0.15, 0.5, 1.0}) {
      scene::Material m;
      m.base_color_factor = {0.8, 0.5, 0.2, 1.0};
      m.metallic_factor = metallic;
      m.roughness_factor = roughness;
      m.ior = 1.33;
      m.specular.factor = 0.8;
      m.specular.color_factor = {1.0, 0.6, 0.3};
      m.has_ior_or_specular = true;
      const scene::Scene s = test::scene_with(test::square(2.0, 0.0, 0.5), m, test::camera_at(2.0, 1.2), three_lights());
      EXPECT_LT(worst_error(s, test::settings_for(9, 9), 0.5), 2e-7) << "metallic " << metallic << " roughness " << roughness;
    }
  }
}

TEST(Model, ClearcoatLiesAboveSheenBaseAndEmission) {
  for (const double coat_roughness : {0.1, 0.6}) {
    scene::Material m = velvet(0.4);
    m.clearcoat.factor = 0.75;
    m.clearcoat.roughness_factor = coat_roughness;
    m.emissive_factor = {0.1, 0.5, 2.0};
    const scene::Scene s = test::scene_with(test::square(2.0, 0.0, 1.0), m, test::camera_at(2.0, 1.2), three_lights());
    EXPECT_LT(worst_error(s, test::settings_for(9, 9), 1.0), tolerance) << "clearcoatRoughness " << coat_roughness;
  }
}

// Normals bent outward so far that the picture's edge looks away from the camera: V is mirrored there.
TEST(Model, ViewIsMirroredWhereTheNormalLooksAway) {
  scene::Material m = velvet(0.5);
  m.clearcoat.factor = 0.5;
  m.clearcoat.roughness_factor = 0.4;
  const double bend = 3.0;
  const scene::Scene s = test::scene_with(test::square(2.0, 0.0, bend), m, test::camera_at(1.0, 1.6), three_lights());
  Settings settings = test::settings_for(10, 10, true);
  EXPECT_LT(worst_error(s, settings, bend), tolerance);
  const image::Image im = render(s, settings);
  EXPECT_EQ(im.at(0, 0, im.channel("mirrored")), 1.0f);
  EXPECT_EQ(im.at(5, 5, im.channel("mirrored")), 0.0f);
}

// Whatever visibility and scaling are asked for besides, and whatever the sheen's own roughness: the draft has none of them.
TEST(Model, SheenOfTheDraftOf2019MeetsTheLongDoubleEvaluation) {
  for (const double roughness : {0.15, 0.4, 1.0}) {
    for (const double metallic : {0.0, 0.6, 1.0}) {
      scene::Material m = velvet(0.5);
      m.metallic_factor = metallic;
      m.roughness_factor = roughness;
      m.clearcoat.factor = 0.6;
      m.clearcoat.roughness_factor = 0.3;
      m.emissive_factor = {0.1, 0.5, 2.0};
      const scene::Scene s = test::scene_with(test::square(2.0, 0.0, 1.0), m, test::camera_at(2.0, 1.2), three_lights());
      Settings settings = test::settings_for(9, 9);
      settings.sheen.model = albedo::Model::Draft2019;
      EXPECT_LT(worst_error(s, settings, 1.0), tolerance) << "roughness " << roughness << " metallic " << metallic;
      const image::Image draft = render(s, settings);
      settings.sheen = {albedo::Visibility::Refined, albedo::AlbedoScaling::View, albedo::Model::Draft2019};
      EXPECT_EQ(render(s, settings).data, draft.data);
    }
  }
}

// Seen along the normal, E of Ashikhmin's lobe is 2^-(p+1) / (p + 2) with p = 1 / (2 r^2); a Lambertian base keeps all its light.
TEST(Model, UniformLightOnTheDraftsSheenHasAClosedForm) {
  scene::Material m = test::lambertian({0.6, 0.3, 0.1, 1.0});
  m.roughness_factor = 0.5;
  m.sheen.color_factor = {0.9, 0.7, 0.4};
  m.sheen.roughness_factor = 0.1;
  const scene::Scene s = test::scene_with(test::square(2.0), m, test::orthographic_at(5.0, 1.0), {});
  scene::Environment white;
  white.uniform = {1.0, 1.0, 1.0};
  Settings settings = test::settings_for(3, 3);
  settings.environment = &white;
  settings.sheen.model = albedo::Model::Draft2019;
  const double e = std::exp2(-3.0) / 4.0;
  EXPECT_NEAR(render(s, settings).at(1, 1, 0), 0.6 + 0.9 * 0.96 * brdf::pi * e, 1e-6);
}

TEST(Model, OrthographicCameraSeesAlongItsAxis) {
  const scene::Scene s = test::scene_with(test::square(2.0, 0.0, 1.0), velvet(0.5), test::orthographic_at(5.0, 1.0), three_lights());
  EXPECT_LT(worst_error(s, test::settings_for(12, 8), 1.0), tolerance);
}

// The default sheenRoughness, where the printed code gives NaN.
TEST(Model, SheenRoughnessZeroLeavesTheBaseAlone) {
  const scene::Scene with = test::scene_with(test::square(2.0, 0.0, 1.0), velvet(0.0), test::camera_at(2.0, 1.2), three_lights());
  scene::Scene without = with;
  without.materials[0].sheen = {};
  for (const auto visibility : {albedo::Visibility::Charlie, albedo::Visibility::Ashikhmin, albedo::Visibility::Refined}) {
    Settings settings = test::settings_for(9, 9, true);
    settings.sheen.visibility = visibility;
    const image::Image one = render(with, settings);
    const image::Image other = render(without, settings);
    ASSERT_EQ(one.data.size(), other.data.size());
    for (int y = 0; y < 9; ++y) {
      for (int x = 0; x < 9; ++x) {
        EXPECT_EQ(test::rgb(one, x, y), test::rgb(other, x, y));
      }
    }
    // A branch of the lobe's that may go either way is evaluated with more care, all in all.
    for (std::size_t i = 0; i < one.data.size(); ++i) {
      EXPECT_NEAR(one.data[i], other.data[i], 0.01F * std::abs(other.data[i]));
    }
  }
}

// A mirror shows no punctual light; neither base nor coat may give NaN for it.
TEST(Model, RoughnessZeroGivesNoHighlight) {
  scene::Material m;
  m.metallic_factor = 1.0;
  m.roughness_factor = 0.0;
  m.clearcoat.factor = 1.0;
  scene::Scene s = test::scene_with(test::square(2.0), m, test::orthographic_at(5.0, 1.0), {test::directional({0.0, 0.0, 1.0})});
  const image::Image im = render(s, test::settings_for(5, 5, true));
  for (int y = 0; y < 5; ++y) {
    for (int x = 0; x < 5; ++x) {
      EXPECT_EQ(test::rgb(im, x, y), glm::dvec3(0.0));
    }
  }
}

// The nearest point, toward +Z, where the line through (x, y) along Z meets a tessellated sphere; none outside it.
std::optional<test::Vector> meet_sphere(const scene::Primitive& sphere, test::Real x, test::Real y) {
  std::optional<test::Vector> nearest;
  for (std::size_t i = 0; i + 2 < sphere.indices.size(); i += 3) {
    test::Vector p[3];
    for (std::size_t k = 0; k < 3; ++k) {
      p[k] = test::vector(sphere.positions[sphere.indices[i + k]]);
    }
    const auto area = [](test::Real ax, test::Real ay, test::Real bx, test::Real by) { return ax * by - ay * bx; };
    test::Real w[3];
    for (std::size_t k = 0; k < 3; ++k) {
      const test::Vector& a = p[(k + 1) % 3];
      const test::Vector& b = p[(k + 2) % 3];
      w[k] = area(a[0] - x, a[1] - y, b[0] - x, b[1] - y);
    }
    const test::Real sum = w[0] + w[1] + w[2];
    if (sum <= 0 || w[0] < 0 || w[1] < 0 || w[2] < 0) {
      continue;
    }
    const test::Real z = (w[0] * p[0][2] + w[1] * p[1][2] + w[2] * p[2][2]) / sum;
    if (!nearest || z > (*nearest)[2]) {
      nearest = {x, y, z};
    }
  }
  return nearest;
}

// A tessellated sphere with analytic normals: interpolated ones point along the radius of the point met, wherever the facet lies.
TEST(Model, TessellatedSphereMeetsTheLongDoubleEvaluation) {
  const scene::Material m = velvet(0.5);
  const scene::Scene s = test::scene_with(test::sphere(96, 48), m, test::orthographic_at(5.0, 1.1), {test::directional({0.5, 0.6, 1.0})});
  const int size = 40;
  const image::Image im = render(s, test::settings_for(size, size));
  int compared = 0;
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const auto met = meet_sphere(s.primitives[0], 1.1L * (2 * (x + 0.5L) / size - 1), 1.1L * (1 - 2 * (y + 0.5L) / size));
      ASSERT_EQ(im.at(x, y, 3), met ? 1.0f : 0.0f) << x << ' ' << y;
      if (!met) {
        continue;
      }
      Point p;
      p.position = *met;
      p.n = p.nc = test::unit(*met);
      p.v = {0.0L, 0.0L, 1.0L};
      const test::Vector want = test::radiance(p, m, s.lights, {});
      for (int c = 0; c < 3; ++c) {
        const auto expected = static_cast<double>(want[static_cast<std::size_t>(c)]);
        if (expected <= 1e-4) {
          continue;
        }
        ++compared;
        EXPECT_NEAR(im.at(x, y, c), expected, 1e-5 * expected) << x << ' ' << y;
      }
    }
  }
  EXPECT_GT(compared, 2000);
}

}  // namespace
}  // namespace sheen::golden
