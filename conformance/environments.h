#pragma once

#include <filesystem>
#include <string>

#include "scene/environment.h"

namespace sheen::conformance {

/// Whether a suite may name an environment so: "white", the same radiance of 1 from everywhere; "sky", smooth and analytic, brightest about
/// a hazy sun; "sun", the same sky with a small disc of peak 1e5 in its place.
bool is_environment(const std::string& name);
std::string environment_names();

/// The environment of that name, made here; "white" is uniform.
scene::Environment make_environment(const std::string& name);

/// The environment of that name, made when first asked for and kept. Safe to call from many threads.
const scene::Environment& kept_environment(const std::string& name);

/// The same as an equirect .exr in a folder, whose name holds what it shows. An old file is kept. Throws image::Error.
std::filesystem::path write_environment(const std::string& name, const std::filesystem::path& folder);

/// What names it to a viewer: that file in CACHE/environments, or, to our own, "uniform:R,G,B" where it is uniform. Throws image::Error.
std::filesystem::path environment_for_viewer(const std::string& name, bool ours, const std::filesystem::path& cache);

}  // namespace sheen::conformance
