#include "scene/gltf_fixture_test.h"

#include <array>
#include <cstdlib>
#include <fstream>
#include <stdexcept>

namespace sheen::scene::test {
namespace {

void append_u32(Bytes& bytes, std::uint32_t value) {
  for (unsigned shift = 0; shift < 32; shift += 8) {
    bytes.push_back(static_cast<std::uint8_t>(value >> shift));
  }
}

void append_big_u32(Bytes& bytes, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) {
    bytes.push_back(static_cast<std::uint8_t>(value >> static_cast<unsigned>(shift)));
  }
}

// PNG (ISO/IEC 15948), annex D.
std::uint32_t crc32(const Bytes& bytes) {
  std::uint32_t crc = 0xFFFFFFFFU;
  for (const std::uint8_t byte : bytes) {
    crc ^= byte;
    for (int i = 0; i < 8; ++i) {
      crc = (crc >> 1U) ^ ((crc & 1U) != 0 ? 0xEDB88320U : 0U);
    }
  }
  return ~crc;
}

void append_chunk(Bytes& file, const char* type, const Bytes& data) {
  append_big_u32(file, static_cast<std::uint32_t>(data.size()));
  Bytes body(type, type + 4);
  body.insert(body.end(), data.begin(), data.end());
  file.insert(file.end(), body.begin(), body.end());
  append_big_u32(file, crc32(body));
}

// RFC 1950 and 1951: one stored block.
Bytes zlib_stored(const Bytes& data) {
  if (data.size() > 0xFFFF) {
    throw std::invalid_argument("one stored block holds 65535 bytes");
  }
  Bytes out = {0x78, 0x01, 0x01};
  const auto size = static_cast<std::uint16_t>(data.size());
  const auto inverse = static_cast<std::uint16_t>(~size);
  for (const std::uint16_t word : {size, inverse}) {
    out.push_back(static_cast<std::uint8_t>(word & 0xFFU));
    out.push_back(static_cast<std::uint8_t>(word >> 8U));
  }
  out.insert(out.end(), data.begin(), data.end());
  std::uint32_t a = 1;
  std::uint32_t b = 0;
  for (const std::uint8_t byte : data) {
    a = (a + byte) % 65521;
    b = (b + a) % 65521;
  }
  append_big_u32(out, b << 16U | a);
  return out;
}

}  // namespace

TemporaryFolder::TemporaryFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "scene-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) {
    throw std::runtime_error("cannot make a temporary folder");
  }
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::filesystem::path TemporaryFolder::write(const std::string& name, const Bytes& bytes) const {
  std::filesystem::path file = path_ / name;
  std::filesystem::create_directories(file.parent_path());
  std::ofstream stream(file, std::ios::binary);
  stream.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  return file;
}

std::filesystem::path TemporaryFolder::write(const std::string& name, std::string_view text) const {
  return write(name, Bytes(text.begin(), text.end()));
}

std::string base64(const Bytes& bytes) {
  constexpr std::string_view alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      group = group << 8U | (i + k < bytes.size() ? bytes[i + k] : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += i + k <= bytes.size() ? alphabet[(group >> (18 - 6 * k)) & 63U] : '=';
    }
  }
  return text;
}

Bytes png(int width, int height, int bits, const std::vector<std::uint16_t>& codes) {
  Bytes header;
  append_big_u32(header, static_cast<std::uint32_t>(width));
  append_big_u32(header, static_cast<std::uint32_t>(height));
  constexpr std::uint8_t rgba = 6;
  for (const std::uint8_t byte : {static_cast<std::uint8_t>(bits), rgba, std::uint8_t{0}, std::uint8_t{0}, std::uint8_t{0}}) {
    header.push_back(byte);
  }
  Bytes rows;
  for (std::size_t i = 0; i < codes.size(); ++i) {
    if (i % (static_cast<std::size_t>(width) * 4) == 0) {
      rows.push_back(0);
    }
    if (bits == 16) {
      rows.push_back(static_cast<std::uint8_t>(codes[i] >> 8U));
    }
    rows.push_back(static_cast<std::uint8_t>(codes[i] & 0xFFU));
  }
  Bytes file = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
  append_chunk(file, "IHDR", header);
  append_chunk(file, "IDAT", zlib_stored(rows));
  append_chunk(file, "IEND", {});
  return file;
}

Bytes jpeg() {
  constexpr std::string_view text =
      "/9j/4AAQSkZJRgABAQAAAQABAAD/2wCEAAEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQ"
      "EBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAf/AABEIAAgACAMB"
      "EQACEQEDEQH/xAGiAAABBQEBAQEBAQAAAAAAAAAAAQIDBAUGBwgJCgsQAAIBAwMCBAMFBQQEAAABfQECAwAEEQUSITFBBhNRYQcicRQygZGhCC"
      "NCscEVUtHwJDNicoIJChYXGBkaJSYnKCkqNDU2Nzg5OkNERUZHSElKU1RVVldYWVpjZGVmZ2hpanN0dXZ3eHl6g4SFhoeIiYqSk5SVlpeYmZqi"
      "o6Slpqeoqaqys7S1tre4ubrCw8TFxsfIycrS09TV1tfY2drh4uPk5ebn6Onq8fLz9PX29/j5+gEAAwEBAQEBAQEBAQAAAAAAAAECAwQFBgcICQ"
      "oLEQACAQIEBAMEBwUEBAABAncAAQIDEQQFITEGEkFRB2FxEyIygQgUQpGhscEJIzNS8BVictEKFiQ04SXxFxgZGiYnKCkqNTY3ODk6Q0RFRkdI"
      "SUpTVFVWV1hZWmNkZWZnaGlqc3R1dnd4eXqCg4SFhoeIiYqSk5SVlpeYmZqio6Slpqeoqaqys7S1tre4ubrCw8TFxsfIycrS09TV1tfY2dri4+"
      "Tl5ufo6ery8/T19vf4+fr/2gAMAwEAAhEDEQA/AMGv8sD/AGxP/9k=";
  Bytes bytes;
  std::uint32_t group = 0;
  int bits = 0;
  constexpr std::string_view alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (const char c : text) {
    if (c == '=') {
      break;
    }
    group = group << 6U | static_cast<std::uint32_t>(alphabet.find(c));
    bits += 6;
    if (bits >= 8) {
      bits -= 8;
      bytes.push_back(static_cast<std::uint8_t>(group >> static_cast<unsigned>(bits)));
    }
  }
  return bytes;
}

int Asset::add_view(const Bytes& bytes) {
  buffer.resize((buffer.size() + 3) / 4 * 4);
  document["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", buffer.size()}, {"byteLength", bytes.size()}});
  buffer.insert(buffer.end(), bytes.begin(), bytes.end());
  return static_cast<int>(document["bufferViews"].size()) - 1;
}

int Asset::add_accessor(const Bytes& bytes, int component_type, const char* type, int count, bool normalized) {
  const int view = add_view(bytes);
  json accessor = {{"bufferView", view}, {"componentType", component_type}, {"type", type}, {"count", count}};
  if (normalized) {
    accessor["normalized"] = true;
  }
  document["accessors"].push_back(accessor);
  return static_cast<int>(document["accessors"].size()) - 1;
}

int Asset::add_texture(const Bytes& image, const char* mime) {
  const int view = add_view(image);
  document["images"].push_back({{"bufferView", view}, {"mimeType", mime}});
  document["textures"].push_back({{"source", document["images"].size() - 1}});
  return static_cast<int>(document["textures"].size()) - 1;
}

json Asset::embedded() const {
  json result = document;
  result["buffers"] =
      json::array({json::object({{"byteLength", buffer.size()}, {"uri", "data:application/octet-stream;base64," + base64(buffer)}})});
  return result;
}

Bytes Asset::glb() const {
  json with_buffer = document;
  with_buffer["buffers"] = json::array({json::object({{"byteLength", buffer.size()}})});
  std::string text = with_buffer.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  Bytes binary = buffer;
  binary.resize((binary.size() + 3) / 4 * 4);
  Bytes file = {'g', 'l', 'T', 'F'};
  append_u32(file, 2);
  append_u32(file, static_cast<std::uint32_t>(12 + 8 + text.size() + 8 + binary.size()));
  append_u32(file, static_cast<std::uint32_t>(text.size()));
  append_u32(file, 0x4E4F534A);
  file.insert(file.end(), text.begin(), text.end());
  append_u32(file, static_cast<std::uint32_t>(binary.size()));
  append_u32(file, 0x004E4942);
  file.insert(file.end(), binary.begin(), binary.end());
  return file;
}

Asset triangle() {
  Asset asset;
  asset.document = {{"asset", {{"version", "2.0"}}}, {"scene", 0}};
  asset.document["scenes"] = json::array({json::object({{"nodes", json::array({0})}})});
  asset.document["nodes"] = json::array({json::object({{"mesh", 0}})});
  asset.document["materials"] = json::array({json::object({{"name", "cloth"}})});
  const int positions = asset.add_accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, 5126, "VEC3", 3);
  const int normals = asset.add_accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, 5126, "VEC3", 3);
  const int texcoords = asset.add_accessor<float>({0, 1, 1, 1, 0, 0}, 5126, "VEC2", 3);
  const int indices = asset.add_accessor<std::uint16_t>({0, 1, 2}, 5123, "SCALAR", 3);
  json primitive = {{"indices", indices}, {"material", 0}};
  primitive["attributes"] = {{"POSITION", positions}, {"NORMAL", normals}, {"TEXCOORD_0", texcoords}};
  asset.document["meshes"] = json::array({{{"name", "patch"}, {"primitives", json::array({primitive})}}});
  return asset;
}

Scene load_text(std::string_view text) {
  const TemporaryFolder folder;
  return load_gltf(folder.write("asset.gltf", text));
}

Scene load(const Asset& asset) {
  return load_text(asset.embedded().dump());
}

std::string error_of_file(const std::filesystem::path& file) {
  try {
    load_gltf(file);
  } catch (const Error& error) {
    std::string message = error.what();
    EXPECT_NE(message.find(file.filename().string()), std::string::npos) << "the file is not named: " << message;
    return message;
  }
  ADD_FAILURE() << "no error";
  return {};
}

std::string error_of_text(std::string_view text) {
  const TemporaryFolder folder;
  return error_of_file(folder.write("asset.gltf", text));
}

std::string error_of(const Asset& asset) {
  return error_of_text(asset.embedded().dump());
}

testing::AssertionResult names(const std::string& message, const std::string& element, const std::string& rule) {
  if (message.find(": " + element) != std::string::npos && message.find(rule) != std::string::npos) {
    return testing::AssertionSuccess();
  }
  return testing::AssertionFailure() << "'" << message << "' does not name the element '" << element << "' and the rule '" << rule << "'";
}

}  // namespace sheen::scene::test
