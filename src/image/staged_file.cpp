#include "image/staged_file.h"

#include <cerrno>
#include <fstream>
#include <random>
#include <string>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

#include "image/io.h"

namespace sheen::image {
namespace {

Error cannot_write(const std::filesystem::path& file, const std::string& why) {
  return Error(file.string() + ": cannot be written: " + why);
}

std::string errno_text() {
  return std::generic_category().message(errno);
}

}  // namespace

StagedFile::StagedFile(std::filesystem::path target) : target_(std::move(target)) {
  std::error_code ignored;
  if (std::filesystem::is_directory(target_, ignored)) {
    throw cannot_write(target_, "it is a folder");
  }
  std::random_device entropy;
  for (int attempt = 0; attempt < 100; ++attempt) {
    staging_ = target_;
    staging_.replace_filename(".sheen-cts-" + std::to_string(::getpid()) + "-" + std::to_string(entropy()) + ".tmp");
    const int descriptor = ::open(staging_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor >= 0) {
      ::close(descriptor);
      return;
    }
    if (errno != EEXIST) {
      throw cannot_write(target_, errno_text());
    }
  }
  throw cannot_write(target_, "no unused temporary name in its folder");
}

StagedFile::~StagedFile() {
  std::error_code ignored;
  if (!staging_.empty()) {
    std::filesystem::remove(staging_, ignored);
  }
}

void StagedFile::fill(const void* bytes, std::size_t count) {
  std::ofstream stream(staging_, std::ios::binary | std::ios::trunc);
  stream.write(static_cast<const char*>(bytes), static_cast<std::streamsize>(count));
  stream.close();
  if (!stream) {
    throw cannot_write(target_, errno_text());
  }
}

void StagedFile::commit() {
  std::error_code error;
  std::filesystem::rename(staging_, target_, error);
  if (error) {
    throw cannot_write(target_, error.message());
  }
  staging_.clear();
}

}  // namespace sheen::image
