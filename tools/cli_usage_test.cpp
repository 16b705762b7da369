#include <string>
#include <vector>

#include "tools/cli_fixture_test.h"

namespace sheen::tools {
namespace {

/// stderr says it, and stdout is silent.
void expect_refused(const Outcome& outcome, int exit_code, const std::string& word) {
  EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
  EXPECT_NE(outcome.err.find(word), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.out, "");
}

TEST_F(CommandLine, EveryCommandHasHelpThatNamesItsFlags) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> commands{
      {{"render"}, "--tone-map"},         {{"golden"}, "--camera"}, {{"compare"}, "--tolerance"},  {{"list"}, "--suite"},
      {{"run"}, "--case-limit"},          {{"join"}, "--output"},   {{"goldens"}, "verify"},       {{"goldens", "generate"}, "--suite"},
      {{"goldens", "verify"}, "--suite"}, {{"lut"}, "--check"},     {{"explain"}, "--visibility"}, {{"serve"}, "--context"}};
  for (const auto& [words, flag] : commands) {
    std::vector<std::string> arguments = words;
    arguments.emplace_back("--help");
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << words[0];
    EXPECT_NE(outcome.out.find(flag), std::string::npos) << outcome.out;
    if (words[0] != "goldens") {
      EXPECT_NE(outcome.out.find("--json"), std::string::npos) << words[0];
    }
  }
  const Outcome all = run({"--help"});
  EXPECT_EQ(all.exit_code, 0);
  for (const auto& [words, flag] : commands) {
    EXPECT_NE(all.out.find(words[0]), std::string::npos);
  }
}

TEST_F(CommandLine, WhatIsNotBuiltIsNotOffered) {
  const Outcome help = run({"--help"});
  for (const char* command : {"export", "judge", "identify", "trade"}) {
    EXPECT_EQ(help.out.find(std::string("\n  ") + command), std::string::npos);
    EXPECT_EQ(run({command}).exit_code, 2) << command;
  }
}

TEST_F(CommandLine, UsageErrorsExitWithTwo) {
  const std::string scene = write_scene("square");
  const std::string out = path("out.exr");
  expect_refused(run({}), 2, "--help");
  expect_refused(run({"nonsense"}), 2, "nonsense");
  expect_refused(run({"render", scene, "-o", out, "--nonsense"}), 2, "--nonsense");
  expect_refused(run({"render", scene, "extra.glb", "-o", out}), 2, "extra.glb");
  expect_refused(run({"render", scene}), 2, "--output");
  expect_refused(run({"render", "-o", out}), 2, "SCENE");
  expect_refused(run({"goldens"}), 2, "--help");
  for (const char* size : {"0", "-1", "1e9", "99999999999999999999", "16385", "12.5", "wide", ""}) {
    expect_refused(run({"render", scene, "-o", out, "--width", size}), 2, "--width");
    expect_refused(run({"golden", scene, "-o", out, "--height", size}), 2, "--height");
  }
  expect_refused(run({"render", scene, "-o", out, "--width", "8", "--width", "9"}), 2, "--width");
  expect_refused(run({"render", scene, "-o", out, "--camera", "-1"}), 2, "--camera");
  expect_refused(run({"render", scene, "-o", out, "--visibility", "0"}), 2, "--visibility");
  expect_refused(run({"render", scene, "-o", out, "--albedo-scaling", "fulll"}), 2, "--albedo-scaling");
  expect_refused(run({"render", scene, "-o", out, "--exposure", "nan"}), 2, "--exposure");
  expect_refused(run({"render", scene, "-o", out, "--environment-rotation", "nan"}), 2, "--environment-rotation");
  expect_refused(run({"golden", scene, "-o", out, "--error", "nan"}), 2, "--error");
  expect_refused(run({"run", "--suite", "core", "--case-limit", "nan"}), 2, "--case-limit");
  expect_refused(run({"render", scene, "-o", out, "--light", "directional:0,0,0:1"}), 2, "--light");
  expect_refused(run({"render", scene, "-o", out, "--albedo-source", "fit", "--visibility", "refined"}), 2, "fit");
  expect_refused(run({"golden", scene, "-o", out, "--context", "egl"}), 2, "--context");
  expect_refused(run({"golden", scene, "-o", out, "--model", "draft"}), 2, "--model");
  expect_refused(run({"render", scene, "-o", out, "--model", "physical", "--visibility", "charlie"}), 2, "--visibility");
  expect_refused(run({"golden", scene, "-o", out, "--model", "draft-2019", "--visibility", "charlie"}), 2, "--visibility");
  expect_refused(run({"golden", scene, "-o", out, "--albedo-scaling", "full", "--model", "draft-2019"}), 2, "--albedo-scaling");
  expect_refused(run({"compare", out, out, "--tolerance", "1"}), 2, "--tolerance");
  expect_refused(run({"lut", "-o", path("t.csv"), "--size", "0"}), 2, "--size");
  expect_refused(run({"lut", "-o", path("t.csv"), "--size", "1", "--layout", "warped"}), 2, "--size");
  expect_refused(run({"lut", "-o", path("t.csv"), "--table", "all", "--layout", "warped"}), 2, "--layout");
  expect_refused(run({"lut", "-o", path("t.csv"), "--table", "ggx", "--visibility", "charlie"}), 2, "--visibility");
  expect_refused(run({"lut", "-o", path("t.csv"), "--check", "table.exr"}), 2, "--check");
  expect_refused(run({"lut", "--check", "table.exr", "--size", "8"}), 2, "--size");
  expect_refused(run({"lut"}), 2, "--output");
  EXPECT_TRUE(names_starting_with("out").empty());
  EXPECT_TRUE(names_starting_with("t.csv").empty());
}

TEST_F(CommandLine, FlagsOfLaterVersionsSaySoAndLeaveNothing) {
  const Outcome outcome = run({"render", write_scene("square"), "-o", path("out.exr"), "--max-error", "0.01"});
  expect_refused(outcome, 2, "not yet");
  EXPECT_NE(outcome.err.find("--max-error"), std::string::npos);
  EXPECT_TRUE(names_starting_with("out").empty());
}

TEST_F(CommandLine, AFailureWithJsonIsOneObjectToo) {
  for (const auto& [arguments, exit_code] :
       std::vector<std::pair<std::vector<std::string>, int>>{{{"explain", path("none.glb"), "--json"}, 3},
                                                             {{"explain", "--nonsense", "--json"}, 2},
                                                             {{"render", "x.glb", "-o", "x.exr", "--environment", "x.hdr", "--json"}, 3}}) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, exit_code);
    const nlohmann::json report = nlohmann::json::parse(outcome.out);
    EXPECT_EQ(report["exit_code"], exit_code);
    EXPECT_NE(outcome.err.find(report["error"].get<std::string>()), std::string::npos);
  }
}

TEST_F(CommandLine, BadInputExitsWithThreeNamingFileElementAndRule) {
  const std::string out = path("out.exr");
  expect_refused(run({"render", path("none.glb"), "-o", out}), 3, "none.glb");
  expect_refused(run({"golden", path("none.glb"), "-o", out}), 3, "none.glb");
  expect_refused(run({"explain", path("none.glb")}), 3, "none.glb");
  expect_refused(run({"compare", path("none.exr"), path("none.exr")}), 3, "none.exr");
  SceneParts parts;
  parts.material = sheen_material();
  parts.material["name"] = "velvet";
  parts.material["extensions"]["KHR_materials_sheen"]["sheenRoughnessFactor"] = 1.5;
  const std::string scene = write_scene("rough", parts);
  const Outcome outcome = run({"render", scene, "-o", out});
  expect_refused(outcome, 3, "rough.gltf");
  EXPECT_NE(outcome.err.find("velvet"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("sheenRoughnessFactor"), std::string::npos) << outcome.err;
  EXPECT_TRUE(names_starting_with("out").empty());
}

TEST_F(CommandLine, ASceneWithoutLightIsLitFromEverywhereAndThatIsSaid) {
  SceneParts parts;
  parts.light = false;
  const std::string scene = write_scene("dark", parts);
  for (const std::string command : {"render", "golden"}) {
    const std::string out = path(command + ".exr");
    const Outcome outcome = run({command, scene, "-o", out, "--width", "8", "--height", "8"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NE(outcome.err.find("uniform:1,1,1"), std::string::npos) << outcome.err;
    EXPECT_TRUE(exists(command + ".exr"));
  }
  const Outcome lit = run({"golden", scene, "-o", path("lit.exr"), "--width", "8", "--height", "8", "--light", "directional:0,0,1:2"});
  EXPECT_EQ(lit.exit_code, 0) << lit.err;
  EXPECT_EQ(lit.err.find("uniform"), std::string::npos) << lit.err;
}

TEST_F(CommandLine, AnOutputThatCannotBeWrittenExitsWithThree) {
  const std::string scene = write_scene("square");
  expect_refused(run({"render", scene, "-o", path("none/out.exr")}), 3, "none");
  expect_refused(run({"golden", scene, "-o", path("out.txt")}), 3, "out.txt");
  expect_refused(run({"lut", "-o", path("out")}), 3, ".csv");
  expect_refused(run({"lut", "--check", path("none.exr")}), 3, "none.exr");
  expect_refused(run({"lut", "--check", path("none.csv")}), 3, "none.csv");
  EXPECT_TRUE(names_starting_with("out").empty());
}

TEST_F(CommandLine, AMachineWithoutTheContextExitsWithFour) {
  // An EGL that is told to use a driver that does not exist has no display to offer.
  const std::string scene = write_scene("square");
  ASSERT_EQ(setenv("__EGL_VENDOR_LIBRARY_FILENAMES", path("none.json").c_str(), 1), 0);
  const Outcome outcome = run({"render", scene, "-o", path("out.exr"), "--context", "egl"});
  unsetenv("__EGL_VENDOR_LIBRARY_FILENAMES");
  expect_refused(outcome, 4, "libegl");
  EXPECT_TRUE(names_starting_with("out").empty());
}

TEST_F(CommandLine, ARunOfAViewerThatDoesNotStartExitsWithFour) {
  const Outcome outcome = run({"run", "--viewer", path("no-such-viewer"), "--report", path("report")});
  EXPECT_EQ(outcome.exit_code, 4) << outcome.err;
}

}  // namespace
}  // namespace sheen::tools
