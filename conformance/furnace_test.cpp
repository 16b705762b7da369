// The laws that the suite furnace names, held of its goldens: a viewer that meets them obeys the laws.

#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "conformance/case_scene.h"
#include "conformance/golden_store.h"
#include "conformance/suite.h"
#include "conformance/test_folder.h"
#include "golden/golden.h"
#include "scene/gltf.h"

namespace sheen::conformance {
namespace {

constexpr double rounding = 2e-6;  // of quadrature, twice 1e-6

class Furnace : public testing::Test {
 protected:
  /// The case of that name, small.
  Case named(const std::string& name) const {
    const auto found = std::find_if(suite_.cases.begin(), suite_.cases.end(), [&](const Case& one) { return one.name == name; });
    EXPECT_NE(found, suite_.cases.end()) << name;
    Case one = found == suite_.cases.end() ? suite_.cases.front() : *found;
    one.width = one.height = 12;
    return one;
  }
  image::Image golden(const Case& one) const {
    return golden::render(scene::load_gltf(write_scene(one, folder_.path())), golden_settings(one, one.model, 8));
  }
  image::Image golden(const std::string& name) const { return golden(named(name)); }

  /// Calls check(x, y, channel) for every value of the sphere.
  template <class Check>
  static void for_each_value(const image::Image& picture, const Check& check) {
    int covered = 0;
    for (int y = 0; y < picture.height; ++y) {
      for (int x = 0; x < picture.width; ++x) {
        if (picture.at(x, y, 3) == 0.0f) {
          continue;
        }
        ++covered;
        for (int c = 0; c < 3; ++c) {
          check(x, y, c);
        }
      }
    }
    EXPECT_GT(covered, 80);
  }

  const Suite suite_ = load_suite("furnace");
  const TestFolder folder_;
};

TEST_F(Furnace, ViewScalingOverWhiteIsTheLargerOfOneAndTheSheenAloneAndFullIsNoMore) {
  for (const char* visibility : {"charlie", "ashikhmin"}) {
    for (const double roughness : {0.25, 0.8}) {
      const auto with_roughness = [&](const std::string& name) {
        Case one = named(name);
        one.description["material"]["extensions"]["KHR_materials_sheen"]["sheenRoughnessFactor"] = roughness;
        return golden(one);
      };
      const image::Image alone = with_roughness("sheen_alone." + std::string(visibility) + ".sheen_25");
      const image::Image view = with_roughness("white_lambert.view." + std::string(visibility) + ".sheen_30");
      const image::Image full = with_roughness("white_lambert.full." + std::string(visibility) + ".sheen_30");
      double least = 1.0;
      for_each_value(alone, [&](int x, int y, int c) {
        const double ceiling = std::max(1.0, static_cast<double>(alone.at(x, y, c)));
        EXPECT_NEAR(view.at(x, y, c), ceiling, rounding) << visibility << " " << roughness << " at " << x << ", " << y;
        EXPECT_LE(full.at(x, y, c), ceiling + rounding) << visibility << " " << roughness << " at " << x << ", " << y;
        least = std::min(least, static_cast<double>(full.at(x, y, c)));
      });
      EXPECT_GT(least, 0.8) << "full scaling loses some, not everything";
    }
  }
}

TEST_F(Furnace, NoLayerMakesMoreThanItsLawAllows) {
  Case white = named("white_lambert.view.charlie.sheen_30");
  white.description["material"]["extensions"]["KHR_materials_sheen"]["sheenRoughnessFactor"] = 0.5;
  const image::Image ceiling = golden(white);  // max(1, E(N.V)) of the sheen that the cases put on every base
  for (const char* kind : {"lambert", "dielectric_rough", "dielectric_smooth", "metal_rough", "metal_smooth", "mirror", "half_metal"}) {
    const std::string base = "base." + std::string(kind);
    const image::Image bare = golden(base + ".bare");
    const image::Image sheen = golden(base + ".sheen");
    const image::Image coated = golden(base + ".coat_over_sheen");
    for_each_value(bare, [&](int x, int y, int c) {
      const double own = std::max(1.0, static_cast<double>(bare.at(x, y, c)));
      const double most = own * static_cast<double>(ceiling.at(x, y, c));
      EXPECT_LE(sheen.at(x, y, c), most + rounding) << kind << " at " << x << ", " << y;
      EXPECT_LE(coated.at(x, y, c), most + rounding) << kind << " under a coat at " << x << ", " << y;
      EXPECT_GT(coated.at(x, y, c), 0.2) << kind;
    });
  }
}

TEST_F(Furnace, CornersAreWhatTheyAreSaidToBe) {
  const image::Image no_sheen = golden("corner.sheen_roughness_zero");
  Case bare = named("corner.sheen_roughness_zero");
  bare.description["material"].erase("extensions");
  const image::Image base = golden(bare);
  Case dark = named("corner.emission_is_not_scaled");
  dark.description["material"].erase("emissiveFactor");
  const image::Image unlit = golden(dark);
  const image::Image glowing = golden("corner.emission_is_not_scaled");
  for_each_value(base, [&](int x, int y, int c) {
    EXPECT_EQ(no_sheen.at(x, y, c), base.at(x, y, c));
    EXPECT_NEAR(glowing.at(x, y, c), unlit.at(x, y, c) + 0.2 * (c + 1), rounding);
  });
}

}  // namespace
}  // namespace sheen::conformance
