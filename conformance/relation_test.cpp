#include "conformance/relation.h"

#include <gtest/gtest.h>

#include "conformance/goldens.h"
#include "conformance/suite.h"
#include "conformance/test_folder.h"

namespace sheen::conformance {
namespace {

/// A suite file around one relation: `members` are those of the relation beside its law and source.
std::string suite_text(const std::string& members) {
  return R"({"suite": "small", "defaults": {"shape": "sphere", "size": [8, 8], "material": {"doubleSided": true},
    "lights": [{"type": "directional", "toward": [0, 0, 1]}],
    "camera": {"type": "perspective", "position": [0, 0, 4], "target": [0, 0, 0], "yfov": 0.6, "znear": 0.1}},
    "groups": [{"name": "a.law", "base": {"relation": {"law": "so it is", "source": "a text", )" +
         members + "}}}]}";
}

const std::string two_scenes =
    R"("scenes": [{"label": "one", "patch": {}}, {"label": "two", "patch": {"material": {"doubleSided": null, "alphaMode": "MASK"}}}])";

/// The message that the relation is refused with; empty when it is not.
std::string refusal(const std::string& members) {
  try {
    parse_suite(suite_text(members), "small.json");
  } catch (const SuiteError& error) {
    return error.what();
  }
  return "";
}

TEST(RelationFile, ScenesAreTheCaseWithTheirPatches) {
  const Suite suite = parse_suite(suite_text(R"("kind": "equal", "exact": true, )" + two_scenes), "small.json");
  EXPECT_TRUE(suite.cases.empty());
  ASSERT_EQ(suite.relations.size(), 1U);
  EXPECT_EQ(suite.size(), 1U);
  EXPECT_EQ(suite.name_of(0), "a.law");
  const Relation& relation = suite.relations[0];
  EXPECT_EQ(relation.kind, RelationKind::Equal);
  EXPECT_TRUE(relation.exact);
  EXPECT_EQ(relation.law, "so it is");
  EXPECT_EQ(relation.source, "a text");
  ASSERT_EQ(relation.scenes.size(), 2U);
  EXPECT_EQ(relation.scenes[0].name, "a.law.one");
  EXPECT_EQ(relation.scenes[0].description["material"], nlohmann::json({{"doubleSided", true}}));
  EXPECT_EQ(relation.scenes[1].description["material"], nlohmann::json({{"alphaMode", "MASK"}})) << "null removes";
  EXPECT_FALSE(relation.scenes[1].description.contains("relation"));
}

TEST(RelationFile, TakesWeightsToleranceShareAndRegion) {
  const Suite suite =
      parse_suite(suite_text(R"("kind": "linear", "weights": [1, -0.5], "share": 0.25, "region": [0, 0.5, 1, 1], "moved": true,
    "tolerance": {"relative": 0.02, "because": "of a reason"}, "excuse": "a reason", )" +
                             two_scenes),
                  "small.json");
  const Relation& relation = suite.relations.at(0);
  EXPECT_EQ(relation.weights, (std::vector<double>{1, -0.5}));
  EXPECT_EQ(relation.share, 0.25);
  EXPECT_EQ(relation.region[1], 0.5);
  EXPECT_TRUE(relation.moved);
  EXPECT_EQ(relation.relative, 0.02);
  EXPECT_EQ(relation.absolute, 2e-5) << "what is not stated stays";
  EXPECT_EQ(relation.excuse, "a reason");
}

TEST(RelationFile, RefusalsNameTheRelationAndTheRule) {
  const std::string equal = R"("kind": "equal", )";
  EXPECT_EQ(refusal(equal + two_scenes), "");
  EXPECT_EQ(refusal(equal + R"("golden": 1, )" + two_scenes), "small.json: groups[0] relation 'a.law': unknown key 'golden'");
  EXPECT_NE(refusal(R"("kind": "same", )" + two_scenes).find("unknown kind 'same'; known: equal, differs, brighter, linear"),
            std::string::npos);
  EXPECT_NE(refusal(two_scenes).find("needs 'kind'"), std::string::npos);
  EXPECT_NE(refusal(equal + R"("law": "", )" + two_scenes).find("needs 'law'"), std::string::npos);
  EXPECT_NE(refusal(equal + R"("scenes": [{"label": "one", "patch": {}}])").find("at least two"), std::string::npos);
  EXPECT_NE(refusal(equal + R"("scenes": [{"label": "one", "patch": {}}, {"label": "one", "patch": {}}])").find("'one'"),
            std::string::npos);
  EXPECT_NE(refusal(equal + R"("scenes": [{"label": "one", "patch": {}}, {"label": "t.wo", "patch": {}}])").find("no dot"),
            std::string::npos);
  EXPECT_NE(refusal(equal + R"("scenes": [{"label": "one", "patch": {}}, {"label": "two", "patch": {"size": [4, 4]}}])").find("one size"),
            std::string::npos);
  EXPECT_NE(refusal(equal + R"("scenes": [{"label": "one", "patch": {}}, {"label": "two", "patch": {"shap": 1}}])").find("unknown key"),
            std::string::npos);
  EXPECT_NE(refusal(R"("kind": "linear", )" + two_scenes).find("'weights'"), std::string::npos);
  EXPECT_NE(refusal(R"("kind": "linear", "weights": [1], )" + two_scenes).find("weights must be 2 numbers"), std::string::npos);
  EXPECT_NE(refusal(equal + R"("weights": [1, -1], )" + two_scenes).find("'weights'"), std::string::npos);
  EXPECT_NE(refusal(equal + R"("tolerance": {"relative": 0.1}, )" + two_scenes).find("because"), std::string::npos);
  EXPECT_NE(refusal(equal + R"("share": 0, )" + two_scenes).find("share"), std::string::npos);
  EXPECT_NE(refusal(equal + R"("region": [0, 0, 2, 1], )" + two_scenes).find("region"), std::string::npos);
  EXPECT_NE(refusal(R"("kind": "differs", "exact": true, )" + two_scenes).find("exact"), std::string::npos);
}

TEST(RelationFile, ASuiteOfRelationsHasNoGoldens) {
  const TestFolder folder;
  GoldensOptions options;
  options.dir = folder.path();
  options.suite = "semantics";
  EXPECT_THROW(generate_goldens(options), std::invalid_argument);
  EXPECT_THROW(verify_goldens(options), std::invalid_argument);
}

}  // namespace
}  // namespace sheen::conformance
