#include "scene/view.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <gtest/gtest.h>

namespace sheen::scene {
namespace {

// A triangle a vertical plane holds, placed at each of these depths.
Scene blend_scene(std::initializer_list<double> depths) {
  Scene scene;
  scene.materials.resize(2);
  scene.materials[1].alpha_mode = AlphaMode::Blend;
  Primitive p;
  p.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  p.indices = {0, 1, 2};
  p.material = 1;
  scene.primitives = {p, p};
  scene.primitives[1].material = 0;
  for (const double depth : depths) {
    Instance instance;
    instance.world_from_local[3] = glm::dvec4(0, 0, -depth, 1);
    scene.instances.push_back(instance);
  }
  return scene;
}

Scene box(const glm::vec3& low, const glm::vec3& high) {
  Scene scene;
  Primitive p;
  for (int i = 0; i < 8; ++i) {
    p.positions.emplace_back((i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y, (i & 4) != 0 ? high.z : low.z);
  }
  scene.primitives = {p};
  scene.instances.resize(1);
  return scene;
}

glm::dvec3 project(const Camera& camera, double aspect, const glm::dvec3& p) {
  const glm::dvec4 clip = clip_from_camera(camera, aspect) * camera_from_world(camera) * glm::dvec4(p, 1.0);
  return glm::dvec3(clip) / clip.w;
}

std::vector<std::uint32_t> instances_of(const std::vector<BlendTriangle>& order) {
  std::vector<std::uint32_t> result;
  result.reserve(order.size());
  for (const BlendTriangle& t : order) {
    result.push_back(t.instance);
  }
  return result;
}

TEST(View, TheIndexedCameraThenTheFirstThenAFramingOne) {
  Scene scene = box(glm::vec3(-1), glm::vec3(1));
  scene.file = "cube.glb";
  EXPECT_EQ(resolve_camera(scene, {}).name, "framing");
  scene.cameras.resize(2);
  scene.cameras[0].name = "a";
  scene.cameras[1].name = "b";
  EXPECT_EQ(resolve_camera(scene, {}).name, "a");
  EXPECT_EQ(resolve_camera(scene, {.camera = 1}).name, "b");
  EXPECT_THROW(resolve_camera(scene, {.camera = 2}), Error);
  EXPECT_THROW(resolve_camera(scene, {.camera = -1}), Error);
}

TEST(View, FramingCameraSeesEveryCornerWhateverTheAspect) {
  for (const double aspect : {0.25, 1.0, 4.0}) {
    for (const double size : {1e-4, 1.0, 1e5}) {
      const auto s = static_cast<float>(size);
      const Scene scene = box(glm::vec3(3 * s, -s, 0), glm::vec3(5 * s, s, 7 * s));
      const Camera camera = framing_camera(scene, aspect);
      for (const glm::vec3& corner : scene.primitives[0].positions) {
        const glm::dvec3 ndc = project(camera, aspect, glm::dvec3(corner));
        for (int axis = 0; axis < 3; ++axis) {
          EXPECT_LT(std::abs(ndc[axis]), 1.0) << "aspect " << aspect << " size " << size;
        }
      }
    }
  }
}

TEST(View, FramingCameraFollowsInstances) {
  Scene scene = box(glm::vec3(-1), glm::vec3(1));
  scene.instances[0].world_from_local[3] = glm::dvec4(100, 0, 0, 1);
  EXPECT_EQ(framing_camera(scene, 1.0).world_from_camera[3].x, 100.0);
}

TEST(View, FramingCameraOfNothingIsUsable) {
  for (const Scene& scene : {Scene{}, box(glm::vec3(2), glm::vec3(2))}) {
    const Camera camera = framing_camera(scene, 1.0);
    EXPECT_GT(camera.znear, 0.0);
    EXPECT_GT(camera.zfar, camera.znear);
  }
}

// glTF 2.0, section 3.10.3: near and far planes land on -1 and +1, yfov and ymag on the top edge, whatever the aspect.
TEST(View, ProjectionsMapTheirPlanesToTheEdges) {
  Camera camera;
  camera.yfov = 1.0;
  camera.znear = 0.5;
  camera.zfar = 20.0;
  const double top = std::tan(0.5);
  EXPECT_NEAR(project(camera, 2.0, {0, 0, -0.5}).z, -1.0, 1e-12);
  EXPECT_NEAR(project(camera, 2.0, {0, 0, -20}).z, 1.0, 1e-12);
  EXPECT_NEAR(project(camera, 2.0, {2 * 3 * top, 3 * top, -3}).x, 1.0, 1e-12);
  EXPECT_NEAR(project(camera, 2.0, {0, 3 * top, -3}).y, 1.0, 1e-12);
  camera.zfar = std::numeric_limits<double>::infinity();
  EXPECT_NEAR(project(camera, 2.0, {0, 0, -0.5}).z, -1.0, 1e-12);
  EXPECT_NEAR(project(camera, 2.0, {0, 0, -1e12}).z, 1.0, 1e-11);
  camera.perspective = false;
  camera.ymag = 3.0;
  camera.zfar = 20.0;
  EXPECT_NEAR(project(camera, 2.0, {6, 3, -0.5}).x, 1.0, 1e-12);
  EXPECT_NEAR(project(camera, 2.0, {6, 3, -0.5}).y, 1.0, 1e-12);
  EXPECT_NEAR(project(camera, 2.0, {6, 3, -0.5}).z, -1.0, 1e-12);
  EXPECT_NEAR(project(camera, 2.0, {6, 3, -20}).z, 1.0, 1e-12);
}

TEST(View, CameraFromWorldInvertsTheCamerasPlace) {
  Camera camera;
  camera.world_from_camera = glm::dmat4(glm::dvec4(0, 0, -1, 0), glm::dvec4(0, 1, 0, 0), glm::dvec4(1, 0, 0, 0), glm::dvec4(7, 8, 9, 1));
  const glm::dmat4 product = camera_from_world(camera) * camera.world_from_camera;
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(product[i], glm::dmat4(1.0)[i]);
  }
}

TEST(View, BlendTrianglesComeFarthestFirstAndTiesKeepTheirOrder) {
  EXPECT_EQ(instances_of(blend_order(blend_scene({2, 5, 3}), Camera{})), (std::vector<std::uint32_t>{1, 2, 0}));
  EXPECT_EQ(instances_of(blend_order(blend_scene({2, 2, 2}), Camera{})), (std::vector<std::uint32_t>{0, 1, 2}));
  Scene opaque = blend_scene({1});
  opaque.instances[0].primitive = 1;
  EXPECT_TRUE(blend_order(opaque, Camera{}).empty());
}

TEST(View, BlendOrderGoesByTheViewingAxisNotByDistance) {
  Scene scene = blend_scene({10, 11});
  scene.instances[0].world_from_local[3].x = 50.0;  // farther from the eye, nearer along the axis
  EXPECT_EQ(instances_of(blend_order(scene, Camera{})), (std::vector<std::uint32_t>{1, 0}));
}

}  // namespace
}  // namespace sheen::scene
