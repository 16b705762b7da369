#pragma once

#include <string>
#include <string_view>

namespace sheen::scene {

/// What to do about an extension whose data this loader does not decode (Draco, meshopt, KTX2, WebP, AVIF): "; convert the file with:
/// gltf-transform ...", to follow a rule in an error; empty for other extensions. The commands are those of gltf-transform 4
/// (gltf-transform.dev), which decodes all of these.
std::string conversion_advice(std::string_view extension);

}  // namespace sheen::scene
