#include "conformance/mutants/mutant.h"

#include <set>

#include <gtest/gtest.h>

#include "conformance/mutants/hunt.h"
#include "conformance/run.h"
#include "renderer/shader_sources.h"

namespace sheen::conformance {
namespace {

TEST(Mutants, AreAtLeastFortyEachWithANameAReasonAndAMistake) {
  std::set<std::string> names;
  for (const Mutant& mutant : mutants()) {
    EXPECT_TRUE(names.insert(mutant.name).second) << mutant.name << " stands there twice";
    EXPECT_NE(mutant.name, unmutated);
    EXPECT_FALSE(mutant.why.empty()) << mutant.name;
    EXPECT_TRUE(!mutant.edits.empty() || !mutant.swaps.empty() || mutant.alter) << mutant.name << " makes no mistake";
  }
  EXPECT_GE(names.size(), 40U);
}

TEST(Mutants, ChangeTheShadersTheyName) {
  for (const Mutant& mutant : mutants()) {
    std::map<std::string, std::string> files;
    ASSERT_NO_THROW(files = shader_files(mutant)) << mutant.name;
    for (const auto& [file, text] : files) {
      EXPECT_NE(text, renderer::shader_sources().at(file)) << mutant.name;
    }
  }
}

TEST(Mutants, LookFirstWhereThereAreCases) {
  for (const Mutant& mutant : mutants()) {
    for (const CaseFilter& place : mutant.first) {
      EXPECT_FALSE(list(place.suite, place.filter).empty()) << mutant.name << " looks at " << place.suite << " " << place.filter;
    }
  }
}

TEST(Mutants, TheControlChangesNothing) {
  const Mutant control = find_mutant(unmutated);
  EXPECT_TRUE(shader_files(control).empty());
  EXPECT_FALSE(control.alter);
  EXPECT_THROW(find_mutant("no.such_mutant"), std::invalid_argument);
}

TEST(ShaderEdits, APassageThatIsGoneOrStandsThereTwiceIsAnError) {
  Mutant mutant{.name = "tried", .why = ""};
  for (const char* passage : {"no such passage", "return", ""}) {
    mutant.edits = {{"common.glsl", passage, "x"}};
    EXPECT_THROW(shader_files(mutant), std::logic_error) << "'" << passage << "'";
  }
  mutant.edits = {{"no_such.glsl", "return", "x"}};
  EXPECT_THROW(shader_files(mutant), std::logic_error);
}

TEST(ShaderEdits, ApplyOneAfterTheOtherAndToFilesThatStandIn) {
  Mutant mutant{.name = "tried", .why = ""};
  mutant.swaps = {{"fresnel.glsl", {"common.glsl"}}};
  mutant.edits = {{"fresnel.glsl", "float max3(vec3 v)", "float largest(vec3 v)"}, {"fresnel.glsl", "largest", "greatest"}};
  const std::map<std::string, std::string> files = shader_files(mutant);
  ASSERT_EQ(files.size(), 1U);
  EXPECT_NE(files.at("fresnel.glsl").find("float greatest(vec3 v)"), std::string::npos);
}

std::string results_of(const std::string& status, const std::string& compared_pixels) {
  return R"({"cases": [{"name": "first", "status": "pass", "message": "", "compared_pixels": 9},
                       {"name": "second", "status": ")" +
         status + R"(", "message": "why", "compared_pixels": )" + compared_pixels + "}]}";
}

TEST(Fate, OnlyAPictureThatWasJudgedKills) {
  const Fate killed = read_fate("core", results_of("fail", "5"));
  ASSERT_TRUE(killed.kill);
  EXPECT_EQ(killed.kill->suite, "core");
  EXPECT_EQ(killed.kill->name, "second");
  EXPECT_TRUE(killed.error.empty());
  // A shader that does not compile fails its case without a picture.
  for (const auto& [status, compared] :
       {std::pair{"fail", "null"}, std::pair{"crash", "null"}, std::pair{"timeout", "null"}, std::pair{"invalid", "5"}}) {
    const Fate error = read_fate("core", results_of(status, compared));
    EXPECT_FALSE(error.kill) << status;
    EXPECT_NE(error.error.find("second"), std::string::npos) << status;
  }
  for (const char* status : {"pass", "approximation", "unsupported"}) {
    const Fate alive = read_fate("core", results_of(status, "5"));
    EXPECT_FALSE(alive.kill) << status;
    EXPECT_TRUE(alive.error.empty()) << status;
  }
}

}  // namespace
}  // namespace sheen::conformance
