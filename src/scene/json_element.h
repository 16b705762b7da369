#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace sheen::scene {

/// Values a number of a schema may take.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_excluded = false;
  bool high_excluded = false;

  bool contains(double x) const { return (low_excluded ? x > low : x >= low) && (high_excluded ? x < high : x <= high); }
  /// "[0, 1]", "(0, inf)"
  std::string text() const;
};

inline constexpr Range any_number{};
inline constexpr Range unit_interval{.low = 0.0, .high = 1.0};
inline constexpr Range non_negative{.low = 0.0};
inline constexpr Range positive{.low = 0.0, .low_excluded = true};

/// A JSON object of a glTF document that knows where it stands. Every getter checks type and range and throws Error naming the file, the
/// element ("materials[2] 'velvet'") and the rule, with the specification that sets it. Refers to the document, which must outlive it.
class Element {
 public:
  /// The root of a document. Throws Error when it is no object.
  Element(const std::string& file, const nlohmann::json& root);

  bool has(const char* key) const;

  /// Number within `range`; without a fallback the member is required.
  double number(const char* key, double fallback, const Range& range = any_number) const;
  double required_number(const char* key, const Range& range = any_number) const;
  /// Whole number in [0, 2^53].
  std::uint64_t count(const char* key, std::uint64_t fallback) const;
  std::uint64_t required_count(const char* key) const;
  /// Index into an array of `size` elements called `target`; -1 where the member is absent.
  int index(const char* key, std::size_t size, const char* target) const;
  int required_index(const char* key, std::size_t size, const char* target) const;
  /// Indices into an array of `size` elements called `target`; empty where the member is absent.
  std::vector<int> indices(const char* key, std::size_t size, const char* target) const;
  bool boolean(const char* key, bool fallback) const;
  std::string string(const char* key, const std::string& fallback) const;
  std::string required_string(const char* key) const;
  std::vector<std::string> strings(const char* key) const;
  /// Exactly `size` numbers, each within `range`; empty where the member is absent.
  std::vector<double> numbers(const char* key, std::size_t size, const Range& range = any_number) const;
  template <std::size_t N>
  std::array<double, N> numbers(const char* key, const std::array<double, N>& fallback, const Range& range = any_number) const {
    const std::vector<double> given = numbers(key, N, range);
    std::array<double, N> result = fallback;
    for (std::size_t i = 0; i < given.size(); ++i) {
      result[i] = given[i];
    }
    return result;
  }

  std::optional<Element> child(const char* key) const;
  Element required_child(const char* key) const;
  /// The objects of an array; at the root they become elements of their own, named by index and `name`.
  std::vector<Element> children(const char* key) const;
  std::optional<Element> extension(const char* name) const;
  /// Names of the members.
  std::vector<std::string> keys() const;

  /// Throws Error about a member of this element (nullptr: the element itself); the specification's name is added.
  [[noreturn]] void fail(const char* key, const std::string& rule) const;
  /// "materials[2] 'velvet'"
  const std::string& name() const { return owner_; }
  const std::string& file() const { return *file_; }

 private:
  const nlohmann::json* find(const char* key) const;
  const nlohmann::json& require(const char* key) const;
  double checked_number(const char* key, const nlohmann::json& value, const Range& range) const;
  std::uint64_t checked_count(const char* key, const nlohmann::json& value) const;
  int checked_index(const char* key, const nlohmann::json& value, std::size_t size, const char* target) const;

  const std::string* file_;
  const nlohmann::json* value_;
  std::string owner_;
  std::string path_;  ///< within the owner, ending in a dot unless empty
  std::string specification_ = "glTF 2.0";
  bool root_ = false;
};

}  // namespace sheen::scene
