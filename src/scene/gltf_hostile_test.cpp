// Whatever a file holds, loading it gives a scene or an Error: nothing else is thrown, nothing crashes (the sanitizers watch), and what is
// loaded keeps the promises of scene.h.
#include <cmath>
#include <random>

#include "scene/gltf_fixture_test.h"

namespace sheen::scene::test {
namespace {

// A binary asset with something of everything.
Bytes rich_glb() {
  Asset asset = triangle();
  const int texture = asset.add_texture(png(2, 2, 8, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16}));
  const int photo = asset.add_texture(jpeg(), "image/jpeg");
  asset.attributes()["COLOR_0"] = asset.add_accessor<std::uint8_t>({255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255}, 5121, "VEC4", 3, true);
  asset.material()["normalTexture"]["index"] = texture;
  asset.material()["extensions"]["KHR_materials_sheen"] = {{"sheenColorFactor", {1, 1, 1}}, {"sheenColorTexture", {{"index", photo}}}};
  asset.document["cameras"] = json::array({{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}}});
  asset.document["extensions"]["KHR_lights_punctual"]["lights"] = json::array({{{"type", "point"}}});
  asset.document["nodes"] = json::array({{{"mesh", 0}, {"children", {1}}}, {{"camera", 0}, {"rotation", {0, 0, 0, 1}}}});
  asset.document["nodes"][1]["extensions"]["KHR_lights_punctual"]["light"] = 0;
  const int indices = asset.add_view(bytes_of<std::uint8_t>({2}));
  const int values = asset.add_view(bytes_of<float>({0, 2, 0}));
  json sparse = {{"count", 1}};
  sparse["indices"] = {{"bufferView", indices}, {"componentType", 5121}};
  sparse["values"] = {{"bufferView", values}};
  asset.document["accessors"][0]["sparse"] = sparse;
  return asset.glb();
}

void expect_promises(const Scene& scene) {
  for (const Texture& texture : scene.textures) {
    ASSERT_LT(static_cast<std::size_t>(texture.picture), scene.pictures.size());
  }
  for (const Picture& picture : scene.pictures) {
    ASSERT_EQ(picture.codes.size(), static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height) * 4);
  }
  for (const Primitive& primitive : scene.primitives) {
    const std::size_t vertices = primitive.positions.size();
    ASSERT_EQ(primitive.normals.size(), vertices);
    ASSERT_EQ(primitive.indices.size() % 3, 0U);
    ASSERT_LT(static_cast<std::size_t>(primitive.material), scene.materials.size());
    if (scene.materials[static_cast<std::size_t>(primitive.material)].normal_texture.present()) {
      ASSERT_EQ(primitive.tangents.size(), vertices);
      ASSERT_EQ(primitive.texcoords[0].size(), vertices);
    }
    for (const std::uint32_t index : primitive.indices) {
      ASSERT_LT(index, vertices);
    }
    for (const glm::vec3& p : primitive.positions) {
      ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
    }
  }
  for (const Instance& instance : scene.instances) {
    ASSERT_LT(static_cast<std::size_t>(instance.primitive), scene.primitives.size());
  }
}

// Loads whatever it is; true when it was a scene.
bool survives(const TemporaryFolder& folder, const Bytes& bytes) {
  try {
    expect_promises(load_gltf(folder.write("asset.glb", bytes)));
    return true;
  } catch (const Error&) {
    return false;
  }
}

TEST(GltfHostile, TheWholeFileLoads) {
  const TemporaryFolder folder;
  EXPECT_TRUE(survives(folder, rich_glb()));
}

TEST(GltfHostile, EveryTruncationIsAnError) {
  const TemporaryFolder folder;
  const Bytes whole = rich_glb();
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_FALSE(survives(folder, Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)))) << size;
  }
}

TEST(GltfHostile, EveryTruncatedChunkIsHandled) {
  const TemporaryFolder folder;
  Bytes whole = rich_glb();
  for (std::size_t size = whole.size(); size > 0; size -= std::min<std::size_t>(size, 5)) {
    Bytes bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
    if (bytes.size() < 12) {
      break;
    }
    for (std::size_t i = 0; i < 4; ++i) {
      bytes[8 + i] = static_cast<std::uint8_t>(size >> (8 * i));
    }
    survives(folder, bytes);
  }
}

TEST(GltfHostile, FlippedBitsNeverCrash) {
  const TemporaryFolder folder;
  const Bytes whole = rich_glb();
  std::mt19937 random(20260101);
  int loaded = 0;
  for (int i = 0; i < 1000; ++i) {
    Bytes bytes = whole;
    for (std::uint32_t flips = 1 + random() % 3; flips > 0; --flips) {
      bytes[random() % bytes.size()] ^= static_cast<std::uint8_t>(1U << (random() % 8));
    }
    loaded += survives(folder, bytes) ? 1 : 0;
  }
  EXPECT_GT(loaded, 0) << "some flips only change a colour";
}

TEST(GltfHostile, ReplacedValuesNeverCrash) {
  const TemporaryFolder folder;
  const Bytes whole = rich_glb();
  const std::string text(whole.begin(), whole.end());
  std::mt19937 random(7);
  const char digits[] = "0123456789-.eE[]{}\",:";
  for (int i = 0; i < 800; ++i) {
    Bytes bytes = whole;
    // Within the JSON: digits become other digits or punctuation, so that documents stay nearly well formed.
    const std::size_t json_size = bytes[12] | static_cast<std::size_t>(bytes[13]) << 8U;
    std::size_t at = 20 + random() % json_size;
    while (at < 20 + json_size && std::isdigit(bytes[at]) == 0) {
      ++at;
    }
    if (at == 20 + json_size) {
      continue;
    }
    bytes[at] = static_cast<std::uint8_t>(digits[random() % (i % 2 == 0 ? 10 : sizeof digits - 1)]);
    survives(folder, bytes);
  }
}

}  // namespace
}  // namespace sheen::scene::test
