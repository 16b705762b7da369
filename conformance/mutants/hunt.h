#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "conformance/mutants/mutant.h"

namespace sheen::conformance {

/// The programs of a hunt, and where it works.
struct Hunt {
  std::string driver;            ///< sheen-cts-run-driver: one run of a suite, in a process of its own
  std::string viewer;            ///< sheen-cts-mutant-viewer
  std::filesystem::path folder;  ///< reports, and the cache of scenes and goldens that all mutants share
};

/// A case that a viewer failed.
struct Kill {
  std::string suite;
  std::string name;
  std::string message;
};

/// What became of a mutant.
struct Fate {
  std::optional<Kill> kill;
  std::string
      error;  ///< what went wrong with the hunt itself: a shader that does not compile, a crash, an invalid case; empty when nothing
};

/// Looks for a case that the mutant fails: where it says, then in every suite there is, in each up to the first case that fails. Only a
/// picture that was drawn and judged kills.
Fate hunt(const Hunt& hunt, const Mutant& mutant);

/// The cases of those that the unmutated viewer, reached the same way, does not pass.
struct Control {
  std::vector<Kill> killed;
  std::string error;
};
Control control(const Hunt& hunt, const std::vector<Kill>& kills);

/// What a finished run says of the viewer: the first case that it failed. A crash, a timeout, an invalid case and a picture that was not
/// drawn are errors. @param results  text of results.json
Fate read_fate(const std::string& suite, const std::string& results);

}  // namespace sheen::conformance
