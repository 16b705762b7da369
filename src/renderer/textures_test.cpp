#include "renderer/textures.h"

#include "renderer/renderer_fixture.h"

namespace sheen::renderer {
namespace {

using scene::Filter;
using scene::MipFilter;
using scene::Wrap;
using test::pi;
using test::square_scene;

constexpr scene::Sampler nearest{Wrap::Repeat, Wrap::Repeat, Filter::Nearest, Filter::Nearest, MipFilter::None};
constexpr scene::Sampler linear{Wrap::Repeat, Wrap::Repeat, Filter::Linear, Filter::Linear, MipFilter::None};

/// Codes of a picture whose every channel is `value`.
std::vector<std::uint16_t> gray(std::initializer_list<std::uint16_t> values) {
  std::vector<std::uint16_t> codes;
  for (const std::uint16_t value : values) {
    codes.insert(codes.end(), {value, value, value, 255});
  }
  return codes;
}

/// IEC 61966-2-1.
double from_srgb(int code) {
  const double c = code / 255.0;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

class Texturing : public test::WithRenderer {
 protected:
  /// The square showing a picture as its emission alone: the texture's own values come out.
  static scene::Scene shown(scene::Picture content, scene::Sampler sampler) {
    scene::Scene scene = square_scene();
    scene.lights.clear();
    scene.materials[0].emissive_factor = glm::dvec3(1.0);
    scene.materials[0].emissive_texture = test::add_texture(scene, std::move(content), sampler);
    return scene;
  }
};

TEST_F(Texturing, APicturesFirstTexelIsAtTheUpperLeftWhereUAndVAreZero) {
  const image::Image picture = render(shown(test::picture(2, 2, gray({255, 0, 128, 64})), nearest));
  EXPECT_FLOAT_EQ(picture.at(0, 0, 0), 1.0f);
  EXPECT_FLOAT_EQ(picture.at(7, 0, 0), 0.0f);
  EXPECT_NEAR(picture.at(0, 7, 0), from_srgb(128), 1e-6);
  EXPECT_NEAR(picture.at(7, 7, 0), from_srgb(64), 1e-6);
}

TEST_F(Texturing, BilinearFilteringMixesLinearLightAcrossTheSeam) {
  // 8 pixels over 2 texels: pixel 3 stands at u = 7/16, 3/8 of a texel past the centre of texel 0; pixel 0 mixes texel 1 round the seam.
  const image::Image picture = render(shown(test::picture(2, 1, gray({255, 0})), linear));
  EXPECT_NEAR(picture.at(3, 4, 0), 1.0 - 0.375, 1e-6);
  EXPECT_NEAR(picture.at(0, 4, 0), 1.0 - 0.375, 1e-6);
  scene::Sampler clamped = linear;
  clamped.wrap_s = Wrap::ClampToEdge;
  EXPECT_NEAR(render(shown(test::picture(2, 1, gray({255, 0})), clamped)).at(0, 4, 0), 1.0, 1e-6);
}

TEST_F(Texturing, WrapModesHoldOnBothSidesOfThePicture) {
  for (const Wrap wrap : {Wrap::Repeat, Wrap::MirroredRepeat, Wrap::ClampToEdge}) {
    scene::Sampler sampler = nearest;
    sampler.wrap_s = wrap;
    scene::Scene scene = shown(test::picture(2, 1, gray({255, 0})), sampler);
    // u from -2 to 2 over 8 pixels: half a unit each.
    scene.materials[0].emissive_texture.transform = glm::dmat3(glm::dvec3(4, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(-2, 0, 1));
    const image::Image picture = render(scene);
    const std::array<std::array<float, 8>, 3> expected{{{1, 0, 1, 0, 1, 0, 1, 0}, {1, 0, 0, 1, 1, 0, 0, 1}, {1, 1, 1, 1, 1, 0, 0, 0}}};
    for (int x = 0; x < 8; ++x) {
      EXPECT_FLOAT_EQ(picture.at(x, 4, 0), expected.at(static_cast<std::size_t>(wrap)).at(static_cast<std::size_t>(x)))
          << "wrap " << static_cast<int>(wrap) << ", pixel " << x;
    }
  }
}

TEST_F(Texturing, TheLevelFollowsThePixelsSize) {
  // 16 x 16 texels, columns 1 and 0 in turn, on 8 x 8 pixels: lambda is 1, and level 1 is the mean everywhere.
  std::vector<std::uint16_t> codes;
  for (int i = 0; i < 256; ++i) {
    const auto value = static_cast<std::uint16_t>(i % 2 == 0 ? 255 : 0);
    codes.insert(codes.end(), {value, value, value, 255});
  }
  const scene::Picture stripes = test::picture(16, 16, codes);
  for (const MipFilter mip : {MipFilter::Nearest, MipFilter::Linear}) {
    for (const Filter filter : {Filter::Nearest, Filter::Linear}) {
      const image::Image picture = render(shown(stripes, {Wrap::Repeat, Wrap::Repeat, Filter::Nearest, filter, mip}));
      EXPECT_NEAR(picture.at(3, 3, 0), 0.5, 1e-6);
    }
  }
  const image::Image magnified =
      render(shown(stripes, {Wrap::Repeat, Wrap::Repeat, Filter::Nearest, Filter::Linear, MipFilter::Linear}), 32);
  EXPECT_FLOAT_EQ(magnified.at(0, 3, 0), 1.0f) << "magnified, the nearest texel of level 0";
  EXPECT_FLOAT_EQ(magnified.at(2, 3, 0), 0.0f);
}

TEST_F(Texturing, TrilinearFilteringMixesTwoLevels) {
  // A 2 x 2 checkerboard whose every level above 0 is its mean, at lambda = log2(1.5): nearest within the levels.
  scene::Scene scene =
      shown(test::picture(2, 2, gray({255, 0, 0, 255})), {Wrap::Repeat, Wrap::Repeat, Filter::Linear, Filter::Nearest, MipFilter::Linear});
  const double scale = 6.0;  // 8 pixels over 6 pictures of 2 texels: 1.5 texels a pixel
  scene.materials[0].emissive_texture.transform = glm::dmat3(glm::dvec3(scale, 0, 0), glm::dvec3(0, scale, 0), glm::dvec3(0, 0, 1));
  const double lambda = std::log2(1.5);
  // Pixel 0 is at u = v = 6/16 of a picture: texel (0, 0), whose value is 1.
  EXPECT_NEAR(render(scene).at(0, 0, 0), (1 - lambda) * 1.0 + lambda * 0.5, 1e-5);
}

TEST_F(Texturing, PixelsOfOneQuadMayReadDifferentLevels) {
  // A square seen at a slant: lambda crosses whole numbers within quads. Every texel of the picture is 1, and so must every pixel be.
  scene::Scene scene = shown(test::picture(64, 16, std::vector<std::uint16_t>(std::size_t{64} * 16 * 4, 255)), {});
  scene.cameras[0].perspective = true;
  scene.instances[0].world_from_local = glm::rotate(glm::scale(glm::dmat4(1.0), glm::dvec3(1, 1, 8)), -1.5, glm::dvec3(1, 0.2, 0));
  scene.materials[0].emissive_texture.transform = glm::dmat3(glm::dvec3(5, 0, 0), glm::dvec3(0, 9, 0), glm::dvec3(0.3, 0.1, 1));
  const image::Image picture = render(scene, 64);
  int covered = 0;
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      if (picture.at(x, y, 3) == 0.0f) {
        continue;
      }
      ++covered;
      ASSERT_NEAR(picture.at(x, y, 0), 1.0, 1e-5) << "pixel " << x << ", " << y;
    }
  }
  EXPECT_GT(covered, 100);
}

TEST_F(Texturing, EveryLevelOfAnOddPictureIsWhereItIsLookedFor) {
  // One colour at every level; the rest of the texture is not initialised.
  for (const auto& [width, height] : {std::pair{1, 1}, std::pair{1, 9}, std::pair{13, 1}, std::pair{7, 5}, std::pair{33, 12}}) {
    for (const double scale : {0.01, 1.0, 3.0, 60.0}) {
      std::vector<std::uint16_t> codes(static_cast<std::size_t>(width * height) * 4, 255);
      scene::Scene scene = shown(test::picture(width, height, codes), {});
      scene.materials[0].emissive_texture.transform = glm::dmat3(glm::dvec3(scale, 0, 0), glm::dvec3(0, scale, 0), glm::dvec3(0, 0, 1));
      EXPECT_NEAR(render(scene).at(5, 2, 0), 1.0, 1e-5) << width << " x " << height << " at scale " << scale;
    }
  }
}

TEST(Pictures, OfEqualTexelsAreOneTextureAndOthersAreNot) {
  const std::unique_ptr<gles::Context> context = gles::Context::create_any(gles::ContextKind::OsMesa);
  const gles::CurrentScope current(*context);
  scene::Scene scene = square_scene();
  std::vector<scene::TextureInfo> infos;
  for (const auto& codes : {gray({255, 0}), gray({255, 0}), gray({255, 1})}) {
    infos.push_back(test::add_texture(scene, test::picture(2, 1, codes), nearest));
  }
  infos.push_back(test::add_texture(scene, test::picture(1, 2, gray({255, 0})), nearest));
  infos.push_back(test::add_texture(scene, test::picture(2, 1, gray({255, 0}))));  // with mipmaps
  std::vector<TextureUse> uses;
  for (const scene::TextureInfo& info : infos) {
    uses.push_back({.name = "emissive_texture", .info = &info});
  }
  uses.push_back({.name = "emissive_texture", .info = infos.data(), .space = scene::ColorSpace::Srgb});
  Pictures pictures(context->gl());
  pictures.prepare(scene, uses);
  EXPECT_EQ(pictures.texture(scene, uses[1]), pictures.texture(scene, uses[0]));
  for (std::size_t i = 2; i < uses.size(); ++i) {
    EXPECT_NE(pictures.texture(scene, uses[i]), pictures.texture(scene, uses[0])) << "use " << i;
  }
}

TEST_F(Texturing, TheSecondSetOfCoordinatesIsRead) {
  scene::Scene scene = shown(test::picture(1, 2, gray({255, 0})), nearest);
  EXPECT_FLOAT_EQ(render(scene).at(4, 1, 0), 1.0f);
  scene.materials[0].emissive_texture.texcoord = 1;  // upside down
  EXPECT_FLOAT_EQ(render(scene).at(4, 1, 0), 0.0f);
}

TEST_F(Texturing, EveryTextureIsReadInItsOwnChannelAndColourSpace) {
  const scene::Picture codes = test::picture(1, 1, {64, 128, 192, 100});
  const double lobe = 1.0 / (4.0 * pi);
  const double red = from_srgb(64);
  {
    scene::Scene scene = square_scene();
    scene.materials[0].base_color_texture = test::add_texture(scene, codes, nearest);
    EXPECT_NEAR(middle(scene), red / pi, 1e-6) << "base colour: sRGB";
  }
  {
    scene::Scene scene = square_scene();
    scene.materials[0].metallic_factor = 1.0;
    scene.materials[0].metallic_roughness_texture = test::add_texture(scene, codes, nearest);
    const double metallic = 192.0 / 255.0;
    const double alpha = std::pow(128.0 / 255.0, 2);
    const double peak = 1.0 / (pi * alpha * alpha) / 4.0;  // D Vis at N = L = V
    EXPECT_NEAR(middle(scene), (1 - metallic) / pi + metallic * peak, 2e-5) << "metallic b, roughness g, linear";
  }
  {
    scene::Scene scene = square_scene();
    scene.materials[0].specular.factor = 1.0;
    scene.materials[0].specular.factor_texture = test::add_texture(scene, codes, nearest);
    const double strength = 100.0 / 255.0;
    EXPECT_NEAR(middle(scene), (1 - strength * 0.04) / pi + strength * 0.04 * lobe, 1e-6) << "specular: a, linear";
    scene.materials[0].specular.factor_texture = {};
    scene.materials[0].specular.color_texture = test::add_texture(scene, codes, nearest);
    EXPECT_NEAR(middle(scene), (1 - from_srgb(192) * 0.04) / pi + red * 0.04 * lobe, 1e-6) << "specular colour: rgb, sRGB";
  }
  {
    scene::Scene scene = square_scene();
    scene.materials[0].clearcoat.factor = 1.0;
    scene.materials[0].clearcoat.roughness_factor = 1.0;
    scene.materials[0].clearcoat.factor_texture = test::add_texture(scene, codes, nearest);
    const double k = 64.0 / 255.0 * 0.04;
    EXPECT_NEAR(middle(scene), (1 - k) / pi + k * lobe, 1e-6) << "clearcoat: r, linear";
    scene.materials[0].clearcoat.factor_texture = {};
    scene.materials[0].clearcoat.roughness_texture = test::add_texture(scene, codes, nearest);
    const double alpha = std::pow(128.0 / 255.0, 2);
    EXPECT_NEAR(middle(scene), 0.96 / pi + 0.04 / (4.0 * pi * alpha * alpha), 1e-5) << "clearcoat roughness: g, linear";
  }
}

TEST_F(Texturing, SheenColourIsSrgbAndSheenRoughnessIsLinearAlpha) {
  Settings unscaled;
  unscaled.sheen.scaling = albedo::AlbedoScaling::None;
  scene::Scene scene = square_scene();
  scene.materials[0].base_color_factor = {0, 0, 0, 1};
  scene.materials[0].sheen.color_factor = glm::dvec3(1.0);
  scene.materials[0].sheen.roughness_factor = 100.0 / 255.0;
  scene.lights[0].direction = glm::normalize(glm::dvec3(-1, 0, -1));
  const double white = middle(scene, unscaled);
  ASSERT_GT(white, 0.0);
  scene.materials[0].sheen.color_texture = test::add_texture(scene, test::picture(1, 1, {64, 128, 192, 7}), nearest);
  EXPECT_NEAR(middle(scene, unscaled), from_srgb(64) * white, 1e-6 * white);
  scene.materials[0].sheen.color_texture = {};
  scene.materials[0].sheen.roughness_factor = 1.0;
  scene.materials[0].sheen.roughness_texture = test::add_texture(scene, test::picture(1, 1, {7, 7, 7, 100}), nearest);
  EXPECT_NEAR(middle(scene, unscaled), white, 1e-5 * white);
}

TEST_F(Texturing, OnePictureServesTwoColourSpaces) {
  scene::Scene scene = square_scene();
  scene.materials[0].metallic_factor = 1.0;
  const scene::TextureInfo both = test::add_texture(scene, test::picture(1, 1, {255, 255, 128, 255}), nearest);
  scene.materials[0].metallic_roughness_texture = both;
  scene.materials[0].emissive_texture = both;
  scene.materials[0].emissive_factor = {0, 0, 1};
  const image::Image picture = render(scene);
  const double metallic = 128.0 / 255.0;
  EXPECT_NEAR(picture.at(4, 4, 2), (1 - metallic) / pi + metallic / (4.0 * pi) + from_srgb(128), 1e-6);
}

}  // namespace
}  // namespace sheen::renderer
