#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "renderer/renderer.h"
#include "scene/scene.h"

namespace sheen::conformance {

/// A file of shaders/ with a passage that stands in it exactly once replaced by another.
struct ShaderEdit {
  std::string file;
  std::string passage;
  std::string instead;
};

/// A file of shaders/ that stands in for another, or several, one after the other.
struct ShaderSwap {
  std::string file;
  std::vector<std::string> made_of;
};

/// Cases of a suite: its name and a filter over their names (RunOptions::filter).
struct CaseFilter {
  std::string suite;
  std::string filter;
};

/// What a viewer makes of the scene it has read and the settings it was asked for.
using Alteration = std::function<void(scene::Scene&, renderer::Settings&)>;

/// Our own viewer with one mistake that viewers make: in its shaders, or in what it makes of the scene it read and the settings it was
/// asked for. Every mutant must fail a case of some suite.
struct Mutant {
  std::string name;  ///< dotted: "sheen.alpha_g_is_the_roughness"
  std::string why;   ///< who makes the mistake, or why it is made
  /// Where a killer is looked for first: it saves time, and decides nothing. Then come the suites as they are.
  std::vector<CaseFilter> first{};
  std::vector<ShaderEdit> edits{};
  std::vector<ShaderSwap> swaps{};
  Alteration alter{};
};

/// All of them, by subject.
std::vector<Mutant> mutants();

/// Name of the control, a mutant without any mistake.
inline constexpr const char* unmutated = "none";

/// The mutant of that name, or the control. Throws std::invalid_argument when there is none.
Mutant find_mutant(const std::string& name);

/// The files of shaders/ that the mutant changes, as it has them. Throws std::logic_error, naming mutant, file and passage, where a passage
/// does not stand in its file exactly once: no mutant becomes the truth unseen.
std::map<std::string, std::string> shader_files(const Mutant& mutant);

/// Alterations of each material, and of each light, of a scene.
Alteration of_materials(const std::function<void(scene::Material&)>& change);
Alteration of_lights(const std::function<void(scene::Light&)>& change);

/// The subjects that mutants() adds up.
std::vector<Mutant> sheen_lobe_mutants();    ///< distribution and visibility
std::vector<Mutant> sheen_layer_mutants();   ///< where the layer stands among the others
std::vector<Mutant> albedo_table_mutants();  ///< tables of E, made or read
std::vector<Mutant> albedo_scale_mutants();  ///< what the sheen leaves of the base
std::vector<Mutant> clearcoat_mutants();
std::vector<Mutant> base_mutants();
std::vector<Mutant> output_mutants();  ///< emission, alpha, what is written out
std::vector<Mutant> normal_mutants();  ///< normals, tangents, sides
std::vector<Mutant> punctual_light_mutants();
std::vector<Mutant> environment_mutants();
std::vector<Mutant> texture_channel_mutants();     ///< which channel holds what, and how
std::vector<Mutant> texture_coordinate_mutants();  ///< where a texture is read
std::vector<Mutant> reader_mutants();              ///< what a file says and what it leaves out

}  // namespace sheen::conformance
