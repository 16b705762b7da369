#include "image/decode_hdr.h"

#include <cstddef>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "image/test_folder.h"

namespace sheen::image {
namespace {

/// A Radiance picture of the given size whose pixels are the bytes given.
std::string radiance(int width, int height, const std::string& pixels) {
  return "#?RADIANCE\nEXPOSURE=2\nFORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(height) + " +X " + std::to_string(width) + "\n" + pixels;
}

TEST(DecodeHdr, AFlatHdrIsReadAndACutOneIsNot) {
  const TestFolder folder;
  // 128/256 2^(129-128) = 1, 64/256 2^1 = 0.5, 255/256 2^1.
  const std::string pixel("\x80\x40\xff\x81", 4);
  for (const int width : {3, 9}) {
    std::string pixels;
    for (int i = 0; i < width * 2; ++i) {
      pixels += pixel;
    }
    put(folder / "flat.hdr", radiance(width, 2, pixels));
    RawPicture image;
    ASSERT_EQ(decode_hdr(folder / "flat.hdr", image), "");
    ASSERT_EQ(image.values.size(), static_cast<std::size_t>(width) * 6);
    EXPECT_EQ((std::vector<float>(image.values.end() - 3, image.values.end())), (std::vector<float>{1.0f, 0.5f, 255.0f / 128}));
    for (std::size_t missing = 1; missing <= 9; ++missing) {
      put(folder / "cut.hdr", radiance(width, 2, pixels.substr(0, pixels.size() - missing)));
      EXPECT_EQ(decode_hdr(folder / "cut.hdr", image).substr(0, 19), "its data ends early")
          << width << " wide, " << missing << " bytes short";
    }
  }
}

TEST(DecodeHdr, ARunLengthEncodedHdrIsReadAndADamagedOneEnds) {
  const TestFolder folder;
  // One line of 8: each component a run of 8 (136), the last as single values.
  const std::string head("\x02\x02\x00\x08", 4);
  const std::string runs = std::string("\x88\x80\x88\x40\x88\x00", 6) + std::string("\x08\x81\x82\x83\x81\x81\x81\x81\x80", 9);
  put(folder / "runs.hdr", radiance(8, 1, head + runs));
  RawPicture image;
  ASSERT_EQ(decode_hdr(folder / "runs.hdr", image), "");
  EXPECT_EQ((std::vector<float>(image.values.begin(), image.values.begin() + 9)), (std::vector<float>{1, 0.5f, 0, 2, 1, 0, 4, 2, 0}));
  EXPECT_EQ(image.values[21], 0.5f);
  const std::string empty_runs(40, '\0');  // a run of no values, again and again
  put(folder / "endless.hdr", radiance(8, 1, head + empty_runs));
  EXPECT_NE(decode_hdr(folder / "endless.hdr", image), "");
  for (std::size_t kept = 0; kept < head.size() + runs.size(); ++kept) {
    put(folder / "cut.hdr", radiance(8, 1, (head + runs).substr(0, kept)));
    EXPECT_NE(decode_hdr(folder / "cut.hdr", image), "") << kept << " bytes";
  }
}

TEST(DecodeHdr, AHeaderThatClaimsMoreThanTheFileHoldsIsRefusedBeforeItIsBelieved) {
  const TestFolder folder;
  RawPicture image;
  put(folder / "huge.hdr", radiance(13300, 13300, std::string(400, '\x80')));
  EXPECT_EQ(decode_hdr(folder / "huge.hdr", image).substr(0, 19), "its data ends early");
  EXPECT_TRUE(image.values.empty());
  for (const char* header : {"#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n+Y 1 +X 1\n"}) {
    put(folder / "other.hdr", std::string(header) + std::string("\x80\x40\xff\x81", 4));
    EXPECT_NE(decode_hdr(folder / "other.hdr", image).find("FORMAT=32-bit_rle_rgbe with its rows from the top"), std::string::npos);
  }
}

}  // namespace
}  // namespace sheen::image
