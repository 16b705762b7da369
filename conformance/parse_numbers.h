#pragma once

#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string_view>
#include <system_error>

namespace sheen::conformance {

/// The numbers between the commas, or nothing unless there are exactly N and each is finite.
template <std::size_t N>
std::optional<std::array<double, N>> parse_numbers(std::string_view text) {
  std::array<double, N> numbers{};
  for (std::size_t i = 0; i < N; ++i) {
    const std::size_t comma = text.find(',');
    if ((comma == std::string_view::npos) != (i + 1 == N)) {
      return std::nullopt;
    }
    std::string_view field = text.substr(0, comma);
    if (field.starts_with('+')) {
      field.remove_prefix(1);
    }
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), numbers[i]);
    if (error != std::errc() || end != field.data() + field.size() || !std::isfinite(numbers[i])) {
      return std::nullopt;
    }
    if (comma != std::string_view::npos) {
      text.remove_prefix(comma + 1);
    }
  }
  return numbers;
}

}  // namespace sheen::conformance
