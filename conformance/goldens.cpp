#include "conformance/goldens.h"

#include <algorithm>
#include <mutex>
#include <set>
#include <stdexcept>
#include <system_error>

#include <tbb/parallel_for.h>

#include "conformance/case_scene.h"
#include "conformance/golden_store.h"
#include "conformance/suite.h"
#include "image/io.h"
#include "scene/gltf.h"

namespace sheen::conformance {
namespace {

namespace fs = std::filesystem;

/// A golden of the suite as it is now.
struct Computed {
  std::string name;
  Manifest::Entry entry;
  image::Image rgba;
};

image::Image only_rgba(const image::Image& golden) {
  image::Image kept(golden.width, golden.height, {"R", "G", "B", "A"});
  for (int c = 0; c < 4; ++c) {
    const int from = golden.channel(kept.channels[static_cast<std::size_t>(c)]);
    for (int y = 0; y < golden.height; ++y) {
      for (int x = 0; x < golden.width; ++x) {
        kept.at(x, y, c) = golden.at(x, y, from);
      }
    }
  }
  return kept;
}

Computed compute(const Case& one, const std::string& suite, const fs::path& scenes) {
  const scene::Scene scene = scene::load_gltf(write_scene(one, scenes));
  golden::Settings settings = golden_settings(one, one.model, 8);
  settings.bounds = false;
  Computed computed{one.name, {suite + "/" + one.name + ".exr", scene::content_hash(scene), settings_text(settings)}, {}};
  computed.rgba = only_rgba(golden::render(scene, settings));
  return computed;
}

struct Plan {
  const Suite& suite;
  fs::path dir;
  fs::path scenes;
};

Plan make_plan(const Suite& suite, const GoldensOptions& options) {
  if (suite.cases.empty()) {
    throw std::invalid_argument("suite " + suite.name + " has no goldens: it holds relations between pictures");
  }
  Plan plan{suite, options.dir.empty() ? find_goldens() : options.dir, {}};
  if (plan.dir.empty()) {
    throw std::invalid_argument("no folder of committed goldens; name one");
  }
  plan.scenes = (options.cache.empty() ? default_cache() : options.cache) / "scenes";
  return plan;
}

/// Computes every case, several at once, and hands each to `use`, one at a time.
template <class Use>
void for_each_golden(const Plan& plan, const GoldensOptions& options, const Use& use) {
  std::mutex mutex;
  std::size_t done = 0;
  tbb::parallel_for(std::size_t{0}, plan.suite.cases.size(), [&](std::size_t i) {
    Computed computed = compute(plan.suite.cases[i], plan.suite.name, plan.scenes);
    const std::lock_guard lock(mutex);
    use(computed);
    ++done;
    if (options.progress) {
      options.progress(done, plan.suite.cases.size());
    }
  });
}

/// Every .exr under DIR/SUITE, relative to DIR.
std::set<std::string> files_in(const Plan& plan) {
  std::set<std::string> files;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(plan.dir / plan.suite.name, error)) {
    if (entry.path().extension() == ".exr") {
      files.insert(plan.suite.name + "/" + entry.path().filename().string());
    }
  }
  return files;
}

std::uintmax_t size_of(const Plan& plan) {
  std::error_code error;
  std::uintmax_t bytes = fs::file_size(plan.dir / "manifest.json", error);
  if (error) {
    bytes = 0;
  }
  for (const std::string& file : files_in(plan)) {
    bytes += fs::file_size(plan.dir / file);
  }
  return bytes;
}

/// What is wrong with one committed golden; empty when nothing is.
std::string check(const Plan& plan, const Manifest& manifest, const Computed& computed) {
  const auto found = manifest.cases.find(computed.name);
  if (found == manifest.cases.end()) {
    return "not in the manifest";
  }
  if (found->second.settings != computed.entry.settings) {
    return "made with other settings: " + found->second.settings;
  }
  if (found->second.scene_hash != computed.entry.scene_hash) {
    return "made of another scene";
  }
  if (found->second.file != computed.entry.file) {
    return "has another file name: " + found->second.file;
  }
  try {
    return disagreement(image::read(plan.dir / found->second.file), computed.rgba);
  } catch (const image::Error& error) {
    return error.what();
  }
}

}  // namespace

GoldensReport generate_goldens(const GoldensOptions& options) {
  return generate_goldens(load_suite(options.suite), options);
}

GoldensReport verify_goldens(const GoldensOptions& options) {
  return verify_goldens(load_suite(options.suite), options);
}

GoldensReport generate_goldens(const Suite& suite, const GoldensOptions& options) {
  const Plan plan = make_plan(suite, options);
  fs::create_directories(plan.dir / plan.suite.name);
  Manifest manifest{golden::formula_version, plan.suite.name, {}};
  for_each_golden(plan, options, [&](const Computed& computed) {
    image::write(plan.dir / computed.entry.file, computed.rgba, image::ExrCompression::Pxr24);
    manifest.cases[computed.name] = computed.entry;
  });
  for (const std::string& file : files_in(plan)) {
    const std::string name = fs::path(file).stem().string();
    if (!manifest.cases.contains(name)) {
      fs::remove(plan.dir / file);
    }
  }
  write_manifest(plan.dir, manifest);
  return {plan.dir, plan.suite.cases.size(), size_of(plan), {}};
}

GoldensReport verify_goldens(const Suite& suite, const GoldensOptions& options) {
  const Plan plan = make_plan(suite, options);
  GoldensReport report{plan.dir, plan.suite.cases.size(), size_of(plan), {}};
  const std::optional<Manifest> manifest = read_manifest(plan.dir);
  if (!manifest) {
    report.problems.push_back("there is no manifest.json");
    return report;
  }
  if (manifest->suite != plan.suite.name) {
    report.problems.push_back("the manifest is of suite '" + manifest->suite + "'");
  }
  if (manifest->formula_version != golden::formula_version) {
    report.problems.push_back("the manifest is of formula version '" + manifest->formula_version + "', this program's is '" +
                              golden::formula_version + "'");
  }
  std::set<std::string> known;
  for_each_golden(plan, options, [&](const Computed& computed) {
    known.insert(computed.entry.file);
    const std::string problem = check(plan, *manifest, computed);
    if (!problem.empty()) {
      report.problems.push_back(computed.name + ": " + problem);
    }
  });
  for (const auto& [name, entry] : manifest->cases) {
    if (!known.contains(entry.file)) {
      report.problems.push_back(name + ": the suite has no such case");
    }
  }
  for (const std::string& file : files_in(plan)) {
    if (!known.contains(file)) {
      report.problems.push_back(file + ": no case of the suite has this file");
    }
  }
  std::sort(report.problems.begin(), report.problems.end());
  return report;
}

}  // namespace sheen::conformance
