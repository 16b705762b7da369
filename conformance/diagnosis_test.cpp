#include "conformance/diagnosis.h"

#include <gtest/gtest.h>

#include "conformance/case_scene.h"
#include "conformance/golden_store.h"
#include "conformance/suite.h"
#include "conformance/test_folder.h"
#include "scene/gltf.h"

namespace sheen::conformance {
namespace {

/// A small case with every term in it, and pictures of it with one term off.
class DiagnosisTest : public testing::Test {
 protected:
  TestFolder folder_;
  scene::Scene scene_;
  golden::Settings settings_;
  image::Image golden_;

  void SetUp() override {
    const Suite suite = parse_suite(R"({"suite": "small", "groups": [{"name": "all_terms", "base": {"shape": "sphere", "size": [24, 24],
      "material": {"pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.3, 0.2, 1], "metallicFactor": 0.2, "roughnessFactor": 0.5},
        "emissiveFactor": [0.02, 0.05, 0.1], "extensions": {"KHR_materials_sheen": {"sheenColorFactor": [0.4, 0.6, 0.9], "sheenRoughnessFactor": 0.6},
        "KHR_materials_clearcoat": {"clearcoatFactor": 0.8, "clearcoatRoughnessFactor": 0.5}}},
      "lights": [{"type": "directional", "toward": [0.5, 0.5, 0.8], "intensity": 3}, {"type": "directional", "toward": [-0.8, 0.1, 0.4], "intensity": 2}],
      "camera": {"type": "perspective", "position": [0, 0, 4], "target": [0, 0, 0], "yfov": 0.55, "znear": 0.1}}}]})",
                                    "small.json");
    scene_ = scene::load_gltf(write_scene(suite.cases[0], folder_.path()));
    settings_ = golden_settings(suite.cases[0], suite.cases[0].model, 8);
    golden_ = golden::render(scene_, settings_);
  }

  /// The picture a viewer with these factors would draw.
  image::Image drawn_with(const golden::TermFactors& factors) {
    image::Image image = golden_;
    const golden::Probe probe(scene_, settings_);
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) {
        if (golden_.at(x, y, 3) == 0.0F) {
          continue;
        }
        const glm::dvec3 radiance = probe.terms(x, y, factors).radiance;
        for (int c = 0; c < 3; ++c) {
          image.at(x, y, c) = static_cast<float>(radiance[c]);
        }
      }
    }
    return image;
  }
  Diagnosis diagnosis_of(const image::Image& candidate) {
    return diagnose(scene_, settings_, candidate, golden_, {}, judge(candidate, golden_, {}));
  }
};

TEST_F(DiagnosisTest, NamesTheTermThatIsOffAndItsFactor) {
  const std::pair<const char*, double golden::TermFactors::*> all[] = {{"sheen lobe D V", &golden::TermFactors::distribution},
                                                                       {"sheen lobe D V", &golden::TermFactors::visibility},
                                                                       {"base or its albedo scale s", &golden::TermFactors::scale},
                                                                       {"base or its albedo scale s", &golden::TermFactors::base},
                                                                       {"coat weight", &golden::TermFactors::coat_weight},
                                                                       {"coat lobe", &golden::TermFactors::coat_lobe},
                                                                       {"emission", &golden::TermFactors::emission}};
  for (const auto& [name, member] : all) {
    golden::TermFactors factors;
    factors.*member = 1.4;
    const Diagnosis diagnosis = diagnosis_of(drawn_with(factors));
    ASSERT_FALSE(diagnosis.fits.empty()) << name;
    EXPECT_EQ(diagnosis.fits.front().term, name);
    EXPECT_NEAR(diagnosis.fits.front().factor, 1.4, 1e-3) << name;
    EXPECT_NE(diagnosis.sentence.find(std::string(name) + " is off by a factor of 1.4"), std::string::npos) << diagnosis.sentence;
  }
}

TEST_F(DiagnosisTest, APassHasTermsButNoCulprit) {
  const Verdict verdict = judge(golden_, golden_, {});
  ASSERT_EQ(verdict.status, Status::Pass) << verdict.message;
  const Diagnosis diagnosis = diagnose(scene_, settings_, golden_, golden_, {}, verdict);
  EXPECT_TRUE(diagnosis.terms.covered);
  EXPECT_EQ(diagnosis.terms.lights.size(), 2U);
  EXPECT_TRUE(diagnosis.fits.empty());
}

TEST_F(DiagnosisTest, SaysSoWhenNoSingleFactorExplainsIt) {
  image::Image mixed_up = golden_;
  for (int y = 0; y < mixed_up.height; ++y) {
    for (int x = 0; x < mixed_up.width; ++x) {
      mixed_up.at(x, y, 0) = 0.3F + 0.5F * golden_.at(x, y, 1);
    }
  }
  EXPECT_EQ(diagnosis_of(mixed_up).sentence.rfind("no single factor explains it", 0), 0U) << diagnosis_of(mixed_up).sentence;
}

}  // namespace
}  // namespace sheen::conformance
