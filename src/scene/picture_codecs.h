#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "scene/scene.h"

namespace sheen::scene {

/// A PNG or JPEG file's pixels as RGBA codes of 8 or 16 bits, alpha 1 where the file has none; chunks and markers about colour, gamma and
/// orientation are ignored (glTF 2.0, section 3.8.3). Damaged data is an error, never a guess.
/// @return  what is wrong with the file, in words that follow its name; empty if nothing is
std::string decode_picture(std::span<const std::uint8_t> file, Picture& picture);

}  // namespace sheen::scene
