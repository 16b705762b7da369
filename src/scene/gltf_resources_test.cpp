#include <filesystem>

#include "scene/gltf_fixture_test.h"

namespace sheen::scene::test {
namespace {

// The triangle with its buffer in a file of that name, referred to by that URI.
std::filesystem::path write_external(const TemporaryFolder& folder, const std::string& uri, const std::string& name,
                                     std::size_t extra_bytes = 0) {
  const Asset asset = triangle();
  Bytes buffer = asset.buffer;
  buffer.resize(buffer.size() + extra_bytes);
  folder.write(name, buffer);
  json document = asset.document;
  document["buffers"] = json::array({json::object({{"byteLength", asset.buffer.size()}, {"uri", uri}})});
  return folder.write("asset.gltf", document.dump());
}

std::string error_of_uri(const std::string& uri) {
  const TemporaryFolder folder;
  folder.write("outside.bin", triangle().buffer);
  json document = triangle().document;
  document["buffers"] = json::array({json::object({{"byteLength", triangle().buffer.size()}, {"uri", uri}})});
  return error_of_file(folder.write("asset/asset.gltf", document.dump()));
}

TEST(GltfResources, EmbeddedExternalAndBinaryFilesGiveTheSameScene) {
  const TemporaryFolder folder;
  const std::string embedded = content_hash(load(triangle()));
  EXPECT_EQ(content_hash(load_gltf(folder.write("asset.glb", triangle().glb()))), embedded);
  EXPECT_EQ(content_hash(load_gltf(write_external(folder, "data.bin", "data.bin"))), embedded);
}

TEST(GltfResources, UrisArePercentDecodedAndKeepPlusSigns) {
  const TemporaryFolder folder;
  EXPECT_EQ(load_gltf(write_external(folder, "my%20data+1.bin", "my data+1.bin")).primitives.size(), 1U);
  EXPECT_EQ(load_gltf(write_external(folder, "sub/../sub/./data.bin", "sub/data.bin")).primitives.size(), 1U);
}

TEST(GltfResources, ExternalFileMayBeLongerThanItsBuffer) {
  const TemporaryFolder folder;
  EXPECT_EQ(load_gltf(write_external(folder, "data.bin", "data.bin", 7)).primitives.size(), 1U);
}

TEST(GltfResources, DataUriMayHaveAnyMediaTypeAndLackPadding) {
  json document = triangle().embedded();
  std::string payload = base64(triangle().buffer);
  while (payload.back() == '=') {
    payload.pop_back();
  }
  document["buffers"][0]["uri"] = "data:model/x;charset=utf-8;base64," + payload;
  EXPECT_EQ(load_text(document.dump()).primitives.size(), 1U);
}

TEST(GltfResources, UrisThatLeaveTheAssetsFolderAreRefused) {
  for (const char* uri : {"../outside.bin", "sub/../../outside.bin", "%2e%2e/outside.bin", "..%2Foutside.bin", "/etc/passwd",
                          "%2Fetc/passwd", "//host/x.bin", "..\\outside.bin", "./../outside.bin"}) {
    EXPECT_TRUE(names(error_of_uri(uri), "buffers[0]", "leaves the asset's folder")) << uri;
  }
  for (const char* uri : {"http://example.org/x.bin", "file:///etc/passwd", "C:/x.bin"}) {
    EXPECT_TRUE(names(error_of_uri(uri), "buffers[0]", "has a scheme")) << uri;
  }
}

TEST(GltfResources, BrokenUrisAreRefused) {
  EXPECT_TRUE(names(error_of_uri(""), "buffers[0]", "is empty"));
  EXPECT_TRUE(names(error_of_uri("%zz.bin"), "buffers[0]", "percent sign"));
  EXPECT_TRUE(names(error_of_uri("."), "buffers[0]", "names no file"));
  EXPECT_TRUE(names(error_of_uri("absent.bin"), "buffers[0]", "no such file"));
  EXPECT_TRUE(names(error_of_uri("data:application/octet-stream;base64,####"), "buffers[0]", "not base64"));
  EXPECT_TRUE(names(error_of_uri("data:application/octet-stream;base64,AAAAA"), "buffers[0]", "not base64"));
  EXPECT_TRUE(names(error_of_uri("data:text/plain,abc"), "buffers[0]", ";base64,"));
}

TEST(GltfResources, MissingOrShortBuffersAreRefused) {
  json document = triangle().embedded();
  document["buffers"][0].erase("uri");
  EXPECT_TRUE(names(error_of_text(document.dump()), "buffers[0]", "is missing"));
  document = triangle().embedded();
  document["buffers"][0]["byteLength"] = triangle().buffer.size() + 1;
  EXPECT_TRUE(names(error_of_text(document.dump()), "buffers[0]", "there are only"));
  document["buffers"][0]["byteLength"] = 0;
  EXPECT_TRUE(names(error_of_text(document.dump()), "buffers[0]", "is 0"));
  document = triangle().document;
  EXPECT_TRUE(names(error_of_text(document.dump()), "bufferViews[0]", "there are 0 buffers"));
}

TEST(GltfResources, BufferViewsMustLieInsideTheirBuffer) {
  Asset asset = triangle();
  asset.document["bufferViews"][0]["byteOffset"] = asset.buffer.size();
  EXPECT_TRUE(names(error_of(asset), "bufferViews[0]", "reaches past the end of buffers[0]"));
  asset.document["bufferViews"][0]["byteOffset"] = 9007199254740992.0;
  EXPECT_TRUE(names(error_of(asset), "bufferViews[0]", "reaches past the end of buffers[0]"));
  asset.document["bufferViews"][0]["byteOffset"] = -4;
  EXPECT_TRUE(names(error_of(asset), "bufferViews[0]", "whole number"));
  asset.document["bufferViews"][0]["byteOffset"] = 1e300;
  EXPECT_TRUE(names(error_of(asset), "bufferViews[0]", "whole number"));
  for (const int stride : {2, 13, 256}) {
    asset = triangle();
    asset.document["bufferViews"][0]["byteStride"] = stride;
    EXPECT_TRUE(names(error_of(asset), "bufferViews[0]", "multiple of 4 in [4, 252]")) << stride;
  }
}

TEST(GltfResources, OtherFilesAreNotGltf) {
  const TemporaryFolder folder;
  EXPECT_TRUE(names(error_of_file(folder.path() / "absent.glb"), "file", "no such file"));
  EXPECT_TRUE(names(error_of_file(folder.path()), "file", "not a regular file"));
  EXPECT_TRUE(names(error_of_text(""), "file", "is empty"));
  EXPECT_TRUE(names(error_of_text("solid cube"), "document", "is not JSON"));
  EXPECT_TRUE(names(error_of_text("[]"), "document", "must be a JSON object"));
  EXPECT_TRUE(names(error_of_text("{}"), "document", "asset is required"));
}

TEST(GltfResources, BinaryContainersAreChecked) {
  const TemporaryFolder folder;
  const Bytes whole = triangle().glb();
  const auto error_with = [&](std::size_t offset, std::uint8_t value) {
    Bytes bytes = whole;
    bytes[offset] = value;
    return error_of_file(folder.write("asset.glb", bytes));
  };
  EXPECT_TRUE(names(error_with(4, 1), "GLB header", "version is 1"));
  EXPECT_TRUE(names(error_with(11, 1), "GLB header", "truncated"));
  EXPECT_TRUE(names(error_with(15, 1), "GLB chunk 0", "past the end"));
  EXPECT_TRUE(names(error_with(16, 0), "GLB chunk 0", "must be JSON"));
  Bytes truncated(whole.begin(), whole.end() - 4);
  EXPECT_TRUE(names(error_of_file(folder.write("asset.glb", truncated)), "GLB header", "truncated"));
}

TEST(GltfDocument, VersionMustBeTwo) {
  Asset asset = triangle();
  asset.document["asset"]["version"] = "1.0";
  EXPECT_TRUE(names(error_of(asset), "document", "must be 2.0"));
  asset.document["asset"]["version"] = 2.0;
  EXPECT_TRUE(names(error_of(asset), "document", "must be a string"));
  asset.document["asset"] = {{"version", "2.1"}, {"minVersion", "2.1"}};
  EXPECT_TRUE(names(error_of(asset), "document", "minVersion"));
}

TEST(GltfDocument, UnknownRequiredExtensionsAreRefusedAndUsedOnesWarnedOf) {
  Asset asset = triangle();
  asset.document["extensionsUsed"] = {"KHR_materials_sheen", "KHR_materials_volume"};
  asset.document["extensionsRequired"] = {"KHR_materials_sheen"};
  const Scene scene = load(asset);
  ASSERT_EQ(scene.warnings.size(), 1U);
  EXPECT_NE(scene.warnings[0].find("KHR_materials_volume"), std::string::npos);
  asset.document["extensionsRequired"] = {"KHR_materials_volume"};
  EXPECT_TRUE(names(error_of(asset), "document", "extensionsRequired holds KHR_materials_volume, which is not supported"));
}

TEST(GltfDocument, RequiredEncodingsAreRefusedWithTheCommandThatTakesThemOut) {
  const std::pair<const char*, const char*> extensions[] = {{"KHR_draco_mesh_compression", "gltf-transform copy IN OUT"},
                                                            {"EXT_meshopt_compression", "gltf-transform copy IN OUT"},
                                                            {"KHR_texture_basisu", "gltf-transform ktxdecompress IN OUT"},
                                                            {"EXT_texture_webp", "gltf-transform png IN OUT --formats webp"},
                                                            {"EXT_texture_avif", "gltf-transform png IN OUT --formats avif"}};
  for (const auto& [extension, advice] : extensions) {
    Asset asset = triangle();
    asset.document["extensionsUsed"] = {extension};
    asset.document["extensionsRequired"] = {extension};
    EXPECT_TRUE(names(error_of(asset), "document", extension));
    EXPECT_TRUE(names(error_of(asset), "document", advice));
  }
}

TEST(GltfDocument, NumbersThatAreNotFiniteNameTheirPlace) {
  const auto error_with = [](const char* number) {
    std::string document = R"({"asset":{"version":"2.0"},"materials":[{},{"pbrMetallicRoughness":{"roughnessFactor":)";
    document.append(number).append("}}]}");
    return error_of_text(document);
  };
  const char* place = "materials[1].pbrMetallicRoughness.roughnessFactor";
  EXPECT_TRUE(names(error_with("1e999"), place, "not finite"));
  EXPECT_TRUE(names(error_with("-1e999"), place, "not finite"));
  EXPECT_TRUE(names(error_with("NaN"), place, "is not JSON"));
}

TEST(GltfDocument, RepeatedMembersAndAbsurdNestingAreRefused) {
  EXPECT_TRUE(names(error_of_text(R"({"asset":{"version":"2.0","version":"2.0"}})"), "asset.version", "given twice"));
  const std::string deep = R"({"asset":{"version":"2.0"},"extras":)" + std::string(100000, '[') + std::string(100000, ']') + "}";
  EXPECT_TRUE(names(error_of_text(deep), "extras", "nested deeper"));
}

}  // namespace
}  // namespace sheen::scene::test
