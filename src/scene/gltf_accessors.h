#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "scene/gltf_resources.h"
#include "scene/json_element.h"

namespace sheen::scene {

/// Component types of glTF 2.0, section 3.6.2.2.
enum class ComponentType : std::uint16_t { Byte = 5120, UnsignedByte, Short, UnsignedShort, UnsignedInt = 5125, Float };

/// Every accessor of a document, checked against its bufferView at construction (glTF 2.0, sections 3.6.2.1 to 3.6.2.4), converted on
/// demand. The document and the resources must outlive it.
class Accessors {
 public:
  /// Throws Error for an accessor that reaches outside its bufferView, is misaligned, or has a type the specification does not know.
  Accessors(const Element& root, const Resources& resources);

  std::size_t size() const { return accessors_.size(); }
  std::size_t count(int accessor) const { return at(accessor).count; }
  const std::string& type(int accessor) const { return at(accessor).type; }
  ComponentType component_type(int accessor) const { return at(accessor).component; }
  bool normalized(int accessor) const { return at(accessor).normalized; }
  const Element& element(int accessor) const { return at(accessor).element; }

  /// All components as floats, normalised integers by section 3.6.2.2, sparse values put in. Throws Error for NaN and Inf (section 3.6.2.2)
  /// and for sparse indices that do not increase or exceed the count.
  std::vector<float> floats(int accessor) const;

  /// Unsigned integers of an index accessor, each below `vertices` and none the primitive restart value (section 3.7.2.1). Throws Error.
  std::vector<std::uint32_t> indices(int accessor, std::size_t vertices) const;

 private:
  struct Sparse {
    std::size_t count = 0;
    ComponentType index_type = ComponentType::UnsignedInt;
    std::span<const std::uint8_t> indices;
    std::span<const std::uint8_t> values;
  };
  struct Accessor {
    Element element;
    std::string type;
    ComponentType component = ComponentType::Float;
    bool normalized = false;
    std::size_t count = 0;
    std::size_t components = 1;          ///< a matrix counts all of its elements
    std::size_t element_size = 0;        ///< bytes
    std::size_t stride = 0;              ///< bytes
    std::span<const std::uint8_t> data;  ///< empty: zeros
    Sparse sparse;
  };

  const Accessor& at(int accessor) const { return accessors_[static_cast<std::size_t>(accessor)]; }
  static void read_sparse(Accessor& accessor, const Resources& resources);
  static std::vector<std::uint32_t> sparse_indices(const Accessor& accessor);

  std::vector<Accessor> accessors_;
};

}  // namespace sheen::scene
