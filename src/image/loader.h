#pragma once

#include <filesystem>
#include <vector>

#include "image/module.h"

namespace sheen::image {

/// The image module, loaded when first asked for and never unloaded (OpenImageIO's libraries do not survive that). Thread-safe.
/// Throws Error with every place that was tried.
const Module& loaded_module();

/// Where the module is looked for, in order, by an executable lying in `folder`: beside it (build tree), in the library folder of an
/// installation, and, unless the executable is an installed one, in the build tree it comes from.
std::vector<std::filesystem::path> module_places(const std::filesystem::path& folder);

}  // namespace sheen::image
