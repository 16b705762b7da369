#include "gles/library.h"

#include <dlfcn.h>

#include "gles/context.h"

namespace sheen::gles {

Library::Library(const std::string& what, const std::vector<std::string>& names) {
  std::string tried;
  for (const std::string& name : names) {
    handle_ = dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (handle_ != nullptr) {
      name_ = name;
      return;
    }
    const char* why = dlerror();
    tried += "\n  dlopen " + name + ": " + (why != nullptr ? why : "no reason given");
  }
  throw Unavailable(what + " cannot be opened:" + tried);
}

void* Library::address(const char* name) const {
  void* const found = dlsym(handle_, name);
  if (found == nullptr) {
    throw Unavailable(name_ + " has no function " + name);
  }
  return found;
}

}  // namespace sheen::gles
