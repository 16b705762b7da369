#include "conformance/goldens.h"

#include <algorithm>
#include <fstream>

#include <gtest/gtest.h>

#include "conformance/case_scene.h"
#include "conformance/golden_store.h"
#include "conformance/paths.h"
#include "conformance/suite.h"
#include "conformance/test_folder.h"
#include "image/io.h"
#include "scene/gltf.h"

namespace sheen::conformance {
namespace {

namespace fs = std::filesystem;

/// One small case with its scene, and committed goldens made of it by hand.
class GoldenStoreTest : public testing::Test {
 protected:
  TestFolder folder_;
  Case case_;
  scene::Scene scene_;
  std::string hash_;
  golden::Settings settings_;

  void SetUp() override {
    case_ = load_suite("core").cases.front();
    case_.width = 16;
    case_.height = 16;
    scene_ = scene::load_gltf(write_scene(case_, folder_.path()));
    hash_ = scene::content_hash(scene_);
    settings_ = golden_settings(case_, case_.model, 8);
  }
  fs::path cache() const { return folder_.path() / "cache"; }
  fs::path committed() const { return folder_.path() / "goldens"; }

  /// Commits this image as the case's golden.
  void commit(const image::Image& golden, const std::string& hash, const std::string& formula_version) {
    fs::create_directories(committed() / "core");
    image::Image rgba(golden.width, golden.height, {"R", "G", "B", "A"});
    for (int y = 0; y < golden.height; ++y) {
      for (int x = 0; x < golden.width; ++x) {
        for (int c = 0; c < 4; ++c) {
          rgba.at(x, y, c) = golden.at(x, y, golden.channel(rgba.channels[static_cast<std::size_t>(c)]));
        }
      }
    }
    image::write(committed() / "core" / "case.exr", rgba, image::ExrCompression::Pxr24);
    write_manifest(committed(), {formula_version, "core", {{case_.name, {"core/case.exr", hash, settings_text(settings_)}}}});
  }
  Reference reference() const { return GoldenStore(cache(), committed(), "core").reference(case_, scene_, hash_, settings_); }
};

TEST_F(GoldenStoreTest, TheSecondTimeComesFromTheCacheAndIsTheSame) {
  const GoldenStore store(cache(), {}, "core");
  const image::Image first = store.computed(scene_, hash_, settings_);
  ASSERT_EQ(std::distance(fs::directory_iterator(cache()), fs::directory_iterator()), 1);
  const image::Image second = store.computed(scene_, hash_, settings_);
  for (const std::string& name : first.channels) {
    for (int i = 0; i < 16 * 16; ++i) {
      ASSERT_EQ(first.at(i % 16, i / 16, first.channel(name)), second.at(i % 16, i / 16, second.channel(name))) << name;
    }
  }
}

TEST_F(GoldenStoreTest, ADamagedCacheFileIsComputedAnew) {
  const GoldenStore store(cache(), {}, "core");
  const image::Image first = store.computed(scene_, hash_, settings_);
  std::ofstream(fs::directory_iterator(cache())->path(), std::ios::trunc) << "not an image";
  EXPECT_EQ(store.computed(scene_, hash_, settings_).data, first.data);
}

TEST_F(GoldenStoreTest, OtherSettingsHaveAnotherPlace) {
  const GoldenStore store(cache(), {}, "core");
  store.computed(scene_, hash_, settings_);
  golden::Settings other = settings_;
  other.subpixel_bits = 4;
  store.computed(scene_, hash_, other);
  other.sheen.visibility = albedo::Visibility::Ashikhmin;
  store.computed(scene_, hash_, other);
  other.sheen.scaling = albedo::AlbedoScaling::View;
  store.computed(scene_, hash_, other);
  other.precision = golden::Precision::Mediump;
  store.computed(scene_, hash_, other);
  EXPECT_EQ(std::distance(fs::directory_iterator(cache()), fs::directory_iterator()), 5);
}

TEST_F(GoldenStoreTest, ACaseOfMediumpHasTheSameGoldenUnderWiderBounds) {
  const GoldenStore store(cache(), {}, "core");
  EXPECT_EQ(settings_.precision, golden::Precision::Highp) << "what a case does not say is highp";
  case_.precision = golden::Precision::Mediump;
  const golden::Settings mediump = golden_settings(case_, case_.model, 8);
  EXPECT_EQ(mediump.precision, golden::Precision::Mediump);
  const image::Image narrow = store.computed(scene_, hash_, settings_);
  const image::Image wide = store.computed(scene_, hash_, mediump);
  int wider = 0;
  for (int i = 0; i < 16 * 16; ++i) {
    const auto at = [i](const image::Image& image, const char* name) { return image.at(i % 16, i / 16, image.channel(name)); };
    ASSERT_EQ(at(wide, "G"), at(narrow, "G"));
    ASSERT_GE(at(wide, "bound.G"), at(narrow, "bound.G"));
    wider += at(wide, "bound.G") > at(narrow, "bound.G") ? 1 : 0;
  }
  EXPECT_GT(wider, 0);
}

TEST_F(GoldenStoreTest, ACacheThatCannotBeWrittenOnlyCostsTime) {
  std::ofstream(folder_.path() / "file") << "in the way";
  const GoldenStore store(folder_.path() / "file" / "cache", {}, "core");
  EXPECT_EQ(store.computed(scene_, hash_, settings_).width, 16);
}

TEST_F(GoldenStoreTest, ACommittedGoldenIsUsedWhenTheManifestFits) {
  commit(golden::render(scene_, settings_), hash_, golden::formula_version);
  EXPECT_TRUE(reference().pxr24);
  EXPECT_EQ(reference().problem, "");
}

TEST_F(GoldenStoreTest, ACommittedGoldenOfAnotherSceneOrVersionIsNotUsed) {
  commit(golden::render(scene_, settings_), "0123", golden::formula_version);
  EXPECT_FALSE(reference().pxr24);
  commit(golden::render(scene_, settings_), hash_, "0");
  EXPECT_FALSE(reference().pxr24);
}

TEST_F(GoldenStoreTest, ACommittedGoldenThatIsOffJudgesNothing) {
  image::Image wrong = golden::render(scene_, settings_);
  wrong.at(8, 8, wrong.channel("G")) *= 1.0001F;
  commit(wrong, hash_, golden::formula_version);
  EXPECT_NE(reference().problem.find("channel G at 8, 8"), std::string::npos) << reference().problem;
}

TEST_F(GoldenStoreTest, DisagreementAllowsPxr24sRoundingAndNoMore) {
  const image::Image truth = golden::render(scene_, settings_);
  image::Image other = truth;
  const int g = truth.channel("G");
  other.at(8, 8, g) = truth.at(8, 8, g) * (1 + 0x1p-16F);
  EXPECT_EQ(disagreement(other, truth), "");
  other.at(8, 8, g) = truth.at(8, 8, g) * (1 + 0x1p-15F);
  EXPECT_NE(disagreement(other, truth), "");
  other = truth;
  other.at(0, 0, truth.channel("A")) = 1.0F;
  EXPECT_NE(disagreement(other, truth), "") << "coverage is compared too";
}

TEST(Manifest, IsReadAsWritten) {
  const TestFolder folder;
  EXPECT_FALSE(read_manifest(folder.path()).has_value());
  write_manifest(folder.path(), {"7", "core", {{"a.b", {"core/a.b.exr", "12ab", "8x8"}}}});
  const Manifest manifest = read_manifest(folder.path()).value();
  EXPECT_EQ(manifest.formula_version, "7");
  EXPECT_EQ(manifest.cases.at("a.b").scene_hash, "12ab");
  std::ofstream(folder.path() / "manifest.json") << "{}";
  EXPECT_THROW(read_manifest(folder.path()), std::runtime_error);
}

TEST(Goldens, VerifyNamesEachMismatchMissingAndExtraFile) {
  const TestFolder folder;
  GoldensOptions options;
  options.dir = folder.path() / "goldens";
  options.cache = folder.path() / "cache";
  Suite suite = load_suite("core");
  suite.cases.resize(4);
  EXPECT_EQ(verify_goldens(suite, options).problems, std::vector<std::string>{"there is no manifest.json"});
  EXPECT_EQ(generate_goldens(suite, options).cases, 4U);
  EXPECT_EQ(verify_goldens(suite, options).problems, std::vector<std::string>{});

  const auto file = [&](std::size_t i) { return options.dir / "core" / (suite.cases[i].name + ".exr"); };
  fs::remove(file(0));
  image::Image changed = image::read(file(1));
  for (float& value : changed.data) {
    value *= 1.001F;
  }
  image::write(file(1), changed, image::ExrCompression::Pxr24);
  fs::copy_file(file(2), options.dir / "core" / "stranger.exr");
  suite.cases[3].description["lights"][0]["intensity"] = 7.0;
  const std::vector<std::string> problems = verify_goldens(suite, options).problems;
  EXPECT_EQ(problems.size(), 4U);
  for (const std::string& expected :
       {suite.cases[0].name, suite.cases[1].name, suite.cases[3].name + ": made of another scene", std::string("core/stranger.exr")}) {
    EXPECT_TRUE(std::any_of(problems.begin(), problems.end(), [&](const std::string& p) { return p.rfind(expected, 0) == 0; })) << expected;
  }
  suite.cases.pop_back();
  EXPECT_EQ(verify_goldens(suite, options).problems.size(), 5U)
      << "a manifest entry and a file of no case, beside the first two and the stranger";
  generate_goldens(suite, options);
  EXPECT_EQ(verify_goldens(suite, options).problems, std::vector<std::string>{}) << "strangers are removed, the rest made anew";
}

TEST(Goldens, TheCommittedOnesAreWhatThisProgramComputes) {
  GoldensOptions options;
  const TestFolder folder;
  options.cache = folder.path();
  ASSERT_FALSE(find_goldens().empty());
  const GoldensReport report = verify_goldens(options);
  EXPECT_EQ(report.problems, std::vector<std::string>{});
  EXPECT_LT(report.bytes, 10U * 1000U * 1000U);
}

}  // namespace
}  // namespace sheen::conformance
