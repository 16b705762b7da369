#include "scene/gltf_materials.h"

#include <array>
#include <limits>

namespace sheen::scene {
namespace {

constexpr const char* layers[] = {"KHR_materials_sheen", "KHR_materials_clearcoat", "KHR_materials_specular", "KHR_materials_ior"};
constexpr const char* other_models[] = {"KHR_materials_pbrSpecularGlossiness", "KHR_materials_unlit"};

glm::dvec3 color(const Element& element, const char* key, const std::array<double, 3>& fallback, const Range& range = unit_interval) {
  const auto c = element.numbers<3>(key, fallback, range);
  return {c[0], c[1], c[2]};
}

// Reads a normalTextureInfo: a textureInfo with a scale.
void read_normal_texture(const Element& owner, const char* key, Textures& textures, TextureInfo& info, double& scale) {
  info = textures.read(owner, key);
  if (info.present()) {
    scale = owner.child(key)->number("scale", 1.0);
  }
}

void read_base(const Element& element, Textures& textures, Material& material) {
  if (const auto pbr = element.child("pbrMetallicRoughness")) {
    const auto base = pbr->numbers<4>("baseColorFactor", {1.0, 1.0, 1.0, 1.0}, unit_interval);
    material.base_color_factor = {base[0], base[1], base[2], base[3]};
    material.base_color_texture = textures.read(*pbr, "baseColorTexture");
    material.metallic_factor = pbr->number("metallicFactor", 1.0, unit_interval);
    material.roughness_factor = pbr->number("roughnessFactor", 1.0, unit_interval);
    material.metallic_roughness_texture = textures.read(*pbr, "metallicRoughnessTexture");
  }
  read_normal_texture(element, "normalTexture", textures, material.normal_texture, material.normal_scale);
  material.occlusion_texture = textures.read(element, "occlusionTexture");
  if (material.occlusion_texture.present()) {
    material.occlusion_strength = element.child("occlusionTexture")->number("strength", 1.0, unit_interval);
  }
  material.emissive_factor = color(element, "emissiveFactor", {0.0, 0.0, 0.0});
  material.emissive_texture = textures.read(element, "emissiveTexture");
  if (const auto strength = element.extension("KHR_materials_emissive_strength")) {
    material.emissive_factor *= strength->number("emissiveStrength", 1.0, non_negative);
  }
}

void read_alpha(const Element& element, Material& material) {
  const std::string mode = element.string("alphaMode", "OPAQUE");
  if (mode == "OPAQUE") {
    material.alpha_mode = AlphaMode::Opaque;
  } else if (mode == "MASK") {
    material.alpha_mode = AlphaMode::Mask;
  } else if (mode == "BLEND") {
    material.alpha_mode = AlphaMode::Blend;
  } else {
    element.fail("alphaMode", "is '" + mode + "', must be OPAQUE, MASK or BLEND (section 3.9.4)");
  }
  material.alpha_cutoff = element.number("alphaCutoff", 0.5, non_negative);
  material.double_sided = element.boolean("doubleSided", false);
}

void read_ior(const Element& element, Material& material) {
  const auto extension = element.extension("KHR_materials_ior");
  if (!extension) {
    return;
  }
  material.has_ior_or_specular = true;
  material.ior = extension->number("ior", 1.5);
  if (material.ior != 0.0 && !(material.ior >= 1.0)) {
    extension->fail("ior", "is " + std::to_string(material.ior) + ", must be 0 or at least 1");
  }
}

void read_specular(const Element& element, Textures& textures, Material& material) {
  const auto extension = element.extension("KHR_materials_specular");
  if (!extension) {
    return;
  }
  material.has_ior_or_specular = true;
  material.specular.factor = extension->number("specularFactor", 1.0, unit_interval);
  material.specular.factor_texture = textures.read(*extension, "specularTexture");
  material.specular.color_factor = color(*extension, "specularColorFactor", {1.0, 1.0, 1.0}, non_negative);
  material.specular.color_texture = textures.read(*extension, "specularColorTexture");
}

void read_sheen(const Element& element, Textures& textures, Sheen& sheen) {
  const auto extension = element.extension("KHR_materials_sheen");
  if (!extension) {
    return;
  }
  sheen.color_factor = color(*extension, "sheenColorFactor", {0.0, 0.0, 0.0});
  sheen.color_texture = textures.read(*extension, "sheenColorTexture");
  sheen.roughness_factor = extension->number("sheenRoughnessFactor", 0.0, unit_interval);
  sheen.roughness_texture = textures.read(*extension, "sheenRoughnessTexture");
}

void read_clearcoat(const Element& element, Textures& textures, Clearcoat& clearcoat) {
  const auto extension = element.extension("KHR_materials_clearcoat");
  if (!extension) {
    return;
  }
  clearcoat.factor = extension->number("clearcoatFactor", 0.0, unit_interval);
  clearcoat.factor_texture = textures.read(*extension, "clearcoatTexture");
  clearcoat.roughness_factor = extension->number("clearcoatRoughnessFactor", 0.0, unit_interval);
  clearcoat.roughness_texture = textures.read(*extension, "clearcoatRoughnessTexture");
  read_normal_texture(*extension, "clearcoatNormalTexture", textures, clearcoat.normal_texture, clearcoat.normal_scale);
}

void check_exclusions(const Element& element, std::vector<std::string>& warnings) {
  for (const char* other : other_models) {
    if (!element.extension(other)) {
      continue;
    }
    for (const char* layer : layers) {
      if (const auto extension = element.extension(layer)) {
        extension->fail(nullptr, std::string("must not be used on a material that also uses ") + other);
      }
    }
    warnings.push_back(element.name() + ": " + other + " is not drawn; the metallic-roughness model stands in for it");
  }
}

}  // namespace

std::vector<Material> read_materials(const Element& root, Textures& textures, std::vector<std::string>& warnings) {
  std::vector<Material> materials;
  for (const Element& element : root.children("materials")) {
    check_exclusions(element, warnings);
    Material material;
    material.name = element.string("name", "");
    read_base(element, textures, material);
    read_alpha(element, material);
    read_ior(element, material);
    read_specular(element, textures, material);
    read_sheen(element, textures, material.sheen);
    read_clearcoat(element, textures, material.clearcoat);
    materials.push_back(std::move(material));
  }
  return materials;
}

}  // namespace sheen::scene
