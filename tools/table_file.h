#pragma once

#include <filesystem>
#include <string>

#include "image/image.h"

namespace sheen::tools {

/// A table read from a file.
struct TableFile {
  image::Image image;
  bool from_codes = false;  ///< its values were decoded from codes by the sRGB curve
};

/// Reads a picture (image::read), or a .csv: with a header that names roughness or sheen_roughness and n_dot_v, one texel a line, ordered
/// so that either stays the same along a row of the table, every other column becoming a channel; without one, a line a row of the table.
/// Throws image::Error or InputError naming file, line and rule.
TableFile read_table(const std::filesystem::path& file);

/// The picture of a .csv's text; `name` is for errors.
image::Image parse_table(const std::string& text, const std::string& name);

}  // namespace sheen::tools
