#include "conformance/function_spec.h"

#include <algorithm>
#include <map>
#include <stdexcept>

namespace sheen::conformance {
namespace {

const std::vector<FunctionSpec>& specs_of(renderer::Precision precision) {
  static const auto make = [](renderer::Precision which) {
    std::vector<FunctionSpec> all;
    add_operation_specs(which, all);
    add_lobe_specs(which, all);
    add_layer_specs(which, all);
    add_whole_specs(which, all);
    return all;
  };
  static const std::vector<FunctionSpec> highp = make(renderer::Precision::Highp);
  static const std::vector<FunctionSpec> mediump = make(renderer::Precision::Mediump);
  return precision == renderer::Precision::Highp ? highp : mediump;
}

}  // namespace

std::vector<std::string> function_names() {
  std::vector<std::string> names;
  for (const FunctionSpec& spec : specs_of(renderer::Precision::Highp)) {
    names.push_back(spec.name);
  }
  return names;
}

FunctionSpec function_spec(const std::string& name, renderer::Precision precision) {
  const auto& all = specs_of(precision);
  const auto found = std::find_if(all.begin(), all.end(), [&](const FunctionSpec& spec) { return spec.name == name; });
  if (found == all.end()) {
    throw std::invalid_argument("unknown function '" + name + "'");
  }
  return *found;
}

}  // namespace sheen::conformance
