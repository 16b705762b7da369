#pragma once

#include <filesystem>
#include <string>

#include "scene/scene.h"

namespace sheen::scene {

/// Reads a .gltf or .glb file. Throws Error, naming file, element and rule, for anything the specifications forbid (see README, "Scenes").
Scene load_gltf(const std::filesystem::path& file);

/// 128-bit XXH3 (32 hex digits) of what can change a picture: geometry, materials, pictures, lights, cameras; no file name, no container.
std::string content_hash(const Scene& scene);

}  // namespace sheen::scene
