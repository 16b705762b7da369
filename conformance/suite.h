#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "conformance/case.h"
#include "conformance/relation.h"
#include "conformance/sweep.h"

namespace sheen::conformance {

/// Cases, each judged by its golden, and relations, each judged by its law, expanded from one file of declared sweeps
/// (conformance/suites/README.md has the language).
struct Suite {
  std::string name;
  std::string description;
  std::vector<Case> cases;
  std::vector<Relation> relations;

  /// Everything that is judged: the cases, then the relations.
  std::size_t size() const { return cases.size() + relations.size(); }
  /// Name of the case or relation of that index.
  const std::string& name_of(std::size_t index) const {
    return index < cases.size() ? cases[index].name : relations[index - cases.size()].name;
  }
};

/// Makes a case of a sweep's point. Throws SuiteError.
Case make_case(SweepPoint point, const std::string& file, const std::string& element);

/// The suite of that name that this program carries. Throws std::invalid_argument, naming those there are, when it has none of that name.
Suite load_suite(const std::string& name);

/// A file that adds groups to a suite.
struct SuitePart {
  std::string_view text;
  std::string file;  ///< for messages
};

/// Expands the text of a suite file and of those that add to it; `file` is for messages. Throws SuiteError, naming file and element, for
/// anything unknown, missing or out of place, and for two cases or relations of one name.
Suite parse_suite(std::string_view text, const std::string& file, const std::vector<SuitePart>& parts = {});

/// Whether a case is let through: GoogleTest's filter syntax (globs of * and ?, separated by ':', those after the first '-' excluded); a
/// pattern is tried on "CASE" and on "SUITE.CASE".
bool matches_filter(const std::string& filter, const std::string& suite, const std::string& case_name);

}  // namespace sheen::conformance
