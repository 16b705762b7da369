#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "conformance/case.h"
#include "conformance/function_case.h"
#include "conformance/relation.h"
#include "conformance/sweep.h"

namespace sheen::conformance {

/// Cases, each judged by its golden, relations, each judged by its law, and functions, each judged by what is promised of it, expanded from
/// one file of declared sweeps (conformance/suites/README.md has the language).
struct Suite {
  std::string name;
  std::string description;
  std::vector<Case> cases;
  std::vector<Relation> relations;
  std::vector<FunctionCase> functions;

  /// Everything that is judged: the cases, then the relations, then the functions.
  std::size_t size() const { return cases.size() + relations.size() + functions.size(); }
  /// That of an index, or null where the index is another kind's.
  const Case* case_at(std::size_t index) const { return index < cases.size() ? &cases[index] : nullptr; }
  const Relation* relation_at(std::size_t index) const {
    return index >= cases.size() && index - cases.size() < relations.size() ? &relations[index - cases.size()] : nullptr;
  }
  const FunctionCase* function_at(std::size_t index) const {
    const std::size_t others = cases.size() + relations.size();
    return index >= others ? &functions.at(index - others) : nullptr;
  }
  /// Name of what has that index.
  const std::string& name_of(std::size_t index) const {
    const Relation* relation = relation_at(index);
    return case_at(index) != nullptr ? cases[index].name : relation != nullptr ? relation->name : function_at(index)->name;
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
