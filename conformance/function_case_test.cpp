#include "conformance/function_case.h"

#include <set>

#include <gtest/gtest.h>

#include "conformance/case.h"
#include "conformance/function_spec.h"
#include "conformance/suite.h"
#include "renderer/functions.h"

namespace sheen::conformance {
namespace {

using nlohmann::json;

json whole() {
  return {
      {"function", "ggx_distribution"}, {"precision", "mediump"}, {"formulation", "literal"}, {"arguments", "random"}, {"size", {8, 4}}};
}

/// What the description is refused with; empty when it is not.
std::string refusal(const json& patch) {
  json description = whole();
  description.merge_patch(patch);
  try {
    make_function_case({"name", description}, "small.json", "groups[0]");
  } catch (const SuiteError& error) {
    return error.what();
  }
  return "";
}

TEST(FunctionCase, HoldsWhatIsDescribed) {
  const FunctionCase one = make_function_case({"name", whole()}, "small.json", "groups[0]");
  EXPECT_EQ(one.function, "ggx_distribution");
  EXPECT_EQ(describe(one), "literal mediump, random arguments");
  EXPECT_EQ(one.width, 8);
  EXPECT_EQ(one.height, 4);
}

TEST(FunctionCase, RefusesWhatItDoesNotKnowNamingCaseAndRule) {
  EXPECT_NE(refusal({{"function", "ggx"}}).find("groups[0] case 'name': unknown function 'ggx'"), std::string::npos);
  EXPECT_NE(refusal({{"precision", "lowp"}}).find("known: highp, mediump"), std::string::npos);
  EXPECT_NE(refusal({{"formulation", nullptr}}).find("needs 'formulation'"), std::string::npos);
  EXPECT_NE(refusal({{"arguments", "all"}}).find("known: dense, random, adversarial"), std::string::npos);
  EXPECT_NE(refusal({{"size", {8, 0}}}).find("needs 'size'"), std::string::npos);
  EXPECT_NE(refusal({{"material", json::object()}}).find("unknown key 'material'"), std::string::npos);
  EXPECT_NE(refusal({{"function", "base"}}).find("'base' has no literal form"), std::string::npos);
}

TEST(FunctionSuite, JudgesEveryFunctionThatCanBeEvaluatedInEveryFormItHas) {
  const Suite suite = load_suite("function");
  std::set<std::string> tried;
  for (const FunctionCase& one : suite.functions) {
    tried.insert(one.function + (one.formulation == renderer::Formulation::Literal ? " literal" : ""));
  }
  for (const renderer::ShaderFunction& function : renderer::shader_functions()) {
    EXPECT_TRUE(tried.contains(function.name)) << function.name;
    const FunctionSpec spec = function_spec(function.name, renderer::Precision::Highp);
    EXPECT_EQ(spec.has_literal, tried.contains(function.name + " literal")) << function.name;
    std::vector<double> typical;
    for (const Parameter& parameter : spec.parameters) {
      typical.push_back(parameter.typical);
    }
    const std::vector<double> arguments = spec.place(typical);
    EXPECT_EQ(arguments.size(), static_cast<std::size_t>(function.scalars())) << function.name;
    EXPECT_EQ(spec.promise(arguments, renderer::Formulation::Stable).size(), static_cast<std::size_t>(function.channels)) << function.name;
  }
  EXPECT_EQ(function_names().size(), renderer::shader_functions().size());
  EXPECT_TRUE(suite.cases.empty());
  EXPECT_EQ(suite.size(), suite.functions.size());
  EXPECT_EQ(suite.function_at(3), &suite.functions[3]);
}

}  // namespace
}  // namespace sheen::conformance
