#include "image/png_check.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <vector>

namespace sheen::image {
namespace {

constexpr std::array<std::uint32_t, 256> crc_table = [] {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t n = 0; n < 256; ++n) {
    std::uint32_t c = n;
    for (int bit = 0; bit < 8; ++bit) {
      c = (c & 1u) != 0 ? 0xedb88320u ^ (c >> 1u) : c >> 1u;
    }
    table[n] = c;
  }
  return table;
}();

std::uint32_t crc(const std::uint8_t* bytes, std::size_t count) {
  std::uint32_t c = 0xffffffffu;
  for (std::size_t i = 0; i < count; ++i) {
    c = crc_table[(c ^ bytes[i]) & 0xffu] ^ (c >> 8u);
  }
  return ~c;
}

std::uint32_t word(const std::uint8_t* bytes) {
  return std::uint32_t{bytes[0]} << 24u | std::uint32_t{bytes[1]} << 16u | std::uint32_t{bytes[2]} << 8u | bytes[3];
}

}  // namespace

std::string png_flaw(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::vector<char> content((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
  const std::vector<std::uint8_t> bytes(content.begin(), content.end());
  constexpr std::array<std::uint8_t, 8> signature = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  if (bytes.size() < signature.size() || !std::equal(signature.begin(), signature.end(), bytes.begin())) {
    return "not a PNG file";
  }
  constexpr std::size_t around = 12;  // length, type and checksum
  for (std::size_t at = signature.size(); bytes.size() - at >= around;) {
    const std::size_t length = word(&bytes[at]);
    if (length > bytes.size() - at - around) {
      return "PNG data ends early";
    }
    const std::string type(content.begin() + static_cast<std::ptrdiff_t>(at + 4), content.begin() + static_cast<std::ptrdiff_t>(at + 8));
    if (crc(&bytes[at + 4], length + 4) != word(&bytes[at + 8 + length])) {
      return "PNG chunk " + type + ": its checksum does not match";
    }
    if (type == "IEND") {
      return {};
    }
    at += around + length;
  }
  return "PNG data ends early";
}

}  // namespace sheen::image
