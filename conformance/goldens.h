#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace sheen::conformance {

/// Where scenes and computed goldens are kept: $XDG_CACHE_HOME/sheen-cts, else $HOME/.cache/sheen-cts, else a folder under the system's
/// temporary one.
std::filesystem::path default_cache();

/// Where the committed goldens are: ../share/sheen-cts/goldens beside the program, else the source tree's if the program runs from its
/// build tree; empty when there are none.
std::filesystem::path find_goldens();

struct Suite;

struct GoldensOptions {
  std::filesystem::path dir;  ///< folder of manifest.json; empty: find_goldens()
  std::string suite = "core";
  std::filesystem::path cache;                                        ///< empty: default_cache(); scenes are written there
  std::function<void(std::size_t done, std::size_t total)> progress;  ///< from any thread, one call at a time
};

struct GoldensReport {
  std::filesystem::path dir;
  std::size_t cases = 0;              ///< cases of the suite
  std::uintmax_t bytes = 0;           ///< of all files
  std::vector<std::string> problems;  ///< verify: one line for each golden that is missing, too many, or off; empty when all is well
};

/// Computes every golden of the suite and writes DIR/SUITE/CASE.exr (RGBA, PXR24) and DIR/manifest.json; goldens of cases that are no more
/// are removed. Throws std::invalid_argument (unknown suite, one without goldens, no folder), image::Error, scene::Error.
GoldensReport generate_goldens(const GoldensOptions& options);

/// Recomputes every golden and holds the files to it within PXR24's rounding; names each mismatch, missing file, extra file, and each entry
/// of the manifest that no longer fits (formula version, scene, settings). Throws std::invalid_argument (unknown suite, no folder).
GoldensReport verify_goldens(const GoldensOptions& options);

/// The same for a suite at hand (options.suite is not looked at).
GoldensReport generate_goldens(const Suite& suite, const GoldensOptions& options);
GoldensReport verify_goldens(const Suite& suite, const GoldensOptions& options);

}  // namespace sheen::conformance
