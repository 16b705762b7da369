#include "conformance/case.h"

#include <array>
#include <utility>

namespace sheen::conformance {
namespace {

using albedo::AlbedoScaling;
using albedo::Model;
using albedo::Visibility;

constexpr std::array<std::pair<Visibility, const char*>, 3> visibilities = {
    {{Visibility::Charlie, "charlie"}, {Visibility::Ashikhmin, "ashikhmin"}, {Visibility::Refined, "refined"}}};
constexpr std::array<std::pair<AlbedoScaling, const char*>, 4> scalings = {
    {{AlbedoScaling::Full, "full"}, {AlbedoScaling::View, "view"}, {AlbedoScaling::None, "none"}, {AlbedoScaling::Literal, "literal"}}};
constexpr std::array<std::pair<Model, const char*>, 3> models = {
    {{Model::Ratified, "ratified"}, {Model::Draft2019, "draft-2019"}, {Model::Physical, "physical"}}};

constexpr std::array<std::pair<golden::Precision, const char*>, 2> precisions = {
    {{golden::Precision::Highp, "highp"}, {golden::Precision::Mediump, "mediump"}}};

template <class Table, class Value>
std::string word_of(const Table& table, Value value) {
  for (const auto& [candidate, word] : table) {
    if (candidate == value) {
      return word;
    }
  }
  throw std::logic_error("a value without a word");
}

template <class Table>
auto value_of(const Table& table, const std::string& word, const char* what) {
  std::string known;
  for (const auto& [candidate, name] : table) {
    if (word == name) {
      return candidate;
    }
    known += known.empty() ? name : std::string(", ") + name;
  }
  throw std::invalid_argument(std::string("unknown ") + what + " '" + word + "'; known: " + known);
}

}  // namespace

std::string to_string(Visibility visibility) {
  return word_of(visibilities, visibility);
}
std::string to_string(golden::Precision precision) {
  return word_of(precisions, precision);
}
std::string to_string(AlbedoScaling scaling) {
  return word_of(scalings, scaling);
}
std::string to_string(Model model) {
  return word_of(models, model);
}
Visibility parse_visibility(const std::string& word) {
  return value_of(visibilities, word, "visibility");
}
AlbedoScaling parse_albedo_scaling(const std::string& word) {
  return value_of(scalings, word, "albedo scaling");
}
golden::Precision parse_golden_precision(const std::string& word) {
  return value_of(precisions, word, "precision");
}
Model parse_model(const std::string& word) {
  return value_of(models, word, "model");
}

}  // namespace sheen::conformance
