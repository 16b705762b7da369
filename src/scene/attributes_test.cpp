#include "scene/attributes.h"

#include <glm/geometric.hpp>

#include "scene/gltf_fixture_test.h"

namespace sheen::scene::test {
namespace {

// Two triangles of a unit square in the XY plane that share an edge, seen from +Z, with v growing downwards as in an image.
Primitive square() {
  Primitive p;
  p.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  p.normals.assign(4, {0, 0, 1});
  p.texcoords[0] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
  p.indices = {0, 1, 2, 0, 2, 3};
  return p;
}

glm::vec3 bitangent(const Primitive& p, std::size_t v) {
  return glm::cross(p.normals[v], glm::vec3(p.tangents[v])) * p.tangents[v].w;
}

TEST(Attributes, FlatNormalsAreThoseOfTheTriangleAndUnshareVertices) {
  Asset asset = triangle();
  asset.attributes() = {{"POSITION", asset.add_accessor<float>({0, 0, 0, 2, 0, 0, 0, 2, 0, 0, 0, 2}, 5126, "VEC3", 4)}};
  asset.attributes()["TANGENT"] = asset.add_accessor<float>({1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1}, 5126, "VEC4", 4);
  asset.attributes()["COLOR_0"] = asset.add_accessor<float>({1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1}, 5126, "VEC3", 4);
  asset.primitive()["indices"] = asset.add_accessor<std::uint8_t>({0, 1, 2, 0, 3, 1}, 5121, "SCALAR", 6);
  const Primitive p = load(asset).primitives.at(0);
  ASSERT_EQ(p.positions.size(), 6U);
  EXPECT_EQ(p.normals[0], glm::vec3(0, 0, 1));
  EXPECT_EQ(p.normals[4], glm::vec3(0, 1, 0));
  EXPECT_EQ(p.colors[4], glm::vec4(1, 1, 1, 1));
  EXPECT_EQ(p.indices, (std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5}));
  EXPECT_TRUE(p.tangents.empty()) << "glTF 2.0, section 3.7.2.1: without normals the tangents given are ignored";
}

TEST(Attributes, TriangleWithoutAreaStillGetsAUnitNormal) {
  Primitive p;
  p.positions = {{1, 2, 3}, {1, 2, 3}, {1, 2, 3}};
  p.indices = {0, 1, 2};
  make_flat_normals(p);
  EXPECT_EQ(p.normals[0], glm::vec3(0, 0, 1));
}

TEST(Attributes, TangentsFollowUAndBitangentsOpposeV) {
  Primitive p = square();
  make_tangents(p, TextureInfo{.texture = 0});
  ASSERT_EQ(p.tangents.size(), 6U);
  for (std::size_t v = 0; v < 6; ++v) {
    EXPECT_EQ(p.tangents[v], glm::vec4(1, 0, 0, 1));
    EXPECT_EQ(bitangent(p, v), glm::vec3(0, 1, 0)) << "green points up in the image";
  }
}

TEST(Attributes, MirroredCoordinatesTurnTheHandedness) {
  Primitive p = square();
  for (glm::vec2& uv : p.texcoords[0]) {
    uv.x = 1 - uv.x;
  }
  make_tangents(p, TextureInfo{.texture = 0});
  EXPECT_EQ(p.tangents[0], glm::vec4(-1, 0, 0, -1));
  EXPECT_EQ(bitangent(p, 0), glm::vec3(0, 1, 0));
}

TEST(Attributes, TangentsFollowTheSetAndTransformOfTheMap) {
  Primitive p = square();
  p.texcoords[1] = p.texcoords[0];
  p.texcoords[0].assign(4, {0, 0});
  TextureInfo info{.texture = 0, .texcoord = 1};
  // A quarter turn: u' = v, v' = -u, so u' grows along -Y and v' along -X.
  info.transform = glm::dmat3(0, -1, 0, 1, 0, 0, 0, 0, 1);
  make_tangents(p, info);
  EXPECT_EQ(p.tangents[0], glm::vec4(0, -1, 0, 1));
  EXPECT_EQ(bitangent(p, 0), glm::vec3(1, 0, 0));
}

TEST(Attributes, TheOffsetOfTheTransformCostsNoDigits) {
  Primitive given = square();
  given.texcoords[0][2] = {0.9f, 0.1f};
  Primitive shifted = given;
  TextureInfo info{.texture = 0};
  make_tangents(given, info);
  info.transform[2] = {1e9, -1e9, 1};
  make_tangents(shifted, info);
  EXPECT_EQ(shifted.tangents, given.tangents);
}

TEST(Attributes, TrianglesThatShareAVertexShareItsTangent) {
  Primitive p = square();
  p.texcoords[0][2] = {0.9f, 0.1f};
  make_tangents(p, TextureInfo{.texture = 0});
  EXPECT_EQ(p.tangents[0], p.tangents[3]);
  EXPECT_EQ(p.tangents[2], p.tangents[4]);
  EXPECT_NE(p.tangents[1], p.tangents[0]) << "one triangle alone";
}

// Quantized normals are not exactly unit (KHR_mesh_quantization, implementation note).
TEST(Attributes, TheLengthOfNormalsDoesNotTurnTangents) {
  Primitive unit = square();
  unit.normals.assign(4, {0.6f, 0, 0.8f});
  Primitive shorter = unit;
  shorter.normals.assign(4, {0.3f, 0, 0.4f});
  make_tangents(unit, TextureInfo{.texture = 0});
  make_tangents(shorter, TextureInfo{.texture = 0});
  for (std::size_t v = 0; v < 6; ++v) {
    EXPECT_NEAR(glm::length(shorter.tangents[v] - unit.tangents[v]), 0.0f, 1e-6f);
  }
}

TEST(Attributes, TangentsLieInThePlaneOfTheShadingNormal) {
  Primitive p = square();
  p.normals.assign(4, glm::normalize(glm::vec3(1, 0, 1)));
  make_tangents(p, TextureInfo{.texture = 0});
  EXPECT_NEAR(glm::dot(glm::vec3(p.tangents[0]), p.normals[0]), 0.0f, 1e-7f);
  EXPECT_NEAR(glm::length(glm::vec3(p.tangents[0])), 1.0f, 1e-7f);
}

TEST(Attributes, CoordinatesWithoutAreaStillGiveAFrame) {
  Primitive p = square();
  p.texcoords[0].assign(4, {0.5f, 0.5f});
  make_tangents(p, TextureInfo{.texture = 0});
  EXPECT_NEAR(glm::length(glm::vec3(p.tangents[0])), 1.0f, 1e-7f);
  EXPECT_EQ(glm::dot(glm::vec3(p.tangents[0]), p.normals[0]), 0.0f);
}

TEST(Attributes, TangentsAreMadeOnlyWhereANormalMapNeedsThem) {
  Asset asset = triangle();
  const int texture = asset.add_texture(png(1, 1, 8, {128, 128, 255, 255}));
  EXPECT_TRUE(load(asset).primitives[0].tangents.empty());
  asset.material()["extensions"]["KHR_materials_clearcoat"]["clearcoatNormalTexture"]["index"] = texture;
  EXPECT_EQ(load(asset).primitives[0].tangents.size(), 3U);
  asset.attributes()["TANGENT"] = asset.add_accessor<float>({0, 1, 0, -1, 0, 1, 0, -1, 0, 1, 0, -1}, 5126, "VEC4", 3);
  EXPECT_EQ(load(asset).primitives[0].tangents[0], glm::vec4(0, 1, 0, -1));
}

TEST(Attributes, VectorsOfLengthZeroAreReplacedAndWarnedOf) {
  Asset asset = triangle();
  asset.attributes()["NORMAL"] = asset.add_accessor<float>({0, 0, 0, 0, 0, 1, 0, 0, 1}, 5126, "VEC3", 3);
  asset.attributes()["TANGENT"] = asset.add_accessor<float>({0, 0, 0, 1, 1, 0, 0, -0.5f, 1, 0, 0, 1}, 5126, "VEC4", 3);
  const Scene scene = load(asset);
  EXPECT_EQ(scene.primitives[0].normals[0], glm::vec3(0, 0, 1));
  EXPECT_EQ(scene.primitives[0].tangents[0], glm::vec4(1, 0, 0, 1));
  EXPECT_EQ(scene.primitives[0].tangents[1].w, -1.0f);
  EXPECT_EQ(scene.warnings.size(), 1U);
}

}  // namespace
}  // namespace sheen::scene::test
