#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "brdf/model.h"
#include "golden/geometry.h"
#include "golden/rays.h"
#include "golden/surface.h"
#include "golden/texture.h"
#include "golden/triangle_edges.h"

namespace sheen::golden {

/// Which level of detail mipmapped textures are read at: the specification's ideal one, but for one texture of the material the one given,
/// for a driver chooses for each texture apart. And where all are read.
struct LodChoice {
  std::optional<double> level;  ///< within lod_interval(); none: the ideal level for all
  std::size_t slot = 0;         ///< which texture, below SurfaceReader::slot_count
  glm::dvec2 nudge{0.0};        ///< of every texture's coordinates, as a share, -1 to 1, of the farthest that a driver's may lie off
};

/// How far off the texture coordinates of a driver may lie at a hit.
struct TextureReach {
  double texels = 0;             ///< the farthest, of the textures without mipmaps
  bool beyond_the_step = false;  ///< whether more than what moving the sample by the step makes of it
};

/// Levels of detail that OpenGL ES allows.
struct LodInterval {
  double low, high;
};

/// OpenGL ES 3.0.6, table 6.10: TEXTURE_MAX_LOD; and, negated, TEXTURE_MIN_LOD.
inline constexpr double coarsest_level = 1000.0;

/// The levels of a range, in pieces over which what a texture gives runs straight from end to end, which may jump from one to the next; of
/// levels that give the same, one.
std::vector<LodInterval> straight_pieces(const Texture& texture, const LodInterval& range);

/// Both ends of a range, every whole level in it, and where magnification ends. One, if the range is no more.
std::vector<double> corners_within(const LodInterval& range);

/// corners_within() and three more between each two whole levels, since shading does not run straight.
std::vector<double> levels_within(const LodInterval& range);

/// Reads materials: everything between a hit and its shading.
class SurfaceReader {
 public:
  /// A texture of a material.
  struct Slot {
    std::optional<Texture> texture;
    int texcoord = 0;
    glm::dmat3 transform{1.0};
    std::size_t same_place = 0;   ///< the first slot of the material that is read at the same coordinates
    std::size_t same_levels = 0;  ///< and the first whose levels of detail are the same as well
  };
  /// A material with its textures decoded.
  struct Material {
    const scene::Material* source = nullptr;
    Layers layers;
    bool needs_lod = false;
    Slot base_color, metallic_roughness, normal, occlusion, emissive, specular, specular_color;
    Slot sheen_color, sheen_roughness, clearcoat, clearcoat_roughness, clearcoat_normal;
  };

  /// Decodes every texture that a material in use reads under that model: occlusion only for environment light. The references must outlive
  /// this. Throws scene::Error.
  /// @param step  by which a driver's grid may move a sample, in pixels
  SurfaceReader(const scene::Scene& scene, const Geometry& geometry, const RayGenerator& rays, bool environment, brdf::Model model,
                double step);

  const Material& material(int index) const { return materials_[static_cast<std::size_t>(index)]; }
  Layers layers(int material) const { return materials_[static_cast<std::size_t>(material)].layers; }
  /// Whether a material's textures depend on the level of detail; else LodChoice changes nothing.
  bool needs_lod(int material) const { return materials_[static_cast<std::size_t>(material)].needs_lod; }

  /// Textures a material may have; base colour is the first.
  static constexpr std::size_t slot_count = 12;
  static constexpr std::size_t base_color_slot = 0, normal_slot = 2, clearcoat_normal_slot = 10;

  /// From the least level allowed for one texture of the surface at a hit to the most; none where it has no mipmaps or is not there.
  std::optional<LodInterval> lod_interval(const Hit& hit, const Ray& ray, std::size_t slot) const;

  /// What the pixels beside one make of a triangle.
  struct Neighbourhood {
    std::array<glm::dvec3, 9> weights;  ///< at the 3 x 3 pixel centres, row by row, on the triangle's plane
    bool beyond = false;                ///< whether a ray never meets the plane, and that goes for `ideal_beyond` too
    bool ideal_beyond = false;          ///< whether it is one of the three that the ideal level is of
    double stretch = 0;                 ///< of differences between neighbours, by a driver's roundings and snapping; a share
  };
  Neighbourhood neighbourhood(const Hit& hit, const EdgeFunctions& edges) const;

  /// Of a texture that needs one.
  struct Lod {
    double ideal;
    LodInterval allowed;
  };
  Lod lod(const Slot& slot, const Hit& hit, const Neighbourhood& beside) const;

  /// levels_within() for one texture at a hit; of a normal map corners_within() and as many more as leave no more than that angle, in
  /// radians, between the normals of two neighbours: a lobe may rise and fall again while a normal swings past it. Empty where no other
  /// level than the ideal one is allowed.
  std::vector<double> levels_to_try(const Hit& hit, const Ray& ray, std::size_t slot, double largest_angle) const;

  TextureReach texture_reach(const Hit& hit, const Ray& ray) const;

  /// What shading needs at a hit of a ray; weights outside [0, 1] extrapolate.
  Surface<double> surface(const Hit& hit, const Ray& ray, LodChoice lod = {}) const;

  /// The same where `usual` is the surface without such a choice, in less time.
  Surface<double> varied(const Surface<double>& usual, const Hit& hit, const Ray& ray, LodChoice lod) const;

  /// Alpha of the base colour times that of COLOR_0, in [0, 1] (glTF 2.0, section 3.9.4).
  double opacity(const Hit& hit, const Ray& ray, LodChoice lod = {}) const;

 private:
  struct Footprint;
  static constexpr std::array<Slot Material::*, slot_count> slots{
      &Material::base_color, &Material::metallic_roughness,  &Material::normal,           &Material::emissive,
      &Material::specular,   &Material::specular_color,      &Material::sheen_color,      &Material::sheen_roughness,
      &Material::clearcoat,  &Material::clearcoat_roughness, &Material::clearcoat_normal, &Material::occlusion};
  static const Slot& slot_of(const Material& material, std::size_t slot) { return material.*slots[slot]; }
  static void compare_slots(Material& material);
  void read_material(const scene::Scene& scene, TextureStore& store, int index, bool environment);
  glm::dvec2 texcoord(const Slot& slot, const Hit& hit, const glm::dvec3& weights) const;
  glm::dvec2 coordinate_rounding(const Slot& slot, const Hit& hit) const;
  glm::dvec2 moved_by_step(const Slot& slot, const Hit& hit, const Ray& ray) const;
  glm::dvec3 weights_beside(const Hit& hit, const Ray& ray, double dx, double dy, bool& beyond) const;
  double level(const Slot& slot, const Hit& hit, const Footprint& footprint) const;
  glm::dvec4 read(const Slot& slot, const Hit& hit, const Footprint& footprint) const;
  glm::dvec3 mapped_normal(const Slot& slot, double scale, const glm::dvec3& normal, const Hit& hit, const Footprint& footprint) const;
  glm::dvec3 mapped_normal(const Hit& hit, const Ray& ray, LodChoice lod) const;
  glm::dvec3 interpolated_normal(const Hit& hit) const;
  Footprint footprint(const Hit& hit, const Ray& ray, LodChoice lod) const;
  void fill(Surface<double>& s, std::size_t slot, const glm::dvec3& normal, const Hit& hit, const Footprint& f) const;

  const Geometry& geometry_;
  const RayGenerator& rays_;
  brdf::Model model_;
  double step_;
  std::vector<Material> materials_;
};

}  // namespace sheen::golden
