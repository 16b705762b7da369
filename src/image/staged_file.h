#pragma once

#include <filesystem>

namespace sheen::image {

/// A file that appears whole or not at all: written under an unused name beside its target, then renamed over it. Destroyed without
/// commit(), it leaves nothing behind and the target as it was.
class StagedFile {
 public:
  /// Creates the empty staging file. Throws Error when the folder is missing or not writable, or the target is a folder.
  explicit StagedFile(std::filesystem::path target);
  StagedFile(const StagedFile&) = delete;
  StagedFile& operator=(const StagedFile&) = delete;
  ~StagedFile();

  /// Where to write.
  const std::filesystem::path& path() const { return staging_; }
  /// Replaces path()'s content. Throws Error.
  void fill(const void* bytes, std::size_t count);
  /// Puts the file in its place. Throws Error.
  void commit();

 private:
  std::filesystem::path target_;
  std::filesystem::path staging_;
};

}  // namespace sheen::image
