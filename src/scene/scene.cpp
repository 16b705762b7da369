#include "scene/scene.h"

#include <cstddef>
#include <cstdio>
#include <string_view>

#include <glm/matrix.hpp>

namespace sheen::scene {
namespace {

// Bytes of the UTF-8 character (RFC 3629, section 4) that text begins with; 0 if it begins with none.
std::size_t utf8_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U; };
  const auto tail = [&](std::size_t i) { return (byte(i) & 0xC0U) == 0x80U; };
  const unsigned first = byte(0);
  const unsigned second = byte(1);
  if (first < 0x80U) {
    return 1;
  }
  if (first >= 0xC2U && first <= 0xDFU && tail(1)) {
    return 2;
  }
  if ((first & 0xF0U) == 0xE0U && tail(1) && tail(2)) {
    const bool overlong = first == 0xE0U && second < 0xA0U;
    const bool surrogate = first == 0xEDU && second > 0x9FU;
    return overlong || surrogate ? 0 : 3;
  }
  if (first >= 0xF0U && first <= 0xF4U && tail(1) && tail(2) && tail(3)) {
    const bool overlong = first == 0xF0U && second < 0x90U;
    const bool beyond = first == 0xF4U && second > 0x8FU;
    return overlong || beyond ? 0 : 4;
  }
  return 0;
}

}  // namespace

std::string legible(std::string_view text) {
  constexpr std::size_t shown = 180;  // of either end
  const auto part = [](std::string_view piece) {
    std::string out;
    while (!piece.empty()) {
      const std::size_t length = utf8_length(piece);
      const auto first = static_cast<unsigned char>(piece.front());
      if (length == 0 || first < 0x20U || first == 0x7FU) {
        char code[5];
        std::snprintf(code, sizeof code, "\\x%02x", static_cast<unsigned>(first));
        out += code;
        piece.remove_prefix(1);
      } else {
        out += piece.substr(0, length);
        piece.remove_prefix(length);
      }
    }
    return out;
  };
  if (text.size() <= 2 * shown) {
    return part(text);
  }
  const auto within = [&](std::size_t i) { return (static_cast<unsigned char>(text[i]) & 0xC0U) == 0x80U; };
  std::size_t head = shown;
  std::size_t tail = text.size() - shown;
  for (int i = 0; i < 3 && within(head); ++i) {
    --head;
  }
  for (int i = 0; i < 3 && within(tail); ++i) {
    ++tail;
  }
  return part(text.substr(0, head)) + " ... " + part(text.substr(tail));
}

Error::Error(const std::string& file, const std::string& element, const std::string& rule)
    : std::runtime_error(file + ": " + legible(element) + ": " + legible(rule)) {}

bool Instance::mirrored() const {
  return glm::determinant(glm::dmat3(world_from_local)) < 0.0;
}

}  // namespace sheen::scene
