#include "conformance/run.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <map>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "conformance/function_samples.h"
#include "conformance/run_fixture_test.h"
#include "conformance/suite.h"
#include "conformance/test_folder.h"
#include "image/io.h"

namespace sheen::conformance {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// The picture, its colours times a factor.
image::Image brightened(image::Image picture, float factor) {
  for (std::size_t i = 0; i < picture.data.size(); i += picture.channels.size()) {
    for (std::size_t c = 0; c < 3; ++c) {
      picture.data[i + c] *= factor;
    }
  }
  return picture;
}

TEST_F(RunTest, ARightPictureOfEachPassesAndTheReportIsComplete) {
  const Outcome outcome = run_with(foreign_hello,
                                   {{"defaults.sheen_empty", {{"image", picture("defaults.sheen_empty").string()}}},
                                    {"emission.strong", {{"image", picture("emission.strong").string()}}}},
                                   "defaults.sheen_empty:core.emission.strong");
  EXPECT_EQ(outcome.ending, "exited with status 0");
  EXPECT_EQ(outcome.results["summary"]["pass"], 2) << outcome.results.dump(1);
  EXPECT_EQ(outcome.results["cases"].size(), 2U);
  EXPECT_EQ(json::parse(contents("results.json")), outcome.results);
  EXPECT_NE(contents("results.xml").find("name=\"emission.strong\""), std::string::npos) << contents("results.xml");
  EXPECT_NE(contents("index.html").find("emission.strong"), std::string::npos);
  for (const char* kind : {"candidate.exr", "candidate.png", "golden.exr", "golden.png"}) {
    EXPECT_TRUE(fs::is_regular_file(report() / "images" / (std::string("emission.strong.") + kind))) << kind;
  }
}

TEST_F(RunTest, CrashHangAndNonsenseCostOneCaseEach) {
  const fs::path right = picture("defaults.clearcoat_is_0");
  image::Image wrong_size(8, 8, {"R", "G", "B", "A"});
  image::write(folder_.path() / "small.exr", wrong_size);
  image::Image holes = image::read(right);
  holes.data[4 * (64 * 128 + 64)] = std::numeric_limits<float>::quiet_NaN();
  image::write(folder_.path() / "holes.exr", holes);
  const Outcome outcome = run_with(foreign_hello,
                                   {{"defaults.sheen_roughness_is_0", "crash"},
                                    {"defaults.sheen_color_is_black", "hang"},
                                    {"defaults.sheen_color_texture", "garbage"},
                                    {"defaults.sheen_empty", {{"image", (folder_.path() / "small.exr").string()}}},
                                    {"defaults.clearcoat_is_0", {{"image", right.string()}}},
                                    {"defaults.clearcoat_roughness_is_0", "unsupported"},
                                    {"defaults.material_is_white_metal", {{"image", (folder_.path() / "holes.exr").string()}}}},
                                   "defaults.*", "lenient", {}, 2);
  EXPECT_EQ(outcome.ending, "exited with status 1");
  EXPECT_EQ(outcome.status("defaults.sheen_roughness_is_0"), "crash");
  EXPECT_EQ(outcome.status("defaults.sheen_color_is_black"), "timeout");
  EXPECT_EQ(outcome.status("defaults.sheen_color_texture_alone_is_black"), "invalid");
  EXPECT_EQ(outcome.status("defaults.sheen_empty"), "invalid");
  EXPECT_EQ(outcome.status("defaults.clearcoat_is_0"), "pass");
  EXPECT_EQ(outcome.status("defaults.clearcoat_roughness_is_0"), "unsupported");
  EXPECT_EQ(outcome.status("defaults.material_is_white_metal"), "fail");
  EXPECT_EQ(outcome.find("defaults.material_is_white_metal")["nonfinite_pixels"], 1);
  const std::string xml = contents("results.xml");
  EXPECT_NE(xml.find("failures=\"5\""), std::string::npos) << xml;
  EXPECT_NE(xml.find("skipped=\"1\""), std::string::npos) << xml;
}

TEST_F(RunTest, AWrongPictureFailsAndTheReportSaysWhichTermIsOff) {
  const std::string name = "clearcoat.none.over_no_sheen.on_dielectric";
  image::write(folder_.path() / "half.exr", brightened(image::read(picture(name)), 0.5F));
  const Outcome outcome = run_with(foreign_hello, {{"*", {{"image", (folder_.path() / "half.exr").string()}}}}, name);
  EXPECT_EQ(outcome.ending, "exited with status 1");
  EXPECT_EQ(outcome.status(name), "fail");
  EXPECT_GT(outcome.find(name)["bound_ratio"].get<double>(), 1);
  EXPECT_NE(outcome.find(name)["message"].get<std::string>().find("base or its albedo scale s is off by a factor of 0.5"),
            std::string::npos)
      << outcome.find(name)["message"];
}

TEST_F(RunTest, AnAllowedFormIsAnApproximationThatStrictRefuses) {
  const std::string name = "scaling.full.charlie.roughness_80";
  const json answers = {{"*", {{"image", picture(name, {albedo::Visibility::Charlie, albedo::AlbedoScaling::View}).string()}}}};
  const Outcome lenient = run_with(foreign_hello, answers, name);
  EXPECT_EQ(lenient.ending, "exited with status 0");
  EXPECT_EQ(lenient.status(name), "approximation");
  EXPECT_EQ(lenient.find(name)["identified"], "albedo_scaling view");
  const Outcome strict = run_with(foreign_hello, answers, name, "strict");
  EXPECT_EQ(strict.ending, "exited with status 1");
  EXPECT_NE(contents("results.xml").find("failures=\"1\""), std::string::npos);
}

TEST_F(RunTest, AViewerThatTakesSettingsMustDrawWhatIsAskedFor) {
  const std::string name = "scaling.full.charlie.roughness_80";
  json hello = foreign_hello;
  hello["capabilities"] = {"settings"};
  const Outcome outcome =
      run_with(hello, {{"*", {{"image", picture(name, {albedo::Visibility::Ashikhmin, albedo::AlbedoScaling::Full}).string()}}}}, name);
  EXPECT_EQ(outcome.status(name), "fail");
  EXPECT_EQ(outcome.find(name)["identified"], "visibility ashikhmin");
}

TEST_F(RunTest, AFormThatTheTextDoesNotAllowFails) {
  const std::string name = "scaling.full.charlie.roughness_80";
  const Outcome outcome = run_with(
      foreign_hello, {{"*", {{"image", picture(name, {albedo::Visibility::Charlie, albedo::AlbedoScaling::None}).string()}}}}, name);
  EXPECT_EQ(outcome.status(name), "fail");
  EXPECT_TRUE(outcome.find(name)["identified"].is_null());
}

TEST_F(RunTest, EightBitPicturesAreJudgedToHalfACode) {
  const std::string name = "defaults.sheen_empty";
  const image::Image right = image::read(picture(name));
  image::write(folder_.path() / "right.png", right);
  json hello = foreign_hello;
  hello["encoding"] = "srgb-8bit";
  const Outcome outcome = run_with(hello, {{"*", {{"image", (folder_.path() / "right.png").string()}}}}, name);
  EXPECT_EQ(outcome.status(name), "pass") << outcome.results.dump(1);
  EXPECT_TRUE(fs::is_regular_file(report() / "images" / (name + ".candidate.exr")));
}

TEST_F(RunTest, ViewersOfOthersAreGrantedAToleranceBeyondTheBoundAndOursIsNot) {
  const std::string name = "clearcoat.none.over_no_sheen.on_dielectric";
  image::write(folder_.path() / "near.exr", brightened(image::read(picture(name)), 1.001F));
  const json answers = {{"*", {{"image", (folder_.path() / "near.exr").string()}}}};
  json hello = foreign_hello;
  hello["context"] = {{"subpixel_bits", 8}};
  const Outcome foreign = run_with(hello, answers, name);
  EXPECT_EQ(foreign.status(name), "pass") << foreign.results.dump(1);
  hello["viewer"] = "sheen-cts";
  const Outcome own = run_with(hello, answers, name);
  EXPECT_EQ(own.status(name), "fail") << own.results.dump(1);
  const auto bound = [&name](const Outcome& outcome) { return outcome.find(name)["median_bound"].get<double>(); };
  EXPECT_LT(bound(own), 0.001) << "the bound alone";
  EXPECT_GE(bound(foreign), bound(own) + 0.001) << "what is granted is told";
}

/// Cases that say of themselves in which precision they are drawn, or that they must not be.
class ExtremesRunTest : public RunTest {
 protected:
  void SetUp() override { suite_ = "extremes"; }
};

TEST_F(ExtremesRunTest, ASceneThatBreaksARuleMustNotBeDrawn) {
  const std::string drawn = picture("metallic.1.highp").string();
  json answers = {{"metallic.above_1", "failed"},
                  {"metallic.below_0", {{"image", drawn}}},
                  {"base_color.above_1", "unsupported"},
                  {"base_color.below_0", "crash"}};
  const std::string filter = "metallic.above_1:metallic.below_0:base_color.above_1:base_color.below_0";
  const Outcome foreign = run_with(foreign_hello, answers, filter);
  EXPECT_EQ(foreign.status("metallic.above_1"), "pass");
  EXPECT_EQ(foreign.status("metallic.below_0"), "approximation") << "no text asks a viewer to notice";
  EXPECT_EQ(foreign.find("metallic.below_0")["identified"], "out of range");
  EXPECT_EQ(foreign.status("base_color.above_1"), "unsupported");
  EXPECT_EQ(foreign.status("base_color.below_0"), "crash");
  json ours = foreign_hello;
  ours["viewer"] = "sheen-cts";
  answers.erase("base_color.below_0");
  const Outcome own = run_with(ours, answers, filter);
  EXPECT_EQ(own.status("metallic.above_1"), "pass");
  EXPECT_EQ(own.status("metallic.below_0"), "fail");
  EXPECT_NE(own.find("metallic.below_0")["message"].get<std::string>().find("breaks a rule"), std::string::npos);
  EXPECT_EQ(own.status("base_color.below_0"), "pass");
}

TEST_F(ExtremesRunTest, ACaseIsDrawnAndJudgedInItsPrecisionElseInThatOfTheRun) {
  const std::string high = "metallic.1.highp";
  const std::string medium = "metallic.1.mediump";
  const json answers = {{high, {{"image", picture(high).string()}}}, {medium, {{"image", picture(medium).string()}}}};
  const Outcome outcome = run_with(foreign_hello, answers, high + ":" + medium);
  EXPECT_EQ(outcome.results["summary"]["pass"], 2) << outcome.results.dump(1);
  EXPECT_EQ(settings_of(high).value("precision", ""), "highp");
  EXPECT_EQ(settings_of(medium).value("precision", ""), "mediump");
  EXPECT_GT(outcome.find(medium)["median_bound"], outcome.find(high)["median_bound"]) << "ten bits leave more open";

  suite_ = "core";
  const std::string silent = "clearcoat.none.over_no_sheen.on_dielectric";
  const json right = {{"*", {{"image", picture(silent).string()}}}};
  const Outcome by_default = run_with(foreign_hello, right, silent);
  EXPECT_EQ(settings_of(silent).value("precision", ""), "highp");
  precision_ = "mediump";
  std::filesystem::remove(folder_.path() / "requests");
  const Outcome asked = run_with(foreign_hello, right, silent);
  EXPECT_EQ(settings_of(silent).value("precision", ""), "mediump");
  EXPECT_GT(asked.find(silent)["median_bound"], by_default.find(silent)["median_bound"]);
}

TEST_F(ExtremesRunTest, OfMediumpMuchMayBeUnpromisedAsLongAsItIsFiniteAndNotNegative) {
  const std::string name = "sheen_roughness.1e_4.mediump";
  const std::string right = picture(name).string();
  const Outcome outcome = run_with(foreign_hello, {{"*", {{"image", right}}}}, name);
  EXPECT_EQ(outcome.status(name), "pass") << outcome.results.dump(1);
  const double excluded = outcome.find(name)["excluded_pixels"];
  const double compared = outcome.find(name)["compared_pixels"];
  EXPECT_GT(excluded, 0.02 * (excluded + compared)) << "more than any other case may leave out";
  EXPECT_NE(outcome.find(name)["message"].get<std::string>().find("promise no more"), std::string::npos);
  for (const float value : {-1e-3F, std::numeric_limits<float>::infinity()}) {
    image::Image wrong = image::read(right);
    for (std::size_t i = 0; i < wrong.data.size(); i += wrong.channels.size()) {
      wrong.data[i] = value;
    }
    image::write(folder_.path() / "wrong.exr", wrong);
    EXPECT_EQ(run_with(foreign_hello, {{"*", {{"image", (folder_.path() / "wrong.exr").string()}}}}, name).status(name), "fail") << value;
  }
}

TEST_F(RunTest, ShardsPartTheCasesBetweenThem) {
  std::map<std::string, int> seen;
  for (int shard = 0; shard < 3; ++shard) {
    const Outcome outcome = run_with(foreign_hello, {{"*", "failed"}}, "defaults.*", "lenient",
                                     {"GTEST_TOTAL_SHARDS=3", "GTEST_SHARD_INDEX=" + std::to_string(shard)});
    for (const json& one : outcome.results["cases"]) {
      ++seen[one["name"].get<std::string>()];
    }
  }
  EXPECT_EQ(seen.size(), list("core", "defaults.*").size());
  for (const auto& [name, times] : seen) {
    EXPECT_EQ(times, 1) << name;
  }
}

TEST_F(RunTest, GoogleTestsOwnFilterVariableIsHonoured) {
  const Outcome outcome =
      run_with(foreign_hello, {{"*", "unsupported"}}, "defaults.*", "lenient", {"GTEST_FILTER=core.defaults.sheen_empty"});
  ASSERT_EQ(outcome.results["cases"].size(), 1U);
  EXPECT_EQ(outcome.ending, "exited with status 1") << "nothing passed";
}

TEST_F(RunTest, FunctionsAreAskedOfViewersThatEvaluateThemAndHeldToTheirPromises) {
  suite_ = "function";
  const auto values = [this](const char* name, float rounding) {
    const FunctionSamples samples = make_samples({name, "exp2", renderer::Precision::Highp, renderer::Formulation::Stable,
                                                  name == std::string("right") ? ArgumentSet::Dense : ArgumentSet::Random, 64, 64});
    image::Image picture(64, 64, {"R", "G", "B", "A"});
    for (std::size_t i = 0; i < samples.promises.size(); ++i) {
      picture.data[4 * i] = static_cast<float>(samples.promises[i].front().value) * rounding;
    }
    const fs::path file = folder_.path() / (std::string(name) + ".exr");
    image::write(file, picture);
    return json{{"image", file.string()}};
  };
  // 2^-16 is 128 ulp; near 0 an exponential is granted 3.
  const json answers = {{"exp2.highp.dense", values("right", 1)}, {"exp2.highp.random", values("wrong", 1 + 0x1p-16F)}};
  const std::string filter = "operation.exp2.highp.dense:operation.exp2.highp.random";
  json hello = foreign_hello;
  hello["capabilities"] = {"functions"};
  const Outcome outcome = run_with(hello, answers, filter);
  EXPECT_EQ(outcome.ending, "exited with status 1");
  EXPECT_EQ(outcome.status("operation.exp2.highp.dense"), "pass") << outcome.results.dump(1);
  EXPECT_EQ(outcome.status("operation.exp2.highp.random"), "fail");
  EXPECT_GT(outcome.find("operation.exp2.highp.random")["bound_ratio"].get<double>(), 1);
  EXPECT_EQ(outcome.find("operation.exp2.highp.dense")["function"]["precision"], "highp");
  EXPECT_NE(contents("index.html").find("<svg class=plots"), std::string::npos);
  EXPECT_EQ(run_with(foreign_hello, answers, filter).status("operation.exp2.highp.dense"), "unsupported");
}

TEST(Run, AFilterThatMatchesNothingIsNotAPass) {
  RunOptions options;
  options.filter = "no.such.case";
  EXPECT_THROW(run(options), std::invalid_argument);
  options = {};
  options.suite = "cor";
  EXPECT_THROW(run(options), std::invalid_argument);
  options = {};
  options.context = "glx";
  EXPECT_THROW(run(options), std::invalid_argument);
  options = {};
  options.viewer = "'unclosed";
  EXPECT_THROW(run(options), std::invalid_argument);
}

TEST(Run, AViewerThatDoesNotStartEndsIt) {
  const TestFolder folder;
  RunOptions options;
  options.report = folder.path() / "report";
  options.cache = folder.path() / "cache";
  options.viewer = "/no/such/viewer";
  EXPECT_THROW(run(options), ViewerUnavailable);
}

}  // namespace
}  // namespace sheen::conformance
