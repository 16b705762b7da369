#include <functional>

#include "scene/gltf_fixture_test.h"

namespace sheen::scene::test {
namespace {

Scene full_scene() {
  Asset asset = triangle();
  asset.material()["emissiveTexture"]["index"] = asset.add_texture(png(1, 1, 8, {10, 20, 30, 40}));
  Scene scene = load(asset);
  scene.lights.resize(1);
  scene.cameras.resize(1);
  return scene;
}

TEST(ContentHash, IsThirtyTwoHexDigits) {
  const std::string hash = content_hash(full_scene());
  EXPECT_EQ(hash.size(), 32U);
  EXPECT_EQ(hash.find_first_not_of("0123456789abcdef"), std::string::npos);
  EXPECT_EQ(hash, content_hash(full_scene()));
}

TEST(ContentHash, NamesAndFilesDoNotCount) {
  Scene scene = full_scene();
  const std::string before = content_hash(scene);
  scene.file = "elsewhere.glb";
  scene.materials[0].name = "other";
  scene.pictures[0].name = "other";
  scene.cameras[0].name = "other";
  scene.warnings.emplace_back("other");
  EXPECT_EQ(content_hash(scene), before);
}

TEST(ContentHash, EverythingThatCanChangeAPictureCounts) {
  const std::function<void(Scene&)> changes[] = {
      [](Scene& s) { s.pictures[0].codes[2] ^= 1U; },
      [](Scene& s) { s.pictures[0].bits = 16; },
      [](Scene& s) { s.textures[0].sampler.wrap_s = Wrap::ClampToEdge; },
      [](Scene& s) { s.textures[0].sampler.mip = MipFilter::None; },
      [](Scene& s) { s.materials[0].base_color_factor.a = 0.5; },
      [](Scene& s) { s.materials[0].sheen.color_factor.b = 0.5; },
      [](Scene& s) { s.materials[0].sheen.roughness_factor = 0.5; },
      [](Scene& s) { s.materials[0].clearcoat.normal_scale = 0.5; },
      [](Scene& s) { s.materials[0].emissive_texture.texcoord = 1; },
      [](Scene& s) { s.materials[0].emissive_texture.transform[2][0] = 0.5; },
      [](Scene& s) { s.materials[0].double_sided = true; },
      [](Scene& s) { s.materials[0].alpha_mode = AlphaMode::Blend; },
      [](Scene& s) { s.primitives[0].positions[0].x += 1e-6f; },
      [](Scene& s) { s.primitives[0].normals[0].x += 1e-6f; },
      [](Scene& s) { s.primitives[0].texcoords[0][0].x += 1.0f; },
      [](Scene& s) { std::swap(s.primitives[0].texcoords[0], s.primitives[0].texcoords[1]); },
      [](Scene& s) { std::swap(s.primitives[0].indices[0], s.primitives[0].indices[1]); },
      [](Scene& s) { s.instances[0].world_from_local[3].x = 1.0; },
      [](Scene& s) { s.lights[0].intensity = 2.0; },
      [](Scene& s) { s.lights[0].direction.x = 1.0; },
      [](Scene& s) { s.cameras[0].yfov = 1.0; },
      [](Scene& s) { s.cameras[0].world_from_camera[3].x = 1.0; },
  };
  const std::string before = content_hash(full_scene());
  for (std::size_t i = 0; i < std::size(changes); ++i) {
    Scene scene = full_scene();
    changes[i](scene);
    EXPECT_NE(content_hash(scene), before) << "change " << i;
  }
}

}  // namespace
}  // namespace sheen::scene::test
