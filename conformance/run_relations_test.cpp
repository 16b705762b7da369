#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <stdexcept>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "conformance/run.h"
#include "conformance/run_fixture_test.h"
#include "image/io.h"

namespace sheen::conformance {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

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
    return kept(picture);
  }
  json even(float grey) { return even(grey, grey, grey); }

  json kept(const image::Image& picture) {
    const fs::path file = folder_.path() / ("picture" + std::to_string(files_++) + ".exr");
    image::write(file, picture);
    return {{"image", file.string()}};
  }
  /// What a perfect viewer draws of a relation's scene.
  image::Image drawn(const std::string& relation, const std::string& label) const {
    for (const Relation& one : load_suite(suite_).relations) {
      for (std::size_t i = 0; one.name == relation && i < one.labels.size(); ++i) {
        if (one.labels[i] == label) {
          const scene::Scene scene = scene::load_gltf(write_scene(one.scenes[i], folder_.path() / "cache" / "scenes"));
          golden::Settings settings = golden_settings(one.scenes[i], one.scenes[i].model, 4);
          settings.bounds = false;
          return golden::render(scene, settings);
        }
      }
    }
    throw std::logic_error("no scene " + label + " of " + relation);
  }
  /// A perfect viewer's answers to all of a relation.
  json perfect(const std::string& name) {
    json answers;
    for (const Relation& one : load_suite(suite_).relations) {
      for (std::size_t i = 0; one.name == name && i < one.labels.size(); ++i) {
        answers[name + "." + one.labels[i] + "-"] = kept(drawn(name, one.labels[i]));
      }
    }
    return answers;
  }

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

TEST_F(RelationRunTest, OurOwnViewersPicturesAreHeldToTheirGoldens) {
  const std::string name = "lights.of_twice_the_strength_give_twice_the_light";
  json ours = foreign_hello;
  ours["viewer"] = "sheen-cts";
  image::Image once = drawn(name, "once");
  image::Image twice = drawn(name, "twice");
  const auto answers = [&] { return json{{"twice_the_light.twice", kept(twice)}, {"twice_the_light.once", kept(once)}}; };
  EXPECT_EQ(run_with(ours, answers(), name).status(name), "pass");
  const Outcome fair = run_with(foreign_hello, answers(), name);
  EXPECT_EQ(fair.status(name), "pass");
  for (float& value : twice.data) {
    value *= value < 1.0F ? 1.0005F : 1.0F;  // of colours, not of coverage
  }
  EXPECT_EQ(run_with(foreign_hello, answers(), name).status(name), "pass") << "to viewers of others 1e-3 is granted";
  const Outcome own = run_with(ours, answers(), name);
  EXPECT_EQ(own.status(name), "fail");
  EXPECT_NE(own.find(name)["message"].get<std::string>().find("'twice': the pixel at"), std::string::npos) << own.results.dump(1);
  EXPECT_GT(own.find(name)["bound_ratio"].get<double>(), 1);
  for (float& value : once.data) {
    value *= value < 1.0F ? 1.0005F : 1.0F;
  }
  EXPECT_EQ(run_with(ours, answers(), name).status(name), "fail") << "though the law is kept";
  twice = drawn(name, "twice");
  const Outcome second = run_with(ours, answers(), name);
  EXPECT_EQ(second.status(name), "fail");
  EXPECT_NE(second.find(name)["message"].get<std::string>().find("'once': the pixel at"), std::string::npos) << second.results.dump(1);
}

TEST_F(RelationRunTest, OurOwnViewersMustAgreeToTheBitWhereTheyAreExact) {
  const std::string name = "sheen.color_zero_is_no_sheen";
  json ours = foreign_hello;
  ours["viewer"] = "sheen-cts";
  const image::Image without = drawn(name, "without");
  image::Image zero = without;
  const auto answers = [&] { return json{{"no_sheen.without", kept(without)}, {"no_sheen.zero", kept(zero)}}; };
  EXPECT_EQ(run_with(ours, answers(), name).status(name), "pass");
  float& middle = zero.at(48, 48, 1);
  ASSERT_GT(middle, 0.0F);
  middle = std::nextafter(middle, 1.0F);
  EXPECT_EQ(run_with(foreign_hello, answers(), name).status(name), "pass");
  const Outcome own = run_with(ours, answers(), name);
  EXPECT_EQ(own.status(name), "fail");
  EXPECT_NE(own.find(name)["message"].get<std::string>().find("not the same to the bit"), std::string::npos) << own.results.dump(1);
  precision_ = "mediump";
  EXPECT_EQ(run_with(ours, answers(), name).status(name), "pass") << "no rule asks for the same bits of two shaders";
}

TEST_F(RelationRunTest, OfOurOwnASceneThatMustNotBeSeenMayShowNothing) {
  const std::string name = "sides.back_of_a_single_sided_square_is_not_seen";
  json ours = foreign_hello;
  ours["viewer"] = "sheen-cts";
  json answers = perfect(name);
  EXPECT_EQ(run_with(ours, answers, name).status(name), "pass");
  answers[name + ".single-"] = even(0.1F);
  EXPECT_NE(run_with(ours, answers, name).status(name), "pass");
}

TEST_F(RelationRunTest, OfASmallSceneEdgesMayTakeMoreThanOfACase) {
  const std::string name = "default.double_sided";  // of a 45th
  json ours = foreign_hello;
  ours["viewer"] = "sheen-cts";
  const Outcome own = run_with(ours, perfect(name), name);
  EXPECT_EQ(own.status(name), "pass") << own.results.dump(1);
  const json edges = own.find(name);
  EXPECT_GT(edges["excluded_pixels"].get<double>(), 0.02 * edges["compared_pixels"].get<double>());
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

}  // namespace
}  // namespace sheen::conformance
