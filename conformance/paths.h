#pragma once

#include <filesystem>

namespace sheen::conformance {

/// The running program's own file, links followed.
std::filesystem::path this_program();

}  // namespace sheen::conformance
