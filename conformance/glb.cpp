#include "conformance/glb.h"

#include <atomic>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <system_error>

#include <unistd.h>

namespace sheen::conformance {
namespace {

void append_u32(std::vector<std::uint8_t>& out, std::uint32_t value) {
  for (int shift = 0; shift < 32; shift += 8) {
    out.push_back(static_cast<std::uint8_t>(value >> shift));
  }
}

}  // namespace

int GlbBuilder::add_view(const void* bytes, std::size_t size, int target) {
  while (binary_.size() % 4 != 0) {
    binary_.push_back(0);
  }
  nlohmann::json view = {{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", size}};
  if (target != 0) {
    view["target"] = target;
  }
  const auto* first = static_cast<const std::uint8_t*>(bytes);
  binary_.insert(binary_.end(), first, first + size);
  json_["bufferViews"].push_back(std::move(view));
  return static_cast<int>(json_["bufferViews"].size()) - 1;
}

std::vector<std::uint8_t> GlbBuilder::finish() const {
  std::vector<std::uint8_t> binary = binary_;
  while (binary.size() % 4 != 0) {
    binary.push_back(0);
  }
  nlohmann::json root = json_;
  root["buffers"] = nlohmann::json::array({{{"byteLength", binary.size()}}});
  std::string text = root.dump();
  while (text.size() % 4 != 0) {
    text.push_back(' ');
  }
  std::vector<std::uint8_t> file;
  file.reserve(28 + text.size() + binary.size());
  append_u32(file, 0x46546C67);  // "glTF"
  append_u32(file, 2);
  append_u32(file, static_cast<std::uint32_t>(12 + 8 + text.size() + 8 + binary.size()));
  append_u32(file, static_cast<std::uint32_t>(text.size()));
  append_u32(file, 0x4E4F534A);  // "JSON"
  file.insert(file.end(), text.begin(), text.end());
  append_u32(file, static_cast<std::uint32_t>(binary.size()));
  append_u32(file, 0x004E4942);  // "BIN"
  file.insert(file.end(), binary.begin(), binary.end());
  return file;
}

void write_file(const std::filesystem::path& file, const void* bytes, std::size_t size) {
  static std::atomic<unsigned> serial{0};
  std::filesystem::path temporary = file;
  temporary += std::string(".").append(std::to_string(getpid())).append("-").append(std::to_string(serial++)).append(".tmp");
  std::ofstream out(temporary, std::ios::binary | std::ios::trunc);
  out.write(static_cast<const char*>(bytes), static_cast<std::streamsize>(size));
  out.close();
  std::error_code error;
  if (out.fail()) {
    std::filesystem::remove(temporary, error);
    throw std::runtime_error(file.string() + ": cannot be written: " + std::strerror(errno));
  }
  std::filesystem::rename(temporary, file, error);
  if (error) {
    const std::string reason = error.message();
    std::filesystem::remove(temporary, error);
    throw std::runtime_error(file.string() + ": cannot be written: " + reason);
  }
}

void write_file(const std::filesystem::path& file, const std::string& text) {
  write_file(file, text.data(), text.size());
}

}  // namespace sheen::conformance
