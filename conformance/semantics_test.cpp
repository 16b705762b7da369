// Every law of the suite holds for the CPU's truth, and breaks for viewers that read a file wrongly: the truth of a scene read wrongly
// stands in for those.
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include <gtest/gtest.h>

#include "conformance/case_scene.h"
#include "conformance/golden_store.h"
#include "conformance/relate.h"
#include "conformance/run.h"
#include "conformance/suite.h"
#include "conformance/test_folder.h"
#include "golden/golden.h"
#include "image/srgb.h"
#include "scene/gltf.h"

namespace sheen::conformance {
namespace {

const Suite& semantics() {
  static const Suite suite = load_suite("semantics");
  return suite;
}

const Relation& relation(const std::string& name) {
  for (const Relation& one : semantics().relations) {
    if (one.name == name) {
      return one;
    }
  }
  throw std::logic_error("no relation " + name);
}

/// A way to misread: changes the scene, or the form of the model that is asked for.
using Misreading = std::function<void(scene::Scene&, golden::Settings&)>;

/// Half the size is enough, and quicker.
Relation at_half_size(Relation relation) {
  for (Case& one : relation.scenes) {
    one.width /= 2;
    one.height /= 2;
  }
  return relation;
}

/// The truth of every scene, misread or not.
std::vector<image::Image> pictures_of(const Relation& relation, const Misreading& misread = {}) {
  static const TestFolder folder;
  std::vector<image::Image> pictures;
  for (const Case& one : relation.scenes) {
    scene::Scene scene = scene::load_gltf(write_scene(one, folder.path()));
    golden::Settings settings = golden_settings(one, one.model, 8);
    settings.bounds = false;
    if (misread) {
      misread(scene, settings);
    }
    pictures.push_back(golden::render(scene, settings));
  }
  return pictures;
}

/// What an 8-bit viewer with Khronos' PBR neutral tone mapper makes of radiance: its toe takes the least channel's share from all, so it is
/// no function of each channel alone (KhronosGroup/ToneMapping, PBR_Neutral).
image::Image tone_mapped(image::Image picture) {
  for (std::size_t i = 0; i < picture.data.size(); i += picture.channels.size()) {
    const auto texel = picture.data.begin() + static_cast<std::ptrdiff_t>(i);
    const double least = std::min({texel[0], texel[1], texel[2]});
    const double toe = least < 0.08 ? least - 6.25 * least * least : 0.04;
    const double peak = std::max({texel[0], texel[1], texel[2]}) - toe;
    const double pressed = peak < 0.76 ? peak : 1 - 0.24 * 0.24 / (peak + 0.24 - 0.76);
    const double white = peak < 0.76 ? 0 : 1 - 1 / (0.15 * (peak - pressed) + 1);
    for (int c = 0; c < 3; ++c) {
      const double scaled = peak > 0 ? (texel[c] - toe) * pressed / peak : 0;
      const double code = std::round(255 * image::linear_to_srgb(scaled + (pressed - scaled) * white));
      texel[c] = static_cast<float>(image::srgb_to_linear(code / 255));
    }
  }
  return picture;
}

TEST(SemanticsSuite, HoldsRelationsOfEveryKindEachWithItsSource) {
  const Suite& suite = semantics();
  EXPECT_TRUE(suite.cases.empty());
  EXPECT_GE(suite.relations.size(), 40U);
  std::map<RelationKind, int> kinds;
  for (const Relation& one : suite.relations) {
    ++kinds[one.kind];
    EXPECT_TRUE(one.source.starts_with("KHR_") || one.source.starts_with("glTF 2.0, ")) << one.name << ": " << one.source;
    for (std::size_t i = 1; i < one.scenes.size(); ++i) {
      EXPECT_NE(one.scenes[i].description, one.scenes[0].description) << one.name << ": a picture is always like itself";
    }
  }
  for (const RelationKind kind : {RelationKind::Equal, RelationKind::Differs, RelationKind::Brighter, RelationKind::Linear}) {
    EXPECT_GE(kinds[kind], 5) << to_string(kind);
  }
  EXPECT_EQ(list("semantics").size(), suite.relations.size());
  EXPECT_EQ(list("semantics", "sheen.color_zero_is_no_sheen").at(0).law, "If sheenColorFactor is zero, the whole sheen layer is disabled");
}

TEST(SemanticsSuite, TheTruthKeepsEveryLawAndToneMappedEveryOneThatIsLeft) {
  RelationRules mapping;
  mapping.srgb8 = true;
  mapping.tone_mapped = true;
  int unsupported = 0;
  for (const Relation& whole : semantics().relations) {
    const Relation one = at_half_size(whole);
    std::vector<image::Image> pictures = pictures_of(one);
    const Verdict verdict = relate(one, pictures, {});
    EXPECT_EQ(verdict.status, Status::Pass) << one.name << ": " << verdict.message;
    std::transform(pictures.begin(), pictures.end(), pictures.begin(), tone_mapped);
    const Verdict mapped = relate(one, pictures, mapping);
    unsupported += mapped.status == Status::Unsupported ? 1 : 0;
    EXPECT_TRUE(mapped.status == Status::Pass || mapped.status == Status::Unsupported) << one.name << " tone-mapped: " << mapped.message;
  }
  EXPECT_LE(unsupported, 5) << "a law that needs radiance is asked of few";
}

TEST(SemanticsSuite, OnePictureForAllBreaksWhateverAsksForADifference) {
  for (const Relation& one : semantics().relations) {
    image::Image grey(one.scenes[0].width, one.scenes[0].height, {"R", "G", "B", "A"});
    for (float& value : grey.data) {
      value = 0.5F;
    }
    const Verdict verdict = relate(one, std::vector<image::Image>(one.scenes.size(), grey), {});
    const bool asks = one.kind == RelationKind::Differs || one.kind == RelationKind::Brighter;
    EXPECT_EQ(verdict.status, asks ? Status::Fail : one.kind == RelationKind::Equal ? Status::Pass : verdict.status) << one.name;
  }
}

TEST(SemanticsSuite, APictureOffByATwentiethBreaksEveryEqualityAndSum) {
  for (const Relation& one : semantics().relations) {
    if (one.kind != RelationKind::Equal && one.kind != RelationKind::Linear) {
      continue;
    }
    image::Image grey(one.scenes[0].width, one.scenes[0].height, {"R", "G", "B", "A"});
    for (float& value : grey.data) {
      value = 0.5F;
    }
    std::vector<image::Image> pictures(one.scenes.size(), grey);
    for (std::size_t i = 0; i < pictures.back().data.size(); ++i) {
      pictures.back().data[i] *= i % 4 == 3 ? 1.0F : 1.05F;
    }
    EXPECT_EQ(relate(one, pictures, {}).status, Status::Fail) << one.name;
  }
}

struct WrongViewer {
  const char* how;
  Misreading misread;
  std::vector<const char*> broken;  ///< some of the relations that must not hold for it
};

/// Every texture of a material, with its name.
std::vector<std::pair<std::string, scene::TextureInfo*>> textures_of(scene::Material& m) {
  return {{"base_color", &m.base_color_texture},
          {"metallic_roughness", &m.metallic_roughness_texture},
          {"normal", &m.normal_texture},
          {"emissive", &m.emissive_texture},
          {"sheen_color", &m.sheen.color_texture},
          {"sheen_roughness", &m.sheen.roughness_texture},
          {"clearcoat", &m.clearcoat.factor_texture},
          {"clearcoat_roughness", &m.clearcoat.roughness_texture},
          {"clearcoat_normal", &m.clearcoat.normal_texture}};
}

Misreading of_material(std::function<void(scene::Material&)> change) {
  return [change](scene::Scene& scene, golden::Settings&) {
    for (scene::Material& material : scene.materials) {
      change(material);
    }
  };
}

/// Reads channel `from` of every picture where channel `to` is meant.
Misreading of_channel(std::size_t from, std::size_t to) {
  return [from, to](scene::Scene& scene, golden::Settings&) {
    for (scene::Picture& picture : scene.pictures) {
      for (std::size_t i = 0; i < picture.codes.size(); i += 4) {
        picture.codes[i + to] = picture.codes[i + from];
      }
    }
  };
}

std::vector<WrongViewer> wrong_viewers() {
  return {
      {"no sheen", of_material([](scene::Material& m) { m.sheen = {}; }), {"sheen.has_an_effect", "sheen_texture.color_is_read_at_all"}},
      {"no coat",
       of_material([](scene::Material& m) { m.clearcoat = {}; }),
       {"clearcoat.has_an_effect", "clearcoat.dims_the_base", "emission.dims_under_the_coat"}},
      {"no albedo scaling",
       [](scene::Scene&, golden::Settings& s) { s.sheen.scaling = albedo::AlbedoScaling::None; },
       {"sheen.dims_the_base"}},
      {"scaling by the view alone",
       [](scene::Scene&, golden::Settings& s) { s.sheen.scaling = albedo::AlbedoScaling::View; },
       {"reciprocity.sheen_over_base.25_and_72", "reciprocity.sheen_over_base.50_and_80"}},
      {"textures without factors",
       of_material([](scene::Material& m) {
         m.sheen.roughness_factor = m.sheen.roughness_texture.present() ? 1 : m.sheen.roughness_factor;
         m.sheen.color_factor = m.sheen.color_texture.present() ? glm::dvec3(1) : m.sheen.color_factor;
         m.clearcoat.factor = m.clearcoat.factor_texture.present() ? 1 : m.clearcoat.factor;
         m.clearcoat.roughness_factor = m.clearcoat.roughness_texture.present() ? 1 : m.clearcoat.roughness_factor;
       }),
       {"sheen.color_zero_disables_its_textures", "sheen_texture.roughness_is_factor_times_alpha",
        "sheen_texture.color_is_factor_times_texture", "clearcoat.factor_zero_is_no_coat",
        "clearcoat_texture.factor_is_linear_and_multiplies", "clearcoat_texture.roughness_is_linear_and_multiplies"}},
      {"factors without textures",
       of_material([](scene::Material& m) {
         for (auto& [name, texture] : textures_of(m)) {
           *texture = {};
         }
       }),
       {"sheen_texture.roughness_is_read_at_all", "clearcoat_texture.factor_is_read_at_all", "base.normal_map_has_an_effect"}},
      {"red for alpha",
       of_channel(0, 3),
       {"sheen_texture.roughness_is_read_from_alpha_alone", "sheen_texture.roughness_is_factor_times_alpha"}},
      {"red for green",
       of_channel(0, 1),
       {"clearcoat_texture.roughness_is_read_from_green_alone", "clearcoat_texture.roughness_is_linear_and_multiplies"}},
      {"alpha for red",
       of_channel(3, 0),
       {"clearcoat_texture.factor_is_read_from_red_alone", "sheen_texture.color_is_not_read_from_alpha"}},
      {"the base's normal map for a coat without one",
       of_material([](scene::Material& m) {
         if (!m.clearcoat.normal_texture.present()) {
           m.clearcoat.normal_texture = m.normal_texture;
         }
       }),
       {"clearcoat.ignores_the_base_normal_map"}},
      {"the coat's normal map for all layers",
       of_material([](scene::Material& m) {
         if (m.clearcoat.normal_texture.present()) {
           m.normal_texture = m.clearcoat.normal_texture;
           m.normal_scale = m.clearcoat.normal_scale;
         }
       }),
       {"clearcoat.normal_map_does_not_reach_the_base", "clearcoat.normal_map_does_not_reach_the_sheen"}},
      {"tangents' handedness lost",
       [](scene::Scene& s, golden::Settings&) {
         for (auto& tangent : s.primitives.at(0).tangents) {
           tangent.w = 1;
         }
       },
       {"base.normal_map_of_mirrored_coordinates_keeps_its_bitangent", "clearcoat.normal_map_of_mirrored_coordinates_keeps_its_bitangent"}},
      {"no second set",
       of_material([](scene::Material& m) {
         for (auto& [name, texture] : textures_of(m)) {
           texture->texcoord = 0;
         }
       }),
       {"texture.second_set_is_the_first_transformed.sheen_color", "texture.second_set_is_the_first_transformed.clearcoat_normal"}},
      {"no texture transform",
       of_material([](scene::Material& m) {
         for (auto& [name, texture] : textures_of(m)) {
           texture->transform = glm::dmat3(1);
         }
       }),
       {"texture.second_set_is_the_first_transformed.base_color", "texture.transform_has_an_effect.sheen_roughness"}},
      {"the first light alone",
       [](scene::Scene& s, golden::Settings&) { s.lights.resize(1); },
       {"lights.order_of_two_does_not_matter", "lights.two_of_half_strength_are_one", "lights.add", "lights.second_has_an_effect"}},
      {"point lights without falloff",
       [](scene::Scene& s, golden::Settings&) {
         for (scene::Light& light : s.lights) {
           light.intensity *= light.type == scene::LightType::Point ? glm::dot(light.position, light.position) : 1;
         }
       },
       {"lights.fall_off_with_the_square_of_the_distance"}},
      {"node transforms lost",
       [](scene::Scene& s, golden::Settings&) { s.instances.at(0).world_from_local = glm::dmat4(1); },
       {"space.turning_everything_changes_nothing", "space.mirroring_everything_mirrors_the_picture"}},
      {"no vertex colors", [](scene::Scene& s, golden::Settings&) { s.primitives.at(0).colors.clear(); }, {"base.vertex_colors_tint_it"}},
      {"all double sided",
       of_material([](scene::Material& m) { m.double_sided = true; }),
       {"sides.back_of_a_single_sided_square_is_not_seen"}},
      {"none double sided",
       of_material([](scene::Material& m) { m.double_sided = false; }),
       {"sides.back_of_a_double_sided_square_is_lit_as_a_front"}},
      {"all blended", of_material([](scene::Material& m) { m.alpha_mode = scene::AlphaMode::Blend; }), {"alpha.opaque_ignores_it"}},
      {"none blended",
       of_material([](scene::Material& m) { m.alpha_mode = scene::AlphaMode::Opaque; }),
       {"alpha.blend_lets_the_background_through", "alpha.blend_covers_by_its_share", "alpha.mask_drops_what_does_not"}},
  };
}

TEST(SemanticsSuite, AViewerThatMisreadsBreaksTheLawsItShould) {
  for (const WrongViewer& viewer : wrong_viewers()) {
    for (const char* name : viewer.broken) {
      const Relation one = at_half_size(relation(name));
      EXPECT_EQ(relate(one, pictures_of(one, viewer.misread), {}).status, Status::Fail) << viewer.how << " passes " << name;
    }
  }
}

}  // namespace
}  // namespace sheen::conformance
