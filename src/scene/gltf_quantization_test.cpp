// KHR_mesh_quantization, table "Extending Mesh Attributes", against the core's, glTF 2.0, section 3.7.2.1.
#include <algorithm>
#include <array>
#include <string>

#include "scene/gltf_fixture_test.h"

namespace sheen::scene::test {
namespace {

struct Form {
  int component;
  bool normalized;
};
constexpr Form forms[] = {{5120, false}, {5120, true},  {5121, false}, {5121, true},  {5122, false},
                          {5122, true},  {5123, false}, {5123, true},  {5125, false}, {5126, false}};

// One letter a form, in their order: c the core allows it, q the extension alone, - neither.
struct Row {
  const char* attribute;
  const char* type;
  int components;
  const char* allowed;
};
constexpr Row table[] = {
    {"POSITION", "VEC3", 3, "qqqqqqqq-c"},   {"NORMAL", "VEC3", 3, "-q---q---c"},     {"TANGENT", "VEC4", 4, "-q---q---c"},
    {"TEXCOORD_0", "VEC2", 2, "qqqcqqqc-c"}, {"TEXCOORD_1", "VEC2", 2, "qqqcqqqc-c"}, {"COLOR_0", "VEC4", 4, "---c---c-c"},
};

// A triangle whose attribute is stored in a form, in elements 4 bytes apart or a multiple of it; the extension in the lists given.
Asset with(const Row& row, const Form& form, std::initializer_list<const char*> lists) {
  Asset asset = triangle();
  const std::size_t size = form.component <= 5121 ? 1 : form.component <= 5123 ? 2 : 4;
  const std::size_t stride = (static_cast<std::size_t>(row.components) * size + 3) / 4 * 4;
  Bytes bytes(3 * stride, 0);
  for (std::size_t vertex = 0; vertex < 3; ++vertex) {
    bytes[vertex * stride + vertex % 2 * size] = 1;
  }
  const int index = asset.add_accessor(bytes, form.component, row.type, 3, form.normalized);
  const std::size_t view = asset.document["accessors"][static_cast<std::size_t>(index)]["bufferView"];
  asset.document["bufferViews"][view]["byteStride"] = stride;
  asset.attributes()[row.attribute] = index;
  for (const char* list : lists) {
    asset.document[list] = {"KHR_mesh_quantization"};
  }
  return asset;
}

TEST(GltfQuantization, EveryFormOfTheTableIsReadAndNoOther) {
  for (const Row& row : table) {
    for (std::size_t i = 0; i < std::size(forms); ++i) {
      const std::string form =
          std::string(row.attribute) + " of " + std::to_string(forms[i].component) + (forms[i].normalized ? " normalized" : "");
      const Asset asset = with(row, forms[i], {"extensionsUsed", "extensionsRequired"});
      if (row.allowed[i] != '-') {
        EXPECT_NO_THROW(load(asset)) << form;
      } else {
        EXPECT_TRUE(names(error_of(asset), "meshes[0] 'patch'", "which KHR_mesh_quantization does not allow either (section 3.7.2.1)"))
            << form;
        EXPECT_TRUE(names(error_of(asset), "meshes[0] 'patch'", row.attribute)) << form;
      }
    }
  }
}

TEST(GltfQuantization, WithoutTheExtensionOnlyTheFormsOfTheCoreAreRead) {
  for (const Row& row : table) {
    for (std::size_t i = 0; i < std::size(forms); ++i) {
      const Asset asset = with(row, forms[i], {});
      const std::string rule = row.allowed[i] == 'q' ? "which only KHR_mesh_quantization allows, and extensionsRequired does not name it"
                                                     : "which it must not have (section 3.7.2.1)";
      if (row.allowed[i] == 'c') {
        EXPECT_NO_THROW(load(asset)) << row.attribute << " " << i;
      } else {
        EXPECT_TRUE(names(error_of(asset), "meshes[0] 'patch'", rule)) << row.attribute << " " << i;
      }
    }
  }
}

TEST(GltfQuantization, AFileThatDoesNotRequireTheExtensionIsReadAndWarnedOf) {
  const Row& positions = table[0];
  EXPECT_TRUE(load(with(positions, forms[0], {"extensionsRequired"})).warnings.empty());
  const Scene scene = load(with(positions, forms[0], {"extensionsUsed"}));
  ASSERT_EQ(scene.warnings.size(), 1U);
  EXPECT_NE(scene.warnings[0].find("must stand in extensionsRequired"), std::string::npos);
}

// max(c / 127, -1), c / 255, max(c / 32767, -1), c / 65535, or the integer itself.
TEST(GltfQuantization, CodesBecomeTheNumbersOfTheExtension) {
  Asset asset = triangle();
  asset.document["extensionsUsed"] = asset.document["extensionsRequired"] = {"KHR_mesh_quantization"};
  const auto first = [&](int accessor) {
    asset.attributes()["TEXCOORD_0"] = accessor;
    return load(asset).primitives[0].texcoords[0][0];
  };
  EXPECT_EQ(first(asset.add_accessor<std::int8_t>({-128, 127, 0, 0, 0, 0}, 5120, "VEC2", 3)), glm::vec2(-128, 127));
  EXPECT_EQ(first(asset.add_accessor<std::int8_t>({-128, 127, 0, 0, 0, 0}, 5120, "VEC2", 3, true)), glm::vec2(-1, 1));
  EXPECT_EQ(first(asset.add_accessor<std::uint8_t>({51, 255, 0, 0, 0, 0}, 5121, "VEC2", 3)), glm::vec2(51, 255));
  EXPECT_EQ(first(asset.add_accessor<std::uint8_t>({51, 255, 0, 0, 0, 0}, 5121, "VEC2", 3, true)), glm::vec2(.2f, 1));
  EXPECT_EQ(first(asset.add_accessor<std::int16_t>({-32768, 32767, 0, 0, 0, 0}, 5122, "VEC2", 3)), glm::vec2(-32768, 32767));
  EXPECT_EQ(first(asset.add_accessor<std::int16_t>({-32768, 32767, 0, 0, 0, 0}, 5122, "VEC2", 3, true)), glm::vec2(-1, 1));
  EXPECT_EQ(first(asset.add_accessor<std::uint16_t>({13107, 65535, 0, 0, 0, 0}, 5123, "VEC2", 3)), glm::vec2(13107, 65535));
  EXPECT_EQ(first(asset.add_accessor<std::uint16_t>({13107, 65535, 0, 0, 0, 0}, 5123, "VEC2", 3, true)), glm::vec2(.2f, 1));
}

}  // namespace
}  // namespace sheen::scene::test
