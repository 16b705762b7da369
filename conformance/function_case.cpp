#include "conformance/function_case.h"

#include <stdexcept>

#include "conformance/case.h"
#include "conformance/function_spec.h"
#include "conformance/shading_words.h"

namespace sheen::conformance {
namespace {

using nlohmann::json;

constexpr int largest_side = 512;

ArgumentSet parse_set(const std::string& word) {
  for (const ArgumentSet set : {ArgumentSet::Dense, ArgumentSet::Random, ArgumentSet::Adversarial}) {
    if (word == to_string(set)) {
      return set;
    }
  }
  throw std::invalid_argument("unknown arguments '" + word + "'; known: dense, random, adversarial");
}

std::string word(const json& description, const char* key) {
  if (!description.contains(key) || !description[key].is_string()) {
    throw std::invalid_argument(std::string("needs '") + key + "' (a word)");
  }
  return description[key].get<std::string>();
}

int side(const json& description, std::size_t which) {
  const json size = description.value("size", json::array());
  const bool good =
      size.is_array() && size.size() == 2 && size[which].is_number_integer() && size[which] >= 1 && size[which] <= largest_side;
  if (!good) {
    throw std::invalid_argument("needs 'size', [width, height] of 1 to " + std::to_string(largest_side));
  }
  return size[which].get<int>();
}

}  // namespace

std::string to_string(ArgumentSet set) {
  switch (set) {
    case ArgumentSet::Dense:
      return "dense";
    case ArgumentSet::Random:
      return "random";
    case ArgumentSet::Adversarial:
      return "adversarial";
  }
  throw std::invalid_argument("unknown set of arguments");
}

std::string describe(const FunctionCase& one) {
  return to_string(one.formulation) + " " + to_string(one.precision) + ", " + to_string(one.arguments) + " arguments";
}

FunctionCase make_function_case(SweepPoint point, const std::string& file, const std::string& element) {
  const std::string where = element + " case '" + point.name + "'";
  check_keys(point.description, {"function", "precision", "formulation", "arguments", "size"}, file, where);
  FunctionCase made;
  made.name = std::move(point.name);
  try {
    made.function = word(point.description, "function");
    made.precision = parse_precision(word(point.description, "precision"));
    made.formulation = parse_formulation(word(point.description, "formulation"));
    made.arguments = parse_set(word(point.description, "arguments"));
    made.width = side(point.description, 0);
    made.height = side(point.description, 1);
    if (made.formulation == renderer::Formulation::Literal && !function_spec(made.function, made.precision).has_literal) {
      throw std::invalid_argument("'" + made.function + "' has no literal form");
    }
  } catch (const std::invalid_argument& error) {
    throw SuiteError(file, where, error.what());
  }
  return made;
}

}  // namespace sheen::conformance
