#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace sheen::tools {

/// The extension in lower case, with its dot.
std::string extension_of(const std::filesystem::path& file);

/// Throws InputError when a file of that name cannot be made: an extension that is not among those given, a folder that does not exist
/// or a folder of that name. Asked before long work, so that it is not lost.
void require_writable(const std::filesystem::path& file, const std::vector<std::string>& extensions);

/// Writes the text to a temporary name in the same folder and renames it: the file is there whole or not at all. Throws InputError.
void write_text(const std::filesystem::path& file, std::string_view text);

}  // namespace sheen::tools
