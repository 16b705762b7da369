#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "conformance/case.h"

namespace sheen::conformance {

/// The case as a .glb that any viewer can load: one mesh, its material and pictures, one camera, lights by KHR_lights_punctual. The same
/// case always gives the same bytes on one machine.
std::vector<std::uint8_t> make_glb(const Case& one);

/// Writes make_glb's bytes under `folder` (made when missing) as CASE-HASH.glb, where HASH is that of the bytes; a file that is there is
/// kept. Throws std::runtime_error when it cannot be written.
std::filesystem::path write_scene(const Case& one, const std::filesystem::path& folder);

}  // namespace sheen::conformance
