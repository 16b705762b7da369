#pragma once

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "conformance/function_parameters.h"
#include "number/bounded_conversion.h"
#include "renderer/renderer.h"

namespace sheen::conformance {

/// What one channel of a function's result must be.
struct Promise {
  double value = 0;       ///< the function in exact arithmetic on these arguments; NaN where it has none
  number::Range range{};  ///< what the rules of GLSL ES allow; infinite where they promise nothing
  double model = 0;       ///< what it stands for: `value` of the stable form, whatever the form under test

  bool is_bounded() const { return range.upper - range.lower < std::numeric_limits<double>::infinity(); }
};

/// How a function is tried and judged in one precision.
struct FunctionSpec {
  std::string name;  ///< of renderer/functions.h
  NumberFormat format;
  std::vector<Parameter> parameters;
  /// The arguments' numbers, in the order in which the function takes them, from the parameters' values; not yet of the format.
  std::function<std::vector<double>(const std::vector<double>&)> place;
  int channels = 1;
  bool has_literal = false;  ///< whether the specifications print another form of it
  std::function<std::vector<Promise>(const std::vector<double>& arguments, renderer::Formulation formulation)> promise;
  bool is_operation = false;  ///< of GLSL itself: errors are told in ulp
  bool is_finite = false;     ///< what is drawn: the stable form may give no NaN or Inf, even where its value is not promised
};

/// The names of functions that can be judged.
std::vector<std::string> function_names();

/// Throws std::invalid_argument for an unknown function.
FunctionSpec function_spec(const std::string& name, renderer::Precision precision);

/// Parts of the list, by what they are about: operations of GLSL (function_operations.cpp), lobes (function_lobes.cpp), the directional
/// albedo and the base (function_layers.cpp), a point with every layer (function_whole.cpp). Each appends what it knows in the given
/// precision.
void add_operation_specs(renderer::Precision precision, std::vector<FunctionSpec>& all);
void add_lobe_specs(renderer::Precision precision, std::vector<FunctionSpec>& all);
void add_layer_specs(renderer::Precision precision, std::vector<FunctionSpec>& all);
void add_whole_specs(renderer::Precision precision, std::vector<FunctionSpec>& all);

}  // namespace sheen::conformance
