#pragma once

#include <string>

#include "conformance/function_parameters.h"
#include "conformance/sweep.h"
#include "renderer/renderer.h"

namespace sheen::conformance {

/// One function of shaders/, in one form and precision, over one set of arguments.
struct FunctionCase {
  std::string name;
  std::string function;
  renderer::Precision precision = renderer::Precision::Highp;
  renderer::Formulation formulation = renderer::Formulation::Stable;
  ArgumentSet arguments = ArgumentSet::Dense;
  int width = 64;
  int height = 64;
};

/// "dense", "random", "adversarial".
std::string to_string(ArgumentSet set);

/// "stable mediump, random arguments".
std::string describe(const FunctionCase& one);

/// Makes a case of a sweep's point with a member `function`. Throws SuiteError for unknown or missing members, unknown words, and a
/// literal form of what the specifications print one form of.
FunctionCase make_function_case(SweepPoint point, const std::string& file, const std::string& element);

}  // namespace sheen::conformance
