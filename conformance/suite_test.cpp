#include "conformance/suite.h"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "conformance/run.h"

namespace sheen::conformance {
namespace {

/// A suite file around one group.
std::string suite_text(const std::string& group) {
  return R"({"suite": "small", "defaults": {"shape": "sphere", "size": [8, 8], "material": {"pbrMetallicRoughness": {"roughnessFactor": 0.5}},
    "lights": [{"type": "directional", "toward": [0, 0, 1]}],
    "camera": {"type": "perspective", "position": [0, 0, 4], "target": [0, 0, 0], "yfov": 0.6, "znear": 0.1}}, "groups": [)" +
         group + "]}";
}

/// The message that the group is refused with; empty when it is not.
std::string refusal(const std::string& group) {
  try {
    parse_suite(suite_text(group), "small.json");
  } catch (const SuiteError& error) {
    return error.what();
  }
  return "";
}

TEST(Suite, CrossTakesEveryCombinationInTheOrderOfTheAxes) {
  const Suite suite = parse_suite(suite_text(R"({"name": "r{rough}.m{metal}", "axes": {
    "rough": [{"label": "1", "patch": {"material": {"pbrMetallicRoughness": {"roughnessFactor": 0.1}}}}, {"label": "2", "patch": {}}],
    "metal": [{"label": "0", "patch": {"material": {"pbrMetallicRoughness": {"metallicFactor": 0}}}}, {"label": "1", "patch": {}}]}})"),
                                  "small.json");
  std::vector<std::string> names;
  for (const Case& one : suite.cases) {
    names.push_back(one.name);
  }
  EXPECT_EQ(names, (std::vector<std::string>{"r1.m0", "r1.m1", "r2.m0", "r2.m1"}));
  EXPECT_EQ(suite.cases[0].description["material"]["pbrMetallicRoughness"],
            nlohmann::json({{"roughnessFactor", 0.1}, {"metallicFactor", 0}}));
  EXPECT_EQ(suite.cases[3].description["material"]["pbrMetallicRoughness"], nlohmann::json({{"roughnessFactor", 0.5}}));
}

TEST(Suite, ZipTakesTheAxesSideBySide) {
  const Suite suite = parse_suite(suite_text(R"({"name": "{a}_{b}", "combine": "zip", "axes": {
    "a": [{"label": "x", "patch": {}}, {"label": "y", "patch": {}}], "b": [{"label": "1", "patch": {}}, {"label": "2", "patch": {}}]}})"),
                                  "small.json");
  ASSERT_EQ(suite.cases.size(), 2U);
  EXPECT_EQ(suite.cases[0].name, "x_1");
  EXPECT_EQ(suite.cases[1].name, "y_2");
}

TEST(Suite, LaterPatchesWinAndNullRemoves) {
  const Suite suite = parse_suite(suite_text(R"({"name": "{a}", "base": {"material": {"doubleSided": true, "alphaMode": "MASK"}},
        "axes": {"a": [{"label": "x", "patch": {"material": {"doubleSided": null, "alphaMode": "BLEND"}}}]}})"),
                                  "small.json");
  EXPECT_FALSE(suite.cases[0].description["material"].contains("doubleSided"));
  EXPECT_EQ(suite.cases[0].description["material"]["alphaMode"], "BLEND");
}

TEST(Suite, RefusalsNameFileElementAndRule) {
  EXPECT_EQ(refusal(R"({"name": "a", "patch": {}})"), "small.json: groups[0]: unknown key 'patch'");
  EXPECT_EQ(refusal(R"({"name": "a", "base": {"shap": "sphere"}})"), "small.json: groups[0] case 'a': unknown key 'shap'");
  EXPECT_NE(refusal(R"({"name": "a", "base": {"shape": "cube"}})").find("case 'a'.shape: unknown shape; known: "), std::string::npos);
  EXPECT_NE(refusal(R"({"name": "a", "base": {"material": {"pbrMetallicRoughness": {"roughnes": 1}}}})").find("unknown key 'roughnes'"),
            std::string::npos);
  EXPECT_NE(refusal(R"({"name": "a", "base": {"material": {"extensions": {"KHR_materials_shine": {}}}}})").find("unknown extension"),
            std::string::npos);
  EXPECT_NE(
      refusal(R"({"name": "a", "base": {"material": {"extensions": {"KHR_materials_sheen": {"color": 1}}}}})").find("unknown key 'color'"),
      std::string::npos);
  EXPECT_NE(
      refusal(R"({"name": "a", "base": {"material": {"normalTexture": {"index": "no_such_picture"}}}})").find("index must name a picture"),
      std::string::npos);
  EXPECT_NE(refusal(R"({"name": "a", "base": {"lights": []}})").find("at least one light"), std::string::npos);
  EXPECT_NE(refusal(R"({"name": "a", "base": {"lights": [{"type": "point", "toward": [0, 0, 1]}]}})").find("lights[0]"), std::string::npos);
  EXPECT_NE(refusal(R"({"name": "a", "base": {"model": {"visibility": "charly"}}})").find("unknown visibility 'charly'"),
            std::string::npos);
  EXPECT_NE(refusal(R"({"name": "a", "base": {"precision": "lowp"}})").find("case 'a'.precision: must be \"highp\" or \"mediump\""),
            std::string::npos);
  EXPECT_NE(refusal(R"({"name": "a", "base": {"refused": 1}})").find("case 'a'.refused: must be true or false"), std::string::npos);
  EXPECT_NE(refusal(R"({"name": "a", "base": {"size": [0, 4]}})").find("whole numbers from 1"), std::string::npos);
  EXPECT_NE(refusal(R"({"name": "{a}.{b}", "axes": {"a": [{"label": "x", "patch": {}}]}})").find("a hole that no axis fills"),
            std::string::npos);
  EXPECT_NE(refusal(R"({"name": "a", "axes": {"a": [{"label": "x", "patch": {}}]}})").find("does not mention the axis {a}"),
            std::string::npos);
  EXPECT_NE(refusal(R"({"name": "A b"})").find("may hold only"), std::string::npos);
  EXPECT_NE(refusal(R"({"name": "a"}, {"name": "a"})").find("two cases are named 'a'"), std::string::npos);
  EXPECT_THROW(parse_suite("{", "small.json"), SuiteError);
}

TEST(Suite, ACaseSaysItsPrecisionAndWhetherItIsRefusedOrNothing) {
  const Suite suite = parse_suite(suite_text(R"({"name": "{a}", "axes": {"a": [{"label": "silent", "patch": {}},
    {"label": "high", "patch": {"precision": "highp"}}, {"label": "medium", "patch": {"precision": "mediump"}},
    {"label": "wrong", "patch": {"refused": true}}, {"label": "right", "patch": {"refused": false}}]}})"),
                                  "small.json");
  ASSERT_EQ(suite.cases.size(), 5U);
  EXPECT_EQ(suite.cases[0].precision, std::nullopt) << "the run decides";
  EXPECT_EQ(suite.cases[1].precision, golden::Precision::Highp);
  EXPECT_EQ(suite.cases[2].precision, golden::Precision::Mediump);
  for (const Case& one : suite.cases) {
    EXPECT_EQ(one.refused, one.name == "wrong") << one.name;
  }
}

TEST(Suite, FurtherFilesAddGroupsUnderTheSameDefaults) {
  const Suite suite = parse_suite(suite_text(R"({"name": "a"})"), "small.json", {{R"({"groups": [{"name": "b"}]})", "small.more.json"}});
  ASSERT_EQ(suite.cases.size(), 2U);
  EXPECT_EQ(suite.cases[1].name, "b");
  EXPECT_EQ(suite.cases[1].description, suite.cases[0].description);
  const auto refused = [](const std::string& part) {
    try {
      parse_suite(suite_text(R"({"name": "a"})"), "small.json", {{part, "small.more.json"}});
    } catch (const SuiteError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(refused(R"({"groups": [{"name": "a"}]})"), "small.more.json: groups[0]: two cases are named 'a'");
  EXPECT_EQ(refused(R"({"suite": "small", "groups": []})"), "small.more.json: the file: unknown key 'suite'");
}

TEST(Suite, FilterIsThatOfGoogleTest) {
  EXPECT_TRUE(matches_filter("*", "core", "sheen.white"));
  EXPECT_TRUE(matches_filter("sheen.*", "core", "sheen.white"));
  EXPECT_TRUE(matches_filter("core.sheen.*", "core", "sheen.white"));
  EXPECT_TRUE(matches_filter("coat*:*.whit?", "core", "sheen.white"));
  EXPECT_FALSE(matches_filter("sheen", "core", "sheen.white")) << "a pattern is matched whole";
  EXPECT_FALSE(matches_filter("sheen.*-*white", "core", "sheen.white"));
  EXPECT_TRUE(matches_filter("-*red", "core", "sheen.white"));
  EXPECT_FALSE(matches_filter("", "core", "") && matches_filter("?", "core", ""));
}

TEST(CoreSuite, SweepsWhatItPromises) {
  const Suite suite = load_suite("core");
  EXPECT_GE(suite.cases.size(), 120U);
  for (const Case& one : suite.cases) {
    EXPECT_GE(one.width, 128) << one.name;
    EXPECT_GE(one.height, 128) << one.name;
  }
  std::set<std::string> seen;
  for (const Case& one : suite.cases) {
    seen.insert(to_string(one.model.visibility) + " " + to_string(one.model.scaling));
  }
  EXPECT_EQ(seen.size(), 12U) << "three visibilities times four scalings";
  const std::string all = [&suite] {
    std::string text;
    for (const Case& one : suite.cases) {
      text += one.description.dump();
    }
    return text;
  }();
  for (const char* texture :
       {"sheenColorTexture", "sheenRoughnessTexture", "clearcoatTexture", "clearcoatRoughnessTexture", "clearcoatNormalTexture",
        "normalTexture", "baseColorTexture", "metallicRoughnessTexture", "emissiveTexture"}) {
    EXPECT_NE(all.find(texture), std::string::npos) << texture;
  }
}

/// The names of a suite's cases.
std::set<std::string> names_of(const Suite& suite) {
  std::set<std::string> names;
  for (const Case& one : suite.cases) {
    names.insert(one.name);
  }
  return names;
}

TEST(ExtremesSuite, TakesEveryFactorToEveryEndInEitherPrecision) {
  const std::set<std::string> names = names_of(load_suite("extremes"));
  for (const std::string factor : {"sheen_color", "sheen_roughness", "roughness", "metallic", "base_color", "clearcoat",
                                   "clearcoat_roughness", "specular", "specular_color", "emission", "together.all"}) {
    const std::string separator = factor == "together.all" ? "_" : ".";
    for (const std::string value : {"0", "least_normal", "1e_7", "1e_4", "1e_3", "1e_2", "1_less_an_ulp", "1"}) {
      for (const std::string precision : {"highp", "mediump"}) {
        EXPECT_TRUE(names.contains(factor + separator + value + "." + precision)) << factor << " " << value << " " << precision;
      }
    }
    if (factor != "together.all") {
      EXPECT_TRUE(names.contains(factor + ".below_0")) << factor;
      EXPECT_EQ(names.contains(factor + ".above_1"), factor != "specular_color") << factor << " (specularColorFactor has no upper end)";
    }
  }
}

TEST(ExtremesSuite, EveryCaseThatIsDrawnIsDrawnInBothPrecisionsAndSaysWhich) {
  const Suite suite = load_suite("extremes");
  const std::set<std::string> names = names_of(suite);
  for (const Case& one : suite.cases) {
    ASSERT_NE(one.precision.has_value(), one.refused) << one.name;
    if (one.precision) {
      const std::string word = "." + to_string(*one.precision);
      ASSERT_TRUE(one.name.ends_with(word)) << one.name;
      const char* other = *one.precision == golden::Precision::Highp ? ".mediump" : ".highp";
      ASSERT_TRUE(names.contains(one.name.substr(0, one.name.size() - word.size()) + other)) << one.name;
    }
  }
}

TEST(CoreSuite, UnknownSuiteNamesTheOnesThereAre) {
  try {
    load_suite("cor");
    FAIL() << "must throw";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "unknown suite 'cor'; known: core, semantics, furnace, environment, extremes, function");
  }
}

TEST(CoreSuite, ListTellsEachCaseAndFilters) {
  const std::vector<CaseInfo> all = list("core");
  const std::vector<CaseInfo> some = list("core", "scaling.none.ashikhmin.*");
  EXPECT_EQ(all.size(), load_suite("core").cases.size());
  ASSERT_EQ(some.size(), 2U);
  EXPECT_EQ(some[0].visibility, "ashikhmin");
  EXPECT_EQ(some[0].albedo_scaling, "none");
}

}  // namespace
}  // namespace sheen::conformance
