#pragma once

#include <filesystem>
#include <string>

#include "scene/scene.h"

namespace sheen::scene {

/// Reads a .gltf or .glb file. Throws Error, naming file, element and rule, for anything the specifications forbid (see README, "Scenes").
Scene load_gltf(const std::filesystem::path& file);

/// 128-bit XXH3 (32 hex digits) over what can change a picture: geometry, materials, decoded pictures, lights, cameras; neither file name nor container.
std::string content_hash(const Scene& scene);

}  // namespace sheen::scene
