#include "image/pfm.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "image/io.h"
#include "image/test_folder.h"

namespace sheen::image {
namespace {

std::string big_endian(std::initializer_list<float> values) {
  std::string bytes;
  for (const float value : values) {
    for (int shift = 24; shift >= 0; shift -= 8) {
      bytes += static_cast<char>(std::bit_cast<std::uint32_t>(value) >> shift);
    }
  }
  return bytes;
}

TEST(Pfm, GreyBigEndianIsReadFromTheBottomRowUp) {
  const TestFolder folder;
  put(folder / "grey.pfm", "Pf\n2 2\n1.0\n" + big_endian({3, 4, 1, 2}));
  const Image image = read(folder / "grey.pfm");
  ASSERT_EQ(image.channels, (std::vector<std::string>{"R", "G", "B"}));
  for (int c = 0; c < 3; ++c) {
    EXPECT_EQ(image.at(0, 0, c), 1.0f) << "the last row stored is the top one";
    EXPECT_EQ(image.at(1, 0, c), 2.0f);
    EXPECT_EQ(image.at(0, 1, c), 3.0f);
    EXPECT_EQ(image.at(1, 1, c), 4.0f);
  }
}

TEST(Pfm, BothByteOrdersGiveTheSamePicture) {
  const TestFolder folder;
  put(folder / "big.pfm", "PF 1 1 2.5\n" + big_endian({-1.5f, 0.25f, 7e30f}));
  const Image big = read(folder / "big.pfm");
  write(folder / "little.pfm", big);
  EXPECT_EQ(read(folder / "little.pfm").data, big.data);
  EXPECT_EQ(big.data, (std::vector<float>{-1.5f, 0.25f, 7e30f}));
}

TEST(Pfm, KeepsInfinityAndNan) {
  const TestFolder folder;
  Image image(1, 1, {"R", "G", "B"});
  image.data = {std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN(), -0.0f};
  write(folder / "special.pfm", image);
  const Image back = read(folder / "special.pfm");
  EXPECT_EQ(back.data[0], image.data[0]);
  EXPECT_NE(back.data[1], back.data[1]);
  EXPECT_TRUE(std::signbit(back.data[2]));
}

TEST(Pfm, ABrokenFileIsAnErrorThatNamesIt) {
  const TestFolder folder;
  const std::string pixel = big_endian({1, 2, 3});
  for (const std::string& content :
       {std::string(), std::string("PF"), std::string("P6\n1 1\n255\n") + pixel, "PF\n1 1\n0\n" + pixel, "PF\n0 1\n1\n" + pixel,
        "PF\n-1 1\n1\n" + pixel, "PF\n1x 1\n1\n" + pixel, "PF\n1 2\n1\n" + pixel, "PF\n2147483647 2147483647\n1\n" + pixel,
        "PF\n99999999999 1\n1\n" + pixel, std::string("PF\n1 1\n-1.0")}) {
    put(folder / "broken.pfm", content);
    try {
      read(folder / "broken.pfm");
      ADD_FAILURE() << "read a picture from: " << content;
    } catch (const Error& e) {
      EXPECT_NE(std::string(e.what()).find("broken.pfm"), std::string::npos) << e.what();
    }
  }
}

}  // namespace
}  // namespace sheen::image
