#include "conformance/run.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <limits>
#include <map>
#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "conformance/case_scene.h"
#include "conformance/child_process.h"
#include "conformance/function_samples.h"
#include "conformance/golden_store.h"
#include "conformance/suite.h"
#include "conformance/test_folder.h"
#include "image/io.h"
#include "scene/gltf.h"

namespace sheen::conformance {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const json foreign_hello = {{"viewer", "fake"}, {"version", "1"}, {"capabilities", json::array()}, {"encoding", "linear-float"}};

/// The end of a run in a process of its own.
struct Outcome {
  std::string ending;
  json results;

  std::string status(const std::string& name) const { return find(name).value("status", "missing"); }
  json find(const std::string& name) const {
    for (const json& one : results.value("cases", json::array())) {
      if (one["name"] == name) {
        return one;
      }
    }
    return json::object();
  }
};

/// Runs the driver with a fake viewer that follows a plan.
class RunTest : public testing::Test {
 protected:
  TestFolder folder_;
  std::string suite_ = "core";

  fs::path report() const { return folder_.path() / "report"; }

  static const Case& core_case(const std::string& name) {
    static const Suite core = load_suite("core");
    for (const Case& one : core.cases) {
      if (one.name == name) {
        return one;
      }
    }
    throw std::logic_error("no case " + name);
  }

  /// The picture a perfect viewer draws of the case, in the given form of the model.
  fs::path picture(const std::string& name, const albedo::SheenModel& model) {
    const Case& one = core_case(name);
    const scene::Scene scene = scene::load_gltf(write_scene(one, folder_.path() / "cache" / "scenes"));
    golden::Settings settings = golden_settings(one, model, 4);
    settings.bounds = false;
    const fs::path file = folder_.path() / (name + std::to_string(pictures_++) + ".exr");
    image::write(file, golden::render(scene, settings));
    return file;
  }
  fs::path picture(const std::string& name) { return picture(name, core_case(name).model); }

  Outcome run_with(const json& hello, const json& answers, const std::string& filter, const std::string& strict = "lenient",
                   const std::vector<std::string>& environment = {}, double limit = 20) {
    const fs::path plan = folder_.path() / "plan.json";
    std::ofstream(plan) << json{{"hello", hello}, {"answers", answers}}.dump();
    std::vector<std::string> command = {"/usr/bin/env"};
    command.insert(command.end(), environment.begin(), environment.end());
    command.insert(command.end(), {SHEEN_CTS_RUN_DRIVER, report().string(), (folder_.path() / "cache").string(), filter, json(limit).dump(),
                                   strict, std::string("'") + SHEEN_CTS_FAKE_VIEWER + "' '" + plan.string() + "'", suite_});
    ChildProcess driver(command);
    std::string text;
    std::string line;
    while (driver.read_line(line, deadline_in(250)) == ChildProcess::ReadStatus::Line) {
      text += line + "\n";
    }
    Outcome outcome;
    outcome.ending = driver.finish(60);
    if (outcome.ending != "exited with status 0" && outcome.ending != "exited with status 1") {
      outcome.ending += ": " + driver.last_words();
    }
    outcome.results = json::parse(text, nullptr, false);
    EXPECT_FALSE(outcome.results.is_discarded()) << "standard output holds results.json and nothing else: " << text;
    return outcome;
  }
  std::string contents(const char* name) const {
    std::ifstream file(report() / name);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
  }

 private:
  int pictures_ = 0;
};

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
  image::Image half = image::read(picture(name));
  for (std::size_t i = 0; i < half.data.size(); i += half.channels.size()) {
    for (std::size_t c = 0; c < 3; ++c) {
      half.data[i + c] *= 0.5F;
    }
  }
  image::write(folder_.path() / "half.exr", half);
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

/// Answers with pictures of one brightness each, by a piece of the scene's name: its relation's and its own label.
class RelationRunTest : public RunTest {
 protected:
  void SetUp() override { suite_ = "semantics"; }

  json even(float red, float green, float blue) {
    image::Image picture(96, 96, {"R", "G", "B", "A"});
    for (std::size_t i = 0; i < picture.data.size(); i += 4) {
      const std::array<float, 4> texel = {red, green, blue, 1.0F};
      std::copy(texel.begin(), texel.end(), picture.data.begin() + static_cast<std::ptrdiff_t>(i));
    }
    const fs::path file = folder_.path() / ("even" + std::to_string(files_++) + ".exr");
    image::write(file, picture);
    return {{"image", file.string()}};
  }
  json even(float grey) { return even(grey, grey, grey); }

 private:
  int files_ = 0;
};

TEST_F(RelationRunTest, OfEveryKindOneKeptPassesAndOneBrokenFails) {
  const json kept = {{"zero_is_no_sheen.without", even(0.5F)},     {"zero_is_no_sheen.zero", even(0.5F)},
                     {"has_an_effect.without", even(0.2F)},        {"has_an_effect.with-", even(0.3F)},
                     {"brightens_a_black_base.with-", even(0.2F)}, {"brightens_a_black_base.without", even(0.1F)},
                     {"twice_the_light.twice", even(0.6F)},        {"twice_the_light.once", even(0.3F)}};
  const std::string filter =
      "sheen.color_zero_is_no_sheen:sheen.has_an_effect:sheen.brightens_a_black_base:lights.of_twice_the_strength_give_twice_the_light";
  const Outcome good = run_with(foreign_hello, kept, filter);
  EXPECT_EQ(good.ending, "exited with status 0") << good.results.dump(1);
  EXPECT_EQ(good.results["summary"]["pass"], 4);
  json broken = kept;
  broken["zero_is_no_sheen.zero"] = even(0.5F, 0.52F, 0.5F);
  broken["has_an_effect.with-"] = even(0.2F);
  broken["brightens_a_black_base.with-"] = even(0.05F);
  broken["twice_the_light.twice"] = even(0.5F);
  const Outcome bad = run_with(foreign_hello, broken, filter);
  EXPECT_EQ(bad.ending, "exited with status 1");
  EXPECT_EQ(bad.results["summary"]["fail"], 4) << bad.results.dump(1);
  const json equal = bad.find("sheen.color_zero_is_no_sheen");
  EXPECT_NEAR(equal["max_abs"].get<double>(), 0.02, 1e-6);
  EXPECT_GT(equal["bound_ratio"].get<double>(), 1);
  EXPECT_NE(equal["message"].get<std::string>().find("broken: If sheenColorFactor is zero, the whole sheen layer is disabled"),
            std::string::npos)
      << equal["message"];
  EXPECT_NE(contents("results.xml").find("name=\"law\""), std::string::npos);
  const std::string page = contents("index.html");
  EXPECT_NE(page.find("<figcaption>zero</figcaption>"), std::string::npos) << "the scenes stand in the place of candidate and golden";
  EXPECT_EQ(page.find("<figcaption>golden</figcaption>"), std::string::npos);
  for (const char* kind : {"without.candidate.exr", "without.candidate.png", "zero.candidate.exr", "zero.candidate.png"}) {
    EXPECT_TRUE(fs::is_regular_file(report() / "images" / (std::string("sheen.color_zero_is_no_sheen.") + kind))) << kind;
  }
}

TEST_F(RelationRunTest, ASceneThatIsNotDrawnDecides) {
  const Outcome outcome = run_with(foreign_hello,
                                   {{"zero_is_no_sheen.zero", "crash"},
                                    {"zero_is_no_sheen.without", even(0.5F)},
                                    {"roughness_has_an_effect.sharp", "unsupported"},
                                    {"its_textures", "no_file"}},
                                   "sheen.color_zero*:sheen.roughness_has_an_effect");
  EXPECT_EQ(outcome.status("sheen.color_zero_is_no_sheen"), "crash");
  EXPECT_EQ(outcome.status("sheen.roughness_has_an_effect"), "unsupported");
  EXPECT_EQ(outcome.status("sheen.color_zero_disables_its_textures"), "invalid");
}

TEST_F(RelationRunTest, AnExcuseHoldsForViewersThatTakeNoSettings) {
  const std::string name = "reciprocity.sheen_over_base.25_and_72";
  const json answers = {{"eye_at_25", even(0.5F)}, {"eye_at_72", even(0.4F)}};
  const Outcome foreign = run_with(foreign_hello, answers, name);
  EXPECT_EQ(foreign.status(name), "approximation");
  EXPECT_NE(foreign.find(name)["message"].get<std::string>().find("allowed, for the text offers scaling by VdotN alone"),
            std::string::npos);
  json hello = foreign_hello;
  hello["capabilities"] = {"settings"};
  EXPECT_EQ(run_with(hello, answers, name).status(name), "fail");
}

TEST_F(RelationRunTest, AViewerThatMapsTonesIsSparedTheLawsOfRadiance) {
  json hello = foreign_hello;
  hello["capabilities"] = {"tone-mapped"};
  hello["encoding"] = "srgb-8bit";
  const auto png = [this](float grey) {
    const fs::path from = even(grey)["image"].get<std::string>();
    const fs::path file = fs::path(from).replace_extension(".png");
    image::write(file, image::read(from));
    return json{{"image", file.string()}};
  };
  const Outcome outcome =
      run_with(hello, {{"color_is_its_intensity", png(0.5F)}, {"twice_the_light.twice", png(0.4F)}, {"twice_the_light.once", png(0.3F)}},
               "sheen.color_is_its_intensity:lights.of_twice*");
  EXPECT_EQ(outcome.status("sheen.color_is_its_intensity"), "unsupported");
  EXPECT_EQ(outcome.status("lights.of_twice_the_strength_give_twice_the_light"), "pass") << "its order is left";
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
