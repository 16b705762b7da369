#include "conformance/sweep.h"

#include <algorithm>
#include <cstddef>

#include "conformance/case.h"

namespace sheen::conformance {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

struct Choice {
  std::string label;
  json patch;
};

struct Axis {
  std::string name;
  std::vector<Choice> choices;
};

std::vector<Axis> read_axes(const ordered_json& axes, const std::string& file, const std::string& element) {
  if (!axes.is_object()) {
    throw SuiteError(file, element + ".axes", "must be an object of arrays");
  }
  std::vector<Axis> result;
  for (const auto& [name, choices] : axes.items()) {
    const std::string where = element + ".axes." + name;
    if (!choices.is_array() || choices.empty()) {
      throw SuiteError(file, where, "must be an array of at least one {label, patch}");
    }
    Axis axis{name, {}};
    for (const auto& choice : choices) {
      check_keys(json(choice), {"label", "patch"}, file, where);
      if (!choice.contains("label") || !choice["label"].is_string() || !choice.contains("patch") || !choice["patch"].is_object()) {
        throw SuiteError(file, where, "each choice needs a label (string) and a patch (object)");
      }
      axis.choices.push_back({choice["label"].get<std::string>(), json(choice["patch"])});
    }
    result.push_back(std::move(axis));
  }
  return result;
}

/// Indices into each axis, the last axis running fastest.
std::vector<std::vector<std::size_t>> combinations(const std::vector<Axis>& axes, const std::string& combine, const std::string& file,
                                                   const std::string& element) {
  std::vector<std::vector<std::size_t>> result;
  if (combine == "zip") {
    const std::size_t count = axes.empty() ? 1 : axes.front().choices.size();
    for (const Axis& axis : axes) {
      if (axis.choices.size() != count) {
        throw SuiteError(file, element + ".axes." + axis.name, "zipped axes must be equally long");
      }
    }
    for (std::size_t i = 0; i < count; ++i) {
      result.emplace_back(axes.size(), i);
    }
    return result;
  }
  result.emplace_back();
  for (const Axis& axis : axes) {
    std::vector<std::vector<std::size_t>> longer;
    for (const auto& prefix : result) {
      for (std::size_t i = 0; i < axis.choices.size(); ++i) {
        longer.push_back(prefix);
        longer.back().push_back(i);
      }
    }
    result = std::move(longer);
  }
  return result;
}

/// The pattern with "{axis}" replaced; counts on every axis being named, so that no two points share a name by accident.
std::string fill_name(std::string name, const std::vector<Axis>& axes, const std::vector<std::size_t>& point, const std::string& file,
                      const std::string& element) {
  for (std::size_t a = 0; a < axes.size(); ++a) {
    const std::string hole = "{" + axes[a].name + "}";
    const std::size_t at = name.find(hole);
    if (at == std::string::npos) {
      throw SuiteError(file, element + ".name", "does not mention the axis " + hole);
    }
    name.replace(at, hole.size(), axes[a].choices[point[a]].label);
  }
  if (name.find('{') != std::string::npos) {
    throw SuiteError(file, element + ".name", "has a hole that no axis fills: " + name);
  }
  return name;
}

}  // namespace

void check_keys(const json& object, const std::vector<std::string>& known, const std::string& file, const std::string& element) {
  if (!object.is_object()) {
    throw SuiteError(file, element, "must be an object");
  }
  for (const auto& [key, value] : object.items()) {
    if (std::find(known.begin(), known.end(), key) == known.end()) {
      throw SuiteError(file, element, "unknown key '" + key + "'");
    }
  }
}

std::vector<SweepPoint> expand_group(const ordered_json& group, const json& defaults, const std::string& file, const std::string& element) {
  check_keys(json(group), {"name", "about", "base", "axes", "combine"}, file, element);
  if (!group.contains("name") || !group["name"].is_string()) {
    throw SuiteError(file, element, "needs a name (string)");
  }
  const std::string pattern = group["name"].get<std::string>();
  const std::string combine = group.contains("combine") && group["combine"].is_string() ? group["combine"].get<std::string>()
                              : group.contains("combine")                               ? "?"
                                                                                        : "cross";
  if (combine != "cross" && combine != "zip") {
    throw SuiteError(file, element + ".combine", "must be \"cross\" or \"zip\"");
  }
  const std::string where = element + " '" + pattern + "'";
  const std::vector<Axis> axes = group.contains("axes") ? read_axes(group["axes"], file, where) : std::vector<Axis>{};
  json start = defaults;
  if (group.contains("base")) {
    if (!group["base"].is_object()) {
      throw SuiteError(file, where + ".base", "must be an object");
    }
    start.merge_patch(json(group["base"]));
  }
  std::vector<SweepPoint> result;
  for (const auto& point : combinations(axes, combine, file, where)) {
    SweepPoint made{fill_name(pattern, axes, point, file, where), start};
    for (std::size_t a = 0; a < axes.size(); ++a) {
      made.description.merge_patch(axes[a].choices[point[a]].patch);
    }
    result.push_back(std::move(made));
  }
  return result;
}

}  // namespace sheen::conformance
