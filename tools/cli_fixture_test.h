#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tools/temporary_folder_test.h"

namespace sheen::tools {

/// What a run of the program left behind.
struct Outcome {
  int exit_code = -1;  ///< -1: it did not exit by itself
  std::string out;
  std::string err;
};

/// What a test scene holds beside its one square, 2 by 2 about the origin, facing +Z.
struct SceneParts {
  bool light = true;  ///< one directional light along -Z, 3 lux
  nlohmann::json material = {{"pbrMetallicRoughness", {{"metallicFactor", 0.0}}}};
};

/// A material with a red sheen.
nlohmann::json sheen_material();

/// Runs the built program as a child, in a folder of its own.
class CommandLine : public testing::Test {
 protected:
  /// Arguments as the program gets them; `input` is its stdin.
  Outcome run(const std::vector<std::string>& arguments, const std::string& input = {}) const;

  /// Writes NAME.gltf and NAME.bin; returns the path of the former.
  std::string write_scene(const std::string& name, const SceneParts& parts = {}) const;

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  bool exists(const std::string& name) const { return std::filesystem::exists(folder_ / name); }
  std::string text(const std::string& name) const;
  /// Names in the folder that start so: what a failed command might have left.
  std::vector<std::string> names_starting_with(const std::string& prefix) const;

 private:
  TemporaryFolder folder_;
};

}  // namespace sheen::tools
