#include "tools/cli_fixture_test.h"

#include <array>
#include <cerrno>
#include <cstdint>
#include <fstream>
#include <iterator>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace sheen::tools {
namespace {

std::string contents(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

template <class Number, std::size_t N>
void put(std::ofstream& out, const std::array<Number, N>& numbers) {
  out.write(reinterpret_cast<const char*>(numbers.data()), static_cast<std::streamsize>(sizeof numbers));
}

}  // namespace

nlohmann::json sheen_material() {
  return {{"pbrMetallicRoughness", {{"metallicFactor", 0.0}}},
          {"extensions", {{"KHR_materials_sheen", {{"sheenColorFactor", {1.0, 0.2, 0.1}}, {"sheenRoughnessFactor", 0.5}}}}}};
}

Outcome CommandLine::run(const std::vector<std::string>& arguments, const std::string& input) const {
  const std::string in = path(".stdin");
  const std::string out = path(".stdout");
  const std::string err = path(".stderr");
  std::ofstream(in) << input;
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, in.c_str(), O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  std::vector<std::string> words{SHEEN_CTS_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  argv.reserve(words.size() + 1);
  for (std::string& word : words) {
    argv.push_back(word.data());
  }
  argv.push_back(nullptr);
  Outcome outcome;
  pid_t child = 0;
  const int started = posix_spawn(&child, argv[0], &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (started != 0) {
    ADD_FAILURE() << "could not start " << words[0];
    return outcome;
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status)) {
    outcome.exit_code = WEXITSTATUS(status);
  }
  outcome.out = contents(out);
  outcome.err = contents(err);
  return outcome;
}

std::string CommandLine::write_scene(const std::string& name, const SceneParts& parts) const {
  std::ofstream bin(path(name + ".bin"), std::ios::binary);
  put(bin, std::array<float, 12>{-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0});
  put(bin, std::array<std::uint16_t, 6>{0, 1, 2, 0, 2, 3});
  nlohmann::json nodes = {{{"mesh", 0}}, {{"camera", 0}, {"translation", {0.0, 0.0, 3.0}}}};
  nlohmann::json gltf = {
      {"asset", {{"version", "2.0"}}},
      {"buffers", {{{"uri", name + ".bin"}, {"byteLength", 60}}}},
      {"bufferViews", {{{"buffer", 0}, {"byteOffset", 0}, {"byteLength", 48}}, {{"buffer", 0}, {"byteOffset", 48}, {"byteLength", 12}}}},
      {"accessors",
       {{{"bufferView", 0}, {"componentType", 5126}, {"count", 4}, {"type", "VEC3"}, {"min", {-1, -1, 0}}, {"max", {1, 1, 0}}},
        {{"bufferView", 1}, {"componentType", 5123}, {"count", 6}, {"type", "SCALAR"}}}},
      {"materials", nlohmann::json::array({parts.material})},
      {"meshes", {{{"primitives", {{{"attributes", {{"POSITION", 0}}}, {"indices", 1}, {"material", 0}}}}}}},
      {"cameras", {{{"type", "perspective"}, {"perspective", {{"yfov", 0.6}, {"znear", 0.1}, {"zfar", 10.0}}}}}},
      {"scene", 0}};
  std::vector<std::string> extensions;
  if (parts.material.contains("extensions")) {
    for (const auto& [extension, value] : parts.material["extensions"].items()) {
      extensions.push_back(extension);
    }
  }
  if (parts.light) {
    nodes.push_back({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    gltf["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "directional"}, {"intensity", 3.0}}};
    extensions.emplace_back("KHR_lights_punctual");
  }
  if (!extensions.empty()) {
    gltf["extensionsUsed"] = extensions;
  }
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    indices.push_back(i);
  }
  gltf["nodes"] = nodes;
  gltf["scenes"] = nlohmann::json::array({{{"nodes", indices}}});
  std::ofstream(path(name + ".gltf")) << gltf.dump(2);
  return path(name + ".gltf");
}

std::string CommandLine::text(const std::string& name) const {
  return contents(folder_ / name);
}

std::vector<std::string> CommandLine::names_starting_with(const std::string& prefix) const {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with(prefix)) {
      names.push_back(name);
    }
  }
  return names;
}

}  // namespace sheen::tools
