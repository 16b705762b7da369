#include <cmath>

#include <glm/vec3.hpp>

#include "scene/gltf_fixture_test.h"
#include "scene/picture_codecs.h"

namespace sheen::scene::test {
namespace {

// The triangle with a 1 x 1 base colour texture.
Asset textured(const Bytes& image = png(1, 1, 8, {10, 20, 30, 40}), const char* mime = "image/png") {
  Asset asset = triangle();
  const int texture = asset.add_texture(image, mime);
  asset.material()["pbrMetallicRoughness"]["baseColorTexture"]["index"] = texture;
  return asset;
}

json& base_texture(Asset& asset) {
  return asset.material()["pbrMetallicRoughness"]["baseColorTexture"];
}

glm::dvec2 transformed(const json& extension, glm::dvec2 uv) {
  Asset asset = textured();
  base_texture(asset)["extensions"]["KHR_texture_transform"] = extension;
  return glm::dvec2(load(asset).materials[0].base_color_texture.transform * glm::dvec3(uv, 1.0));
}

TEST(GltfTextures, PngKeepsItsCodesOfEightAndSixteenBits) {
  const std::vector<std::uint16_t> eight = {1, 2, 3, 4, 255, 254, 253, 0};
  const Picture picture = load(textured(png(1, 2, 8, eight))).pictures.at(0);
  EXPECT_EQ(picture.width, 1);
  EXPECT_EQ(picture.height, 2);
  EXPECT_EQ(picture.bits, 8);
  EXPECT_EQ(picture.codes, eight);
  const std::vector<std::uint16_t> sixteen = {1, 256, 65535, 40000, 12345, 0, 7, 65534};
  const Picture deep = load(textured(png(2, 1, 16, sixteen))).pictures.at(0);
  EXPECT_EQ(deep.bits, 16);
  EXPECT_EQ(deep.codes, sixteen);
}

TEST(GltfTextures, LargePicturesKeepEveryCode) {
  std::vector<std::uint16_t> codes;
  for (int i = 0; i < 61 * 47 * 4; ++i) {
    codes.push_back(static_cast<std::uint16_t>((i * 31 + i / 251) % 256));
  }
  EXPECT_EQ(load(textured(png(61, 47, 8, codes))).pictures.at(0).codes, codes);
}

TEST(GltfTextures, JpegIsDecodedAndOpaque) {
  const Picture picture = load(textured(jpeg(), "image/jpeg")).pictures.at(0);
  ASSERT_EQ(picture.codes.size(), 8U * 8U * 4U);
  EXPECT_NEAR(picture.codes[0], 200, 3);
  EXPECT_NEAR(picture.codes[1], 100, 3);
  EXPECT_NEAR(picture.codes[2], 50, 3);
  EXPECT_EQ(picture.codes[3], 255);
}

TEST(GltfTextures, PicturesMayStandInFilesAndDataUris) {
  const Bytes image = png(1, 1, 8, {10, 20, 30, 40});
  Asset asset = textured(image);
  const std::string inside = content_hash(load(asset));
  asset.document["images"][0] = {{"uri", "data:image/png;base64," + base64(image)}};
  EXPECT_EQ(content_hash(load(asset)), inside);
  const TemporaryFolder folder;
  folder.write("colour map.png", image);
  asset.document["images"][0] = {{"uri", "colour%20map.png"}};
  EXPECT_EQ(content_hash(load_gltf(folder.write("asset.gltf", asset.embedded().dump()))), inside);
  asset.document["images"][0] = {{"uri", "../map.png"}};
  EXPECT_TRUE(names(error_of(asset), "images[0]", "leaves the asset's folder"));
  asset.document["images"][0] = {{"uri", "absent.png"}};
  EXPECT_TRUE(names(error_of(asset), "images[0]", "no such file"));
  asset.document["images"][0] = json::object();
  EXPECT_TRUE(names(error_of(asset), "images[0]", "either a uri or a bufferView"));
}

TEST(GltfTextures, PicturesThatCannotBeDecodedAreRefused) {
  const Bytes good = png(4, 4, 8, std::vector<std::uint16_t>(64, 7));
  EXPECT_TRUE(names(error_of(textured(Bytes(good.begin(), good.begin() + 60))), "images[0]", "cannot be decoded"));
  EXPECT_TRUE(names(error_of(textured(Bytes(good.begin(), good.begin() + 12))), "images[0]", "cannot be decoded as PNG"));
  EXPECT_TRUE(names(error_of(textured({'G', 'I', 'F', '8', '9', 'a', 0, 0})), "images[0]", "neither PNG nor JPEG"));
  EXPECT_TRUE(names(error_of(textured(png(20000, 1, 8, {0}))), "images[0]", "more than 16384"));
  Bytes cut = jpeg();
  cut.resize(100);
  EXPECT_TRUE(names(error_of(textured(cut)), "images[0]", "truncated"));
  cut = jpeg();
  cut.resize(cut.size() - 8);  // in the middle of the coefficients
  EXPECT_TRUE(names(error_of(textured(cut)), "images[0]", "cannot be decoded as JPEG"));
}

TEST(GltfTextures, NoDamagedJpegGetsFurtherThanItsDecoder) {
  const Bytes whole = jpeg();
  for (std::size_t at = 2; at < whole.size(); ++at) {
    for (const int flip : {0x01, 0x10, 0x80, 0xFF}) {
      Bytes damaged = whole;
      damaged[at] = static_cast<std::uint8_t>(damaged[at] ^ flip);
      Picture picture;
      if (decode_picture(damaged, picture).empty()) {
        EXPECT_EQ(picture.codes.size(),
                  std::size_t{4} * static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height));
      }
    }
  }
}

TEST(GltfTextures, FilesOfEqualBytesAreOnePicture) {
  Asset asset = triangle();
  const Bytes red = png(1, 1, 8, {255, 0, 0, 255});
  const Bytes blue = png(1, 1, 8, {0, 0, 255, 255});
  const char* const slots[] = {"emissiveTexture", "occlusionTexture", "normalTexture"};
  for (std::size_t i = 0; i < 3; ++i) {
    asset.material()[slots[i]]["index"] = asset.add_texture(i == 1 ? blue : red);
  }
  const Scene scene = load(asset);
  const auto red_of = [&](const TextureInfo& info) {
    const Texture& texture = scene.textures.at(static_cast<std::size_t>(info.texture));
    return scene.pictures.at(static_cast<std::size_t>(texture.picture)).codes[0];
  };
  EXPECT_EQ(scene.pictures.size(), 2U);
  EXPECT_EQ(red_of(scene.materials[0].emissive_texture), 255);
  EXPECT_EQ(red_of(scene.materials[0].occlusion_texture), 0);
  EXPECT_EQ(red_of(scene.materials[0].normal_texture), 255);
}

TEST(GltfTextures, OnlyPicturesThatAMaterialUsesAreLoaded) {
  Asset asset = triangle();
  asset.add_texture({1, 2, 3});
  const int used = asset.add_texture(png(1, 1, 8, {10, 20, 30, 40}));
  asset.material()["emissiveTexture"]["index"] = used;
  asset.material()["normalTexture"]["index"] = used;
  const Scene scene = load(asset);
  ASSERT_EQ(scene.pictures.size(), 1U);
  ASSERT_EQ(scene.textures.size(), 1U);
  EXPECT_EQ(scene.textures[0].picture, 0);
  EXPECT_EQ(scene.materials[0].emissive_texture.texture, 0);
  EXPECT_EQ(scene.materials[0].normal_texture.texture, 0);
}

TEST(GltfTextures, TexturesThatOnlyAnExtensionCanDecodeAreRefused) {
  const std::pair<const char*, const char*> extensions[] = {{"KHR_texture_basisu", "gltf-transform ktxdecompress IN OUT"},
                                                            {"EXT_texture_webp", "gltf-transform png IN OUT --formats webp"},
                                                            {"EXT_texture_avif", "gltf-transform png IN OUT --formats avif"}};
  for (const auto& [extension, advice] : extensions) {
    Asset asset = textured();
    asset.document["textures"][0] = {{"extensions", {{extension, {{"source", 0}}}}}};
    EXPECT_TRUE(names(error_of(asset), "textures[0]", extension));
    EXPECT_TRUE(names(error_of(asset), "textures[0]", advice));
    // With a picture that can be decoded beside it, the extension is only an offer.
    asset.document["textures"][0]["source"] = 0;
    EXPECT_EQ(load(asset).pictures.size(), 1U);
  }
  Asset asset = textured();
  asset.document["textures"][0] = json::object();
  EXPECT_TRUE(names(error_of(asset), "textures[0]", "has no image"));
}

TEST(GltfTextures, SamplersMapToTheirFiltersAndWraps) {
  Asset asset = textured();
  EXPECT_EQ(load(asset).textures[0].sampler.mip, MipFilter::Linear);
  asset.document["textures"][0]["sampler"] = 0;
  asset.document["samplers"] = json::array({{{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}, {"minFilter", 9985}}});
  const Sampler sampler = load(asset).textures[0].sampler;
  EXPECT_EQ(sampler.wrap_s, Wrap::ClampToEdge);
  EXPECT_EQ(sampler.wrap_t, Wrap::MirroredRepeat);
  EXPECT_EQ(sampler.mag, Filter::Nearest);
  EXPECT_EQ(sampler.min, Filter::Linear);
  EXPECT_EQ(sampler.mip, MipFilter::Nearest);
  const struct {
    int code;
    Filter min;
    MipFilter mip;
  } filters[] = {{9728, Filter::Nearest, MipFilter::None},    {9729, Filter::Linear, MipFilter::None},
                 {9984, Filter::Nearest, MipFilter::Nearest}, {9985, Filter::Linear, MipFilter::Nearest},
                 {9986, Filter::Nearest, MipFilter::Linear},  {9987, Filter::Linear, MipFilter::Linear}};
  for (const auto& f : filters) {
    asset.document["samplers"][0] = {{"minFilter", f.code}};
    const Sampler read = load(asset).textures[0].sampler;
    EXPECT_EQ(read.min, f.min) << f.code;
    EXPECT_EQ(read.mip, f.mip) << f.code;
  }
  for (const char* key : {"wrapS", "wrapT", "magFilter", "minFilter"}) {
    asset.document["samplers"][0] = {{key, 1}};
    EXPECT_TRUE(names(error_of(asset), "samplers[0]", key));
  }
  asset.document["samplers"][0] = json::object();
  asset.document["textures"][0]["sampler"] = 1;
  EXPECT_TRUE(names(error_of(asset), "textures[0]", "sampler is 1, out of range"));
}

TEST(GltfTextures, ReferencesMustBeInRange) {
  Asset asset = textured();
  base_texture(asset)["index"] = 1;
  EXPECT_TRUE(names(error_of(asset), cloth, "baseColorTexture.index is 1, out of range: there are 1 textures"));
  base_texture(asset) = json::object();
  EXPECT_TRUE(names(error_of(asset), cloth, "baseColorTexture.index is required"));
  asset = textured();
  asset.document["textures"][0]["source"] = 5;
  EXPECT_TRUE(names(error_of(asset), "textures[0]", "source is 5, out of range"));
  asset = textured();
  asset.document["images"][0]["bufferView"] = 50;
  EXPECT_TRUE(names(error_of(asset), "images[0]", "bufferView is 50, out of range"));
}

TEST(GltfTextures, TheCoordinateSetMustExist) {
  Asset asset = textured();
  base_texture(asset)["texCoord"] = 1;
  EXPECT_TRUE(names(error_of(asset), "meshes[0] 'patch'", "has no TEXCOORD_1, which baseColorTexture"));
  base_texture(asset)["texCoord"] = 2;
  EXPECT_TRUE(names(error_of(asset), cloth, "texCoord is 2"));
  base_texture(asset)["texCoord"] = 1;
  base_texture(asset)["extensions"]["KHR_texture_transform"]["texCoord"] = 0;
  EXPECT_EQ(load(asset).materials[0].base_color_texture.texcoord, 0);
}

// KHR_texture_transform: scale, then rotation (u turns toward -v, upwards in the image), then offset.
TEST(GltfTextures, TransformsScaleThenRotateThenMove) {
  EXPECT_EQ(transformed(json::object(), {0.25, 0.75}), glm::dvec2(0.25, 0.75));
  EXPECT_EQ(transformed({{"offset", {0.5, -1}}, {"scale", {2, 3}}}, {0.25, 0.75}), glm::dvec2(1.0, 1.25));
  const glm::dvec2 quarter = transformed({{"rotation", std::acos(0.0)}}, {1.0, 0.0});
  EXPECT_NEAR(quarter.x, 0.0, 1e-15);
  EXPECT_NEAR(quarter.y, -1.0, 1e-15);
  const glm::dvec2 all = transformed({{"offset", {0.5, 0.25}}, {"rotation", std::acos(0.0)}, {"scale", {2, 3}}}, {0.25, 0.5});
  EXPECT_NEAR(all.x, 0.5 + 3 * 0.5, 1e-15);
  EXPECT_NEAR(all.y, 0.25 - 2 * 0.25, 1e-15);
}

TEST(GltfTextures, TransformsOfTheWrongTypeAreRefused) {
  for (const json& extension : {json{{"offset", {1}}}, json{{"scale", 2}}, json{{"rotation", "left"}}, json{{"texCoord", -1}}}) {
    Asset asset = textured();
    base_texture(asset)["extensions"]["KHR_texture_transform"] = extension;
    EXPECT_TRUE(names(error_of(asset), cloth, "baseColorTexture.KHR_texture_transform." + extension.begin().key()));
  }
}

TEST(GltfTextures, EveryTextureOfEveryLayerIsRead) {
  Asset asset = textured();
  const json info = {{"index", 0}};
  asset.material()["pbrMetallicRoughness"]["metallicRoughnessTexture"] = info;
  asset.material()["normalTexture"] = {{"index", 0}, {"scale", -2}};
  asset.material()["occlusionTexture"] = {{"index", 0}, {"strength", 0.5}};
  asset.material()["emissiveTexture"] = info;
  asset.material()["extensions"] = {
      {"KHR_materials_sheen", {{"sheenColorTexture", info}, {"sheenRoughnessTexture", info}}},
      {"KHR_materials_specular", {{"specularTexture", info}, {"specularColorTexture", info}}},
      {"KHR_materials_clearcoat",
       {{"clearcoatTexture", info}, {"clearcoatRoughnessTexture", info}, {"clearcoatNormalTexture", {{"index", 0}, {"scale", 3}}}}}};
  const Material m = load(asset).materials[0];
  for (const TextureInfo* read :
       {&m.base_color_texture, &m.metallic_roughness_texture, &m.normal_texture, &m.occlusion_texture, &m.emissive_texture,
        &m.sheen.color_texture, &m.sheen.roughness_texture, &m.specular.factor_texture, &m.specular.color_texture,
        &m.clearcoat.factor_texture, &m.clearcoat.roughness_texture, &m.clearcoat.normal_texture}) {
    EXPECT_TRUE(read->present());
  }
  EXPECT_EQ(m.normal_scale, -2.0);
  EXPECT_EQ(m.occlusion_strength, 0.5);
  EXPECT_EQ(m.clearcoat.normal_scale, 3.0);
}

}  // namespace
}  // namespace sheen::scene::test
