#include "scene/gltf_fixture_test.h"

namespace sheen::scene::test {
namespace {

Asset with_extension(const char* name, const json& value) {
  Asset asset = triangle();
  asset.material()["extensions"][name] = value;
  return asset;
}

TEST(GltfMaterials, DefaultsAreThoseOfTheSpecifications) {
  Asset asset = triangle();
  asset.material()["extensions"] = {{"KHR_materials_sheen", json::object()},
                                    {"KHR_materials_clearcoat", json::object()},
                                    {"KHR_materials_specular", json::object()},
                                    {"KHR_materials_ior", json::object()}};
  const Material m = load(asset).materials.at(0);
  EXPECT_EQ(m.name, "cloth");
  EXPECT_EQ(m.base_color_factor, glm::dvec4(1.0));
  EXPECT_EQ(m.metallic_factor, 1.0);
  EXPECT_EQ(m.roughness_factor, 1.0);
  EXPECT_EQ(m.emissive_factor, glm::dvec3(0.0));
  EXPECT_EQ(m.ior, 1.5);
  EXPECT_EQ(m.specular.factor, 1.0);
  EXPECT_EQ(m.specular.color_factor, glm::dvec3(1.0));
  EXPECT_TRUE(m.has_ior_or_specular);
  EXPECT_FALSE(m.sheen.enabled());
  EXPECT_EQ(m.sheen.roughness_factor, 0.0);
  EXPECT_FALSE(m.clearcoat.enabled());
  EXPECT_EQ(m.clearcoat.roughness_factor, 0.0);
  EXPECT_EQ(m.alpha_mode, AlphaMode::Opaque);
  EXPECT_EQ(m.alpha_cutoff, 0.5);
  EXPECT_FALSE(m.double_sided);
  EXPECT_FALSE(m.base_color_texture.present());
}

TEST(GltfMaterials, EveryFactorIsRead) {
  Asset asset = triangle();
  asset.material()["pbrMetallicRoughness"] = {
      {"baseColorFactor", {0.1, 0.2, 0.3, 0.4}}, {"metallicFactor", 0.25}, {"roughnessFactor", 0.75}};
  asset.material()["emissiveFactor"] = {0.5, 0.25, 1};
  asset.material()["alphaMode"] = "MASK";
  asset.material()["alphaCutoff"] = 0.125;
  asset.material()["doubleSided"] = true;
  asset.material()["extensions"] = {{"KHR_materials_sheen", {{"sheenColorFactor", {0.9, 0.8, 0.7}}, {"sheenRoughnessFactor", 0.6}}},
                                    {"KHR_materials_clearcoat", {{"clearcoatFactor", 0.5}, {"clearcoatRoughnessFactor", 0.1}}},
                                    {"KHR_materials_specular", {{"specularFactor", 0.2}, {"specularColorFactor", {2, 3, 4}}}},
                                    {"KHR_materials_ior", {{"ior", 1.25}}},
                                    {"KHR_materials_emissive_strength", {{"emissiveStrength", 4}}}};
  const Material m = load(asset).materials.at(0);
  EXPECT_EQ(m.base_color_factor, glm::dvec4(0.1, 0.2, 0.3, 0.4));
  EXPECT_EQ(m.metallic_factor, 0.25);
  EXPECT_EQ(m.roughness_factor, 0.75);
  EXPECT_EQ(m.emissive_factor, glm::dvec3(2, 1, 4));
  EXPECT_EQ(m.alpha_mode, AlphaMode::Mask);
  EXPECT_EQ(m.alpha_cutoff, 0.125);
  EXPECT_TRUE(m.double_sided);
  EXPECT_EQ(m.sheen.color_factor, glm::dvec3(0.9, 0.8, 0.7));
  EXPECT_EQ(m.sheen.roughness_factor, 0.6);
  EXPECT_EQ(m.clearcoat.factor, 0.5);
  EXPECT_EQ(m.clearcoat.roughness_factor, 0.1);
  EXPECT_EQ(m.specular.factor, 0.2);
  EXPECT_EQ(m.specular.color_factor, glm::dvec3(2, 3, 4));
  EXPECT_EQ(m.ior, 1.25);
}

TEST(GltfMaterials, PrimitivesWithoutMaterialShareOneDefaultMaterial) {
  Asset asset = triangle();
  asset.primitive().erase("material");
  json& primitives = asset.document["meshes"][0]["primitives"];
  primitives.push_back(asset.primitive());
  const Scene scene = load(asset);
  ASSERT_EQ(scene.materials.size(), 2U);
  EXPECT_EQ(scene.primitives.at(0).material, 1);
  EXPECT_EQ(scene.primitives.at(1).material, 1);
  asset.primitive()["material"] = 1;
  EXPECT_TRUE(names(error_of(asset), "meshes[0] 'patch'", "material is 1, out of range"));
}

TEST(GltfMaterials, LayersExcludeOtherMaterialModels) {
  for (const char* layer : {"KHR_materials_sheen", "KHR_materials_clearcoat", "KHR_materials_specular", "KHR_materials_ior"}) {
    for (const char* other : {"KHR_materials_pbrSpecularGlossiness", "KHR_materials_unlit"}) {
      Asset asset = with_extension(layer, json::object());
      asset.material()["extensions"][other] = json::object();
      const std::string message = error_of(asset);
      EXPECT_TRUE(names(message, cloth, std::string("must not be used on a material that also uses ") + other));
      EXPECT_NE(message.find(layer), std::string::npos) << message;
    }
  }
  EXPECT_EQ(load(with_extension("KHR_materials_unlit", json::object())).warnings.size(), 1U);
}

TEST(GltfMaterials, FactorsOutsideTheirSchemaAreRefused) {
  const struct {
    const char* extension;
    const char* member;
    json value;
  } wrong[] = {
      {"KHR_materials_sheen", "sheenRoughnessFactor", 1.5},
      {"KHR_materials_sheen", "sheenRoughnessFactor", -0.1},
      {"KHR_materials_sheen", "sheenColorFactor", {0.5, 0.5, 1.01}},
      {"KHR_materials_sheen", "sheenColorFactor", {0.5, 0.5}},
      {"KHR_materials_sheen", "sheenColorFactor", 0.5},
      {"KHR_materials_sheen", "sheenRoughnessFactor", "rough"},
      {"KHR_materials_sheen", "sheenRoughnessFactor", nullptr},
      {"KHR_materials_sheen", "sheenColorTexture", 0},
      {"KHR_materials_clearcoat", "clearcoatFactor", 2},
      {"KHR_materials_clearcoat", "clearcoatRoughnessFactor", 4294967296},
      {"KHR_materials_clearcoat", "clearcoatFactor", true},
      {"KHR_materials_specular", "specularFactor", 1.1},
      {"KHR_materials_specular", "specularColorFactor", {1, 1, -1}},
      {"KHR_materials_ior", "ior", 0.5},
      {"KHR_materials_ior", "ior", -1},
      {"KHR_materials_emissive_strength", "emissiveStrength", -1},
  };
  for (const auto& w : wrong) {
    const std::string message = error_of(with_extension(w.extension, {{w.member, w.value}}));
    EXPECT_TRUE(names(message, cloth, std::string(w.extension) + "." + w.member)) << w.value;
  }
  EXPECT_TRUE(names(error_of(with_extension("KHR_materials_sheen", 7)), cloth, "must be an object"));
  EXPECT_EQ(load(with_extension("KHR_materials_ior", {{"ior", 0}})).materials[0].ior, 0.0);
}

TEST(GltfMaterials, CoreFactorsOutsideTheirSchemaAreRefused) {
  for (const json& pbr : {json{{"metallicFactor", 1.1}}, json{{"roughnessFactor", -1}}, json{{"baseColorFactor", {1, 1, 1, 2}}},
                          json{{"baseColorFactor", {1, 1, 1}}}, json{{"roughnessFactor", json::array({1})}}}) {
    Asset asset = triangle();
    asset.material()["pbrMetallicRoughness"] = pbr;
    EXPECT_TRUE(names(error_of(asset), cloth, "pbrMetallicRoughness." + pbr.begin().key()));
  }
  Asset asset = triangle();
  asset.material()["emissiveFactor"] = {0, 0, 3};
  EXPECT_TRUE(names(error_of(asset), cloth, "emissiveFactor is 3.0, outside [0.0, 1.0] (glTF 2.0)"));
  asset = triangle();
  asset.material()["alphaMode"] = "BLENDED";
  EXPECT_TRUE(names(error_of(asset), cloth, "alphaMode is 'BLENDED'"));
  asset = triangle();
  asset.material()["alphaCutoff"] = -1;
  EXPECT_TRUE(names(error_of(asset), cloth, "alphaCutoff"));
  asset = triangle();
  asset.material()["doubleSided"] = 1;
  EXPECT_TRUE(names(error_of(asset), cloth, "doubleSided must be true or false"));
  asset = triangle();
  asset.document["materials"] = 3;
  EXPECT_TRUE(names(error_of(asset), "document", "materials must be an array"));
  asset.document["materials"] = json::array({3});
  EXPECT_TRUE(names(error_of(asset), "document", "materials[0] must be an object"));
}

}  // namespace
}  // namespace sheen::scene::test
