#include "image/loader.h"

#include <exception>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include <dlfcn.h>

#include "image/io.h"

namespace sheen::image {
namespace {

struct Loaded {
  const Module* module = nullptr;
  std::string error;
};

Loaded load_from(const std::filesystem::path& file) {
  // Local: OpenImageIO brings libGLX and libglib with it, whose symbols must not come before those of the GL context we open ourselves.
  void* handle = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) {
    return {nullptr, dlerror()};
  }
  const auto entry = reinterpret_cast<ModuleEntry>(dlsym(handle, module_symbol));
  if (entry == nullptr) {
    return {nullptr, dlerror()};
  }
  return {entry(), {}};
}

Loaded load() {
  try {
    std::string tried;
    for (const auto& file : module_places(std::filesystem::read_symlink("/proc/self/exe").parent_path())) {
      std::error_code ignored;
      if (std::filesystem::exists(file, ignored)) {
        return load_from(file);
      }
      tried += (tried.empty() ? "" : ", ") + file.string();
    }
    return {nullptr, "not found at " + tried};
  } catch (const std::exception& e) {
    return {nullptr, e.what()};
  }
}

}  // namespace

std::vector<std::filesystem::path> module_places(const std::filesystem::path& folder) {
  const std::string name = SHEEN_IMAGE_MODULE_NAME;
  std::vector<std::filesystem::path> places = {folder / name, (folder / SHEEN_IMAGE_MODULE_INSTALL_DIR / name).lexically_normal()};
  // An installed program must not depend on the tree that built it, even where that tree still exists.
  if (folder.filename() != SHEEN_IMAGE_INSTALL_BIN) {
    places.emplace_back(std::filesystem::path(SHEEN_IMAGE_MODULE_BUILD_DIR) / name);
  }
  return places;
}

const Module& loaded_module() {
  static const Loaded loaded = load();
  if (loaded.module == nullptr) {
    throw Error("the image library cannot be loaded: " + loaded.error);
  }
  return *loaded.module;
}

}  // namespace sheen::image
