#pragma once

#include <optional>
#include <stdexcept>
#include <string>

#include <nlohmann/json.hpp>

#include "albedo/sheen_model.h"
#include "golden/golden.h"

namespace sheen::conformance {

/// What is wrong with a suite file: the file, the element in it ("groups[3] 'clearcoat.{coat}'") and the rule it breaks.
class SuiteError : public std::runtime_error {
 public:
  SuiteError(const std::string& file, const std::string& element, const std::string& rule)
      : std::runtime_error(file + ": " + element + ": " + rule) {}
};

/// One picture to draw and judge.
struct Case {
  std::string name;  ///< dotted, reads as a sentence: "sheen.crimson.roughness_0.3.on_metal"
  /// What the scene is: shape, material, lights, camera, node, vertex_colors (conformance/suites/README.md). Already checked.
  nlohmann::json description;
  albedo::SheenModel model;  ///< the form of the model that is asked for
  int width = 128;
  int height = 128;
  std::string environment;                     ///< what lights it from everywhere, a name of environments.h; empty: nothing
  std::optional<golden::Precision> precision;  ///< of the lobes' arithmetic, asked for and judged by; none: what the run says
  bool refused = false;                        ///< whether the scene breaks a rule, so that it must not be drawn
  std::string law;                             ///< what the case holds a viewer to, in a sentence, with its source; may be empty
};

/// The words of the command line: "charlie", "ashikhmin", "refined".
std::string to_string(albedo::Visibility visibility);
/// "highp", "mediump".
std::string to_string(golden::Precision precision);
/// "full", "view", "none", "literal".
std::string to_string(albedo::AlbedoScaling scaling);
/// "ratified", "draft-2019", "physical".
std::string to_string(albedo::Model model);
/// The reverse; throw std::invalid_argument for an unknown word.
albedo::Visibility parse_visibility(const std::string& word);
albedo::AlbedoScaling parse_albedo_scaling(const std::string& word);
albedo::Model parse_model(const std::string& word);
golden::Precision parse_golden_precision(const std::string& word);

}  // namespace sheen::conformance
