#include "conformance/serve.h"

#include <sstream>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "conformance/case_scene.h"
#include "conformance/suite.h"
#include "conformance/test_folder.h"
#include "conformance/viewer.h"
#include "image/io.h"
#include "renderer/renderer.h"
#include "scene/scene.h"

namespace sheen::conformance {
namespace {

using nlohmann::json;

class ServeTest : public testing::Test {
 protected:
  TestFolder folder_;
  std::string scene_;

  void SetUp() override { scene_ = write_scene(load_suite("core").cases.front(), folder_.path()).string(); }

  json request(const std::string& id) const {
    return {{"id", id},
            {"scene", scene_},
            {"environment", nullptr},
            {"camera", 0},
            {"width", 16},
            {"height", 12},
            {"output", (folder_.path() / (id + ".exr")).string()}};
  }
  /// The lines that come back, the hello line first.
  std::vector<std::string> lines_for(const std::string& input, const ServeOptions& options = {}) const {
    std::istringstream in(input);
    std::ostringstream out;
    serve(in, out, options);
    std::vector<std::string> lines;
    std::istringstream text(out.str());
    for (std::string line; std::getline(text, line);) {
      lines.push_back(line);
    }
    return lines;
  }
};

TEST_F(ServeTest, SaysHelloAsItsOwnClientExpects) {
  const std::vector<std::string> lines = lines_for("");
  ASSERT_EQ(lines.size(), 1U);
  const Hello hello = parse_hello(lines[0]);
  EXPECT_EQ(hello.name, "sheen-cts");
  EXPECT_EQ(hello.encoding, Encoding::LinearFloat);
  EXPECT_TRUE(hello.takes_settings());
  EXPECT_FALSE(hello.renderer.empty());
  EXPECT_GE(hello.subpixel_bits, 4);
}

TEST_F(ServeTest, DrawsWhatItIsAskedForAndGoesOnAfterAFailure) {
  json missing = request("b");
  missing["scene"] = (folder_.path() / "missing.glb").string();
  json lit = request("c");
  lit["environment"] = "missing.hdr";
  json odd = request("d");
  odd["settings"] = {{"visibility", "charly"}};
  const std::vector<std::string> lines = lines_for(request("a").dump() + "\n" + missing.dump() + "\n\n" + lit.dump() + "\n" + odd.dump() +
                                                   "\nno json\n" + request("e").dump() + "\n");
  ASSERT_EQ(lines.size(), 7U);
  const auto answer = [&lines](std::size_t i) { return json::parse(lines[i]); };
  EXPECT_EQ(answer(1)["id"], "a");
  EXPECT_EQ(answer(1)["status"], "rendered") << lines[1];
  EXPECT_EQ(image::read(folder_.path() / "a.exr").width, 16);
  EXPECT_EQ(image::read(folder_.path() / "a.exr").height, 12);
  EXPECT_EQ(answer(2)["status"], "failed");
  EXPECT_NE(answer(2)["message"].get<std::string>().find("missing.glb"), std::string::npos);
  EXPECT_EQ(answer(3)["status"], "failed");
  EXPECT_NE(answer(3)["message"].get<std::string>().find("missing.hdr"), std::string::npos);
  EXPECT_EQ(answer(4)["status"], "failed");
  EXPECT_EQ(answer(5)["status"], "failed");
  EXPECT_EQ(answer(6)["status"], "rendered");
}

TEST_F(ServeTest, SettingsChangeThePicture) {
  json plain = request("plain");
  json other = request("other");
  other["settings"] = {{"visibility", "ashikhmin"}, {"albedo_scaling", "none"}, {"precision", "highp"}, {"formulation", "stable"}};
  json draft = request("draft");
  draft["settings"] = {{"model", "draft-2019"}};
  json physical = request("physical");
  physical["settings"] = {{"model", "physical"}};
  json ratified = request("ratified");
  ratified["settings"] = {{"model", "ratified"}};
  lines_for(plain.dump() + "\n" + other.dump() + "\n" + draft.dump() + "\n" + physical.dump() + "\n" + ratified.dump() + "\n");
  const auto data = [this](const std::string& name) { return image::read(folder_.path() / (name + ".exr")).data; };
  EXPECT_NE(data("plain"), data("other"));
  EXPECT_NE(data("plain"), data("draft"));
  EXPECT_NE(data("plain"), data("physical"));
  EXPECT_NE(data("draft"), data("physical"));
  EXPECT_EQ(data("plain"), data("ratified"));
}

TEST_F(ServeTest, AnEnvironmentLightsThePicture) {
  json plain = request("plain");
  json filtered = request("filtered");
  filtered["environment"] = "uniform:1,1,1";
  json sampled = filtered;
  sampled["id"] = "sampled";
  sampled["output"] = (folder_.path() / "sampled.exr").string();
  sampled["settings"] = {{"environment_samples", 64}};
  lines_for(plain.dump() + "\n" + filtered.dump() + "\n" + sampled.dump() + "\n");
  const image::Image without = image::read(folder_.path() / "plain.exr");
  const image::Image with = image::read(folder_.path() / "filtered.exr");
  EXPECT_GT(with.at(8, 6, 1), without.at(8, 6, 1));
  EXPECT_NE(image::read(folder_.path() / "sampled.exr").data, with.data);
}

TEST_F(ServeTest, ReplicasOfAPictureDrawDirectionsOfTheirOwn) {
  json asked = request("replicas");
  asked["environment"] = "uniform:1,1,1";
  asked["settings"] = {{"environment_samples", 16}, {"environment_replicas", 3}};
  std::string lines = asked.dump() + "\n";
  for (const int replicas : {-1, 1, 1000}) {
    asked["settings"]["environment_replicas"] = replicas;
    lines += asked.dump() + "\n";
  }
  const std::vector<std::string> answers = lines_for(lines);
  ASSERT_EQ(answers.size(), 5U);
  EXPECT_EQ(json::parse(answers[1])["status"], "rendered") << answers[1];
  for (const std::size_t i : {2U, 3U, 4U}) {
    EXPECT_NE(json::parse(answers[i])["message"].get<std::string>().find("from 2 to 64"), std::string::npos) << answers[i];
  }
  const image::Image picture = image::read(folder_.path() / "replicas.exr");
  std::vector<float> greens;
  for (const char* name : {"replica.1.G", "replica.2.G", "replica.3.G"}) {
    ASSERT_GE(picture.channel(name), 0) << name;
    greens.push_back(picture.at(8, 6, picture.channel(name)));
  }
  EXPECT_EQ(picture.channel("replica.4.G"), -1);
  EXPECT_NE(greens[0], greens[1]);
  EXPECT_NE(greens[1], greens[2]);
  EXPECT_FLOAT_EQ(picture.at(8, 6, picture.channel("G")), (greens[0] + greens[1] + greens[2]) / 3.0F);
}

TEST_F(ServeTest, MoreDirectionsThanEveryDriverDrawsAreRefused) {
  json request_of_more = request("more");
  request_of_more["environment"] = "uniform:1,1,1";
  std::string lines;
  for (const int samples : {-1, renderer::most_environment_samples + 1}) {
    request_of_more["settings"] = {{"environment_samples", samples}};
    lines += request_of_more.dump() + "\n";
  }
  const std::vector<std::string> answers = lines_for(lines);
  ASSERT_EQ(answers.size(), 3U);
  for (const std::size_t i : {1U, 2U}) {
    EXPECT_EQ(json::parse(answers[i])["status"], "failed");
    EXPECT_NE(json::parse(answers[i])["message"].get<std::string>().find("from 0 to 50000"), std::string::npos) << answers[i];
  }
}

TEST_F(ServeTest, DrawsTheSceneAndTheSettingsAsTheyWereAltered) {
  ServeOptions options;
  options.alter = [](scene::Scene& scene, renderer::Settings& settings) {
    scene.materials.at(0).emissive_factor = glm::dvec3(7.0);
    settings.view.width = 4;
  };
  lines_for(request("plain").dump() + "\n");
  lines_for(request("altered").dump() + "\n", options);
  const image::Image plain = image::read(folder_.path() / "plain.exr");
  const image::Image altered = image::read(folder_.path() / "altered.exr");
  EXPECT_EQ(altered.width, 4);
  EXPECT_GT(altered.at(2, 6, 0), plain.at(8, 6, 0) + 6.0F);
}

TEST_F(ServeTest, DrawsInThePrecisionOfTheRequestElseInItsOwn) {
  std::vector<renderer::Precision> drawn;
  ServeOptions options;
  options.precision = "mediump";
  options.alter = [&drawn](scene::Scene&, renderer::Settings& settings) { drawn.push_back(settings.precision); };
  json asked = request("asked");
  asked["settings"] = {{"precision", "highp"}};
  json unknown = request("unknown");
  unknown["settings"] = {{"precision", "lowp"}};
  const std::vector<std::string> lines = lines_for(request("own").dump() + "\n" + asked.dump() + "\n" + unknown.dump() + "\n", options);
  EXPECT_EQ(drawn, (std::vector<renderer::Precision>{renderer::Precision::Mediump, renderer::Precision::Highp}));
  EXPECT_EQ(json::parse(lines.at(3))["status"], "failed");
  EXPECT_NE(lines.at(3).find("lowp"), std::string::npos) << lines.at(3);
}

TEST_F(ServeTest, RefusesAFactorJustOutsideItsRange) {
  Case outside = load_suite("core").cases.front();
  outside.name = "outside";
  outside.description["material"]["pbrMetallicRoughness"]["metallicFactor"] = 1 + 0x1p-23;
  json wrong = request("wrong");
  wrong["scene"] = write_scene(outside, folder_.path()).string();
  const std::vector<std::string> lines = lines_for(wrong.dump() + "\n");
  EXPECT_EQ(json::parse(lines.at(1))["status"], "failed");
  EXPECT_NE(lines.at(1).find("metallicFactor"), std::string::npos) << lines.at(1);
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "wrong.exr"));
}

TEST_F(ServeTest, EvaluatesAFunctionAtTheArgumentsOfAFile) {
  image::Image arguments(3, 2, {"R", "G", "B", "A"});
  arguments.at(2, 1, 0) = 3;
  image::write(folder_.path() / "arguments.exr", arguments);
  json exponent = request("exponent");
  exponent.erase("scene");
  exponent["function"] = "exp2";
  exponent["arguments"] = (folder_.path() / "arguments.exr").string();
  exponent["width"] = 3;
  exponent["height"] = 2;
  json unknown = exponent;
  unknown["function"] = "exp3";
  json narrow = exponent;
  narrow["width"] = 2;
  const std::vector<std::string> lines = lines_for(exponent.dump() + "\n" + unknown.dump() + "\n" + narrow.dump() + "\n");
  ASSERT_EQ(lines.size(), 4U);
  EXPECT_TRUE(parse_hello(lines[0]).evaluates_functions());
  EXPECT_EQ(json::parse(lines[1])["status"], "rendered") << lines[1];
  const image::Image result = image::read(folder_.path() / "exponent.exr");
  EXPECT_EQ(result.at(2, 1, 0), 8.0F);
  EXPECT_EQ(result.at(0, 0, 0), 1.0F);
  EXPECT_NE(json::parse(lines[2])["message"].get<std::string>().find("unknown function 'exp3'"), std::string::npos) << lines[2];
  EXPECT_EQ(json::parse(lines[3])["status"], "failed");
}

TEST_F(ServeTest, UnknownOptionsAreRefused) {
  std::istringstream in;
  std::ostringstream out;
  EXPECT_THROW(serve(in, out, {"glx", "highp"}), std::invalid_argument);
  EXPECT_THROW(serve(in, out, {"osmesa", "lowp"}), std::invalid_argument);
}

}  // namespace
}  // namespace sheen::conformance
