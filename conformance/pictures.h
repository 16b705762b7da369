#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sheen::conformance {

/// A picture of a sweep, drawn by a formula: PNG codes, row by row from the top.
struct ProceduralPicture {
  int width = 0;
  int height = 0;
  int channels = 4;
  int bits = 8;
  std::vector<std::uint16_t> codes;
};

/// The sampler that a texture's name may ask for after a slash.
struct SamplerChoice {
  int mag_filter = 9729;  ///< GL's numbers, as glTF stores them: 9728 NEAREST, 9729 LINEAR
  int min_filter = 9987;  ///< ... 9984 to 9987: with mipmaps
  int wrap_s = 10497;     ///< 10497 REPEAT, 33071 CLAMP_TO_EDGE, 33648 MIRRORED_REPEAT
  int wrap_t = 10497;
};

struct TextureName {
  std::string picture;
  std::string sampler;  ///< "" (trilinear, repeating), "linear", "nearest", "clamp", "mirror", "bilinear_mips"
};

/// Reads "PICTURE" or "PICTURE/SAMPLER"; nothing when either is unknown.
std::optional<TextureName> parse_texture_name(const std::string& name);
/// Throws std::invalid_argument for an unknown sampler.
SamplerChoice make_sampler(const std::string& name);
/// The names of the pictures, for messages.
std::string picture_names();

/// - "channels": every channel another pattern (r runs across, g down, b in rings, a in waves), so that a wrong channel shows;
/// - "weave": a coloured cloth pattern of middle tones, so that a wrong colour space shows;
/// - "weave16": the same in 16 bits;
/// - "odd": "channels" in 37 x 23 texels, a size of no power of two;
/// - "bumps", "ripples": normal maps, taken from heights;
/// - "flat": the same everywhere, codes 0.2, 0.4, 0.6, 0.8 of the largest in r, g, b, a.
/// A dot and letters of "rgba" keep those channels alone ("channels.a"), the others being code 0.5 everywhere.
/// Smooth and periodic, so that a picture repeats without a seam. Throws std::invalid_argument for an unknown name.
ProceduralPicture make_picture(const std::string& name);

}  // namespace sheen::conformance
