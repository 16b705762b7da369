#include "scene/gltf_accessors.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>

namespace sheen::scene {
namespace {

using Bytes = std::span<const std::uint8_t>;

// An accessor without a bufferView is all zeros (section 3.6.2.3): a few bytes of JSON could ask for any amount of memory. 2^24 elements
// are more than the largest meshes need.
constexpr std::uint64_t most_zeros = std::uint64_t{1} << 24;

std::size_t size_of(ComponentType type) {
  switch (type) {
    case ComponentType::Byte:
    case ComponentType::UnsignedByte:
      return 1;
    case ComponentType::Short:
    case ComponentType::UnsignedShort:
      return 2;
    default:
      return 4;
  }
}

struct Shape {
  const char* name;
  std::size_t columns;
  std::size_t rows;
};
// Section 3.6.2.2, table "accessor element sizes"; a vector is one column.
constexpr Shape shapes[] = {{"SCALAR", 1, 1}, {"VEC2", 1, 2}, {"VEC3", 1, 3}, {"VEC4", 1, 4},
                            {"MAT2", 2, 2},   {"MAT3", 3, 3}, {"MAT4", 4, 4}};

// Columns of a matrix start at multiples of four bytes (section 3.6.2.4).
std::size_t element_size(const Shape& shape, std::size_t component) {
  const std::size_t column = shape.rows * component;
  return shape.columns == 1 ? column : shape.columns * ((column + 3) / 4 * 4);
}

ComponentType component_type(const Element& element) {
  const std::uint64_t code = element.required_count("componentType");
  if (code < 5120 || code > 5126 || code == 5124) {
    element.fail("componentType", "is " + std::to_string(code) + ", must be one of 5120, 5121, 5122, 5123, 5125, 5126 (section 3.6.2.2)");
  }
  return static_cast<ComponentType>(code);
}

template <class T>
T load(const std::uint8_t* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

// Section 3.6.2.2: f = max(c / 127, -1) and its like for the other types.
template <class T>
float normalize(T code) {
  return static_cast<float>(std::max(static_cast<double>(code) / static_cast<double>(std::numeric_limits<T>::max()), -1.0));
}

template <class T>
float convert(const std::uint8_t* bytes, bool normalized) {
  const T code = load<T>(bytes);
  if constexpr (std::is_same_v<T, float>) {
    return code;
  } else {
    return normalized ? normalize(code) : static_cast<float>(code);
  }
}

// One converter a component type, so that the choice is made once an accessor.
using Converter = float (*)(const std::uint8_t*, bool);
Converter converter(ComponentType type) {
  switch (type) {
    case ComponentType::Byte:
      return convert<std::int8_t>;
    case ComponentType::UnsignedByte:
      return convert<std::uint8_t>;
    case ComponentType::Short:
      return convert<std::int16_t>;
    case ComponentType::UnsignedShort:
      return convert<std::uint16_t>;
    case ComponentType::UnsignedInt:
      return convert<std::uint32_t>;
    default:
      return convert<float>;
  }
}

std::uint32_t load_index(const std::uint8_t* bytes, ComponentType type) {
  switch (type) {
    case ComponentType::UnsignedByte:
      return *bytes;
    case ComponentType::UnsignedShort:
      return load<std::uint16_t>(bytes);
    default:
      return load<std::uint32_t>(bytes);
  }
}

bool is_index_type(ComponentType type) {
  return type == ComponentType::UnsignedByte || type == ComponentType::UnsignedShort || type == ComponentType::UnsignedInt;
}

// `count` elements of `size` bytes, `stride` apart, from `offset` on: checked against the view without overflow.
Bytes checked_span(const Element& element, const Resources& resources, int view, std::uint64_t offset, std::uint64_t count,
                   std::size_t size, std::size_t stride, std::size_t alignment) {
  const Bytes bytes = resources.bytes(view);
  const std::size_t view_offset = resources.views[static_cast<std::size_t>(view)].offset;
  const std::string target = "bufferViews[" + std::to_string(view) + "]";
  if (offset > bytes.size() || size > bytes.size() - offset || (count - 1) > (bytes.size() - offset - size) / stride) {
    element.fail("count", "reaches past the end of " + target + ": " + std::to_string(count) + " elements of " + std::to_string(size) +
                              " bytes, " + std::to_string(stride) + " apart, from byte " + std::to_string(offset) + " of " +
                              std::to_string(bytes.size()) + " (section 3.6.2.4)");
  }
  if (offset % alignment != 0 || (view_offset + offset) % alignment != 0) {
    element.fail("byteOffset", "and that of " + target + " must be multiples of the component's size, " + std::to_string(alignment) +
                                   " (section 3.6.2.4)");
  }
  return bytes.subspan(offset, (count - 1) * stride + size);
}

}  // namespace

Accessors::Accessors(const Element& root, const Resources& resources) {
  for (const Element& element : root.children("accessors")) {
    Accessor accessor{.element = element, .type = element.required_string("type"), .data = {}, .sparse = {}};
    const auto* shape = std::find_if(std::begin(shapes), std::end(shapes), [&](const Shape& s) { return accessor.type == s.name; });
    if (shape == std::end(shapes)) {
      element.fail("type", "is '" + accessor.type + "', which is none of SCALAR, VEC2..4, MAT2..4");
    }
    accessor.component = scene::component_type(element);
    accessor.normalized = element.boolean("normalized", false);
    if (accessor.normalized && size_of(accessor.component) == 4) {
      element.fail("normalized", "must not be true for float or unsigned int components (section 5.1.4)");
    }
    const std::uint64_t count = element.required_count("count");
    if (count == 0) {
      element.fail("count", "is 0, must be at least 1");
    }
    const std::size_t component = size_of(accessor.component);
    accessor.components = shape->columns * shape->rows;
    accessor.element_size = scene::element_size(*shape, component);
    accessor.stride = accessor.element_size;
    const std::uint64_t offset = element.count("byteOffset", 0);
    const int view = element.index("bufferView", resources.views.size(), "bufferViews");
    if (view >= 0) {
      const std::size_t stride = resources.views[static_cast<std::size_t>(view)].stride;
      if (stride != 0) {
        if (stride < accessor.element_size || stride % component != 0) {
          element.fail("bufferView", "has byteStride " + std::to_string(stride) + ", which does not fit elements of " +
                                         std::to_string(accessor.element_size) + " bytes (section 3.6.2.4)");
        }
        accessor.stride = stride;
      }
      accessor.data = checked_span(element, resources, view, offset, count, accessor.element_size, accessor.stride, component);
    } else {
      if (offset != 0) {
        element.fail("byteOffset", "must not be given without bufferView (section 5.1.2)");
      }
      if (count > most_zeros) {
        element.fail("count", "is more than 2^24 without a bufferView");
      }
    }
    accessor.count = static_cast<std::size_t>(count);
    read_sparse(accessor, resources);
    accessors_.push_back(std::move(accessor));
  }
}

void Accessors::read_sparse(Accessor& accessor, const Resources& resources) {
  const std::optional<Element> sparse = accessor.element.child("sparse");
  if (!sparse) {
    return;
  }
  const std::uint64_t count = sparse->required_count("count");
  if (count == 0 || count > accessor.count) {
    sparse->fail("count", "is " + std::to_string(count) + ", must lie in [1, " + std::to_string(accessor.count) + "] (section 3.6.2.3)");
  }
  const Element indices = sparse->required_child("indices");
  const Element values = sparse->required_child("values");
  accessor.sparse.index_type = scene::component_type(indices);
  if (!is_index_type(accessor.sparse.index_type)) {
    indices.fail("componentType", "must be 5121, 5123 or 5125 (section 5.3.3)");
  }
  const std::size_t index_size = size_of(accessor.sparse.index_type);
  const std::size_t views = resources.views.size();
  accessor.sparse.indices = checked_span(indices, resources, indices.required_index("bufferView", views, "bufferViews"),
                                         indices.count("byteOffset", 0), count, index_size, index_size, index_size);
  accessor.sparse.values =
      checked_span(values, resources, values.required_index("bufferView", views, "bufferViews"), values.count("byteOffset", 0), count,
                   accessor.element_size, accessor.element_size, size_of(accessor.component));
  accessor.sparse.count = static_cast<std::size_t>(count);
}

std::vector<std::uint32_t> Accessors::sparse_indices(const Accessor& accessor) {
  const Sparse& sparse = accessor.sparse;
  std::vector<std::uint32_t> result(sparse.count);
  for (std::size_t i = 0; i < sparse.count; ++i) {
    result[i] = load_index(sparse.indices.data() + i * size_of(sparse.index_type), sparse.index_type);
    if (result[i] >= accessor.count) {
      accessor.element.fail("sparse.indices", "holds " + std::to_string(result[i]) + " but there are " + std::to_string(accessor.count) +
                                                  " elements (section 3.6.2.3)");
    }
    if (i > 0 && result[i] <= result[i - 1]) {
      accessor.element.fail("sparse.indices", "must strictly increase (section 3.6.2.3)");
    }
  }
  return result;
}

std::vector<float> Accessors::floats(int index) const {
  const Accessor& accessor = at(index);
  const Converter to_float = converter(accessor.component);
  const std::size_t n = accessor.components;
  const std::size_t step = size_of(accessor.component);
  std::vector<float> result(accessor.count * n, 0.0f);
  const auto put = [&](std::size_t element, const std::uint8_t* bytes) {
    for (std::size_t c = 0; c < n; ++c) {
      result[element * n + c] = to_float(bytes + c * step, accessor.normalized);
    }
  };
  if (!accessor.data.empty()) {
    for (std::size_t i = 0; i < accessor.count; ++i) {
      put(i, accessor.data.data() + i * accessor.stride);
    }
  }
  const std::vector<std::uint32_t> replaced = sparse_indices(accessor);
  for (std::size_t i = 0; i < replaced.size(); ++i) {
    put(replaced[i], accessor.sparse.values.data() + i * accessor.element_size);
  }
  for (std::size_t i = 0; i < result.size(); ++i) {
    if (!std::isfinite(result[i])) {
      accessor.element.fail(nullptr, "element " + std::to_string(i / n) + " is NaN or infinite (section 3.6.2.2)");
    }
  }
  return result;
}

std::vector<std::uint32_t> Accessors::indices(int index, std::size_t vertices) const {
  const Accessor& accessor = at(index);
  const Element& element = accessor.element;
  if (accessor.type != "SCALAR") {
    element.fail("type", "must be SCALAR for indices (section 3.7.2.1)");
  }
  if (!is_index_type(accessor.component) || accessor.normalized) {
    element.fail("componentType", "must be 5121, 5123 or 5125, not normalized, for indices (section 3.7.2.1)");
  }
  std::vector<std::uint32_t> result(accessor.count, 0);
  if (!accessor.data.empty()) {
    for (std::size_t i = 0; i < accessor.count; ++i) {
      result[i] = load_index(accessor.data.data() + i * accessor.stride, accessor.component);
    }
  }
  const std::vector<std::uint32_t> replaced = sparse_indices(accessor);
  for (std::size_t i = 0; i < replaced.size(); ++i) {
    result[replaced[i]] = load_index(accessor.sparse.values.data() + i * accessor.element_size, accessor.component);
  }
  const std::uint32_t restart = size_of(accessor.component) == 4 ? 0xFFFFFFFFU : (1U << (8 * size_of(accessor.component))) - 1;
  for (std::size_t i = 0; i < result.size(); ++i) {
    if (result[i] >= vertices) {
      element.fail(nullptr, "index " + std::to_string(i) + " is " + std::to_string(result[i]) + " but there are " +
                                std::to_string(vertices) + " vertices (section 3.7.2.1)");
    }
    if (result[i] == restart) {
      element.fail(nullptr, "index " + std::to_string(i) + " is the primitive restart value (section 3.7.2.1)");
    }
  }
  return result;
}

}  // namespace sheen::scene
