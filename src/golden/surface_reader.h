#pragma once

#include <array>
#include <optional>
#include <vector>

#include "golden/geometry.h"
#include "golden/rays.h"
#include "golden/surface.h"
#include "golden/texture.h"

namespace sheen::golden {

/// Which level of detail mipmapped textures are read at: the specification's ideal one, or the one given, as far as OpenGL ES allows each
/// texture to go.
struct LodChoice {
  std::optional<double> level;  ///< none: the ideal level
};

/// Levels of detail that OpenGL ES allows.
struct LodInterval {
  double low, high;
};

/// What a range of levels may show: both its ends, every whole level in it, where what a texture gives has a corner, and three between each
/// two, since shading does not run straight.
std::vector<double> levels_within(const LodInterval& range);

/// Reads materials: everything between a hit and its shading.
class SurfaceReader {
 public:
  /// Decodes every texture that a material in use reads. The arguments must outlive this. Throws scene::Error.
  SurfaceReader(const scene::Scene& scene, const Geometry& geometry, const RayGenerator& rays);

  Layers layers(int material) const { return materials_[static_cast<std::size_t>(material)].layers; }
  /// Whether a material's textures depend on the level of detail; else LodChoice changes nothing.
  bool needs_lod(int material) const { return materials_[static_cast<std::size_t>(material)].needs_lod; }

  /// From the least level allowed for any texture of the surface at a hit to the most, for a material that needs_lod().
  LodInterval lod_interval(const Hit& hit, const Ray& ray) const;

  /// What shading needs at a hit of a ray; weights outside [0, 1] extrapolate.
  Surface<double> surface(const Hit& hit, const Ray& ray, LodChoice lod = {}) const;

  /// Alpha of the base colour times that of COLOR_0, in [0, 1] (glTF 2.0, section 3.9.4).
  double opacity(const Hit& hit, const Ray& ray, LodChoice lod = {}) const;

 private:
  struct Slot {
    std::optional<Texture> texture;
    int texcoord = 0;
    glm::dmat3 transform{1.0};
  };
  struct Material {
    const scene::Material* source = nullptr;
    Layers layers;
    bool needs_lod = false;
    Slot base_color, metallic_roughness, normal, emissive, specular, specular_color;
    Slot sheen_color, sheen_roughness, clearcoat, clearcoat_roughness, clearcoat_normal;
  };
  struct Footprint;
  void read_material(const scene::Scene& scene, TextureStore& store, int index);
  glm::dvec2 texcoord(const Slot& slot, const Hit& hit, const glm::dvec3& weights) const;
  LodInterval lod_interval(const Slot& slot, const Hit& hit, const Footprint& footprint) const;
  glm::dvec4 read(const Slot& slot, const Hit& hit, const Footprint& footprint) const;
  glm::dvec3 mapped_normal(const Slot& slot, double scale, const glm::dvec3& normal, const Hit& hit, const Footprint& footprint) const;
  glm::dvec3 interpolated_normal(const Hit& hit) const;
  Footprint footprint(const Hit& hit, const Ray& ray, LodChoice lod) const;

  const Geometry& geometry_;
  const RayGenerator& rays_;
  std::vector<Material> materials_;
};

}  // namespace sheen::golden
