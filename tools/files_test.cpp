#include "tools/files.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>

#include "tools/errors.h"
#include "tools/temporary_folder_test.h"

namespace sheen::tools {
namespace {

std::string contents(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(WriteText, ReplacesAFileWholeAndLeavesNothingElse) {
  const TemporaryFolder folder;
  write_text(folder / "table.csv", "first");
  write_text(folder / "table.csv", "second");
  EXPECT_EQ(contents(folder / "table.csv"), "second");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

TEST(WriteText, WhatCannotBeReplacedStaysAndNothingIsLeft) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "taken.csv" / "inner");
  EXPECT_THROW(write_text(folder / "taken.csv", "text"), InputError);
  EXPECT_TRUE(std::filesystem::is_directory(folder / "taken.csv"));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

TEST(RequireWritable, NamesTheFileAndTheRule) {
  const TemporaryFolder folder;
  EXPECT_NO_THROW(require_writable(folder / "a.EXR", {".exr"}));
  EXPECT_NO_THROW(require_writable("a.exr", {".exr"}));
  EXPECT_THROW(require_writable(folder / "a.txt", {".exr", ".png"}), InputError);
  EXPECT_THROW(require_writable(folder / "none" / "a.exr", {".exr"}), InputError);
  std::filesystem::create_directory(folder / "b.exr");
  EXPECT_THROW(require_writable(folder / "b.exr", {".exr"}), InputError);
  try {
    require_writable(folder / "a.txt", {".exr", ".png"});
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("a.txt"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find(".exr, .png"), std::string::npos);
  }
}

}  // namespace
}  // namespace sheen::tools
