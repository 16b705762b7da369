#include "tools/files.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <system_error>

#include <sys/stat.h>
#include <unistd.h>

#include "tools/errors.h"

namespace sheen::tools {
namespace {

/// A file being written: removed unless it was renamed.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::filesystem::path& beside) : name_(beside.string() + ".XXXXXX") {
    descriptor_ = mkstemp(name_.data());
    if (descriptor_ < 0) {
      throw InputError(beside.string() + ": cannot be written: " + std::strerror(errno));
    }
  }
  ~TemporaryFile() {
    if (descriptor_ >= 0) {
      close(descriptor_);
    }
    if (!name_.empty()) {
      unlink(name_.c_str());
    }
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  bool write(std::string_view text) const {
    while (!text.empty()) {
      const ssize_t written = ::write(descriptor_, text.data(), text.size());
      if (written < 0 && errno == EINTR) {
        continue;
      }
      if (written <= 0) {
        return false;
      }
      text.remove_prefix(static_cast<std::size_t>(written));
    }
    return true;
  }

  bool rename_to(const std::filesystem::path& file) {
    // mkstemp makes files for their owner alone; the result is an ordinary one.
    const mode_t mask = umask(0);
    umask(mask);
    const bool closed = fchmod(descriptor_, 0666 & ~mask) == 0 && close(descriptor_) == 0;
    descriptor_ = -1;
    if (!closed || std::rename(name_.c_str(), file.c_str()) != 0) {
      return false;
    }
    name_.clear();
    return true;
  }

 private:
  std::string name_;
  int descriptor_ = -1;
};

}  // namespace

std::string extension_of(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](unsigned char c) { return std::tolower(c); });
  return extension;
}

void require_writable(const std::filesystem::path& file, const std::vector<std::string>& extensions) {
  if (std::find(extensions.begin(), extensions.end(), extension_of(file)) == extensions.end()) {
    std::string known;
    for (const std::string& extension : extensions) {
      known += (known.empty() ? "" : ", ") + extension;
    }
    throw InputError(file.string() + ": output: the name must end in one of " + known);
  }
  std::error_code error;
  if (std::filesystem::is_directory(file, error)) {
    throw InputError(file.string() + ": output: is a folder");
  }
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
  if (!std::filesystem::is_directory(folder, error)) {
    throw InputError(file.string() + ": output: the folder " + folder.string() + " does not exist");
  }
  if (access(folder.c_str(), W_OK | X_OK) != 0) {
    throw InputError(file.string() + ": output: the folder " + folder.string() + " cannot be written to");
  }
}

void write_text(const std::filesystem::path& file, std::string_view text) {
  TemporaryFile temporary(file);
  if (!temporary.write(text) || !temporary.rename_to(file)) {
    throw InputError(file.string() + ": cannot be written: " + std::strerror(errno));
  }
}

}  // namespace sheen::tools
