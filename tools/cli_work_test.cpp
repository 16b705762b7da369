#include <array>
#include <cmath>
#include <cstddef>
#include <sstream>
#include <string>
#include <vector>

#include "image/io.h"
#include "tools/cli_fixture_test.h"

namespace sheen::tools {
namespace {

const std::vector<std::string> small{"--width", "24", "--height", "16"};

std::vector<std::string> with(std::vector<std::string> arguments, const std::vector<std::string>& more) {
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

TEST_F(CommandLine, RenderAndGoldenAgreeAndCompareSaysSo) {
  SceneParts parts;
  parts.material = sheen_material();
  const std::string scene = write_scene("square", parts);
  // From the side, so that the half vector leaves the normal and the lobe, which is dark about it, shows.
  const std::vector<std::string> picture = with(small, {"--light", "directional:1,0,0.5:3"});
  const Outcome drawn = run(with({"render", scene, "-o", path("candidate.exr"), "--json"}, picture));
  ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
  const auto report = nlohmann::json::parse(drawn.out);
  EXPECT_EQ(report["width"], 24);
  EXPECT_EQ(report["visibility"], "charlie");
  const Outcome truth = run(with({"golden", scene, "-o", path("golden.exr"), "--json"}, picture));
  ASSERT_EQ(truth.exit_code, 0) << truth.err;
  EXPECT_EQ(nlohmann::json::parse(truth.out)["height"], 16);

  const image::Image candidate = image::read(path("candidate.exr"));
  const image::Image golden = image::read(path("golden.exr"));
  EXPECT_EQ(candidate.channels, (std::vector<std::string>{"R", "G", "B", "A"}));
  for (const char* name : {"R", "G", "B", "A", "bound.R", "bound.G", "bound.B", "excluded"}) {
    EXPECT_GE(golden.channel(name), 0) << name;
  }
  EXPECT_EQ(golden.at(12, 8, golden.channel("A")), 1.0f);
  EXPECT_GT(golden.at(12, 8, golden.channel("R")), golden.at(12, 8, golden.channel("B"))) << "the sheen is red";

  const Outcome compared = run({"compare", path("candidate.exr"), path("golden.exr"), "--json", "--heatmap", path("heat.png")});
  ASSERT_EQ(compared.exit_code, 0) << compared.err;
  const auto figures = nlohmann::json::parse(compared.out);
  for (const char* name : {"max_abs", "mean_abs", "p99_abs", "max_rel", "mean_rel", "p99_rel", "psnr", "flip", "nonfinite_pixels"}) {
    EXPECT_TRUE(figures.contains(name)) << name;
  }
  EXPECT_LT(figures["mean_rel"], 1e-3);
  EXPECT_TRUE(exists("heat.png"));
}

TEST_F(CommandLine, RenderVerifiesItselfAgainstTheGolden) {
  SceneParts parts;
  parts.material = sheen_material();
  const std::string scene = write_scene("square", parts);
  const Outcome outcome =
      run(with({"render", scene, "-o", path("out.exr"), "--verify", "--json", "--light", "directional:1,0,0.5:3"}, small));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto verdict = nlohmann::json::parse(outcome.out)["verify"];
  EXPECT_EQ(verdict["status"], "pass");
  EXPECT_LE(verdict["bound_ratio"], 1.0);
  EXPECT_GT(verdict["compared_pixels"], 100);
}

TEST_F(CommandLine, EveryModelVerifiesItselfAndSaysWhatItLeavesOut) {
  SceneParts parts;
  parts.material = sheen_material();
  parts.material["name"] = "velvet";
  const std::string scene = write_scene("square", parts);
  std::vector<std::vector<float>> pictures;
  for (const std::string model : {"ratified", "draft-2019", "physical"}) {
    const Outcome outcome = run(
        with({"render", scene, "-o", path("out.exr"), "--verify", "--json", "--light", "directional:1,0,0.5:3", "--model", model}, small));
    ASSERT_EQ(outcome.exit_code, 0) << model << ": " << outcome.err;
    const auto report = nlohmann::json::parse(outcome.out);
    EXPECT_EQ(report["model"], model);
    EXPECT_EQ(report["visibility"], model == "draft-2019" ? "ashikhmin" : "charlie");
    EXPECT_EQ(report["verify"]["status"], "pass");
    EXPECT_EQ(outcome.err.find("velvet") != std::string::npos, model == "physical") << outcome.err;
    pictures.push_back(image::read(path("out.exr")).data);
    for (std::size_t earlier = 0; earlier + 1 < pictures.size(); ++earlier) {
      EXPECT_NE(pictures[earlier], pictures.back()) << model;
    }
  }
  const auto explained = nlohmann::json::parse(run({"explain", scene, "--model", "physical", "--json"}).out);
  EXPECT_EQ(explained["tables"], nlohmann::json({"ggx_albedo"}));
  // A white metal under uniform light vanishes.
  parts.material = {{"pbrMetallicRoughness", {{"roughnessFactor", 0.8}}}};
  parts.light = false;
  const std::string metal = write_scene("metal", parts);
  ASSERT_EQ(
      run(with({"golden", metal, "-o", path("furnace.exr"), "--model", "physical", "--environment", "uniform:1,1,1"}, small)).exit_code, 0);
  EXPECT_NEAR(image::read(path("furnace.exr")).at(12, 8, 1), 1.0f, 1e-5f);
}

TEST_F(CommandLine, BothContextsDraw) {
  const std::string scene = write_scene("square");
  for (const char* context : {"osmesa", "egl"}) {
    const Outcome outcome = run(with({"render", scene, "-o", path(std::string(context) + ".exr"), "--context", context}, small));
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  }
  EXPECT_EQ(image::read(path("osmesa.exr")).data, image::read(path("egl.exr")).data);
}

TEST_F(CommandLine, ALightOfTheCommandLineReplacesTheScenesOwn) {
  SceneParts parts;
  // A Lambertian square: no specular, no metal, so the radiance is lux cos / pi.
  parts.material["extensions"]["KHR_materials_specular"]["specularFactor"] = 0.0;
  const std::string scene = write_scene("square", parts);
  const Outcome outcome =
      run(with({"golden", scene, "-o", path("out.exr"), "--light", "directional:0,3,4:2", "--light", "directional:0,0,9:1"}, small));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NEAR(image::read(path("out.exr")).at(12, 8, 0), (2.0 * 0.8 + 1.0) / 3.14159265358979, 1e-5);
}

TEST_F(CommandLine, ExposureScalesWhatIsWrittenAndPngTakesAToneMap) {
  const std::string scene = write_scene("square");
  ASSERT_EQ(run(with({"render", scene, "-o", path("plain.exr")}, small)).exit_code, 0);
  ASSERT_EQ(run(with({"render", scene, "-o", path("bright.exr"), "--exposure", "1"}, small)).exit_code, 0);
  EXPECT_NEAR(image::read(path("bright.exr")).at(12, 8, 1), 2.0f * image::read(path("plain.exr")).at(12, 8, 1), 1e-6);
  ASSERT_EQ(run(with({"render", scene, "-o", path("clipped.png"), "--exposure", "2"}, small)).exit_code, 0);
  ASSERT_EQ(run(with({"render", scene, "-o", path("mapped.png"), "--exposure", "2", "--tone-map", "khronos-pbr-neutral"}, small)).exit_code,
            0);
  EXPECT_EQ(image::read(path("clipped.png")).at(12, 8, 1), 1.0f);
  EXPECT_LT(image::read(path("mapped.png")).at(12, 8, 1), 1.0f);
}

TEST_F(CommandLine, ImagesOfUnequalSizesAreNotCompared) {
  const std::string scene = write_scene("square");
  ASSERT_EQ(run({"golden", scene, "-o", path("a.exr"), "--width", "8", "--height", "8"}).exit_code, 0);
  ASSERT_EQ(run({"golden", scene, "-o", path("b.exr"), "--width", "8", "--height", "9"}).exit_code, 0);
  const Outcome outcome = run({"compare", path("a.exr"), path("b.exr"), "--heatmap", path("heat.png")});
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_NE(outcome.err.find("8 x 9"), std::string::npos) << outcome.err;
  EXPECT_FALSE(exists("heat.png"));
  EXPECT_EQ(run({"compare", path("a.exr"), path("a.exr"), "--tolerance", "0,0"}).exit_code, 0);
}

TEST_F(CommandLine, CompareFailsOutsideItsTolerance) {
  const std::string scene = write_scene("square");
  ASSERT_EQ(run(with({"golden", scene, "-o", path("a.exr"), "--light", "directional:0,0,1:1"}, small)).exit_code, 0);
  ASSERT_EQ(run(with({"golden", scene, "-o", path("b.exr"), "--light", "directional:0,0,1:1.01"}, small)).exit_code, 0);
  EXPECT_EQ(run({"compare", path("a.exr"), path("b.exr")}).exit_code, 0) << "without a tolerance it only measures";
  EXPECT_EQ(run({"compare", path("a.exr"), path("b.exr"), "--tolerance", "0.02,0"}).exit_code, 0);
  const Outcome outcome = run({"compare", path("a.exr"), path("b.exr"), "--tolerance", "0.001,1e-6", "--json"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(nlohmann::json::parse(outcome.out)["within_tolerance"], false);
}

TEST_F(CommandLine, AnExistingOutputSurvivesAFailure) {
  const std::string scene = write_scene("square");
  ASSERT_EQ(run(with({"golden", scene, "-o", path("out.exr")}, small)).exit_code, 0);
  const std::string before = text("out.exr");
  EXPECT_EQ(run({"golden", path("none.glb"), "-o", path("out.exr")}).exit_code, 3);
  EXPECT_EQ(run({"golden", scene, "-o", path("out.exr"), "--camera", "7"}).exit_code, 3);
  EXPECT_EQ(run({"render", scene, "-o", path("out.exr"), "--environment", "uniform:1,1"}).exit_code, 2);
  EXPECT_TRUE(text("out.exr") == before);
  EXPECT_EQ(names_starting_with("out").size(), 1U);
}

TEST_F(CommandLine, GoldenTakesLightFromEverywhere) {
  const std::string scene = write_scene("square");
  EXPECT_EQ(run(with({"golden", scene, "-o", path("u.exr"), "--environment", "uniform:1,2,3"}, small)).exit_code, 0);
  // The same light, as an image of one colour.
  const std::string pfm = path("white.exr");
  image::Image white(8, 4, {"R", "G", "B"});
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 8; ++x) {
      for (int c = 0; c < 3; ++c) {
        white.at(x, y, c) = static_cast<float>(c + 1);
      }
    }
  }
  image::write(pfm, white);
  ASSERT_EQ(
      run(with({"golden", scene, "-o", path("i.exr"), "--environment", pfm, "--environment-rotation", "90", "--error", "0.002"}, small))
          .exit_code,
      0);
  EXPECT_EQ(run({"compare", path("i.exr"), path("u.exr"), "--tolerance", "0.02,1e-4"}).exit_code, 0);
  const image::Image picture = image::read(path("i.exr"));
  ASSERT_GE(picture.channel("standard_error.G"), 0);
  ASSERT_EQ(
      run(with({"golden", scene, "-o", path("j.exr"), "--environment", pfm, "--environment-rotation", "90", "--error", "0.002"}, small))
          .exit_code,
      0);
  EXPECT_EQ(image::read(path("j.exr")).data, picture.data) << "one seed, one image";
}

TEST_F(CommandLine, AnEnvironmentThatIsNoneIsRefused) {
  const std::string scene = write_scene("square");
  EXPECT_EQ(run({"golden", scene, "-o", path("out.exr"), "--environment", "uniform:1,1,1", "--samples", "511"}).exit_code, 2)
      << "too few for a standard error";
  for (const std::string text : {"uniform:1,2", "uniform:1,-1,1", "uniform:nan,1,1", "sky.png", "sky"}) {
    EXPECT_EQ(run({"golden", scene, "-o", path("out.exr"), "--environment", text}).exit_code, 2) << text;
  }
  EXPECT_EQ(run({"golden", scene, "-o", path("out.exr"), "--environment", path("none.hdr")}).exit_code, 3);
  image::Image dark(2, 1, {"R", "G", "B"});
  dark.at(1, 0, 1) = -1.0F;
  image::write(path("negative.exr"), dark);
  const Outcome outcome = run({"golden", scene, "-o", path("out.exr"), "--environment", path("negative.exr")});
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_NE(outcome.err.find("pixel 1, 0"), std::string::npos) << outcome.err;
  EXPECT_TRUE(names_starting_with("out").empty());
}

TEST_F(CommandLine, ExplainNamesSheenOnlyWhereThereIsSheen) {
  SceneParts cloth;
  cloth.material = sheen_material();
  const auto explain = [this](const std::string& scene) {
    const Outcome outcome = run({"explain", scene, "--json"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return nlohmann::json::parse(outcome.out);
  };
  const auto with_sheen = explain(write_scene("cloth", cloth));
  const auto without = explain(write_scene("plain"));
  for (const char* list : {"features", "defines", "tables", "uniforms", "texture_units"}) {
    EXPECT_EQ(without[list].dump().find("sheen"), std::string::npos) << list;
    EXPECT_EQ(without[list].dump().find("SHEEN"), std::string::npos) << list;
  }
  EXPECT_NE(with_sheen["features"].dump().find("sheen"), std::string::npos);
  EXPECT_NE(with_sheen["tables"].dump().find("charlie"), std::string::npos);
  EXPECT_TRUE(without["tables"].empty());
  EXPECT_NE(without["omitted"].dump().find("sheen"), std::string::npos);
  cloth.light = false;
  EXPECT_NE(explain(write_scene("dark", cloth))["features"].dump().find("environment_uniform"), std::string::npos);
}

TEST_F(CommandLine, LutInCsvHoldsTheClosedFormOfAshikhminTowardNormalIncidence) {
  // E(1, r) = 2^-(p+1) / (p+2), p = 1 / (2 r^2); the last column is half a texel off, so two sizes are extrapolated to N.V = 1.
  const auto last_column = [this](int size) {
    const std::string name = std::to_string(size) + ".csv";
    EXPECT_EQ(run({"lut", "-o", path(name), "--visibility", "ashikhmin", "--size", std::to_string(size), "--json"}).exit_code, 0);
    std::istringstream lines(text(name));
    std::string line;
    std::getline(lines, line);
    EXPECT_EQ(line, "sheen_roughness,n_dot_v,directional_albedo");
    std::vector<std::array<double, 3>> rows;
    while (std::getline(lines, line)) {
      std::array<double, 3> row{};
      char comma = 0;
      std::istringstream(line) >> row[0] >> comma >> row[1] >> comma >> row[2];
      rows.push_back(row);
    }
    EXPECT_EQ(rows.size(), static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
    return rows;
  };
  const auto rows = last_column(64);
  EXPECT_EQ(rows[0][0], 0.5 / 64);
  EXPECT_EQ(rows[1][1], 1.5 / 64);
  for (std::size_t row = 32; row < 64; row += 8) {
    const std::size_t end = row * 64 + 63;
    const double r = rows[end][0];
    const double p = 0.5 / (r * r);
    // Quadratic through the last three columns, which are 1, 3 and 5 half texels away.
    const double at_one = (15.0 * rows[end][2] - 10.0 * rows[end - 1][2] + 3.0 * rows[end - 2][2]) / 8.0;
    EXPECT_NEAR(at_one, std::exp2(-(p + 1.0)) / (p + 2.0), 2e-6) << "sheen_roughness " << r;
  }
}

TEST_F(CommandLine, LutWritesEveryFormat) {
  for (const char* name : {"t.exr", "t.hdr", "t.hpp", "t.csv"}) {
    const Outcome outcome = run({"lut", "-o", path(name), "--size", "8", "--layout", "warped"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_TRUE(exists(name));
  }
  EXPECT_EQ(image::read(path("t.exr")).width, 8);
  EXPECT_NE(text("t.hpp").find("sheen_albedo[64]"), std::string::npos);
}

TEST_F(CommandLine, LutWritesTheSplitSumBesideTheSheen) {
  for (const char* name : {"t.exr", "t.hdr", "t.hpp", "t.csv"}) {
    for (const char* table : {"ggx", "all"}) {
      const Outcome outcome = run({"lut", "-o", path(name), "--size", "16", "--table", table});
      EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    }
  }
  // At normal incidence the smoothest lobe reflects all of f0 and next to no bias.
  const image::Image image = image::read(path("t.exr"));
  EXPECT_NEAR(image.at(15, 0, 0), 1, 1e-3);
  EXPECT_NEAR(image.at(15, 0, 1), 0, 1e-3);
  EXPECT_EQ(text("t.csv").substr(0, text("t.csv").find('\n')), "roughness,n_dot_v,scale,bias,directional_albedo");
  EXPECT_NE(text("t.hpp").find("ggx_split_sum[512]"), std::string::npos);
  EXPECT_NE(text("t.hpp").find("sheen_albedo[256]"), std::string::npos);
}

TEST_F(CommandLine, LutNamesWhatItWroteItself) {
  const auto check = [this](const std::string& name, const std::vector<std::string>& flags) {
    std::vector<std::string> arguments{"lut", "-o", path(name), "--size", "32"};
    arguments.insert(arguments.end(), flags.begin(), flags.end());
    EXPECT_EQ(run(arguments).exit_code, 0);
    const Outcome outcome = run({"lut", "--check", path(name), "--json"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const nlohmann::json report = nlohmann::json::parse(outcome.out);
    EXPECT_EQ(report["axis"], "roughness");
    EXPECT_EQ(report["row_shift"], 0);
    EXPECT_EQ(report["transposed"], false);
    EXPECT_TRUE(report["flipped"].empty());
    return report;
  };
  for (const char* name : {"t.exr", "t.csv"}) {
    const nlohmann::json report = check(name, {"--visibility", "refined"});
    EXPECT_EQ(report["visibility"], "refined");
    EXPECT_EQ(report["texels"], "centre");
    EXPECT_LT(report["max_error"], 1e-5);
  }
  EXPECT_LE(check("t.hdr", {})["max_relative_error"], 1.0 / 128) << "a mantissa of 8 bits, cut off";
  EXPECT_EQ(check("t.exr", {"--table", "all", "--visibility", "ashikhmin"})["channel"], "B");
  const nlohmann::json warped = check("t.exr", {"--layout", "warped"});
  EXPECT_EQ(warped["layout"], "warped");
  EXPECT_EQ(warped["texels"], "edge");
}

TEST_F(CommandLine, LutCheckOfAnotherPictureNamesNothingAndExitsWithOne) {
  EXPECT_EQ(run({"lut", "-o", path("ggx.exr"), "--table", "ggx"}).exit_code, 0);
  const Outcome outcome = run({"lut", "--check", path("ggx.exr"), "--json"});
  EXPECT_EQ(outcome.exit_code, 1);
  const nlohmann::json report = nlohmann::json::parse(outcome.out);
  EXPECT_TRUE(report["visibility"].is_null());
  EXPECT_TRUE(report["max_error"].is_null());
  EXPECT_FALSE(report["message"].get<std::string>().empty());
}

TEST_F(CommandLine, BothWaysToRenderAnEnvironmentMeetItsGolden) {
  SceneParts cloth;
  cloth.material = sheen_material();
  cloth.light = false;
  const std::string scene = write_scene("cloth", cloth);
  const std::vector<std::string> light{"--environment", "uniform:1,1,1", "--albedo-scaling", "view"};
  ASSERT_EQ(run(with(with({"golden", scene, "-o", path("golden.exr")}, small), light)).exit_code, 0);
  for (const std::string samples : {"0", "4096"}) {
    const std::string out = path("candidate" + samples + ".exr");
    const Outcome drawn = run(with(with({"render", scene, "-o", out, "--environment-samples", samples}, small), light));
    ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
    const Outcome compared = run({"compare", out, path("golden.exr"), "--tolerance", "0.01,1e-4"});
    EXPECT_EQ(compared.exit_code, 0) << compared.out;
  }
}

TEST_F(CommandLine, ServeAnswersByTheViewerProtocol) {
  const Outcome hello = run({"serve", "--json"});
  ASSERT_EQ(hello.exit_code, 0) << hello.err;
  EXPECT_EQ(nlohmann::json::parse(hello.out)["encoding"], "linear-float");
  const nlohmann::json request{{"id", 1},     {"scene", write_scene("square")}, {"camera", 0}, {"width", 8},
                               {"height", 8}, {"output", path("out.exr")}};
  const Outcome served = run({"serve"}, request.dump() + "\n");
  ASSERT_EQ(served.exit_code, 0) << served.err;
  std::istringstream lines(served.out);
  std::string line;
  std::getline(lines, line);
  std::getline(lines, line);
  const auto answer = nlohmann::json::parse(line);
  EXPECT_EQ(answer["id"], 1);
  EXPECT_EQ(answer["status"], "rendered") << answer.dump();
  EXPECT_TRUE(exists("out.exr"));
}

}  // namespace
}  // namespace sheen::tools
