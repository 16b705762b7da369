#pragma once

#include <map>
#include <string>

namespace sheen::renderer {

/// The files of shaders/, by file name, as they were when the library was built.
const std::map<std::string, std::string>& shader_sources();

}  // namespace sheen::renderer
