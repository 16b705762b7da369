#include "conformance/paths.h"

#include <cstdlib>
#include <string>
#include <system_error>

#include "conformance/goldens.h"

namespace sheen::conformance {
namespace {

namespace fs = std::filesystem;

bool is_inside(const fs::path& file, const fs::path& folder) {
  std::error_code error;
  const fs::path base = fs::weakly_canonical(folder, error);
  const fs::path relative = file.lexically_relative(base);
  return !error && !relative.empty() && relative.native().rfind("..", 0) != 0;
}

}  // namespace

fs::path this_program() {
  std::error_code error;
  return fs::read_symlink("/proc/self/exe", error);
}

fs::path default_cache() {
  // The XDG Base Directory Specification: a relative path there is invalid and to be ignored.
  const char* xdg = std::getenv("XDG_CACHE_HOME");
  if (xdg != nullptr && *xdg == '/') {
    return fs::path(xdg) / "sheen-cts";
  }
  const char* home = std::getenv("HOME");
  if (home != nullptr && *home == '/') {
    return fs::path(home) / ".cache" / "sheen-cts";
  }
  return fs::temp_directory_path() / "sheen-cts-cache";
}

fs::path find_goldens() {
  const fs::path program = this_program();
  std::error_code error;
  const fs::path installed = program.parent_path().parent_path() / "share" / "sheen-cts" / "goldens";
  if (fs::is_regular_file(installed / "manifest.json", error)) {
    return installed;
  }
  const fs::path source = SHEEN_CTS_SOURCE_GOLDENS;
  if (is_inside(program, SHEEN_CTS_BUILD_TREE) && fs::is_directory(source, error)) {
    return source;
  }
  return {};
}

}  // namespace sheen::conformance
