#include "conformance/shading_words.h"

#include <stdexcept>

namespace sheen::conformance {

using renderer::Formulation;
using renderer::Precision;

std::string to_string(Precision precision) {
  return precision == Precision::Highp ? "highp" : "mediump";
}

std::string to_string(Formulation formulation) {
  return formulation == Formulation::Stable ? "stable" : "literal";
}

Precision parse_precision(const std::string& word) {
  for (const Precision precision : {Precision::Highp, Precision::Mediump}) {
    if (word == to_string(precision)) {
      return precision;
    }
  }
  throw std::invalid_argument("unknown precision '" + word + "'; known: highp, mediump");
}

Formulation parse_formulation(const std::string& word) {
  for (const Formulation formulation : {Formulation::Literal, Formulation::Stable}) {
    if (word == to_string(formulation)) {
      return formulation;
    }
  }
  throw std::invalid_argument("unknown formulation '" + word + "'; known: literal, stable");
}

}  // namespace sheen::conformance
