#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "conformance/case_scene.h"
#include "conformance/child_process.h"
#include "conformance/golden_store.h"
#include "conformance/suite.h"
#include "conformance/test_folder.h"
#include "image/io.h"
#include "scene/gltf.h"

namespace sheen::conformance {

/// The first line of a viewer of others, which takes no settings.
inline const nlohmann::json foreign_hello = {
    {"viewer", "fake"}, {"version", "1"}, {"capabilities", nlohmann::json::array()}, {"encoding", "linear-float"}};

/// The end of a run in a process of its own.
struct Outcome {
  std::string ending;
  nlohmann::json results;

  std::string status(const std::string& name) const { return find(name).value("status", "missing"); }
  nlohmann::json find(const std::string& name) const {
    for (const nlohmann::json& one : results.value("cases", nlohmann::json::array())) {
      if (one["name"] == name) {
        return one;
      }
    }
    return nlohmann::json::object();
  }
};

/// Runs the driver with a fake viewer that follows a plan.
class RunTest : public testing::Test {
 protected:
  TestFolder folder_;
  std::string suite_ = "core";
  std::string precision_ = "highp";

  std::filesystem::path report() const { return folder_.path() / "report"; }

  /// A case of the suite that is run.
  Case named_case(const std::string& name) const {
    for (const Case& one : load_suite(suite_).cases) {
      if (one.name == name) {
        return one;
      }
    }
    throw std::logic_error("no case " + name);
  }

  /// The picture a perfect viewer draws of the case, in the given form of the model.
  std::filesystem::path picture(const std::string& name, const albedo::SheenModel& model) {
    const Case one = named_case(name);
    const scene::Scene scene = scene::load_gltf(write_scene(one, folder_.path() / "cache" / "scenes"));
    golden::Settings settings = golden_settings(one, model, 4);
    settings.bounds = false;
    const std::filesystem::path file = folder_.path() / (name + std::to_string(pictures_++) + ".exr");
    image::write(file, golden::render(scene, settings));
    return file;
  }
  std::filesystem::path picture(const std::string& name) { return picture(name, named_case(name).model); }

  Outcome run_with(const nlohmann::json& hello, const nlohmann::json& answers, const std::string& filter,
                   const std::string& strict = "lenient", const std::vector<std::string>& environment = {}, double limit = 20) {
    const std::filesystem::path plan = folder_.path() / "plan.json";
    std::ofstream(plan)
        << nlohmann::json{{"hello", hello}, {"answers", answers}, {"requests", (folder_.path() / "requests").string()}}.dump();
    std::vector<std::string> command = {"/usr/bin/env"};
    command.insert(command.end(), environment.begin(), environment.end());
    command.insert(command.end(),
                   {SHEEN_CTS_RUN_DRIVER, report().string(), (folder_.path() / "cache").string(), filter, nlohmann::json(limit).dump(),
                    strict, std::string("'") + SHEEN_CTS_FAKE_VIEWER + "' '" + plan.string() + "'", suite_, precision_});
    ChildProcess driver(command);
    std::string text;
    std::string line;
    while (driver.read_line(line, deadline_in(250)) == ChildProcess::ReadStatus::Line) {
      text += line + "\n";
    }
    Outcome outcome;
    outcome.ending = driver.finish(60);
    if (outcome.ending != "exited with status 0" && outcome.ending != "exited with status 1") {
      outcome.ending += ": " + driver.last_words();
    }
    outcome.results = nlohmann::json::parse(text, nullptr, false);
    EXPECT_FALSE(outcome.results.is_discarded()) << "standard output holds results.json and nothing else: " << text;
    return outcome;
  }
  /// The settings that the viewer was asked for, by a piece of the scene's name; an empty object where it was not asked.
  nlohmann::json settings_of(const std::string& piece) const {
    std::ifstream requests(folder_.path() / "requests");
    for (std::string line; std::getline(requests, line);) {
      const nlohmann::json request = nlohmann::json::parse(line);
      if (request.value("scene", "").find(piece) != std::string::npos) {
        return request["settings"];
      }
    }
    return nlohmann::json::object();
  }
  std::string contents(const char* name) const {
    std::ifstream file(report() / name);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
  }

 private:
  int pictures_ = 0;
};

}  // namespace sheen::conformance
