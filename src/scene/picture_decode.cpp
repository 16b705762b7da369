#include <algorithm>
#include <atomic>
#include <exception>
#include <string>
#include <thread>
#include <vector>

#include "scene/gltf_textures.h"
#include "scene/picture_codecs.h"

namespace sheen::scene {
namespace {

using Bytes = std::span<const std::uint8_t>;

Picture decode_image(const Element& element, Bytes bytes) {
  Picture picture;
  picture.name = element.string("name", "");
  if (const std::string wrong = decode_picture(bytes, picture); !wrong.empty()) {
    element.fail(nullptr, wrong);
  }
  return picture;
}

Bytes encoded_bytes(const Element& element, std::size_t index, const Resources& resources) {
  const int view = element.index("bufferView", resources.views.size(), "bufferViews");
  if ((view >= 0) == element.has("uri")) {
    element.fail(nullptr, "must have either a uri or a bufferView (section 5.18)");
  }
  return view >= 0 ? resources.bytes(view) : Bytes(resources.encoded_images[index]);
}

}  // namespace

std::vector<int> share_images(const Element& root, const Resources& resources, const std::vector<int>& images,
                              std::vector<Texture>& textures) {
  const std::vector<Element> elements = root.children("images");
  std::vector<int> left;
  std::vector<Bytes> files;
  std::vector<int> becomes;
  for (const int image : images) {
    const auto index = static_cast<std::size_t>(image);
    const Bytes file = encoded_bytes(elements[index], index, resources);
    const auto known = std::find_if(files.begin(), files.end(), [&](Bytes other) { return std::ranges::equal(file, other); });
    becomes.push_back(static_cast<int>(known - files.begin()));
    if (known == files.end()) {
      files.push_back(file);
      left.push_back(image);
    }
  }
  for (Texture& texture : textures) {
    texture.picture = becomes[static_cast<std::size_t>(texture.picture)];
  }
  return left;
}

std::vector<Picture> decode_images(const Element& root, const Resources& resources, const std::vector<int>& images) {
  const std::vector<Element> elements = root.children("images");
  std::vector<Picture> pictures(images.size());
  std::vector<std::exception_ptr> errors(images.size());
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t i = next++; i < images.size(); i = next++) {
      try {
        const auto index = static_cast<std::size_t>(images[i]);
        pictures[i] = decode_image(elements[index], encoded_bytes(elements[index], index, resources));
      } catch (...) {
        errors[i] = std::current_exception();
      }
    }
  };
  {
    std::vector<std::jthread> helpers;
    const std::size_t threads = std::min<std::size_t>(images.size(), std::max(1U, std::thread::hardware_concurrency()));
    for (std::size_t i = 1; i < threads; ++i) {
      helpers.emplace_back(work);
    }
    work();
  }
  for (const std::exception_ptr& error : errors) {
    if (error) {
      std::rethrow_exception(error);
    }
  }
  return pictures;
}

}  // namespace sheen::scene
