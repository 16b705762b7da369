#pragma once

#include <vector>

#include "scene/gltf_resources.h"
#include "scene/json_element.h"
#include "scene/scene.h"

namespace sheen::scene {

/// The textures of a document. All are checked; only those that a material asks for come into the scene, in the order they are asked for.
class Textures {
 public:
  /// Throws Error for references out of range and sampler values that glTF 2.0, section 5.26, does not know.
  explicit Textures(const Element& root);

  /// Reads the textureInfo in member `key` of `owner`, with KHR_texture_transform; an absent one gives TextureInfo{}. Throws Error.
  TextureInfo read(const Element& owner, const char* key);

  /// What was asked for so far.
  const std::vector<Texture>& textures() const { return textures_; }
  /// Index into the document's images of each picture that is needed: Texture::picture counts these.
  const std::vector<int>& images() const { return images_; }

 private:
  struct Source {
    Element element;
    Sampler sampler;
    int image = -1;
    int used_as = -1;  ///< index into textures_
  };
  int use(int source);

  std::vector<Source> sources_;
  std::vector<Texture> textures_;
  std::vector<int> images_;
};

/// Makes one of the images whose files hold the same bytes (exporters write occlusion twice), and lets textures refer to it.
/// @param images  indices into the document's images, which Texture::picture counts
/// @return  those that are left
std::vector<int> share_images(const Element& root, const Resources& resources, const std::vector<int>& images,
                              std::vector<Texture>& textures);

/// Decodes the wanted images, several at once. Throws Error when one is neither PNG nor JPEG or cannot be decoded.
/// @param images  indices into the document's images
std::vector<Picture> decode_images(const Element& root, const Resources& resources, const std::vector<int>& images);

}  // namespace sheen::scene
