#include "conformance/golden_store.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <unistd.h>

#include "conformance/environments.h"
#include "conformance/glb.h"
#include "image/io.h"

namespace sheen::conformance {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::string cache_name(const std::string& hash, const golden::Settings& settings) {
  std::string text = settings_text(settings);
  std::replace(text.begin(), text.end(), ' ', '-');
  return std::string("v") + golden::formula_version + "-" + hash + "-" + text + "-s" + std::to_string(settings.subpixel_bits) + "-" +
         to_string(settings.precision) + (settings.drawn_directions > 0 ? "-d" + std::to_string(settings.drawn_directions) : "") + ".exr";
}

/// Whether a picture from the cache is what its name says.
bool usable(const image::Image& image, const golden::Settings& settings) {
  const auto has = [&image](const char* name) { return image.channel(name) >= 0; };
  return image.width == settings.view.width && image.height == settings.view.height && has("R") && has("G") && has("B") && has("A") &&
         has("bound.R") && has("bound.G") && has("bound.B") && has("bound.A") && has("excluded");
}

}  // namespace

std::optional<Manifest> read_manifest(const fs::path& dir) {
  const fs::path file = dir / "manifest.json";
  std::ifstream in(file);
  if (!in) {
    return std::nullopt;
  }
  try {
    const json root = json::parse(in);
    Manifest manifest{root.at("formula_version").get<std::string>(), root.at("suite").get<std::string>(), {}};
    for (const auto& [name, entry] : root.at("cases").items()) {
      manifest.cases[name] = {entry.at("file").get<std::string>(), entry.at("scene_hash").get<std::string>(),
                              entry.at("settings").get<std::string>()};
    }
    return manifest;
  } catch (const json::exception& error) {
    throw std::runtime_error(file.string() + ": malformed: " + error.what());
  }
}

void write_manifest(const fs::path& dir, const Manifest& manifest) {
  json cases = json::object();
  for (const auto& [name, entry] : manifest.cases) {
    cases[name] = {{"file", entry.file}, {"scene_hash", entry.scene_hash}, {"settings", entry.settings}};
  }
  const json root = {
      {"formula_version", manifest.formula_version},
      {"suite", manifest.suite},
      {"how_made", "sheen-cts goldens generate: RGBA of the CPU golden, OpenEXR with PXR24; bounds are recomputed in every run"},
      {"cases", cases}};
  write_file(dir / "manifest.json", root.dump(1) + "\n");
}

golden::Settings golden_settings(const Case& one, const albedo::SheenModel& model, int subpixel_bits, int drawn_directions) {
  golden::Settings settings;
  settings.view.width = one.width;
  settings.view.height = one.height;
  settings.view.camera = 0;
  settings.sheen = model;
  settings.subpixel_bits = subpixel_bits;
  settings.precision = one.precision.value_or(golden::Precision::Highp);
  if (!one.environment.empty()) {
    settings.environment = &kept_environment(one.environment);
    settings.sampling.error = golden_error;
    settings.drawn_directions = drawn_directions;
  }
  return settings;
}

std::string settings_text(const golden::Settings& settings) {
  std::string text = std::to_string(settings.view.width) + "x" + std::to_string(settings.view.height) + " camera " +
                     std::to_string(settings.view.camera.value_or(0)) + " " + to_string(settings.sheen.visibility) + " " +
                     to_string(settings.sheen.scaling);
  if (settings.sheen.model != albedo::Model::Ratified) {
    text.append(" ").append(to_string(settings.sheen.model));
  }
  if (settings.environment != nullptr) {
    text.append(" in ").append(scene::content_hash(*settings.environment));
    if (settings.environment->is_image()) {
      text.append(" to ").append(json(settings.sampling.error).dump());
    }
  }
  return text;
}

GoldenStore::GoldenStore(fs::path cache, fs::path committed, std::string suite)
    : cache_(std::move(cache)), committed_(std::move(committed)), suite_(std::move(suite)) {
  if (!committed_.empty()) {
    manifest_ = read_manifest(committed_);
  }
}

image::Image GoldenStore::computed(const scene::Scene& scene, const std::string& hash, const golden::Settings& settings) const {
  const fs::path file = cache_ / cache_name(hash, settings);
  std::error_code error;
  if (fs::is_regular_file(file, error)) {
    try {
      image::Image cached = image::read(file);
      if (usable(cached, settings)) {
        return cached;
      }
    } catch (const image::Error&) {  // a file that cannot be read is computed anew
    }
  }
  image::Image made = golden::render(scene, settings);
  try {
    fs::create_directories(cache_);
    image::write(file, made);
  } catch (const std::exception&) {  // a cache that cannot be written only costs time
  }
  return made;
}

Reference GoldenStore::reference(const Case& one, const scene::Scene& scene, const std::string& hash,
                                 const golden::Settings& settings) const {
  Reference reference{computed(scene, hash, settings), false, ""};
  if (!manifest_ || manifest_->suite != suite_ || manifest_->formula_version != golden::formula_version) {
    return reference;
  }
  const auto found = manifest_->cases.find(one.name);
  if (found == manifest_->cases.end() || found->second.scene_hash != hash || found->second.settings != settings_text(settings)) {
    return reference;
  }
  const image::Image committed = image::read(committed_ / found->second.file);
  const std::string problem = disagreement(committed, reference.image);
  if (!problem.empty()) {
    reference.problem = "the committed golden is not what this program computes (try `goldens verify`): " + problem;
    return reference;
  }
  for (const char* name : {"R", "G", "B", "A"}) {
    const int from = committed.channel(name);
    const int to = reference.image.channel(name);
    for (int y = 0; y < committed.height; ++y) {
      for (int x = 0; x < committed.width; ++x) {
        reference.image.at(x, y, to) = committed.at(x, y, from);
      }
    }
  }
  reference.pxr24 = true;
  return reference;
}

std::string disagreement(const image::Image& committed, const image::Image& computed) {
  if (committed.width != computed.width || committed.height != computed.height) {
    return "its size differs";
  }
  for (const char* name : {"R", "G", "B", "A"}) {
    const int a = committed.channel(name);
    const int b = computed.channel(name);
    if (a < 0 || b < 0) {
      return std::string("it lacks channel ") + name;
    }
    for (int y = 0; y < committed.height; ++y) {
      for (int x = 0; x < committed.width; ++x) {
        const double kept = committed.at(x, y, a);
        const double truth = computed.at(x, y, b);
        // Values under 2^-126 are flushed by some machines; so small a light is nothing.
        const double allowed = std::abs(truth) * (0x1p-16 + 0x1p-23) + 0x1p-126;
        if (!(std::abs(kept - truth) <= allowed)) {
          return std::string("channel ") + name + " at " + std::to_string(x) + ", " + std::to_string(y) + " is " + json(kept).dump() +
                 ", computed " + json(truth).dump();
        }
      }
    }
  }
  return "";
}

}  // namespace sheen::conformance
