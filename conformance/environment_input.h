#pragma once

#include <string>

#include "scene/environment.h"

namespace sheen::conformance {

/// What "uniform:R,G,B" with radiances >= 0 describes, or an equirect in a .hdr or .exr file, whose values must be finite and >= 0.
/// Throws std::invalid_argument for other words, scene::Error and image::Error for what is wrong with a file.
scene::Environment read_environment(const std::string& text);

}  // namespace sheen::conformance
