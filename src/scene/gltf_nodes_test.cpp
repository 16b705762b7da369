#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "scene/gltf_fixture_test.h"

namespace sheen::scene::test {
namespace {

const double half = std::sqrt(0.5);

void expect_near(const glm::dvec3& a, const glm::dvec3& b, double tolerance = 1e-12) {
  EXPECT_LE(glm::distance(a, b), tolerance) << "(" << a.x << ", " << a.y << ", " << a.z << ") is not (" << b.x << ", " << b.y << ", " << b.z
                                            << ")";
}

glm::dvec3 apply(const glm::dmat4& m, const glm::dvec3& p) {
  return glm::dvec3(m * glm::dvec4(p, 1.0));
}

Asset with_nodes(const json& nodes) {
  Asset asset = triangle();
  asset.document["nodes"] = nodes;
  return asset;
}

Asset with_light(const json& light, const json& node = json::object()) {
  Asset asset = triangle();
  asset.document["extensions"]["KHR_lights_punctual"]["lights"] = json::array({light});
  json placed = node;
  placed["extensions"]["KHR_lights_punctual"]["light"] = 0;
  asset.document["nodes"].push_back(placed);
  asset.document["scenes"][0]["nodes"] = {0, 1};
  return asset;
}

Asset with_camera(const json& camera, const json& node = json::object()) {
  Asset asset = triangle();
  asset.document["cameras"] = json::array({camera});
  json placed = node;
  placed["camera"] = 0;
  asset.document["nodes"].push_back(placed);
  asset.document["scenes"][0]["nodes"] = {0, 1};
  return asset;
}

const json perspective = {{"type", "perspective"}, {"perspective", {{"yfov", 0.8}, {"znear", 0.1}}}};

// glTF 2.0, section 3.5.3: M = T R S, a quarter turn about +Z takes +X to +Y.
TEST(GltfNodes, TransformsScaleThenRotateThenTranslate) {
  const json node = {{"mesh", 0}, {"translation", {1, 2, 3}}, {"rotation", {0, 0, half, half}}, {"scale", {2, 3, 4}}};
  const Scene scene = load(with_nodes(json::array({node})));
  expect_near(apply(scene.instances.at(0).world_from_local, {1, 0, 0}), {1, 4, 3});
  expect_near(apply(scene.instances.at(0).world_from_local, {0, 1, 1}), {-2, 2, 7});
}

TEST(GltfNodes, MatricesAreColumnMajorAndParentsApplyAfterChildren) {
  const json parent = {{"matrix", {2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 10, 0, 0, 1}}, {"children", {1}}};
  const json child = {{"mesh", 0}, {"translation", {0, 1, 0}}};
  const Scene scene = load(with_nodes({parent, child}));
  ASSERT_EQ(scene.instances.size(), 1U);
  expect_near(apply(scene.instances[0].world_from_local, {1, 0, 0}), {12, 2, 0});
}

TEST(GltfNodes, NegativeDeterminantsMirror) {
  EXPECT_TRUE(load(with_nodes(json::array({{{"mesh", 0}, {"scale", {-1, 1, 1}}}}))).instances[0].mirrored());
  EXPECT_FALSE(load(with_nodes(json::array({{{"mesh", 0}, {"scale", {-1, -1, 1}}}}))).instances[0].mirrored());
}

TEST(GltfNodes, SingularTransformsAreLeftOutWithAWarning) {
  const Scene scene = load(with_nodes(json::array({{{"mesh", 0}, {"scale", {1, 0, 1}}}})));
  EXPECT_TRUE(scene.instances.empty());
  EXPECT_EQ(scene.warnings.size(), 1U);
}

TEST(GltfNodes, TreesMustBeStrict) {
  Asset asset = with_nodes(json::array({{{"children", {1}}}, {{"children", {2}}}, {{"children", {1}}}}));
  EXPECT_TRUE(names(error_of(asset), "nodes[1]", "two parents"));
  asset = with_nodes(json::array({{{"mesh", 0}}, {{"children", {2}}}, {{"children", {1}}, {"name", "loop"}}}));
  EXPECT_TRUE(names(error_of(asset), "nodes[1]", "cycles"));
  asset = with_nodes(json::array({{{"children", {0}}}}));
  EXPECT_TRUE(names(error_of(asset), "nodes[0]", "cycles"));
  asset = with_nodes(json::array({{{"children", {1, 1}}}, {{"mesh", 0}}}));
  EXPECT_TRUE(names(error_of(asset), "nodes[1]", "two parents"));
  asset = with_nodes(json::array({{{"children", {1}}}, {{"mesh", 0}}}));
  asset.document["scenes"][0]["nodes"] = {1};
  EXPECT_TRUE(names(error_of(asset), "scenes[0]", "no root node"));
  asset.document["scenes"][0]["nodes"] = {0, 0};
  EXPECT_TRUE(names(error_of(asset), "scenes[0]", "twice"));
}

TEST(GltfNodes, DeepTreesNeedNoStack) {
  json nodes = json::array();
  constexpr int depth = 20000;
  for (int i = 0; i < depth; ++i) {
    nodes.push_back({{"children", {i + 1}}, {"translation", {1, 0, 0}}});
  }
  nodes.push_back({{"mesh", 0}});
  expect_near(apply(load(with_nodes(nodes)).instances.at(0).world_from_local, {0, 0, 0}), {depth, 0, 0});
}

TEST(GltfNodes, ReferencesMustBeInRange) {
  for (const char* key : {"mesh", "camera", "skin"}) {
    EXPECT_TRUE(names(error_of(with_nodes(json::array({{{key, 1}}}))), "nodes[0]", std::string(key) + " is 1, out of range"));
  }
  EXPECT_TRUE(names(error_of(with_nodes(json::array({{{"children", {4}}}}))), "nodes[0]", "children is 4, out of range"));
  Asset asset = triangle();
  asset.document["scene"] = 1;
  EXPECT_TRUE(names(error_of(asset), "document", "scene is 1, out of range"));
  asset.document["scene"] = 0;
  asset.document["scenes"][0]["nodes"] = {3};
  EXPECT_TRUE(names(error_of(asset), "scenes[0]", "nodes is 3, out of range"));
}

TEST(GltfNodes, TransformsMustBeWellFormed) {
  const json identity = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  EXPECT_TRUE(names(error_of(with_nodes(json::array({{{"matrix", identity}, {"scale", {1, 1, 1}}}}))), "nodes[0]", "together with matrix"));
  EXPECT_TRUE(names(error_of(with_nodes(json::array({{{"matrix", {1, 2}}}}))), "nodes[0]", "array of 16"));
  json projective = identity;
  projective[3] = 1;
  EXPECT_TRUE(names(error_of(with_nodes(json::array({{{"matrix", projective}}}))), "nodes[0]", "last row"));
  EXPECT_TRUE(names(error_of(with_nodes(json::array({{{"rotation", {0, 0, 0, 0}}}}))), "nodes[0]", "unit quaternion"));
  EXPECT_TRUE(names(error_of(with_nodes(json::array({{{"rotation", {0, 0, 0, 2}}}}))), "nodes[0]", "rotation is 2.0, outside"));
  EXPECT_TRUE(names(error_of(with_nodes(json::array({{{"translation", {0, 0}}}}))), "nodes[0]", "array of 3"));
  const json huge = {{"scale", {1e300, 1e300, 1e300}}, {"children", {1}}};
  EXPECT_TRUE(names(error_of(with_nodes({huge, {{"scale", {1e300, 1, 1}}}})), "nodes[1]", "overflows"));
}

TEST(GltfNodes, OnlyTheDefaultSceneIsDrawn) {
  Asset asset = with_nodes(json::array({{{"mesh", 0}}, {{"mesh", 0}, {"translation", {5, 0, 0}}}}));
  asset.document["scenes"] = json::array({{{"nodes", {0}}}, {{"nodes", {1}}}});
  asset.document["scene"] = 1;
  ASSERT_EQ(load(asset).instances.size(), 1U);
  EXPECT_EQ(load(asset).instances[0].world_from_local[3].x, 5.0);
  asset.document.erase("scene");
  EXPECT_EQ(load(asset).instances.at(0).world_from_local[3].x, 0.0);
  asset.document.erase("scenes");
  EXPECT_EQ(load(asset).instances.size(), 2U);
  EXPECT_EQ(load(asset).warnings.size(), 1U);
}

TEST(GltfNodes, SkinsAndMorphTargetsAreWarnedOf) {
  Asset asset = triangle();
  asset.document["skins"] = json::array({{{"joints", {0}}}});
  asset.document["nodes"][0]["skin"] = 0;
  asset.primitive()["targets"] = json::array({{{"POSITION", 0}}});
  EXPECT_EQ(load(asset).warnings.size(), 2U);
}

TEST(GltfLights, DirectionIsMinusZOfTheNodeWhateverItsScale) {
  const json node = {{"rotation", {0, half, 0, half}}, {"scale", {2, 3, 4}}, {"translation", {7, 8, 9}}};
  const Light sun = load(with_light({{"type", "directional"}, {"intensity", 3}, {"color", {1, 0.5, 0}}, {"range", 5}}, node)).lights.at(0);
  EXPECT_EQ(sun.type, LightType::Directional);
  expect_near(sun.direction, {-1, 0, 0});
  EXPECT_EQ(sun.intensity, 3.0);
  EXPECT_EQ(sun.color, glm::dvec3(1, 0.5, 0));
  EXPECT_TRUE(std::isinf(sun.range)) << "range has no meaning for directional lights";
  const Light spot = load(with_light({{"type", "spot"}, {"spot", {{"innerConeAngle", 0.1}, {"outerConeAngle", 0.2}}}}, node)).lights.at(0);
  expect_near(spot.position, {7, 8, 9});
  EXPECT_EQ(spot.inner_cone, 0.1);
  EXPECT_EQ(spot.outer_cone, 0.2);
}

TEST(GltfLights, DefaultsAreThoseOfTheExtension) {
  const Light point = load(with_light({{"type", "point"}})).lights.at(0);
  EXPECT_EQ(point.type, LightType::Point);
  EXPECT_EQ(point.color, glm::dvec3(1.0));
  EXPECT_EQ(point.intensity, 1.0);
  EXPECT_TRUE(std::isinf(point.range));
  const Light spot = load(with_light({{"type", "spot"}, {"spot", json::object()}})).lights.at(0);
  EXPECT_EQ(spot.inner_cone, 0.0);
  EXPECT_EQ(spot.outer_cone, std::numbers::pi / 4);
  const json widest = {{"type", "spot"}, {"spot", {{"outerConeAngle", static_cast<double>(1.57079637f)}}}};
  EXPECT_NEAR(load(with_light(widest)).lights.at(0).outer_cone, std::numbers::pi / 2, 1e-7);
}

TEST(GltfLights, ValuesOutsideTheSchemaAreRefused) {
  const char* light = "KHR_lights_punctual.lights[0]";
  EXPECT_TRUE(names(error_of(with_light({{"type", "area"}})), light, "'area'"));
  EXPECT_TRUE(names(error_of(with_light(json::object())), light, "type is required"));
  EXPECT_TRUE(names(error_of(with_light({{"type", "point"}, {"range", 0}})), light, "range"));
  EXPECT_TRUE(names(error_of(with_light({{"type", "point"}, {"intensity", -1}})), light, "intensity"));
  EXPECT_TRUE(names(error_of(with_light({{"type", "point"}, {"color", {0, 0, 2}}})), light, "color"));
  EXPECT_TRUE(names(error_of(with_light({{"type", "spot"}})), light, "spot is required"));
  const json inverted = {{"innerConeAngle", 0.5}, {"outerConeAngle", 0.5}};
  EXPECT_TRUE(names(error_of(with_light({{"type", "spot"}, {"spot", inverted}})), light, "less than outerConeAngle"));
  EXPECT_TRUE(names(error_of(with_light({{"type", "spot"}, {"spot", {{"outerConeAngle", 2}}}})), light, "outerConeAngle"));
  Asset asset = with_light({{"type", "point"}});
  asset.document["nodes"][1]["extensions"]["KHR_lights_punctual"]["light"] = 1;
  EXPECT_TRUE(names(error_of(asset), "nodes[1]", "light is 1, out of range"));
  EXPECT_TRUE(names(error_of(with_light({{"type", "directional"}}, {{"scale", {0, 0, 0}}})), "nodes[1]", "no direction"));
}

TEST(GltfCameras, ScaleAndMirroringAreIgnored) {
  const json node = {{"rotation", {0, half, 0, half}}, {"scale", {-2, 3, 4}}, {"translation", {7, 8, 9}}};
  const glm::dmat4 m = load(with_camera(perspective, node)).cameras.at(0).world_from_camera;
  expect_near(glm::dvec3(m[0]), {0, 0, -1});
  expect_near(glm::dvec3(m[1]), {0, 1, 0});
  expect_near(glm::dvec3(m[2]), {1, 0, 0});
  expect_near(glm::dvec3(m[3]), {7, 8, 9});
}

TEST(GltfCameras, BothProjectionsAreRead) {
  const Camera infinite = load(with_camera(perspective)).cameras.at(0);
  EXPECT_TRUE(infinite.perspective);
  EXPECT_EQ(infinite.yfov, 0.8);
  EXPECT_EQ(infinite.znear, 0.1);
  EXPECT_TRUE(std::isinf(infinite.zfar));
  json finite = perspective;
  finite["perspective"]["zfar"] = 10;
  EXPECT_EQ(load(with_camera(finite)).cameras.at(0).zfar, 10.0);
  const json orthographic = {{"xmag", 3}, {"ymag", 2}, {"znear", 0}, {"zfar", 5}};
  const Camera flat = load(with_camera({{"type", "orthographic"}, {"orthographic", orthographic}, {"name", "top"}})).cameras.at(0);
  EXPECT_FALSE(flat.perspective);
  EXPECT_EQ(flat.ymag, 2.0);
  EXPECT_EQ(flat.znear, 0.0);
  EXPECT_EQ(flat.zfar, 5.0);
  EXPECT_EQ(flat.name, "top");
}

TEST(GltfCameras, KeepTheOrderOfTheDocument) {
  Asset asset = triangle();
  json second = perspective;
  second["name"] = "second";
  asset.document["cameras"] = {perspective, second};
  asset.document["nodes"] = json::array({{{"camera", 1}}, {{"camera", 0}}});
  asset.document["scenes"][0]["nodes"] = {0, 1};
  const Scene scene = load(asset);
  ASSERT_EQ(scene.cameras.size(), 2U);
  EXPECT_EQ(scene.cameras[1].name, "second");
}

TEST(GltfCameras, ProjectionsMustBePossible) {
  const auto error_with = [](const char* key, const json& value) {
    json camera = perspective;
    camera["perspective"][key] = value;
    return error_of(with_camera(camera));
  };
  EXPECT_TRUE(names(error_with("yfov", 0), "cameras[0]", "yfov"));
  EXPECT_TRUE(names(error_with("yfov", 3.2), "cameras[0]", "yfov"));
  EXPECT_TRUE(names(error_with("znear", 0), "cameras[0]", "znear"));
  EXPECT_TRUE(names(error_with("zfar", 0.1), "cameras[0]", "greater than znear"));
  EXPECT_TRUE(names(error_with("aspectRatio", 0), "cameras[0]", "aspectRatio"));
  EXPECT_TRUE(names(error_of(with_camera({{"type", "fisheye"}})), "cameras[0]", "'fisheye'"));
  EXPECT_TRUE(names(error_of(with_camera({{"type", "perspective"}})), "cameras[0]", "perspective is required"));
  const json flat = {{"xmag", 1}, {"ymag", 0}, {"znear", 0}, {"zfar", 5}};
  EXPECT_TRUE(names(error_of(with_camera({{"type", "orthographic"}, {"orthographic", flat}})), "cameras[0]", "ymag"));
}

}  // namespace
}  // namespace sheen::scene::test
