#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "conformance/case.h"

namespace sheen::conformance {

/// A named list of cases, expanded from one file of declared sweeps (conformance/suites/README.md has the language).
struct Suite {
  std::string name;
  std::string description;
  std::vector<Case> cases;
};

/// The suite of that name that this program carries. Throws std::invalid_argument, naming those there are, when it has none of that name.
Suite load_suite(const std::string& name);

/// Expands the text of a suite file; `file` is for messages. Throws SuiteError, naming file and element, for anything unknown, missing or
/// out of place, and for two cases of one name.
Suite parse_suite(std::string_view text, const std::string& file);

/// Whether a case is let through: GoogleTest's filter syntax (globs of * and ?, separated by ':', those after the first '-' excluded); a
/// pattern is tried on "CASE" and on "SUITE.CASE".
bool matches_filter(const std::string& filter, const std::string& suite, const std::string& case_name);

}  // namespace sheen::conformance
