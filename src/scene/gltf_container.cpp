#include "scene/gltf_container.h"

#include <cstring>
#include <fstream>
#include <system_error>

#include "scene/scene.h"

namespace sheen::scene {
namespace {

constexpr std::uint32_t glb_magic = 0x46546C67;   // "glTF"
constexpr std::uint32_t json_chunk = 0x4E4F534A;  // "JSON"
constexpr std::uint32_t bin_chunk = 0x004E4942;   // "BIN\0"
constexpr std::size_t header_size = 12;
constexpr std::size_t chunk_header_size = 8;
// tinygltf counts bytes in int.
constexpr std::uintmax_t largest_file = 0x7FFFFFFF;

std::uint32_t read_u32(const std::vector<std::uint8_t>& bytes, std::size_t offset) {
  return static_cast<std::uint32_t>(bytes[offset]) | static_cast<std::uint32_t>(bytes[offset + 1]) << 8 |
         static_cast<std::uint32_t>(bytes[offset + 2]) << 16 | static_cast<std::uint32_t>(bytes[offset + 3]) << 24;
}

void split_glb(Container& container, const std::string& file) {
  const std::vector<std::uint8_t>& bytes = container.bytes;
  if (bytes.size() < header_size + chunk_header_size) {
    throw Error(file, "GLB header", "the file is truncated (glTF 2.0, section 4.4.2)");
  }
  const std::uint32_t version = read_u32(bytes, 4);
  const std::uint32_t length = read_u32(bytes, 8);
  if (version != 2) {
    throw Error(file, "GLB header", "version is " + std::to_string(version) + ", must be 2 (glTF 2.0, section 4.4.2)");
  }
  if (length > bytes.size()) {
    throw Error(file, "GLB header",
                "length is " + std::to_string(length) + " but the file has " + std::to_string(bytes.size()) +
                    " bytes: it is truncated (glTF 2.0, section 4.4.2)");
  }
  std::size_t offset = header_size;
  for (int chunk = 0; offset + chunk_header_size <= length; ++chunk) {
    const std::string element = "GLB chunk " + std::to_string(chunk);
    const std::uint32_t size = read_u32(bytes, offset);
    const std::uint32_t type = read_u32(bytes, offset + 4);
    offset += chunk_header_size;
    if (size > length - offset) {
      throw Error(file, element, "reaches past the end of the file (glTF 2.0, section 4.4.3)");
    }
    if (size % 4 != 0) {
      throw Error(file, element, "its length must be a multiple of 4 (glTF 2.0, section 4.4.3)");
    }
    if (chunk == 0) {
      if (type != json_chunk) {
        throw Error(file, element, "the first chunk must be JSON (glTF 2.0, section 4.4.3)");
      }
      container.json = std::string_view(reinterpret_cast<const char*>(bytes.data() + offset), size);
    } else if (chunk == 1 && type == bin_chunk) {
      container.binary = std::span(bytes).subspan(offset, size);
      container.has_binary = true;
    }
    offset += size;
  }
  if (container.json.empty()) {
    throw Error(file, "GLB chunk 0", "there is no JSON (glTF 2.0, section 4.4.3)");
  }
}

}  // namespace

std::vector<std::uint8_t> read_bytes(const std::filesystem::path& path, const std::string& file, const std::string& element) {
  std::error_code status;
  if (!std::filesystem::is_regular_file(path, status)) {
    throw Error(file, element,
                std::filesystem::exists(path, status) ? "is not a regular file"
                                                      : "there is no such file: " + path.string() + " (glTF 2.0, section 2.8)");
  }
  const std::uintmax_t size = std::filesystem::file_size(path, status);
  if (status) {
    throw Error(file, element, "cannot be read: " + status.message());
  }
  if (size > largest_file) {
    throw Error(file, element, "is larger than 2 GiB");
  }
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(size));
  std::ifstream stream(path, std::ios::binary);
  if (!stream || (size > 0 && !stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size)))) {
    throw Error(file, element, "cannot be read");
  }
  return bytes;
}

Container read_container(const std::filesystem::path& path, const std::string& file) {
  Container container;
  container.bytes = read_bytes(path, file, "file");
  if (container.bytes.size() >= 4 && read_u32(container.bytes, 0) == glb_magic) {
    split_glb(container, file);
  } else {
    if (container.bytes.empty()) {
      throw Error(file, "file", "is empty: neither .gltf nor .glb");
    }
    container.json = std::string_view(reinterpret_cast<const char*>(container.bytes.data()), container.bytes.size());
  }
  return container;
}

}  // namespace sheen::scene
