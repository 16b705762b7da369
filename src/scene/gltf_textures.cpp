#include "scene/gltf_textures.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "scene/gltf_conversions.h"

namespace sheen::scene {
namespace {

// Values of glTF 2.0, section 5.26 (OpenGL's own).
constexpr std::uint64_t nearest = 9728;
constexpr std::uint64_t linear = 9729;
constexpr std::uint64_t nearest_mipmap_nearest = 9984;
constexpr std::uint64_t linear_mipmap_nearest = 9985;
constexpr std::uint64_t nearest_mipmap_linear = 9986;
constexpr std::uint64_t linear_mipmap_linear = 9987;
constexpr std::uint64_t clamp_to_edge = 33071;
constexpr std::uint64_t mirrored_repeat = 33648;
constexpr std::uint64_t repeat = 10497;

Wrap read_wrap(const Element& element, const char* key) {
  switch (const std::uint64_t code = element.count(key, repeat)) {
    case clamp_to_edge:
      return Wrap::ClampToEdge;
    case mirrored_repeat:
      return Wrap::MirroredRepeat;
    case repeat:
      return Wrap::Repeat;
    default:
      element.fail(key, "is " + std::to_string(code) + ", must be 33071, 33648 or 10497 (section 5.26)");
  }
}

Sampler read_sampler(const Element& element) {
  Sampler sampler;
  sampler.wrap_s = read_wrap(element, "wrapS");
  sampler.wrap_t = read_wrap(element, "wrapT");
  switch (const std::uint64_t code = element.count("magFilter", linear)) {
    case nearest:
      sampler.mag = Filter::Nearest;
      break;
    case linear:
      sampler.mag = Filter::Linear;
      break;
    default:
      element.fail("magFilter", "is " + std::to_string(code) + ", must be 9728 or 9729 (section 5.26)");
  }
  switch (const std::uint64_t code = element.count("minFilter", linear_mipmap_linear)) {
    case nearest:
      sampler.min = Filter::Nearest, sampler.mip = MipFilter::None;
      break;
    case linear:
      sampler.min = Filter::Linear, sampler.mip = MipFilter::None;
      break;
    case nearest_mipmap_nearest:
      sampler.min = Filter::Nearest, sampler.mip = MipFilter::Nearest;
      break;
    case linear_mipmap_nearest:
      sampler.min = Filter::Linear, sampler.mip = MipFilter::Nearest;
      break;
    case nearest_mipmap_linear:
      sampler.min = Filter::Nearest, sampler.mip = MipFilter::Linear;
      break;
    case linear_mipmap_linear:
      sampler.min = Filter::Linear, sampler.mip = MipFilter::Linear;
      break;
    default:
      element.fail("minFilter", "is " + std::to_string(code) + ", must be 9728, 9729 or 9984 to 9987 (section 5.26)");
  }
  return sampler;
}

// KHR_texture_transform: translation * rotation * scale. The text says "rotate the UVs counter-clockwise" where v points down, so u turns
// toward -v; the GLSL listing in its README has the sign the other way and is known to be wrong (KhronosGroup/glTF issue 1563): three.js,
// Babylon.js, the Khronos sample renderer and the TextureTransformTest model all turn the way taken here.
glm::dmat3 texture_transform(const Element& extension) {
  const auto offset = extension.numbers<2>("offset", {0.0, 0.0});
  const auto scale = extension.numbers<2>("scale", {1.0, 1.0});
  const double rotation = extension.number("rotation", 0.0);
  const double c = std::cos(rotation);
  const double s = std::sin(rotation);
  return glm::dmat3(c * scale[0], -s * scale[0], 0.0, s * scale[1], c * scale[1], 0.0, offset[0], offset[1], 1.0);
}

int read_texcoord(const Element& element, int fallback) {
  if (!element.has("texCoord")) {
    return fallback;
  }
  const std::uint64_t set = element.required_count("texCoord");
  if (set > 1) {
    element.fail("texCoord", "is " + std::to_string(set) + ": only TEXCOORD_0 and TEXCOORD_1 are read");
  }
  return static_cast<int>(set);
}

}  // namespace

Textures::Textures(const Element& root) {
  std::vector<Sampler> samplers;
  for (const Element& element : root.children("samplers")) {
    samplers.push_back(read_sampler(element));
  }
  const std::size_t images = root.children("images").size();
  for (const Element& element : root.children("textures")) {
    Source source{.element = element, .sampler = {}};
    const int sampler = element.index("sampler", samplers.size(), "samplers");
    if (sampler >= 0) {
      source.sampler = samplers[static_cast<std::size_t>(sampler)];
    }
    source.image = element.index("source", images, "images");
    sources_.push_back(source);
  }
}

int Textures::use(int index) {
  Source& source = sources_[static_cast<std::size_t>(index)];
  if (source.used_as >= 0) {
    return source.used_as;
  }
  if (source.image < 0) {
    std::string alternatives;
    std::string advice;
    if (const auto extensions = source.element.child("extensions")) {
      for (const std::string& name : extensions->keys()) {
        alternatives += (alternatives.empty() ? "" : ", ") + name;
        advice += conversion_advice(name);
      }
    }
    source.element.fail("source", alternatives.empty()
                                      ? "is missing, so the texture has no image (section 3.8.2)"
                                      : "is missing, and the image that " + alternatives +
                                            " gives cannot be decoded here: only PNG and JPEG can (section 3.8.2)" + advice);
  }
  const auto known = std::find(images_.begin(), images_.end(), source.image);
  const auto picture = static_cast<int>(known - images_.begin());
  if (known == images_.end()) {
    images_.push_back(source.image);
  }
  source.used_as = static_cast<int>(textures_.size());
  textures_.push_back({picture, source.sampler});
  return source.used_as;
}

TextureInfo Textures::read(const Element& owner, const char* key) {
  TextureInfo info;
  const std::optional<Element> element = owner.child(key);
  if (!element) {
    return info;
  }
  info.texture = use(element->required_index("index", sources_.size(), "textures"));
  info.texcoord = read_texcoord(*element, 0);
  if (const std::optional<Element> transform = element->extension("KHR_texture_transform")) {
    info.texcoord = read_texcoord(*transform, info.texcoord);
    info.transform = texture_transform(*transform);
  }
  return info;
}

}  // namespace sheen::scene
