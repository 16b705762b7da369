#pragma once

#include <array>

#include "scene/scene.h"
#include "scene/texels.h"

namespace sheen::renderer {

/// Every texture of a material, in the order of their units.
struct TextureSlot {
  const char* name;
  const scene::TextureInfo& (*of)(const scene::Material&);
  scene::ColorSpace space;
};

inline constexpr std::array<TextureSlot, 12> texture_slots{{
    {"base_color_texture", [](const scene::Material& m) -> const scene::TextureInfo& { return m.base_color_texture; },
     scene::ColorSpace::Srgb},
    {"metallic_roughness_texture", [](const scene::Material& m) -> const scene::TextureInfo& { return m.metallic_roughness_texture; },
     scene::ColorSpace::Linear},
    {"normal_texture", [](const scene::Material& m) -> const scene::TextureInfo& { return m.normal_texture; }, scene::ColorSpace::Linear},
    {"occlusion_texture", [](const scene::Material& m) -> const scene::TextureInfo& { return m.occlusion_texture; },
     scene::ColorSpace::Linear},
    {"emissive_texture", [](const scene::Material& m) -> const scene::TextureInfo& { return m.emissive_texture; }, scene::ColorSpace::Srgb},
    {"specular_texture", [](const scene::Material& m) -> const scene::TextureInfo& { return m.specular.factor_texture; },
     scene::ColorSpace::Linear},
    {"specular_color_texture", [](const scene::Material& m) -> const scene::TextureInfo& { return m.specular.color_texture; },
     scene::ColorSpace::Srgb},
    {"sheen_color_texture", [](const scene::Material& m) -> const scene::TextureInfo& { return m.sheen.color_texture; },
     scene::ColorSpace::Srgb},
    {"sheen_roughness_texture", [](const scene::Material& m) -> const scene::TextureInfo& { return m.sheen.roughness_texture; },
     scene::ColorSpace::Linear},
    {"clearcoat_texture", [](const scene::Material& m) -> const scene::TextureInfo& { return m.clearcoat.factor_texture; },
     scene::ColorSpace::Linear},
    {"clearcoat_roughness_texture", [](const scene::Material& m) -> const scene::TextureInfo& { return m.clearcoat.roughness_texture; },
     scene::ColorSpace::Linear},
    {"clearcoat_normal_texture", [](const scene::Material& m) -> const scene::TextureInfo& { return m.clearcoat.normal_texture; },
     scene::ColorSpace::Linear},
}};

}  // namespace sheen::renderer
