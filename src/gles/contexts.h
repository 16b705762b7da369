#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gles/context.h"

namespace sheen::gles {

/// An OSMesa context: core profile 4.5 or, failing that, 3.3. Throws Unavailable, saying what was tried and what to install.
std::unique_ptr<Context> create_osmesa_context(const std::vector<std::string>& library_names);

/// A GL ES 3.0 context by EGL without any surface: surfaceless, then device, then default display. Throws Unavailable likewise.
std::unique_ptr<Context> create_egl_context(const std::vector<std::string>& library_names);

}  // namespace sheen::gles
