#include "conformance/mutants/mutant.h"

#include <algorithm>
#include <iterator>
#include <stdexcept>

#include "renderer/shader_sources.h"

namespace sheen::conformance {
namespace {

const std::string& built_in(const Mutant& mutant, const std::string& file) {
  const auto found = renderer::shader_sources().find(file);
  if (found == renderer::shader_sources().end()) {
    throw std::logic_error("mutant " + mutant.name + ": there is no shader file " + file);
  }
  return found->second;
}

void apply(const Mutant& mutant, const ShaderEdit& edit, std::string& text) {
  const std::size_t place = text.find(edit.passage);
  if (edit.passage.empty() || place == std::string::npos || text.find(edit.passage, place + 1) != std::string::npos) {
    throw std::logic_error("mutant " + mutant.name + ": this does not stand in " + edit.file + " exactly once: " + edit.passage);
  }
  text.replace(place, edit.passage.size(), edit.instead);
}

}  // namespace

std::vector<Mutant> mutants() {
  std::vector<Mutant> all;
  for (const auto& subject : {sheen_lobe_mutants, sheen_layer_mutants, albedo_table_mutants, albedo_scale_mutants, clearcoat_mutants,
                              base_mutants, output_mutants, normal_mutants, punctual_light_mutants, environment_mutants,
                              texture_channel_mutants, texture_coordinate_mutants, reader_mutants}) {
    std::vector<Mutant> some = subject();
    std::move(some.begin(), some.end(), std::back_inserter(all));
  }
  return all;
}

Mutant find_mutant(const std::string& name) {
  if (name == unmutated) {
    return {.name = name, .why = "the control"};
  }
  for (Mutant& mutant : mutants()) {
    if (mutant.name == name) {
      return mutant;
    }
  }
  throw std::invalid_argument("there is no mutant '" + name + "'");
}

std::map<std::string, std::string> shader_files(const Mutant& mutant) {
  std::map<std::string, std::string> files;
  for (const ShaderSwap& swap : mutant.swaps) {
    built_in(mutant, swap.file);
    std::string& text = files[swap.file];
    for (const std::string& part : swap.made_of) {
      text += built_in(mutant, part);
    }
  }
  for (const ShaderEdit& edit : mutant.edits) {
    apply(mutant, edit, files.try_emplace(edit.file, built_in(mutant, edit.file)).first->second);
  }
  return files;
}

Alteration of_materials(const std::function<void(scene::Material&)>& change) {
  return [change](scene::Scene& scene, renderer::Settings&) { std::for_each(scene.materials.begin(), scene.materials.end(), change); };
}

Alteration of_lights(const std::function<void(scene::Light&)>& change) {
  return [change](scene::Scene& scene, renderer::Settings&) { std::for_each(scene.lights.begin(), scene.lights.end(), change); };
}

}  // namespace sheen::conformance
