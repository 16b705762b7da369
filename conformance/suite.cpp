#include "conformance/suite.h"

#include <algorithm>
#include <set>

#include "conformance/description.h"
#include "conformance/embedded_suites.h"
#include "conformance/run.h"
#include "conformance/sweep.h"

namespace sheen::conformance {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

/// Case names become file names and GoogleTest names.
bool is_case_name(const std::string& name) {
  const auto good = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '.' || c == '_'; };
  return !name.empty() && name.size() < 200 && std::all_of(name.begin(), name.end(), good) && name.front() != '.' && name.back() != '.' &&
         name.find("..") == std::string::npos;
}

/// Whether the glob (? one character, * any run of them) matches the whole text.
bool glob_matches(std::string_view glob, std::string_view text) {
  std::size_t g = 0;
  std::size_t t = 0;
  std::size_t star = std::string_view::npos;
  std::size_t resume = 0;
  while (t < text.size()) {
    if (g < glob.size() && glob[g] == '*') {
      star = g++;
      resume = t;
    } else if (g < glob.size() && (glob[g] == '?' || glob[g] == text[t])) {
      ++g;
      ++t;
    } else if (star != std::string_view::npos) {
      g = star + 1;
      t = ++resume;
    } else {
      return false;
    }
  }
  return std::all_of(glob.begin() + static_cast<std::ptrdiff_t>(g), glob.end(), [](char c) { return c == '*'; });
}

bool any_matches(std::string_view patterns, const std::string& suite, const std::string& name) {
  while (!patterns.empty()) {
    const std::size_t end = std::min(patterns.find(':'), patterns.size());
    const std::string_view pattern = patterns.substr(0, end);
    if (glob_matches(pattern, name) || glob_matches(pattern, suite + "." + name)) {
      return true;
    }
    patterns.remove_prefix(std::min(end + 1, patterns.size()));
  }
  return false;
}

/// The JSON of a file with groups and nothing but the known members.
ordered_json parse_file(std::string_view text, const std::string& file, const std::vector<std::string>& known) {
  ordered_json root;
  try {
    root = ordered_json::parse(text);
  } catch (const json::exception& error) {
    throw SuiteError(file, "the file", std::string("is not JSON: ") + error.what());
  }
  check_keys(json(root), known, file, "the file");
  if (!root.contains("groups")) {
    throw SuiteError(file, "the file", "needs 'groups'");
  }
  if (!root["groups"].is_array()) {
    throw SuiteError(file, "groups", "must be an array");
  }
  return root;
}

void add_groups(const ordered_json& groups, const json& defaults, const std::string& file, std::set<std::string>& names, Suite& suite) {
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const std::string element = "groups[" + std::to_string(g) + "]";
    for (SweepPoint& point : expand_group(groups[g], defaults, file, element)) {
      if (!names.insert(point.name).second) {
        throw SuiteError(file, element, "two cases are named '" + point.name + "'");
      }
      if (point.description.contains("function")) {
        suite.functions.push_back(make_function_case(std::move(point), file, element));
      } else if (point.description.contains("relation")) {
        suite.relations.push_back(make_relation(std::move(point), file, element));
      } else {
        suite.cases.push_back(make_case(std::move(point), file, element));
      }
    }
  }
}

/// What `list` shows of a case, of the first scene of a relation, of a function.
CaseInfo info_of(const Suite& suite, std::size_t index) {
  const Relation* relation = suite.relation_at(index);
  if (const FunctionCase* function = suite.function_at(index)) {
    return {function->name, "", "", function->width, function->height, describe(*function)};
  }
  const Case& one = relation == nullptr ? suite.cases[index] : relation->scenes.front();
  return {suite.name_of(index),
          to_string(one.model.visibility),
          to_string(one.model.scaling),
          one.width,
          one.height,
          relation == nullptr ? one.law : relation->law};
}

}  // namespace

Case make_case(SweepPoint point, const std::string& file, const std::string& element) {
  if (!is_case_name(point.name)) {
    throw SuiteError(file, element, "case name '" + point.name + "' may hold only a-z, 0-9, _ and single dots inside");
  }
  check_description(point.description, file, element + " case '" + point.name + "'");
  Case made;
  made.name = std::move(point.name);
  const json model = point.description.value("model", json::object());
  made.model.visibility = parse_visibility(model.value("visibility", "charlie"));
  made.model.scaling = parse_albedo_scaling(model.value("albedo_scaling", "full"));
  made.width = point.description["size"][0].get<int>();
  made.height = point.description["size"][1].get<int>();
  made.environment = point.description.value("environment", "");
  made.law = point.description.value("law", "");
  made.refused = point.description.value("refused", false);
  if (point.description.contains("precision")) {
    made.precision = parse_golden_precision(point.description["precision"].get<std::string>());
  }
  made.description = std::move(point.description);
  return made;
}

Suite parse_suite(std::string_view text, const std::string& file, const std::vector<SuitePart>& parts) {
  const ordered_json root = parse_file(text, file, {"suite", "description", "defaults", "groups"});
  if (!root.contains("suite")) {
    throw SuiteError(file, "the file", "needs 'suite'");
  }
  if (!root["suite"].is_string() || !is_case_name(root["suite"].get<std::string>())) {
    throw SuiteError(file, "suite", "must be a name");
  }
  Suite suite;
  suite.name = root["suite"].get<std::string>();
  if (root.contains("description") && root["description"].is_string()) {
    suite.description = root["description"].get<std::string>();
  }
  const json defaults = root.contains("defaults") ? json(root["defaults"]) : json::object();
  if (!defaults.is_object()) {
    throw SuiteError(file, "defaults", "must be an object");
  }
  std::set<std::string> names;
  add_groups(root["groups"], defaults, file, names, suite);
  for (const SuitePart& part : parts) {
    add_groups(parse_file(part.text, part.file, {"groups"})["groups"], defaults, part.file, names, suite);
  }
  return suite;
}

Suite load_suite(const std::string& name) {
  std::vector<SuitePart> files;
  for (const EmbeddedSuite& suite : embedded_suites()) {
    if (suite.name == name) {
      files.push_back({suite.text, "suites/" + std::string(suite.file)});
    }
  }
  if (!files.empty()) {
    return parse_suite(files.front().text, files.front().file, {files.begin() + 1, files.end()});
  }
  std::string known;
  for (const std::string& suite : suite_names()) {
    known += (known.empty() ? "" : ", ") + suite;
  }
  throw std::invalid_argument("unknown suite '" + name + "'; known: " + known);
}

bool matches_filter(const std::string& filter, const std::string& suite, const std::string& case_name) {
  const std::size_t dash = filter.find('-');
  const std::string positive = filter.substr(0, dash);
  const std::string negative = dash == std::string::npos ? "" : filter.substr(dash + 1);
  return any_matches(positive.empty() ? "*" : positive, suite, case_name) && !any_matches(negative, suite, case_name);
}

std::vector<std::string> suite_names() {
  std::vector<std::string> names;
  for (const EmbeddedSuite& suite : embedded_suites()) {
    if (names.empty() || names.back() != suite.name) {
      names.emplace_back(suite.name);
    }
  }
  return names;
}

std::vector<CaseInfo> list(const std::string& suite_name, const std::string& filter) {
  const Suite suite = load_suite(suite_name);
  std::vector<CaseInfo> cases;
  for (std::size_t i = 0; i < suite.size(); ++i) {
    if (matches_filter(filter, suite.name, suite.name_of(i))) {
      cases.push_back(info_of(suite, i));
    }
  }
  return cases;
}

}  // namespace sheen::conformance
