#pragma once

#include <string>

#include "renderer/renderer.h"

namespace sheen::conformance {

/// "highp", "mediump"; "stable", "literal".
std::string to_string(renderer::Precision precision);
std::string to_string(renderer::Formulation formulation);
/// The reverse; throw std::invalid_argument for an unknown word.
renderer::Precision parse_precision(const std::string& word);
renderer::Formulation parse_formulation(const std::string& word);

}  // namespace sheen::conformance
