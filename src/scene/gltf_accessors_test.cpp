#include "scene/gltf_accessors.h"

#include <cmath>
#include <limits>

#include "scene/gltf_fixture_test.h"

namespace sheen::scene::test {
namespace {

using Indices = std::vector<std::uint32_t>;

Indices indices_with_mode(int mode, std::initializer_list<std::uint8_t> order) {
  Asset asset = triangle();
  asset.attributes() = {{"POSITION", asset.add_accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 2, 1, 0}, 5126, "VEC3", 5)}};
  asset.primitive()["indices"] = asset.add_accessor(order, 5121, "SCALAR", static_cast<int>(order.size()));
  asset.primitive()["mode"] = mode;
  asset.attributes()["NORMAL"] = asset.add_accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, 5126, "VEC3", 5);
  return load(asset).primitives[0].indices;
}

template <class T>
std::vector<glm::vec2> texcoords(std::initializer_list<T> values, int component_type, bool normalized) {
  Asset asset = triangle();
  asset.attributes()["TEXCOORD_0"] = asset.add_accessor(values, component_type, "VEC2", 3, normalized);
  return load(asset).primitives[0].texcoords[0];
}

TEST(GltfAccessors, EveryIndexTypeIsRead) {
  Asset asset = triangle();
  asset.primitive()["indices"] = asset.add_accessor<std::uint8_t>({2, 0, 1}, 5121, "SCALAR", 3);
  EXPECT_EQ(load(asset).primitives[0].indices, (Indices{2, 0, 1}));
  asset.primitive()["indices"] = asset.add_accessor<std::uint16_t>({1, 2, 0}, 5123, "SCALAR", 3);
  EXPECT_EQ(load(asset).primitives[0].indices, (Indices{1, 2, 0}));
  asset.primitive()["indices"] = asset.add_accessor<std::uint32_t>({0, 2, 1}, 5125, "SCALAR", 3);
  EXPECT_EQ(load(asset).primitives[0].indices, (Indices{0, 2, 1}));
  asset.primitive().erase("indices");
  EXPECT_EQ(load(asset).primitives[0].indices, (Indices{0, 1, 2}));
}

// glTF 2.0, section 3.6.2.2: c / 255 and c / 65535.
TEST(GltfAccessors, NormalizedTexcoordsSpanTheUnitInterval) {
  const std::vector<glm::vec2> bytes = texcoords<std::uint8_t>({0, 255, 51, 102, 1, 2}, 5121, true);
  EXPECT_EQ(bytes[0], glm::vec2(0.0f, 1.0f));
  EXPECT_EQ(bytes[1], glm::vec2(0.2f, 0.4f));
  const std::vector<glm::vec2> shorts = texcoords<std::uint16_t>({0, 65535, 13107, 26214, 1, 2}, 5123, true);
  EXPECT_EQ(shorts[0], glm::vec2(0.0f, 1.0f));
  EXPECT_EQ(shorts[1], glm::vec2(0.2f, 0.4f));
}

// KHR_mesh_quantization allows signed types: max(c / 127, -1) and max(c / 32767, -1), or the integer itself.
TEST(GltfAccessors, QuantizedAttributesAreReadWhereTheExtensionIsUsed) {
  Asset asset = triangle();
  const int bytes = asset.add_accessor<std::int8_t>({0, 0, 127, 0, 0, 127, 0, -128, 0}, 5120, "VEC3", 3, true);
  asset.attributes()["NORMAL"] = bytes;
  EXPECT_TRUE(names(error_of(asset), "meshes[0] 'patch'", "NORMAL"));
  asset.document["extensionsUsed"] = {"KHR_mesh_quantization"};
  asset.document["extensionsRequired"] = {"KHR_mesh_quantization"};
  EXPECT_EQ(load(asset).primitives[0].normals[0], glm::vec3(0, 0, 1));
  EXPECT_EQ(load(asset).primitives[0].normals[2], glm::vec3(0, -1, 0));
  asset.attributes()["POSITION"] = asset.add_accessor<std::int16_t>({-7, 0, 0, 300, 0, 0, 0, 1, 0}, 5122, "VEC3", 3);
  EXPECT_EQ(load(asset).primitives[0].positions[1], glm::vec3(300, 0, 0));
  asset.attributes()["POSITION"] = asset.add_accessor<std::int16_t>({-32768, 0, 0, 32767, 0, 0, 0, 1, 0}, 5122, "VEC3", 3, true);
  EXPECT_EQ(load(asset).primitives[0].positions[0].x, -1.0f);
  EXPECT_EQ(load(asset).primitives[0].positions[1].x, 1.0f);
}

TEST(GltfAccessors, ColorsAreReadInEveryFormAndRgbGetsAlphaOne) {
  Asset asset = triangle();
  asset.attributes()["COLOR_0"] = asset.add_accessor<float>({1, 0, 0, 0, 1, 0, 0, 0, .5f}, 5126, "VEC3", 3);
  EXPECT_EQ(load(asset).primitives[0].colors[2], glm::vec4(0, 0, .5f, 1));
  asset.attributes()["COLOR_0"] = asset.add_accessor<float>({1, 0, 0, .25f, 0, 1, 0, 1, 0, 0, 1, 1}, 5126, "VEC4", 3);
  EXPECT_EQ(load(asset).primitives[0].colors[0], glm::vec4(1, 0, 0, .25f));
  asset.attributes()["COLOR_0"] = asset.add_accessor<std::uint8_t>({255, 0, 0, 51, 0, 0, 0, 0, 0, 0, 0, 0}, 5121, "VEC4", 3, true);
  EXPECT_EQ(load(asset).primitives[0].colors[0], glm::vec4(1, 0, 0, .2f));
  asset.attributes()["COLOR_0"] = asset.add_accessor<std::uint8_t>({255, 0, 51, 0, 0, 0, 0, 0, 0}, 5121, "VEC3", 3, true);
  EXPECT_EQ(load(asset).primitives[0].colors[0], glm::vec4(1, 0, .2f, 1));
  asset.attributes()["COLOR_0"] = asset.add_accessor<std::uint16_t>({0, 65535, 0, 0, 0, 0, 0, 0, 0}, 5123, "VEC3", 3, true);
  EXPECT_EQ(load(asset).primitives[0].colors[0], glm::vec4(0, 1, 0, 1));
  asset.attributes()["COLOR_0"] = asset.add_accessor<std::uint8_t>({255, 0, 51, 0, 0, 0, 0, 0, 0}, 5121, "VEC3", 3, false);
  EXPECT_TRUE(names(error_of(asset), "meshes[0] 'patch'", "COLOR_0"));
  for (const float outside : {-1e-45F, std::nextafter(1.0F, 2.0F)}) {
    asset.attributes()["COLOR_0"] = asset.add_accessor<float>({1, 0, 0, 0, 1, outside, 0, 0, 1}, 5126, "VEC3", 3);
    EXPECT_TRUE(names(error_of(asset), "meshes[0] 'patch'", "vertex 1")) << outside;
  }
}

TEST(GltfAccessors, InterleavedAttributesAreTakenApart) {
  Asset asset = triangle();
  const int view = asset.add_view(bytes_of<float>({0, 0, 0, .1f, .2f, 2, 0, 0, .3f, .4f, 0, 3, 0, .5f, .6f}));
  asset.document["bufferViews"][static_cast<std::size_t>(view)]["byteStride"] = 20;
  asset.document["accessors"].push_back({{"bufferView", view}, {"componentType", 5126}, {"type", "VEC3"}, {"count", 3}});
  asset.document["accessors"].push_back(
      {{"bufferView", view}, {"byteOffset", 12}, {"componentType", 5126}, {"type", "VEC2"}, {"count", 3}});
  const auto last = asset.document["accessors"].size() - 1;
  asset.attributes()["POSITION"] = last - 1;
  asset.attributes()["TEXCOORD_1"] = last;
  const Scene scene = load(asset);
  EXPECT_EQ(scene.primitives[0].positions[2], glm::vec3(0, 3, 0));
  EXPECT_EQ(scene.primitives[0].texcoords[1][1], glm::vec2(.3f, .4f));
  EXPECT_EQ(scene.primitives[0].texcoords[0][0], glm::vec2(0, 1));
  asset.document["accessors"][last]["byteOffset"] = 16;
  EXPECT_TRUE(names(error_of(asset), "accessors[5]", "past the end of bufferViews[4]"));
}

TEST(GltfAccessors, SparseValuesReplaceThoseOfTheViewOrZeros) {
  Asset asset = triangle();
  const int indices = asset.add_view(bytes_of<std::uint16_t>({1, 2}));
  const int values = asset.add_view(bytes_of<float>({5, 0, 0, 0, 6, 0}));
  json sparse = {{"count", 2}};
  sparse["indices"] = {{"bufferView", indices}, {"componentType", 5123}};
  sparse["values"] = {{"bufferView", values}};
  asset.document["accessors"][0]["sparse"] = sparse;
  EXPECT_EQ(load(asset).primitives[0].positions[1], glm::vec3(5, 0, 0));
  EXPECT_EQ(load(asset).primitives[0].positions[2], glm::vec3(0, 6, 0));
  asset.document["accessors"][0].erase("bufferView");
  EXPECT_EQ(load(asset).primitives[0].positions[0], glm::vec3(0, 0, 0));
  EXPECT_EQ(load(asset).primitives[0].positions[1], glm::vec3(5, 0, 0));
  const std::size_t at = asset.document["bufferViews"][static_cast<std::size_t>(indices)]["byteOffset"];
  asset.buffer[at] = 2;
  EXPECT_TRUE(names(error_of(asset), "accessors[0]", "strictly increase"));
  asset.buffer[at + 2] = 3;
  EXPECT_TRUE(names(error_of(asset), "accessors[0]", "there are 3 elements"));
  asset.document["accessors"][0]["sparse"]["count"] = 4;
  EXPECT_TRUE(names(error_of(asset), "accessors[0]", "must lie in [1, 3]"));
}

// glTF 2.0, section 3.7.2.1: every other triangle of a strip turns round; a fan turns about its first vertex.
TEST(GltfAccessors, StripsAndFansBecomeTrianglesThatFaceTheSameWay) {
  EXPECT_EQ(indices_with_mode(5, {0, 1, 2, 3, 4}), (Indices{0, 1, 2, 1, 3, 2, 2, 3, 4}));
  EXPECT_EQ(indices_with_mode(6, {0, 1, 2, 3, 4}), (Indices{1, 2, 0, 2, 3, 0, 3, 4, 0}));
  EXPECT_EQ(indices_with_mode(4, {0, 1, 2, 2, 1, 3}), (Indices{0, 1, 2, 2, 1, 3}));
}

TEST(GltfAccessors, TopologiesMustFitTheNumberOfVertices) {
  Asset asset = triangle();
  asset.primitive()["indices"] = asset.add_accessor<std::uint8_t>({0, 1, 2, 0}, 5121, "SCALAR", 4);
  EXPECT_TRUE(names(error_of(asset), "meshes[0] 'patch'", "multiple of 3"));
  asset.primitive()["indices"] = asset.add_accessor<std::uint8_t>({0, 1}, 5121, "SCALAR", 2);
  asset.primitive()["mode"] = 5;
  EXPECT_TRUE(names(error_of(asset), "meshes[0] 'patch'", "at least 3"));
  asset.primitive()["mode"] = 7;
  EXPECT_TRUE(names(error_of(asset), "meshes[0] 'patch'", "at most 6"));
}

TEST(GltfAccessors, PointsAndLinesAreLeftOutWithAWarning) {
  Asset asset = triangle();
  asset.primitive()["mode"] = 1;
  const Scene scene = load(asset);
  EXPECT_TRUE(scene.primitives.empty());
  EXPECT_TRUE(scene.instances.empty());
  EXPECT_EQ(scene.warnings.size(), 1U);
}

TEST(GltfAccessors, IndicesMustNameVertices) {
  Asset asset = triangle();
  asset.primitive()["indices"] = asset.add_accessor<std::uint16_t>({0, 1, 3}, 5123, "SCALAR", 3);
  EXPECT_TRUE(names(error_of(asset), "accessors[4]", "index 2 is 3 but there are 3 vertices"));
  asset.primitive()["indices"] = asset.add_accessor<float>({0, 1, 2}, 5126, "SCALAR", 3);
  EXPECT_TRUE(names(error_of(asset), "accessors[5]", "for indices"));
  asset.primitive()["indices"] = 0;
  EXPECT_TRUE(names(error_of(asset), "accessors[0]", "must be SCALAR"));
  asset.primitive()["indices"] = 99;
  EXPECT_TRUE(names(error_of(asset), "meshes[0] 'patch'", "indices is 99, out of range"));
}

TEST(GltfAccessors, AttributesMustHaveOneElementAVertex) {
  Asset asset = triangle();
  asset.attributes()["NORMAL"] = asset.add_accessor<float>({0, 0, 1, 0, 0, 1}, 5126, "VEC3", 2);
  EXPECT_TRUE(names(error_of(asset), "meshes[0] 'patch'", "NORMAL has 2 elements but POSITION has 3"));
  asset.attributes()["NORMAL"] = 2;
  EXPECT_TRUE(names(error_of(asset), "meshes[0] 'patch'", "of type VEC2"));
  asset.attributes()["NORMAL"] = 77;
  EXPECT_TRUE(names(error_of(asset), "meshes[0] 'patch'", "NORMAL is 77, out of range"));
  asset.attributes()["NORMAL"] = "normal";
  EXPECT_TRUE(names(error_of(asset), "meshes[0] 'patch'", "must be a whole number"));
}

TEST(GltfAccessors, NaNAndInfinityAreRefused) {
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    Asset asset = triangle();
    asset.attributes()["POSITION"] = asset.add_accessor<float>({0, 0, 0, 1, bad, 0, 0, 1, 0}, 5126, "VEC3", 3);
    EXPECT_TRUE(names(error_of(asset), "accessors[4]", "element 1 is NaN or infinite"));
  }
}

TEST(GltfAccessors, CountsOffsetsAndTypesAreChecked) {
  const auto error_with = [](const char* key, const json& value) {
    Asset asset = triangle();
    asset.document["accessors"][0][key] = value;
    return error_of(asset);
  };
  EXPECT_TRUE(names(error_with("count", 4), "accessors[0]", "past the end"));
  EXPECT_TRUE(names(error_with("count", 0), "accessors[0]", "is 0"));
  EXPECT_TRUE(names(error_with("count", 4294967296), "accessors[0]", "past the end"));
  EXPECT_TRUE(names(error_with("count", 9007199254740991), "accessors[0]", "past the end"));
  EXPECT_TRUE(names(error_with("count", 2.5), "accessors[0]", "whole number"));
  EXPECT_TRUE(names(error_with("count", "3"), "accessors[0]", "whole number"));
  EXPECT_TRUE(names(error_with("byteOffset", 4), "accessors[0]", "past the end"));
  EXPECT_TRUE(names(error_with("componentType", 5124), "accessors[0]", "componentType is 5124"));
  EXPECT_TRUE(names(error_with("componentType", 5130), "accessors[0]", "componentType is 5130"));
  EXPECT_TRUE(names(error_with("type", "VEC5"), "accessors[0]", "VEC5"));
  EXPECT_TRUE(names(error_with("bufferView", 9), "accessors[0]", "bufferView is 9, out of range"));
  EXPECT_TRUE(names(error_with("normalized", true), "accessors[0]", "must not be true"));
}

TEST(GltfAccessors, ComponentsMustBeAligned) {
  Asset asset = triangle();
  const int view = asset.add_view(bytes_of<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 0}));
  asset.document["accessors"][0] = {{"bufferView", view}, {"byteOffset", 2}, {"componentType", 5126}, {"type", "VEC3"}, {"count", 3}};
  EXPECT_TRUE(names(error_of(asset), "accessors[0]", "multiples of the component's size, 4"));
}

TEST(GltfAccessors, AnAccessorOfZerosCannotAskForAnyAmountOfMemory) {
  Asset asset = triangle();
  asset.document["accessors"][0] = {{"componentType", 5126}, {"type", "VEC3"}, {"count", 1000000000}};
  EXPECT_TRUE(names(error_of(asset), "accessors[0]", "without a bufferView"));
}

}  // namespace
}  // namespace sheen::scene::test
