#include "conformance/case_scene.h"

#include <cmath>
#include <fstream>
#include <map>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <unistd.h>

#include "conformance/pictures.h"
#include "conformance/shapes.h"
#include "conformance/suite.h"
#include "conformance/test_folder.h"
#include "scene/gltf.h"

namespace sheen::conformance {
namespace {

const Suite& core() {
  static const Suite suite = load_suite("core");
  return suite;
}

const Case& core_case(const std::string& name) {
  for (const Case& one : core().cases) {
    if (one.name == name) {
      return one;
    }
  }
  throw std::logic_error("no case " + name);
}

glm::dvec3 vec(const std::array<float, 3>& v) {
  return {v[0], v[1], v[2]};
}

TEST(Shapes, WindCounterClockwiseAboutTheirNormals) {
  for (const char* name : {"sphere", "cloth", "ring", "square", "slivers"}) {
    const Shape shape = make_shape(name);
    for (std::size_t i = 0; i < shape.indices.size(); i += 3) {
      const glm::dvec3 a = vec(shape.positions[shape.indices[i]]);
      const glm::dvec3 face = glm::cross(vec(shape.positions[shape.indices[i + 1]]) - a, vec(shape.positions[shape.indices[i + 2]]) - a);
      ASSERT_GT(glm::dot(face, vec(shape.normals[shape.indices[i]])), 0) << name << " triangle " << i / 3;
    }
  }
}

TEST(Shapes, FramesAreOrthonormalAndFollowTheTexture) {
  for (const char* name : {"sphere", "cloth", "ring", "square", "slivers"}) {
    const Shape shape = make_shape(name);
    for (std::size_t i = 0; i < shape.indices.size(); i += 3) {
      const std::size_t a = shape.indices[i];
      const glm::dvec3 n = vec(shape.normals[a]);
      const glm::dvec3 t{shape.tangents[a][0], shape.tangents[a][1], shape.tangents[a][2]};
      ASSERT_NEAR(glm::length(n), 1, 1e-6) << name;
      ASSERT_NEAR(glm::length(t), 1, 1e-6) << name;
      ASSERT_NEAR(glm::dot(n, t), 0, 1e-6) << name;
      // Along a triangle's edges, u grows with the tangent and v against the bitangent (v runs down, the picture's up is the bitangent).
      const glm::dvec3 b = glm::cross(n, t) * static_cast<double>(shape.tangents[a][3]);
      const std::size_t c = shape.indices[i + 1];
      const glm::dvec3 edge = vec(shape.positions[c]) - vec(shape.positions[a]);
      const double dv = static_cast<double>(shape.texcoord_0[c][1]) - shape.texcoord_0[a][1];
      ASSERT_LT(glm::dot(edge, b) * dv, 0) << name << " triangle " << i / 3;
    }
  }
}

TEST(Shapes, SliversAreFiveHundredTimesAsLongAsHigh) {
  const Shape shape = make_shape("slivers");
  for (std::size_t i = 0; i < shape.indices.size(); i += 3) {
    const glm::dvec3 a = vec(shape.positions[shape.indices[i]]);
    glm::dvec3 least = a;
    glm::dvec3 most = a;
    for (std::size_t k = 1; k < 3; ++k) {
      least = glm::min(least, vec(shape.positions[shape.indices[i + k]]));
      most = glm::max(most, vec(shape.positions[shape.indices[i + k]]));
    }
    // Positions are floats: a height of 0.002 is the difference of two of up to 1.
    ASSERT_NEAR((most - least).x / (most - least).y, 500, 500 * 0x1p-23 / 0.002) << "triangle " << i / 3;
  }
}

TEST(Shapes, BrokenNormalsAreThoseOfASquareAtEveryLength) {
  const Shape shape = make_shape("broken_normals");
  std::map<float, int> lengths;
  for (const std::array<float, 3>& normal : shape.normals) {
    const double length = glm::length(vec(normal));
    for (const float known : {0.0F, 1e-6F, 1.0F, 1000.0F}) {
      lengths[known] += std::abs(length - known) <= 1e-6 * known ? 1 : 0;
    }
    ASSERT_GE(normal[2], 0.0F) << "none faces away";
  }
  int told = 0;
  for (const auto& [length, count] : lengths) {
    EXPECT_GT(count, 0) << length;
    told += count;
  }
  EXPECT_EQ(told, static_cast<int>(shape.normals.size())) << "and there is no other length";
  for (std::size_t i = 0; i < shape.indices.size(); i += 3) {
    const glm::dvec3 a = vec(shape.positions[shape.indices[i]]);
    ASSERT_GT(glm::cross(vec(shape.positions[shape.indices[i + 1]]) - a, vec(shape.positions[shape.indices[i + 2]]) - a).z, 0);
  }
}

TEST(Shapes, MotleyHasNothingBetweenItsColors) {
  for (std::size_t c = 0; c < 4; ++c) {
    std::map<float, int> counts;
    for (const std::array<float, 4>& color : make_shape("motley").colors) {
      ++counts[color.at(c)];
    }
    ASSERT_EQ(counts.size(), 2U) << c;
    EXPECT_GT(counts[0.0F], 13 * 13 / 3) << c;
    EXPECT_GT(counts[1.0F], 13 * 13 / 3) << c;
  }
}

TEST(Pictures, RepeatWithoutASeamAndTellChannelsApart) {
  for (const char* name : {"channels", "weave", "odd"}) {
    const ProceduralPicture picture = make_picture(name);
    const auto code = [&picture](int x, int y, int c) {
      return static_cast<int>(picture.codes[static_cast<std::size_t>((y * picture.width + x) * picture.channels + c)]);
    };
    for (int y = 0; y < picture.height; ++y) {
      for (int c = 0; c < 4; ++c) {
        int largest_step = 0;
        for (int x = 1; x < picture.width; ++x) {
          largest_step = std::max(largest_step, std::abs(code(x, y, c) - code(x - 1, y, c)));
        }
        EXPECT_LE(std::abs(code(0, y, c) - code(picture.width - 1, y, c)), largest_step + 1) << name;
      }
    }
  }
}

TEST(Pictures, AKeptChannelIsTheWholePicturesAndTheOthersAreFlat) {
  const ProceduralPicture whole = make_picture("channels");
  const ProceduralPicture kept = make_picture("channels.ga");
  ASSERT_EQ(kept.codes.size(), whole.codes.size());
  for (std::size_t i = 0; i < whole.codes.size(); ++i) {
    EXPECT_EQ(kept.codes[i], i % 4 == 1 || i % 4 == 3 ? whole.codes[i] : 128) << i;
  }
  EXPECT_FALSE(parse_texture_name("channels."));
  EXPECT_FALSE(parse_texture_name("channels.x/linear"));
  EXPECT_TRUE(parse_texture_name("channels.a/linear"));
}

TEST(CaseScene, EveryCoreCaseLoadsAndIsWhatItsDescriptionSays) {
  const TestFolder folder;
  for (const Case& one : core().cases) {
    const std::filesystem::path file = write_scene(one, folder.path());
    ASSERT_LT(std::filesystem::file_size(file), 400U * 1024U) << one.name;
    const scene::Scene scene = scene::load_gltf(file);
    EXPECT_TRUE(scene.warnings.empty()) << one.name << ": " << (scene.warnings.empty() ? "" : scene.warnings.front());
    ASSERT_EQ(scene.instances.size(), 1U) << one.name;
    ASSERT_EQ(scene.cameras.size(), 1U) << one.name;
    ASSERT_EQ(scene.lights.size(), one.description["lights"].size()) << one.name;
  }
}

TEST(CaseScene, OfTheExtremesThoseAreRefusedThatBreakARuleAndNoOthers) {
  const TestFolder folder;
  for (const Case& one : load_suite("extremes").cases) {
    const std::filesystem::path file = write_scene(one, folder.path());
    if (one.refused) {
      EXPECT_THROW(scene::load_gltf(file), scene::Error) << one.name;
    } else {
      EXPECT_NO_THROW(scene::load_gltf(file)) << one.name;
    }
  }
}

TEST(CaseScene, NumbersReachTheSceneToTheirLastBit) {
  const TestFolder folder;
  std::map<std::string, double> found;
  for (const Case& one : load_suite("extremes").cases) {
    if (one.name.starts_with("metallic.") && one.name.ends_with(".highp")) {
      found[one.name] = scene::load_gltf(write_scene(one, folder.path())).materials.at(0).metallic_factor;
    }
  }
  EXPECT_EQ(found.at("metallic.least_normal.highp"), 0x1p-126);
  EXPECT_EQ(found.at("metallic.1_less_an_ulp.highp"), 1 - 0x1p-24);
  EXPECT_EQ(found.at("metallic.1.highp"), 1);
  EXPECT_EQ(found.at("metallic.0.highp"), 0);
}

TEST(CaseScene, CameraLooksAtItsTargetAndLightsComeFromWhereTheyShould) {
  const TestFolder folder;
  const Case& one = core_case("lights.directional_then_point_then_spot");
  const scene::Scene scene = scene::load_gltf(write_scene(one, folder.path()));
  const glm::dmat4& camera = scene.cameras[0].world_from_camera;
  const glm::dvec3 position(camera[3]);
  EXPECT_LT(glm::length(glm::normalize(-position) + glm::dvec3(camera[2])), 1e-9) << "looks along -Z at the origin";
  EXPECT_GT(camera[1].y, 0) << "upright";
  ASSERT_EQ(scene.lights.size(), 3U);
  EXPECT_EQ(scene.lights[0].type, scene::LightType::Directional);
  EXPECT_LT(glm::length(scene.lights[0].direction + glm::normalize(glm::dvec3(0.2, 0.9, 0.4))), 1e-9);
  EXPECT_LT(glm::length(scene.lights[1].position - glm::dvec3(-1.6, 0.3, 1.4)), 1e-9);
  EXPECT_LT(glm::length(scene.lights[2].direction - glm::normalize(glm::dvec3(0.2, 0, 0.4) - glm::dvec3(1.9, 0.2, 2.0))), 1e-9);
  EXPECT_NEAR(scene.lights[2].outer_cone, 0.4, 1e-12);
}

TEST(CaseScene, TextureReferencesKeepSetTransformAndSampler) {
  const TestFolder folder;
  const scene::Scene by_transform =
      scene::load_gltf(write_scene(core_case("texture.sheen_color.second_uv_set_by_transform"), folder.path()));
  EXPECT_EQ(by_transform.materials[0].sheen.color_texture.texcoord, 1);
  EXPECT_NEAR(by_transform.materials[0].sheen.color_texture.transform[0][0], 0.5, 1e-12);
  const scene::Scene mirrored = scene::load_gltf(write_scene(core_case("texture.sheen_color.mirrored"), folder.path()));
  EXPECT_EQ(mirrored.textures[0].sampler.wrap_s, scene::Wrap::MirroredRepeat);
  const scene::Scene shared = scene::load_gltf(write_scene(core_case("texture.sheen_roughness.shared_with_the_color"), folder.path()));
  EXPECT_EQ(shared.pictures.size(), 1U) << "a picture used twice is stored once";
  EXPECT_EQ(shared.materials[0].sheen.color_texture.texture, shared.materials[0].sheen.roughness_texture.texture);
}

TEST(CaseScene, PicturesKeepTheirCodes) {
  const TestFolder folder;
  const scene::Scene scene = scene::load_gltf(write_scene(core_case("texture.sheen_color.sixteen_bits"), folder.path()));
  const ProceduralPicture picture = make_picture("weave16");
  ASSERT_EQ(scene.pictures.size(), 1U);
  EXPECT_EQ(scene.pictures[0].bits, 16);
  EXPECT_EQ(scene.pictures[0].codes, picture.codes);
}

TEST(CaseScene, TheSameCaseGivesTheSameFile) {
  const TestFolder folder;
  const Case& one = core_case("texture.normal.plain");
  EXPECT_EQ(make_glb(one), make_glb(one));
  const std::filesystem::path file = write_scene(one, folder.path());
  EXPECT_EQ(write_scene(one, folder.path()), file);
  Case other = one;
  other.description["material"]["pbrMetallicRoughness"]["roughnessFactor"] = 0.61;
  EXPECT_NE(write_scene(other, folder.path()), file);
}

TEST(CaseScene, ATruncatedFileOfThatNameIsWrittenAnew) {
  const TestFolder folder;
  const Case& one = core_case("defaults.sheen_empty");
  const std::filesystem::path file = write_scene(one, folder.path());
  const auto size = std::filesystem::file_size(file);
  std::filesystem::resize_file(file, 100);
  EXPECT_EQ(write_scene(one, folder.path()), file);
  EXPECT_EQ(std::filesystem::file_size(file), size);
}

}  // namespace
}  // namespace sheen::conformance
