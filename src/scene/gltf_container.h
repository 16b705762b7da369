#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sheen::scene {

/// A .gltf or .glb file in memory, split into its parts; which of the two it is, its first bytes say.
struct Container {
  std::vector<std::uint8_t> bytes;
  std::string_view json;                 ///< within bytes
  std::span<const std::uint8_t> binary;  ///< within bytes: the BIN chunk, empty where there is none
  bool has_binary = false;               ///< whether there is a BIN chunk, be it empty
};

/// Reads a whole file. Throws Error(`file`, `element`, ...) when it cannot be read or is larger than 2 GiB.
std::vector<std::uint8_t> read_bytes(const std::filesystem::path& path, const std::string& file, const std::string& element);

/// Reads `path` and, for a GLB, checks header and chunks (glTF 2.0, section 4.4). Throws Error.
Container read_container(const std::filesystem::path& path, const std::string& file);

}  // namespace sheen::scene
