#pragma once

#include <string>
#include <vector>

namespace sheen::gles {

/// A shared library opened at run time. It is never closed: a GL driver keeps thread-local data and threads of its own (LLVM's among them)
/// that do not survive being unmapped.
class Library {
 public:
  /// Opens the first of `names` that opens. Throws Unavailable with the loader's words for every name when none does.
  Library(const std::string& what, const std::vector<std::string>& names);

  /// The function of that name. Throws Unavailable when the library lacks it.
  template <class Function>
  Function symbol(const char* name) const {
    return reinterpret_cast<Function>(address(name));
  }
  const std::string& name() const { return name_; }

 private:
  void* address(const char* name) const;

  void* handle_ = nullptr;
  std::string name_;
};

}  // namespace sheen::gles
