#include <algorithm>
#include <array>

#include "conformance/mutants/mutant.h"

namespace sheen::conformance {
namespace {

constexpr const char* sheen_color_sampled =
    "value.rgb *= texture_sample(u_sheen_color_texture, SHEEN_COLOR_TEXTURE_UV, SHEEN_COLOR_TEXTURE_SAMPLER).rgb;";
constexpr const char* base_color_sampled =
    "value *= texture_sample(u_base_color_texture, BASE_COLOR_TEXTURE_UV, BASE_COLOR_TEXTURE_SAMPLER);";
constexpr const char* emissive_sampled = "value *= texture_sample(u_emissive_texture, EMISSIVE_TEXTURE_UV, EMISSIVE_TEXTURE_SAMPLER).rgb;";

/// GLSL that undoes the decoding of colours: IEC 61966-2-1's curve of the linear vec3 of that name.
std::string encoded(const std::string& linear) {
  return "mix(12.92 * " + linear + ", 1.055 * pow(max(" + linear + ", vec3(1e-9)), vec3(1.0 / 2.4)) - 0.055, step(0.0031308, " + linear +
         "))";
}

void for_each_texture(scene::Scene& scene, const std::function<void(scene::TextureInfo&)>& change) {
  for (scene::Material& m : scene.materials) {
    for (scene::TextureInfo* info :
         {&m.base_color_texture, &m.metallic_roughness_texture, &m.normal_texture, &m.occlusion_texture, &m.emissive_texture,
          &m.specular.factor_texture, &m.specular.color_texture, &m.sheen.color_texture, &m.sheen.roughness_texture,
          &m.clearcoat.factor_texture, &m.clearcoat.roughness_texture, &m.clearcoat.normal_texture}) {
      if (info->present()) {
        change(*info);
      }
    }
  }
}

void for_each_sampler(scene::Scene& scene, const std::function<void(scene::Sampler&)>& change) {
  for (scene::Texture& texture : scene.textures) {
    change(texture.sampler);
  }
}

scene::Wrap without(scene::Wrap wrap, scene::Wrap unknown) {
  return wrap == unknown ? scene::Wrap::Repeat : wrap;
}

}  // namespace

/// Which channels hold what, and how.
std::vector<Mutant> texture_channel_mutants() {
  return {
      {.name = "texture.sheen_roughness_from_red",
       .why = "a texture of one value is read from its first channel",
       .first = {{"core", "texture.sheen_roughness.*"}},
       .edits = {{"material.glsl", "SHEEN_ROUGHNESS_TEXTURE_SAMPLER).a", "SHEEN_ROUGHNESS_TEXTURE_SAMPLER).r"}}},
      {.name = "texture.sheen_roughness_from_green",
       .why = "roughness is green in the base and in the coat",
       .first = {{"core", "texture.sheen_roughness.*"}},
       .edits = {{"material.glsl", "SHEEN_ROUGHNESS_TEXTURE_SAMPLER).a", "SHEEN_ROUGHNESS_TEXTURE_SAMPLER).g"}}},
      {.name = "texture.sheen_roughness_ignored",
       .why = "the alpha of a colour's picture is not looked for",
       .first = {{"core", "texture.sheen_roughness.*"}},
       .alter = of_materials([](scene::Material& material) { material.sheen.roughness_texture = {}; })},
      {.name = "texture.sheen_color_ignored",
       .why = "the factor alone is read",
       .first = {{"core", "texture.sheen_color.*"}},
       .alter = of_materials([](scene::Material& material) { material.sheen.color_texture = {}; })},
      {.name = "texture.sheen_color_without_the_factor",
       .why = "a texture is taken to replace the factor",
       .first = {{"core", "texture.sheen_color.*"}},
       .edits = {{"material.glsl", "value.rgb *= texture_sample(u_sheen_color_texture",
                  "value.rgb = texture_sample(u_sheen_color_texture"}}},
      {.name = "texture.sheen_color_not_decoded",
       .why = "the texture is uploaded as data",
       .first = {{"core", "texture.sheen_color.*"}},
       .edits = {{"material.glsl", sheen_color_sampled,
                  "vec3 texel = texture_sample(u_sheen_color_texture, SHEEN_COLOR_TEXTURE_UV, SHEEN_COLOR_TEXTURE_SAMPLER).rgb;\n    "
                  "value.rgb *= " +
                      encoded("texel") + ";"}}},
      {.name = "texture.base_color_not_decoded",
       .why = "the texture is uploaded as data",
       .first = {{"core", "texture.base_color.*"}},
       .edits =
           {{"material.glsl", base_color_sampled,
             "vec4 texel = texture_sample(u_base_color_texture, BASE_COLOR_TEXTURE_UV, BASE_COLOR_TEXTURE_SAMPLER);\n    value *= vec4(" +
                 encoded("texel.rgb") + ", texel.a);"}}},
      {.name = "texture.base_color_decoded_by_a_power",
       .why = "the sRGB curve is taken for a power of 2.2",
       .first = {{"core", "texture.base_color.*"}},
       .edits = {{"material.glsl", base_color_sampled,
                  "vec4 texel = texture_sample(u_base_color_texture, BASE_COLOR_TEXTURE_UV, BASE_COLOR_TEXTURE_SAMPLER);\n    value *= "
                  "vec4(pow(" +
                      encoded("texel.rgb") + ", vec3(2.2)), texel.a);"}}},
      {.name = "texture.emissive_not_decoded",
       .why = "the texture is uploaded as data",
       .first = {{"core", "texture.emissive.*"}},
       .edits = {{"material.glsl", emissive_sampled,
                  "vec3 texel = texture_sample(u_emissive_texture, EMISSIVE_TEXTURE_UV, EMISSIVE_TEXTURE_SAMPLER).rgb;\n    value *= " +
                      encoded("texel") + ";"}}},
      {.name = "texture.clearcoat_from_green",
       .why = "the coat's two textures are swapped",
       .first = {{"core", "texture.clearcoat.*"}},
       .edits = {{"material.glsl", "CLEARCOAT_TEXTURE_SAMPLER).r", "CLEARCOAT_TEXTURE_SAMPLER).g"}}},
      {.name = "texture.clearcoat_roughness_from_red",
       .why = "a texture of one value is read from its first channel",
       .first = {{"core", "texture.clearcoat_roughness.*"}},
       .edits = {{"material.glsl", "CLEARCOAT_ROUGHNESS_TEXTURE_SAMPLER).g", "CLEARCOAT_ROUGHNESS_TEXTURE_SAMPLER).r"}}},
      {.name = "texture.roughness_from_red",
       .why = "a picture of one's own has roughness first",
       .first = {{"core", "texture.metallic_roughness.*"}},
       .edits = {{"material.glsl", "METALLIC_ROUGHNESS_TEXTURE_SAMPLER).bg", "METALLIC_ROUGHNESS_TEXTURE_SAMPLER).br"}}},
      {.name = "texture.metallic_from_red",
       .why = "older files had metallic in red",
       .first = {{"core", "texture.metallic_roughness.*"}},
       .edits = {{"material.glsl", "METALLIC_ROUGHNESS_TEXTURE_SAMPLER).bg", "METALLIC_ROUGHNESS_TEXTURE_SAMPLER).rg"}}},
      {.name = "texture.occlusion_from_green",
       .why = "the picture is shared with the roughness, and so is the swizzle",
       .first = {{"furnace", "corner.occlusion"}},
       .edits = {{"material.glsl", "OCCLUSION_TEXTURE_SAMPLER).r", "OCCLUSION_TEXTURE_SAMPLER).g"}}},
  };
}

/// Where a texture is read.
std::vector<Mutant> texture_coordinate_mutants() {
  return {
      {.name = "texture.second_set_ignored",
       .why = "one set of coordinates is read",
       .first = {{"core", "texture.*.second_uv_set"}},
       .alter = [](scene::Scene& scene,
                   renderer::Settings&) { for_each_texture(scene, [](scene::TextureInfo& info) { info.texcoord = 0; }); }},
      {.name = "texture.transform_ignored",
       .why = "KHR_texture_transform is not known",
       .first = {{"core", "texture.*.transformed"}},
       .alter = [](scene::Scene& scene,
                   renderer::Settings&) { for_each_texture(scene, [](scene::TextureInfo& info) { info.transform = glm::dmat3(1.0); }); }},
      {.name = "texture.transform_ignored_by_the_coat_normal",
       .why = "the last texture to be added is forgotten",
       .first = {{"core", "texture.clearcoat_normal.transformed"}},
       .alter = of_materials([](scene::Material& material) { material.clearcoat.normal_texture.transform = glm::dmat3(1.0); })},
      {.name = "texture.transform_ignored_by_the_sheen_roughness",
       .why = "textures that share a picture are taken to share its transform",
       .first = {{"core", "texture.sheen_roughness.transformed"}},
       .alter = of_materials([](scene::Material& material) { material.sheen.roughness_texture.transform = glm::dmat3(1.0); })},
      {.name = "texture.transform_turned_the_other_way",
       .why = "v points down, which turns the sense of rotation",
       .first = {{"core", "texture.*.transformed"}},
       .alter =
           [](scene::Scene& scene, renderer::Settings&) {
             for_each_texture(scene, [](scene::TextureInfo& info) {
               info.transform[0][1] = -info.transform[0][1];
               info.transform[1][0] = -info.transform[1][0];
             });
           }},
      {.name = "texture.transform_in_the_other_order",
       .why = "scale * rotation * translation, where the matrices stand the other way round",
       .first = {{"core", "texture.*.transformed"}},
       .alter =
           [](scene::Scene& scene, renderer::Settings&) {
             for_each_texture(scene, [](scene::TextureInfo& info) {
               const glm::dvec2 offset(info.transform[2]);
               info.transform[2] = glm::dvec3(glm::dmat2(info.transform) * offset, 1.0);
             });
           }},
      {.name = "texture.upside_down",
       .why = "v runs upward in OpenGL and downward in glTF",
       .first = {{"core", "texture.*.plain"}},
       .alter =
           [](scene::Scene& scene, renderer::Settings&) {
             for_each_texture(scene, [](scene::TextureInfo& info) {
               info.transform = glm::dmat3(1.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 1.0, 1.0) * info.transform;
             });
           }},
      {.name = "texture.half_a_texel_off",
       .why = "texels are taken to stand at whole coordinates",
       .first = {{"core", "texture.*.plain"}},
       .edits = {{"textures.glsl", "vec2 st = clamp(uv * vec2(size), -1e9, 1e9);", "vec2 st = clamp(uv * vec2(size), -1e9, 1e9) + 0.5;"}}},
      {.name = "texture.mirrored_wrap_repeats",
       .why = "MIRRORED_REPEAT is not told from REPEAT",
       .first = {{"core", "texture.sheen_color.mirrored"}},
       .alter =
           [](scene::Scene& scene, renderer::Settings&) {
             for_each_sampler(scene, [](scene::Sampler& sampler) {
               sampler.wrap_s = without(sampler.wrap_s, scene::Wrap::MirroredRepeat);
               sampler.wrap_t = without(sampler.wrap_t, scene::Wrap::MirroredRepeat);
             });
           }},
      {.name = "texture.clamped_wrap_repeats",
       .why = "samplers are not read, and the default repeats",
       .first = {{"core", "texture.sheen_color.clamped"}},
       .alter =
           [](scene::Scene& scene, renderer::Settings&) {
             for_each_sampler(scene, [](scene::Sampler& sampler) {
               sampler.wrap_s = without(sampler.wrap_s, scene::Wrap::ClampToEdge);
               sampler.wrap_t = without(sampler.wrap_t, scene::Wrap::ClampToEdge);
             });
           }},
      {.name = "texture.nearest_is_linear",
       .why = "samplers are not read, and the default is linear",
       .first = {{"core", "texture.sheen_color.nearest"}},
       .alter =
           [](scene::Scene& scene, renderer::Settings&) {
             for_each_sampler(scene, [](scene::Sampler& sampler) {
               sampler.mag = scene::Filter::Linear;
               sampler.min = scene::Filter::Linear;
             });
           }},
      {.name = "texture.sixteen_bits_cut_to_eight",
       .why = "the picture's decoder returns bytes",
       .first = {{"core", "texture.sheen_color.sixteen_bits"}},
       .alter =
           [](scene::Scene& scene, renderer::Settings&) {
             for (scene::Picture& picture : scene.pictures) {
               if (picture.bits == 16) {
                 std::for_each(picture.codes.begin(), picture.codes.end(),
                               [](std::uint16_t& code) { code = static_cast<std::uint16_t>((code >> 8) * 257); });
               }
             }
           }},
  };
}

}  // namespace sheen::conformance
