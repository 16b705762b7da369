#include <array>
#include <cstdint>
#include <memory>
#include <new>
#include <string>
#include <type_traits>
#include <vector>

#include <xxhash.h>

#include "scene/environment.h"
#include "scene/gltf.h"

namespace sheen::scene {
namespace {

// Feeds values field by field (a struct as a whole would bring its padding along), sequences with their length before them, so that no two
// different scenes give the same stream of bytes.
class Hasher {
 public:
  Hasher() : state_(XXH3_createState()) {
    if (!state_) {
      throw std::bad_alloc();
    }
    XXH3_128bits_reset(state_.get());
  }

  template <class T>
  requires std::is_arithmetic_v<T> || std::is_enum_v<T>
  void add(const T& value) { XXH3_128bits_update(state_.get(), &value, sizeof value); }
  template <glm::length_t N, class T>
  void add(const glm::vec<N, T>& value) {
    for (glm::length_t i = 0; i < N; ++i) {
      add(value[i]);
    }
  }
  template <glm::length_t C, glm::length_t R, class T>
  void add(const glm::mat<C, R, T>& value) {
    for (glm::length_t i = 0; i < C; ++i) {
      add(value[i]);
    }
  }
  template <class T>
  void add(const std::vector<T>& values) {
    static_assert(std::has_unique_object_representations_v<T> || std::is_trivially_copyable_v<T>);
    add(static_cast<std::uint64_t>(values.size()));
    if (!values.empty()) {
      XXH3_128bits_update(state_.get(), values.data(), values.size() * sizeof(T));
    }
  }

  std::string hex() const {
    XXH128_canonical_t canonical;
    XXH128_canonicalFromHash(&canonical, XXH3_128bits_digest(state_.get()));
    std::string text;
    for (const unsigned char byte : canonical.digest) {
      text += "0123456789abcdef"[byte >> 4U];
      text += "0123456789abcdef"[byte & 15U];
    }
    return text;
  }

 private:
  struct Free {
    void operator()(XXH3_state_t* state) const { XXH3_freeState(state); }
  };
  std::unique_ptr<XXH3_state_t, Free> state_;
};

void add(Hasher& hasher, const TextureInfo& info) {
  hasher.add(info.texture);
  hasher.add(info.texcoord);
  hasher.add(info.transform);
}

void add(Hasher& hasher, const Picture& picture) {
  hasher.add(picture.width);
  hasher.add(picture.height);
  hasher.add(picture.bits);
  hasher.add(picture.codes);
}

void add(Hasher& hasher, const Texture& texture) {
  hasher.add(texture.picture);
  hasher.add(texture.sampler.wrap_s);
  hasher.add(texture.sampler.wrap_t);
  hasher.add(texture.sampler.mag);
  hasher.add(texture.sampler.min);
  hasher.add(texture.sampler.mip);
}

void add(Hasher& hasher, const Material& m) {
  hasher.add(m.base_color_factor);
  hasher.add(m.metallic_factor);
  hasher.add(m.roughness_factor);
  hasher.add(m.normal_scale);
  hasher.add(m.occlusion_strength);
  hasher.add(m.emissive_factor);
  hasher.add(m.ior);
  hasher.add(m.specular.factor);
  hasher.add(m.specular.color_factor);
  hasher.add(m.has_ior_or_specular);
  hasher.add(m.sheen.color_factor);
  hasher.add(m.sheen.roughness_factor);
  hasher.add(m.clearcoat.factor);
  hasher.add(m.clearcoat.roughness_factor);
  hasher.add(m.clearcoat.normal_scale);
  hasher.add(m.alpha_mode);
  hasher.add(m.alpha_cutoff);
  hasher.add(m.double_sided);
  for (const TextureInfo* info :
       {&m.base_color_texture, &m.metallic_roughness_texture, &m.normal_texture, &m.occlusion_texture, &m.emissive_texture,
        &m.specular.factor_texture, &m.specular.color_texture, &m.sheen.color_texture, &m.sheen.roughness_texture,
        &m.clearcoat.factor_texture, &m.clearcoat.roughness_texture, &m.clearcoat.normal_texture}) {
    add(hasher, *info);
  }
}

void add(Hasher& hasher, const Primitive& primitive) {
  hasher.add(primitive.positions);
  hasher.add(primitive.normals);
  hasher.add(primitive.tangents);
  for (const std::vector<glm::vec2>& set : primitive.texcoords) {
    hasher.add(set);
  }
  hasher.add(primitive.colors);
  hasher.add(primitive.indices);
  hasher.add(primitive.material);
}

void add(Hasher& hasher, const Instance& instance) {
  hasher.add(instance.primitive);
  hasher.add(instance.world_from_local);
}

void add(Hasher& hasher, const Light& light) {
  hasher.add(light.type);
  hasher.add(light.color);
  hasher.add(light.intensity);
  hasher.add(light.range);
  hasher.add(light.inner_cone);
  hasher.add(light.outer_cone);
  hasher.add(light.position);
  hasher.add(light.direction);
}

void add(Hasher& hasher, const Camera& camera) {
  hasher.add(camera.world_from_camera);
  hasher.add(camera.perspective);
  hasher.add(camera.yfov);
  hasher.add(camera.ymag);
  hasher.add(camera.znear);
  hasher.add(camera.zfar);
}

template <class T>
void add_all(Hasher& hasher, const std::vector<T>& values) {
  hasher.add(static_cast<std::uint64_t>(values.size()));
  for (const T& value : values) {
    add(hasher, value);
  }
}

}  // namespace

std::string content_hash(const Scene& scene) {
  Hasher hasher;
  add_all(hasher, scene.pictures);
  add_all(hasher, scene.textures);
  add_all(hasher, scene.materials);
  add_all(hasher, scene.primitives);
  add_all(hasher, scene.instances);
  add_all(hasher, scene.lights);
  add_all(hasher, scene.cameras);
  return hasher.hex();
}

std::string content_hash(const Environment& environment) {
  Hasher hasher;
  hasher.add(environment.uniform);
  hasher.add(environment.width);
  hasher.add(environment.height);
  hasher.add(environment.texels);
  return hasher.hex();
}

}  // namespace sheen::scene
