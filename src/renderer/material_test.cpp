#include "albedo/directional_albedo.h"
#include "renderer/renderer_fixture.h"

namespace sheen::renderer {
namespace {

using albedo::AlbedoScaling;
using albedo::Visibility;
using test::lambert;
using test::pi;
using test::square_scene;

class Materials : public test::WithRenderer {
 protected:
  /// The square, its shading normal tilted so that N.V is n_dot_v, under a light of 1 lux at n_dot_l and an azimuth from the view.
  static scene::Scene posed(const scene::Material& material, double n_dot_v, double n_dot_l, double azimuth) {
    scene::Scene scene = square_scene(material);
    const double sine_v = std::sqrt(1.0 - n_dot_v * n_dot_v);
    const double sine_l = std::sqrt(1.0 - n_dot_l * n_dot_l);
    const glm::dvec3 normal(-sine_v, 0, n_dot_v);
    const glm::dvec3 along(n_dot_v, 0, sine_v);  // the view's direction in the tangent plane
    const glm::dvec3 across = glm::cross(normal, along);
    scene.primitives[0].normals.assign(4, glm::vec3(normal));
    scene.lights[0].direction = -(n_dot_l * normal + sine_l * (std::cos(azimuth) * along + std::sin(azimuth) * across));
    return scene;
  }

  static scene::Material sheen_over(double base_color, double sheen_roughness) {
    scene::Material material = lambert();
    material.base_color_factor = {base_color, base_color, base_color, 1};
    material.sheen.color_factor = glm::dvec3(1.0);
    material.sheen.roughness_factor = sheen_roughness;
    return material;
  }

  static Settings with(Visibility visibility, AlbedoScaling scaling, Formulation formulation = Formulation::Stable) {
    Settings settings;
    settings.sheen = {visibility, scaling};
    settings.formulation = formulation;
    return settings;
  }
};

// D V (N.L) at sheen_roughness .5, N.V .5, N.L .6, azimuth .5, by an independent long-double evaluation of KHR_materials_sheen.
constexpr double published_lobe = 0.06618617242;

TEST_F(Materials, TheSheenLobeIsTheSpecificationsInBothFormulations) {
  const scene::Scene scene = posed(sheen_over(0.0, 0.5), 0.5, 0.6, 0.5);
  for (const Formulation formulation : {Formulation::Literal, Formulation::Stable}) {
    EXPECT_NEAR(middle(scene, with(Visibility::Charlie, AlbedoScaling::None, formulation)), published_lobe, 1e-6);
    EXPECT_NEAR(middle(scene, with(Visibility::Ashikhmin, AlbedoScaling::None, formulation)) / published_lobe, 1.262, 5e-4);
  }
}

TEST_F(Materials, AlbedoScalingTakesFromTheBaseWhatTheSheenReflects) {
  const double e_v = albedo::directional_albedo(Visibility::Charlie, 0.5, 0.5);
  const double e_l = albedo::directional_albedo(Visibility::Charlie, 0.3, 0.5);
  const scene::Scene black = posed(sheen_over(0.0, 0.5), 0.5, 0.3, 0.5);
  const scene::Scene white = posed(sheen_over(1.0, 0.5), 0.5, 0.3, 0.5);
  const double lobe = middle(black, with(Visibility::Charlie, AlbedoScaling::None));
  const double base = 0.3 / pi;
  EXPECT_NEAR(middle(white, with(Visibility::Charlie, AlbedoScaling::None)), lobe + base, 1e-6);
  EXPECT_NEAR(middle(white, with(Visibility::Charlie, AlbedoScaling::View)), lobe + (1 - e_v) * base, 1e-5);
  EXPECT_NEAR(middle(white, with(Visibility::Charlie, AlbedoScaling::Full)), lobe + (1 - e_l) * base, 1e-5)
      << "the light lies lower than the view";
  EXPECT_NEAR(middle(white, with(Visibility::Charlie, AlbedoScaling::Literal)), lobe + (1 - e_l) * base, 1e-5);
}

TEST_F(Materials, EveryVisibilityReadsItsOwnTable) {
  for (const Visibility visibility : brdf::visibilities) {
    const double e = albedo::directional_albedo(visibility, 0.4, 0.6);
    const double lobe = middle(posed(sheen_over(0.0, 0.6), 0.4, 0.9, 1.0), with(visibility, AlbedoScaling::Full));
    const double both = middle(posed(sheen_over(1.0, 0.6), 0.4, 0.9, 1.0), with(visibility, AlbedoScaling::Full));
    EXPECT_NEAR((both - lobe) / (0.9 / pi), 1 - e, 2e-5);
  }
}

TEST_F(Materials, TheFitStaysWithinItsPublishedError) {
  Settings settings = with(Visibility::Charlie, AlbedoScaling::View);
  settings.albedo_source = AlbedoSource::Fit;
  for (const Visibility visibility : {Visibility::Charlie, Visibility::Ashikhmin}) {
    settings.sheen.visibility = visibility;
    for (const double r : {0.2, 0.5, 0.9}) {
      const double lobe = middle(posed(sheen_over(0.0, r), 0.4, 0.9, 1.0), settings);
      const double both = middle(posed(sheen_over(1.0, r), 0.4, 0.9, 1.0), settings);
      EXPECT_NEAR((both - lobe) / (0.9 / pi), 1 - albedo::directional_albedo(visibility, 0.4, r), 0.0205) << "sheen_roughness " << r;
    }
  }
}

TEST_F(Materials, TheClampedScaleNeverTurnsTheBaseNegativeAndTheLiteralOneDoes) {
  // Charlie's E passes 1 at grazing angles of small roughness.
  ASSERT_GT(albedo::directional_albedo(Visibility::Charlie, 0.002, 0.1), 1.5);
  const auto base_part = [&](AlbedoScaling scaling) {
    return middle(posed(sheen_over(1.0, 0.1), 0.002, 0.9, 3.0), with(Visibility::Charlie, scaling)) -
           middle(posed(sheen_over(0.0, 0.1), 0.002, 0.9, 3.0), with(Visibility::Charlie, scaling));
  };
  EXPECT_GE(base_part(AlbedoScaling::Full), 0.0);
  EXPECT_LT(base_part(AlbedoScaling::Literal), -0.1);
}

TEST_F(Materials, SheenOfRoughnessZeroVanishesAndLeavesTheBaseWhole) {
  for (const Visibility visibility : brdf::visibilities) {
    EXPECT_NEAR(middle(posed(sheen_over(1.0, 0.0), 0.5, 0.6, 0.5), with(visibility, AlbedoScaling::Full)), 0.6 / pi, 1e-6);
  }
}

TEST_F(Materials, EveryExtremeIsFinite) {
  for (const Precision precision : {Precision::Highp, Precision::Mediump}) {
    for (const double roughness : {0.0, 1e-6, 0.003, 0.05, 1.0}) {
      for (const double cosine : {0.0, 1e-7, 1.0}) {
        scene::Material material;
        material.roughness_factor = roughness;
        material.metallic_factor = 0.5;
        material.sheen = {glm::dvec3(1.0), {}, roughness, {}};
        material.clearcoat.factor = 1.0;
        material.clearcoat.roughness_factor = roughness;
        Settings settings;
        settings.precision = precision;
        for (const double light : {1e-7, 1.0}) {
          const double value = middle(posed(material, cosine, light, pi), settings);
          EXPECT_TRUE(std::isfinite(value) && value >= 0.0) << value << " at roughness " << roughness << ", N.V " << cosine << ", N.L "
                                                            << light << (precision == Precision::Mediump ? ", mediump" : ", highp");
        }
      }
    }
  }
}

TEST_F(Materials, ANormalThatTurnsAwaySeesTheMirroredView) {
  const scene::Scene facing = posed(sheen_over(0.3, 0.5), 0.25, 0.6, 0.5);
  scene::Scene away = posed(sheen_over(0.3, 0.5), 0.25, 0.6, 0.5);
  // The mirror image of the view in the normal's plane: the same pose with the view on the far side.
  const glm::dvec3 normal(away.primitives[0].normals[0]);
  const glm::dvec3 view(0, 0, 1);
  const glm::dvec3 reflected = view - 2.0 * glm::dot(view, normal) * normal;
  const glm::dvec3 axis = glm::normalize(glm::cross(reflected, view));
  const double angle = std::acos(glm::dot(reflected, view));
  const glm::dmat3 turn(glm::rotate(glm::dmat4(1.0), angle, axis));
  away.primitives[0].normals.assign(4, glm::vec3(turn * normal));
  away.lights[0].direction = turn * away.lights[0].direction;
  ASSERT_LT(away.primitives[0].normals[0].z, 0.0f);
  EXPECT_NEAR(middle(away), middle(facing), 1e-6);
}

TEST_F(Materials, ADielectricMixesTwoBrdfsWithAMetalNotTheirReflectance) {
  scene::Material material;
  material.base_color_factor = {0.5, 0.5, 0.5, 1};
  material.metallic_factor = 0.25;
  material.roughness_factor = 1.0;
  // At normal incidence of view and light: D = 1 / pi, Vis = 1 / 4, w = 0.
  const double lobe = 1.0 / (4.0 * pi);
  const double expected = 0.75 * (0.96 * 0.5 / pi + 0.04 * lobe) + 0.25 * 0.5 * lobe;
  for (const Formulation formulation : {Formulation::Literal, Formulation::Stable}) {
    EXPECT_NEAR(middle(square_scene(material), with(Visibility::Charlie, AlbedoScaling::Full, formulation)), expected, 1e-6);
  }
}

TEST_F(Materials, IorAndSpecularSetTheDielectricsReflectance) {
  scene::Material material = lambert();
  material.roughness_factor = 1.0;
  material.ior = 2.0;
  material.specular.factor = 0.5;
  material.specular.color_factor = {0.5, 1, 1};
  const double f0 = 1.0 / 9.0;
  const double lobe = 1.0 / (4.0 * pi);
  EXPECT_NEAR(middle(square_scene(material)), (1 - 0.5 * f0) / pi + 0.5 * (0.5 * f0) * lobe, 1e-6);
  material.ior = 0.0;
  material.specular = {};
  EXPECT_NEAR(middle(square_scene(material)), lobe, 1e-6) << "ior 0 means f0 = 1: no light reaches the diffuse part";
}

TEST_F(Materials, ClearcoatDarkensWhatLiesUnderItAndAddsItsOwnLobe) {
  scene::Material material = lambert();
  material.clearcoat.factor = 0.5;
  material.emissive_factor = glm::dvec3(1.0);
  const double k = 0.5 * 0.04;
  EXPECT_NEAR(middle(square_scene(material)), (1 - k) * (1.0 / pi + 1.0), 1e-6) << "roughness 0 is a mirror, which shows no punctual light";
  material.clearcoat.roughness_factor = 1.0;
  EXPECT_NEAR(middle(square_scene(material)), (1 - k) * (1.0 / pi + 1.0) + k / (4.0 * pi), 1e-6);
  scene::Scene unlit = square_scene(material);
  unlit.lights.clear();
  EXPECT_NEAR(middle(unlit), 1 - k, 1e-6);
}

TEST_F(Materials, TheBaseNormalMapNeverReachesTheCoat) {
  scene::Material material = lambert();
  material.base_color_factor = {0, 0, 0, 1};
  material.clearcoat.factor = 1.0;
  material.clearcoat.roughness_factor = 0.5;
  scene::Scene scene = square_scene(material);
  const double plain = middle(scene);
  scene.materials[0].normal_texture = test::add_texture(scene, test::picture(1, 1, {255, 128, 180, 255}));
  EXPECT_NEAR(middle(scene), plain, 1e-7);
  scene.materials[0].clearcoat.normal_texture = scene.materials[0].normal_texture;
  EXPECT_LT(middle(scene), 0.5 * plain) << "and the coat's own does";
}

TEST_F(Materials, ALightBelowTheBaseStillLightsATiltedCoat) {
  scene::Material material;
  material.clearcoat.factor = 1.0;
  material.clearcoat.roughness_factor = 1.0;
  scene::Scene scene = square_scene(material);
  scene.lights[0].direction = glm::normalize(glm::dvec3(-1, 0, 0.1));
  EXPECT_EQ(middle(scene), 0.0);
  scene.materials[0].clearcoat.normal_texture = test::add_texture(scene, test::picture(1, 1, {255, 128, 255, 255}));
  EXPECT_GT(middle(scene), 0.0);
}

TEST_F(Materials, ANormalMapTiltsTheNormalAlongTheTangentFrame) {
  // Code 128 is 1/255 above zero after decoding; 0 and 255 are exact.
  const double zero = 128.0 / 255.0 * 2.0 - 1.0;
  for (const int axis : {0, 1}) {
    scene::Scene scene = square_scene();
    std::vector<std::uint16_t> codes{128, 128, 255, 255};
    codes[static_cast<std::size_t>(axis)] = 255;
    scene.materials[0].normal_texture = test::add_texture(scene, test::picture(1, 1, codes));
    scene.materials[0].normal_scale = 0.5;
    glm::dvec3 n(0.5 * zero, 0.5 * zero, 1.0);
    n[axis] = 0.5;
    n = glm::normalize(n);
    scene.lights[0].direction = glm::normalize(glm::dvec3(-0.4, -0.2, -1));
    EXPECT_NEAR(middle(scene), glm::dot(n, -scene.lights[0].direction) / pi, 1e-6) << "axis " << axis;
    // Handedness -1 turns the bitangent round, and with it the y of the map.
    scene.primitives[0].tangents.assign(4, {1, 0, 0, -1});
    n.y = -n.y;
    EXPECT_NEAR(middle(scene), glm::dot(n, -scene.lights[0].direction) / pi, 1e-6) << "axis " << axis << ", left-handed";
  }
}

}  // namespace
}  // namespace sheen::renderer
