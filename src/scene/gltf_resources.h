#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "scene/gltf_container.h"
#include "scene/json_element.h"
#include "scene/scene.h"

namespace sheen::scene {

/// A bufferView, checked against its buffer.
struct BufferView {
  int buffer = 0;
  std::size_t offset = 0;
  std::size_t length = 0;
  std::size_t stride = 0;  ///< 0: tightly packed
};

/// The bytes a document refers to. Spans point into `buffers`.
struct Resources {
  std::vector<std::vector<std::uint8_t>> buffers;
  std::vector<BufferView> views;
  std::vector<std::vector<std::uint8_t>> encoded_images;  ///< by image index; filled for the wanted ones that are not in a bufferView

  std::span<const std::uint8_t> bytes(int view) const;
};

/// Loads every buffer, and the wanted images that have a URI, through tinygltf. tinygltf sees only the parts of the document that name
/// bytes, already checked, and can open no file but those that passed path_of_uri(). Throws Error for a missing or short buffer, a
/// bufferView outside its buffer and whatever glTF 2.0, sections 3.6.1 and 2.8, forbid.
/// @param folder  the asset's folder
/// @param images  indices of the images that are wanted
Resources load_resources(const Element& root, const Container& container, const std::filesystem::path& folder,
                         const std::vector<int>& images);

}  // namespace sheen::scene
