#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace sheen::conformance {

/// Collects a glTF asset with one binary buffer and lays it out as .glb (glTF 2.0, section 4.4).
class GlbBuilder {
 public:
  nlohmann::json& json() { return json_; }

  /// Appends bytes as a buffer view (4-byte aligned) and returns its index. @param target  GL's number, 0 for none
  int add_view(const void* bytes, std::size_t size, int target);
  /// Appends an accessor over a view of its own. @param type  "SCALAR", "VEC2", ...; component_type  GL's number
  template <class Element>
  int add_accessor(const std::vector<Element>& elements, const std::string& type, int component_type, int target) {
    const int view = add_view(elements.data(), elements.size() * sizeof(Element), target);
    json_["accessors"].push_back({{"bufferView", view}, {"componentType", component_type}, {"count", elements.size()}, {"type", type}});
    return static_cast<int>(json_["accessors"].size()) - 1;
  }
  /// The whole file.
  std::vector<std::uint8_t> finish() const;

 private:
  nlohmann::json json_ = {{"asset", {{"version", "2.0"}, {"generator", "sheen-cts"}}}};
  std::vector<std::uint8_t> binary_;
};

/// Writes bytes to a temporary name in the same folder and renames it. Throws std::runtime_error naming the file.
void write_file(const std::filesystem::path& file, const void* bytes, std::size_t size);
void write_file(const std::filesystem::path& file, const std::string& text);

}  // namespace sheen::conformance
