#include "conformance/environments.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "conformance/environment_input.h"
#include "conformance/test_folder.h"
#include "image/io.h"

namespace sheen::conformance {
namespace {

TEST(Environments, AFileHoldsWhatIsMadeAndIsWrittenOnce) {
  const TestFolder folder;
  for (const std::string name : {"sky", "sun"}) {
    const auto file = write_environment(name, folder.path());
    EXPECT_EQ(scene::content_hash(read_environment(file.string())), scene::content_hash(make_environment(name))) << name;
    const auto time = std::filesystem::last_write_time(file);
    EXPECT_EQ(write_environment(name, folder.path()), file);
    EXPECT_EQ(std::filesystem::last_write_time(file), time);
  }
  const scene::Environment white = read_environment(write_environment("white", folder.path()).string());
  EXPECT_EQ(make_environment("white").uniform, glm::dvec3(1.0));
  EXPECT_EQ(white.radiance({0.6, 0.0, 0.8}), glm::dvec3(1.0));
}

TEST(Environments, OurOwnViewerIsToldOfUniformLightInWords) {
  const TestFolder folder;
  const scene::Environment told = read_environment(environment_for_viewer("white", true, folder.path()).string());
  EXPECT_FALSE(told.is_image());
  EXPECT_EQ(told.uniform, glm::dvec3(1.0));
  EXPECT_TRUE(read_environment(environment_for_viewer("white", false, folder.path()).string()).is_image());
  EXPECT_TRUE(read_environment(environment_for_viewer("sky", true, folder.path()).string()).is_image());
}

TEST(Environments, APictureWithoutColorIsNone) {
  const TestFolder folder;
  const std::string file = (folder.path() / "layered.exr").string();
  image::write(file, image::Image(2, 1, {"beauty.B", "beauty.G", "beauty.R"}));
  try {
    read_environment(file);
    ADD_FAILURE() << "read by position";
  } catch (const image::Error& error) {
    EXPECT_EQ(std::string(error.what()), file + ": an environment needs the channels R, G and B; it has beauty.B, beauty.G, beauty.R");
  }
}

TEST(Environments, TheSunIsSmallBrightAndWhereTheHazyOneIs) {
  const scene::Environment sun = make_environment("sun");
  const auto bright = std::count_if(sun.texels.begin(), sun.texels.end(), [](const glm::vec3& texel) { return texel.x > 1e4F; });
  EXPECT_GE(bright, 2);
  EXPECT_LE(bright, 9);
  const auto brightest = std::max_element(sun.texels.begin(), sun.texels.end(), [](const auto& a, const auto& b) { return a.x < b.x; });
  EXPECT_GE(brightest->x, 1e5F);
  const auto at = static_cast<int>(brightest - sun.texels.begin());
  const scene::Environment sky = make_environment("sky");
  const glm::dvec3 toward = sun.direction({(at % 512 + 0.5) / 512, (at / 512 + 0.5) / 256});
  EXPECT_GT(sky.radiance(toward).x, 5.0);
  EXPECT_LT(sky.radiance(-toward).x, 1.0);
}

TEST(Environments, AnUnknownNameIsRefusedAndSaysWhichThereAre) {
  EXPECT_TRUE(is_environment("sky"));
  EXPECT_FALSE(is_environment("room"));
  try {
    make_environment("room");
    FAIL() << "nothing thrown";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("white, sky, sun"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace sheen::conformance
