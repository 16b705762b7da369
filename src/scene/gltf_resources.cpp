#include "scene/gltf_resources.h"

#include <map>
#include <optional>
#include <utility>

#include <nlohmann/json.hpp>
#include <tiny_gltf.h>

#include "scene/gltf_uri.h"

namespace sheen::scene {
namespace {

using nlohmann::json;
using FileBytes = std::vector<std::uint8_t>;

// What tinygltf may open: names made here, each with the bytes read here.
using Files = std::map<std::string, FileBytes>;

tinygltf::FsCallbacks only(Files& files) {
  tinygltf::FsCallbacks callbacks{};
  callbacks.FileExists = [](const std::string& name, void* user) { return static_cast<Files*>(user)->contains(name); };
  callbacks.ExpandFilePath = [](const std::string& name, void*) { return name; };
  callbacks.ReadWholeFile = [](FileBytes* out, std::string*, const std::string& name, void* user) {
    *out = std::move(static_cast<Files*>(user)->at(name));
    return true;
  };
  callbacks.WriteWholeFile = [](std::string*, const std::string&, const FileBytes&, void*) { return false; };
  callbacks.user_data = &files;
  return callbacks;
}

// Keeps an image's bytes as they are: pictures are decoded later, several at once.
bool keep_encoded(tinygltf::Image* image, int, std::string*, std::string*, int, int, const unsigned char* bytes, int size, void*) {
  image->image.assign(bytes, bytes + size);
  image->as_is = true;
  return true;
}

// A resource in the form tinygltf is given: a data URI it knows, or a name in `files`.
json carried_uri(const Element& element, const std::string& uri, const std::string& name, const std::filesystem::path& folder, Files& files,
                 std::size_t& size) {
  if (is_data_uri(uri)) {
    const std::string_view payload = base64_payload(element, uri);
    size = base64_size(payload);
    return "data:application/octet-stream;base64," + std::string(payload);
  }
  FileBytes bytes = read_bytes(folder / path_of_uri(element, uri), element.file(), element.name());
  size = bytes.size();
  files[name] = std::move(bytes);
  return name;
}

json carried_buffer(const Element& element, std::size_t index, const Container& container, const std::filesystem::path& folder,
                    Files& files) {
  const std::uint64_t length = element.required_count("byteLength");
  if (length == 0) {
    element.fail("byteLength", "is 0, must be at least 1");
  }
  const std::string name = "buffer-" + std::to_string(index);
  const std::string uri = element.string("uri", "");
  json result;
  std::size_t size = 0;
  if (element.has("uri")) {
    result["uri"] = carried_uri(element, uri, name, folder, files, size);
  } else if (index == 0 && container.has_binary) {
    files[name] = FileBytes(container.binary.begin(), container.binary.end());
    size = container.binary.size();
    result["uri"] = name;
  } else {
    element.fail("uri", "is missing, and only the first buffer of a GLB with a BIN chunk may leave it out (section 3.6.1.2)");
  }
  if (size < length) {
    element.fail("byteLength", "is " + std::to_string(length) + " but there are only " + std::to_string(size) + " bytes (section 3.6.1)");
  }
  result["byteLength"] = size;
  return result;
}

BufferView read_view(const Element& element, const std::vector<FileBytes>& buffers) {
  BufferView view;
  view.buffer = element.required_index("buffer", buffers.size(), "buffers");
  const std::uint64_t offset = element.count("byteOffset", 0);
  const std::uint64_t length = element.required_count("byteLength");
  const std::uint64_t stride = element.count("byteStride", 0);
  const std::size_t available = buffers[static_cast<std::size_t>(view.buffer)].size();
  if (length == 0) {
    element.fail("byteLength", "is 0, must be at least 1");
  }
  if (offset > available || length > available - offset) {
    element.fail("byteLength", "reaches past the end of buffers[" + std::to_string(view.buffer) + "]: " + std::to_string(offset) + " + " +
                                   std::to_string(length) + " > " + std::to_string(available) + " (section 3.6.1)");
  }
  if (element.has("byteStride") && (stride < 4 || stride > 252 || stride % 4 != 0)) {
    element.fail("byteStride", "is " + std::to_string(stride) + ", must be a multiple of 4 in [4, 252] (section 5.11.4)");
  }
  view.offset = offset;
  view.length = length;
  view.stride = stride;
  return view;
}

}  // namespace

std::span<const std::uint8_t> Resources::bytes(int view) const {
  const BufferView& v = views[static_cast<std::size_t>(view)];
  return std::span(buffers[static_cast<std::size_t>(v.buffer)]).subspan(v.offset, v.length);
}

Resources load_resources(const Element& root, const Container& container, const std::filesystem::path& folder,
                         const std::vector<int>& images) {
  Files files;
  json document;
  document["asset"]["version"] = "2.0";
  document["buffers"] = json::array();
  document["images"] = json::array();
  const std::vector<Element> buffers = root.children("buffers");
  std::vector<std::uint64_t> lengths;
  for (std::size_t i = 0; i < buffers.size(); ++i) {
    document["buffers"].push_back(carried_buffer(buffers[i], i, container, folder, files));
    lengths.push_back(buffers[i].required_count("byteLength"));
  }
  const std::vector<Element> image_elements = root.children("images");
  std::vector<int> carried_images;
  for (const int i : images) {
    const Element& element = image_elements[static_cast<std::size_t>(i)];
    if (!element.has("uri")) {
      continue;
    }
    std::size_t size = 0;
    const json uri = carried_uri(element, element.string("uri", ""), "image-" + std::to_string(i), folder, files, size);
    if (size == 0) {
      element.fail("uri", "holds no bytes");
    }
    document["images"].push_back({{"uri", uri}});
    carried_images.push_back(i);
  }

  tinygltf::TinyGLTF loader;
  loader.SetFsCallbacks(only(files));
  loader.SetImageLoader(keep_encoded, nullptr);
  tinygltf::Model model;
  std::string error;
  std::string warning;
  const std::string text = document.dump();
  if (!loader.LoadASCIIFromString(&model, &error, &warning, text.c_str(), static_cast<unsigned int>(text.size()), "") ||
      model.buffers.size() != buffers.size() || model.images.size() != carried_images.size()) {
    throw Error(root.file(), "buffers and images", "cannot be loaded: " + error + warning);
  }

  Resources resources;
  for (std::size_t i = 0; i < buffers.size(); ++i) {
    resources.buffers.push_back(std::move(model.buffers[i].data));
    resources.buffers.back().resize(static_cast<std::size_t>(lengths[i]));
  }
  for (const Element& view : root.children("bufferViews")) {
    resources.views.push_back(read_view(view, resources.buffers));
  }
  resources.encoded_images.resize(image_elements.size());
  for (std::size_t i = 0; i < carried_images.size(); ++i) {
    resources.encoded_images[static_cast<std::size_t>(carried_images[i])] = std::move(model.images[i].image);
  }
  return resources;
}

}  // namespace sheen::scene
