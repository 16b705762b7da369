#pragma once

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "scene/gltf.h"

namespace sheen::scene::test {

using nlohmann::json;
using Bytes = std::vector<std::uint8_t>;

/// How errors name the material of triangle().
inline constexpr const char* cloth = "materials[0] 'cloth'";

/// A folder of its own, removed at the end.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::filesystem::path write(const std::string& name, const Bytes& bytes) const;
  std::filesystem::path write(const std::string& name, std::string_view text) const;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

template <class T>
Bytes bytes_of(std::initializer_list<T> values) {
  Bytes bytes(values.size() * sizeof(T));
  std::memcpy(bytes.data(), values.begin(), bytes.size());
  return bytes;
}

std::string base64(const Bytes& bytes);

/// PNG of RGBA codes, rows from the top.
Bytes png(int width, int height, int bits, const std::vector<std::uint16_t>& codes);

/// 8 x 8 JPEG, every pixel near (200, 100, 50).
Bytes jpeg();

/// A document and its one buffer, to be changed by a test and written in any of the three ways.
struct Asset {
  json document;
  Bytes buffer;

  /// Appends bytes, aligned to 4, and a bufferView of them; returns its index.
  int add_view(const Bytes& bytes);
  /// Appends an accessor over a bufferView of its own; returns its index.
  int add_accessor(const Bytes& bytes, int component_type, const char* type, int count, bool normalized = false);
  template <class T>
  int add_accessor(std::initializer_list<T> values, int component_type, const char* type, int count, bool normalized = false) {
    return add_accessor(bytes_of(values), component_type, type, count, normalized);
  }
  /// Appends an image in the buffer, and a texture of it; returns the texture's index.
  int add_texture(const Bytes& image, const char* mime = "image/png");

  json& primitive() { return document["meshes"][0]["primitives"][0]; }
  json& attributes() { return primitive()["attributes"]; }
  json& material() { return document["materials"][0]; }

  /// The document with the buffer in a data URI.
  json embedded() const;
  Bytes glb() const;
};

/// One triangle (0,0,0) (1,0,0) (0,1,0), unsigned short indices, normals +Z, TEXCOORD_0 = (0,1) (1,1) (0,0), one material, one node.
Asset triangle();

/// Loads the asset as .gltf with embedded data.
Scene load(const Asset& asset);
Scene load_text(std::string_view text);

/// The message of the Error that loading raises; fails the test when there is none or when it does not name the file.
std::string error_of(const Asset& asset);
std::string error_of_text(std::string_view text);
std::string error_of_file(const std::filesystem::path& file);

/// Whether a message names the element and the rule.
testing::AssertionResult names(const std::string& message, const std::string& element, const std::string& rule);

}  // namespace sheen::scene::test
