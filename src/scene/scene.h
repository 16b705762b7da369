#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace sheen::scene {

/// A text that may come from anywhere, fit for a terminal, a log and JSON: control characters and whatever is no UTF-8 as \xNN, and of a
/// long one its beginning and its end.
std::string legible(std::string_view text);

/// What is wrong with a scene: the file, the element in it ("materials[2] 'velvet'") and the rule it breaks. Element and rule may quote a
/// hostile file: each is made legible().
class Error : public std::runtime_error {
 public:
  Error(const std::string& file, const std::string& element, const std::string& rule);
};

enum class Wrap { Repeat, MirroredRepeat, ClampToEdge };
enum class Filter { Nearest, Linear };
enum class MipFilter { None, Nearest, Linear };

/// Sampler of glTF 2.0, section 3.8.3. A filter that the file leaves open is linear, with trilinear mipmaps.
struct Sampler {
  Wrap wrap_s = Wrap::Repeat;
  Wrap wrap_t = Wrap::Repeat;
  Filter mag = Filter::Linear;
  Filter min = Filter::Linear;
  MipFilter mip = MipFilter::Linear;
};

/// Decoded picture, RGBA codes of 8 or 16 bits, first row is v = 0 (the image's top). Colour space is the business of its user.
struct Picture {
  std::string name;
  int width = 0;
  int height = 0;
  int bits = 8;                      ///< 8 or 16: a code's largest value is 2^bits - 1
  std::vector<std::uint16_t> codes;  ///< width * height * 4
};

struct Texture {
  int picture = -1;
  Sampler sampler;
};

/// Reference from a material to a texture, with KHR_texture_transform applied.
struct TextureInfo {
  int texture = -1;  ///< -1: none
  int texcoord = 0;  ///< 0 or 1
  /// Maps (u, v, 1) to the transformed (u', v', 1): translation * rotation * scale, KHR_texture_transform.
  glm::dmat3 transform = glm::dmat3(1.0);

  bool present() const { return texture >= 0; }
};

enum class AlphaMode { Opaque, Mask, Blend };

/// KHR_materials_sheen. Colour is linear; the colour texture is sRGB (rgb), the roughness texture linear (a).
struct Sheen {
  glm::dvec3 color_factor{0.0};
  TextureInfo color_texture;
  double roughness_factor = 0.0;
  TextureInfo roughness_texture;

  /// A zero factor disables the layer wholly, whatever the texture.
  bool enabled() const { return color_factor != glm::dvec3(0.0); }
};

/// KHR_materials_clearcoat. All textures are linear: factor in r, roughness in g.
struct Clearcoat {
  double factor = 0.0;
  TextureInfo factor_texture;
  double roughness_factor = 0.0;
  TextureInfo roughness_texture;
  TextureInfo normal_texture;
  double normal_scale = 1.0;

  bool enabled() const { return factor != 0.0; }
};

/// KHR_materials_specular. factor_texture.a is linear, color_texture.rgb is sRGB.
struct Specular {
  double factor = 1.0;
  TextureInfo factor_texture;
  glm::dvec3 color_factor{1.0};
  TextureInfo color_texture;
};

/// A glTF 2.0 metallic-roughness material with the layers this suite knows. Defaults are the specification's.
struct Material {
  std::string name;
  glm::dvec4 base_color_factor{1.0};
  TextureInfo base_color_texture;  ///< sRGB rgb, linear a
  double metallic_factor = 1.0;
  double roughness_factor = 1.0;
  TextureInfo metallic_roughness_texture;  ///< linear: roughness g, metallic b
  TextureInfo normal_texture;
  double normal_scale = 1.0;
  TextureInfo occlusion_texture;  ///< linear r; scales environment light alone
  double occlusion_strength = 1.0;
  glm::dvec3 emissive_factor{0.0};  ///< already times KHR_materials_emissive_strength
  TextureInfo emissive_texture;     ///< sRGB
  double ior = 1.5;                 ///< KHR_materials_ior; 0 means f0 = 1
  Specular specular;
  bool has_ior_or_specular = false;  ///< whether the file gave either extension
  Sheen sheen;
  Clearcoat clearcoat;
  AlphaMode alpha_mode = AlphaMode::Opaque;
  double alpha_cutoff = 0.5;
  bool double_sided = false;
};

/// Indexed triangles. Attributes a file lacks are empty, except normals, which the loader fills (flat), and tangents, which it fills
/// where the material has a normal map.
struct Primitive {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;                   ///< unit as in the file; never empty after loading
  std::vector<glm::vec4> tangents;                  ///< xyz, w = handedness (+1 or -1)
  std::array<std::vector<glm::vec2>, 2> texcoords;  ///< TEXCOORD_0, TEXCOORD_1
  std::vector<glm::vec4> colors;                    ///< COLOR_0, linear; a = 1 where the file gives RGB
  std::vector<std::uint32_t> indices;               ///< three a triangle, counter-clockwise seen from the front
  int material = 0;                                 ///< always valid: the loader appends the default material where needed
};

/// A primitive placed in the world.
struct Instance {
  int primitive = 0;
  glm::dmat4 world_from_local{1.0};

  /// Whether the transform mirrors, so that front faces wind clockwise (glTF 2.0, section 3.7.4).
  bool mirrored() const;
};

enum class LightType { Directional, Point, Spot };

/// KHR_lights_punctual, in world space.
struct Light {
  LightType type = LightType::Directional;
  glm::dvec3 color{1.0};
  double intensity = 1.0;                                  ///< lux (directional) or candela
  double range = std::numeric_limits<double>::infinity();  ///< metres
  double inner_cone = 0.0;                                 ///< radians
  double outer_cone = 0.7853981633974483;                  ///< radians
  glm::dvec3 position{0.0};                                ///< point and spot
  glm::dvec3 direction{0.0, 0.0, -1.0};                    ///< unit, the way the light travels; directional and spot
};

struct Camera {
  std::string name;
  glm::dmat4 world_from_camera{1.0};  ///< rigid: rotation and translation; looks along -Z, +Y up
  bool perspective = true;
  double yfov = 0.7853981633974483;  ///< radians, perspective
  double ymag = 1.0;                 ///< half height, orthographic
  double znear = 0.01;
  double zfar = std::numeric_limits<double>::infinity();  ///< infinity: infinite projection
};

/// Everything a picture is made of, as plain data; nothing here draws.
struct Scene {
  std::string file;  ///< where it came from, for messages
  std::vector<Picture> pictures;
  std::vector<Texture> textures;
  std::vector<Material> materials;
  std::vector<Primitive> primitives;
  std::vector<Instance> instances;
  std::vector<Light> lights;
  std::vector<Camera> cameras;
  std::vector<std::string> warnings;  ///< what was read but is not drawn (skins, morph targets, points, lines)
};

}  // namespace sheen::scene
