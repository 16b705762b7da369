#pragma once

#include <filesystem>
#include <string>

namespace sheen::image {

/// What is wrong with a PNG's chunks (a cut file, a checksum that does not match), or an empty string. Checked before a decoder sees the
/// file: libpng leaves a corrupt one by longjmp, past the destructors of who called it, and writes to stderr. Source: PNG specification,
/// third edition, sections 5.2, 5.3 and 5.5, and annex D for the checksum.
std::string png_flaw(const std::filesystem::path& file);

}  // namespace sheen::image
