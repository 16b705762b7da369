#include "image/io.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "image/loader.h"
#include "image/srgb.h"
#include "image/test_folder.h"

namespace sheen::image {
namespace {

using Names = std::vector<std::string>;

/// A picture with every channel its own, also negative and over 1; alpha in [0, 1].
Image pattern(int width, int height, const Names& names) {
  Image image(width, height, names);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < static_cast<int>(names.size()); ++c) {
        const float value = std::sin(0.37f * static_cast<float>(x) + 1.7f * static_cast<float>(y) + static_cast<float>(c)) * 3.0f;
        image.at(x, y, c) = names[static_cast<std::size_t>(c)] == "A" ? 0.5f + value / 6.0f : value;
      }
    }
  }
  return image;
}

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& e) {
    return e.what();
  }
  return {};
}

TEST(ImageIo, ExrKeepsEveryFloatOfEveryChannelUnderItsName) {
  const TestFolder folder;
  const Names names = {"R", "G", "B", "A", "bound.R", "bound.G", "bound.B", "excluded"};
  Image image = pattern(7, 5, names);
  image.at(1, 1, 0) = std::numeric_limits<float>::infinity();
  image.at(2, 1, 4) = 1e-42f;
  write(folder / "golden.exr", image);
  const Image back = read(folder / "golden.exr");
  ASSERT_EQ(back.width, 7);
  ASSERT_EQ(back.height, 5);
  ASSERT_EQ(Names(back.channels.begin(), back.channels.begin() + 4), Names(names.begin(), names.begin() + 4)) << "colour comes first";
  for (const std::string& name : names) {
    const int at = back.channel(name);
    ASSERT_GE(at, 0) << name;
    for (int y = 0; y < 5; ++y) {
      for (int x = 0; x < 7; ++x) {
        EXPECT_EQ(back.at(x, y, at), image.at(x, y, image.channel(name))) << name << " at " << x << ", " << y;
      }
    }
  }
}

TEST(ImageIo, ExrChannelsMayComeInAnyOrder) {
  const TestFolder folder;
  const Image image = pattern(3, 2, {"Z", "A", "B", "G", "R"});
  write(folder / "order.exr", image);
  const Image back = read(folder / "order.exr");
  EXPECT_EQ(Names(back.channels.begin(), back.channels.begin() + 4), (Names{"R", "G", "B", "A"}));
  for (const std::string& name : image.channels) {
    EXPECT_EQ(back.at(2, 1, back.channel(name)), image.at(2, 1, image.channel(name))) << name;
  }
}

/// The bytes of an uncompressed EXR of half floats, written here from the file layout (OpenEXR, "OpenEXR File Layout"): `row` holds the
/// halves of each line of the data window, channel after channel in alphabetical order.
std::string half_exr(const Names& names, const std::array<std::int32_t, 4>& data_window, const std::array<std::int32_t, 4>& display_window,
                     const std::vector<std::vector<std::uint16_t>>& rows) {
  const auto number = [](auto value) { return std::string(reinterpret_cast<const char*>(&value), sizeof(value)); };
  const auto text = [](const std::string& value) { return value + std::string(1, '\0'); };
  const auto attribute = [&](const char* name, const char* type, const std::string& value) {
    return text(name) + text(type) + number(static_cast<std::int32_t>(value.size())) + value;
  };
  const auto box = [&](const std::array<std::int32_t, 4>& b) { return number(b[0]) + number(b[1]) + number(b[2]) + number(b[3]); };
  std::string list;
  for (const std::string& name : names) {
    list += text(name) + number(std::int32_t{1}) + number(0) + number(1) + number(1);
  }
  std::string file = std::string("\x76\x2f\x31\x01", 4) + number(std::int32_t{2});
  file += attribute("channels", "chlist", list + std::string(1, '\0')) + attribute("compression", "compression", std::string(1, '\0'));
  file += attribute("dataWindow", "box2i", box(data_window)) + attribute("displayWindow", "box2i", box(display_window));
  file += attribute("lineOrder", "lineOrder", std::string(1, '\0')) + attribute("pixelAspectRatio", "float", number(1.0f));
  file += attribute("screenWindowCenter", "v2f", number(0.0f) + number(0.0f)) + attribute("screenWindowWidth", "float", number(1.0f));
  file += std::string(1, '\0');
  std::string chunks;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    file += number(static_cast<std::uint64_t>(0));
    std::string line;
    for (const std::uint16_t half : rows[i]) {
      line += number(half);
    }
    chunks += number(data_window[1] + static_cast<std::int32_t>(i)) + number(static_cast<std::int32_t>(line.size())) + line;
  }
  const std::size_t table = file.size() - rows.size() * 8;
  std::uint64_t at = file.size();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    file.replace(table + 8 * i, 8, number(at));
    at += 8 + 2 * rows[i].size();
  }
  return file + chunks;
}

TEST(ImageIo, HalfFloatExrIsReadOverItsDisplayWindow) {
  const TestFolder folder;
  // Halves: 0x3c00 = 1, 0x4000 = 2, 0x3800 = 0.5, 0x7c00 = infinity, 0x0001 = 2^-24. The data window begins left of the display window.
  put(folder / "window.exr",
      half_exr({"B", "G", "R"}, {-1, 1, 1, 1}, {0, 0, 3, 2}, {{0x3c00, 0x4000, 0x3800, 0, 0x7c00, 0, 0x3c00, 0x0001, 0x4000}}));
  const Image image = read(folder / "window.exr");
  ASSERT_EQ(image.width, 4);
  ASSERT_EQ(image.height, 3);
  ASSERT_EQ(image.channels, (Names{"R", "G", "B"}));
  const auto pixel = [&](int x, int y) { return std::vector<float>{image.at(x, y, 0), image.at(x, y, 1), image.at(x, y, 2)}; };
  EXPECT_EQ(pixel(0, 1), (std::vector<float>{std::exp2(-24.0f), std::numeric_limits<float>::infinity(), 2.0f}));
  EXPECT_EQ(pixel(1, 1), (std::vector<float>{2.0f, 0.0f, 0.5f}));
  EXPECT_EQ(pixel(2, 1), (std::vector<float>{0, 0, 0})) << "outside the data window";
  EXPECT_EQ(pixel(0, 0), (std::vector<float>{0, 0, 0})) << "above it";
}

TEST(ImageIo, ALuminanceExrBecomesColour) {
  const TestFolder folder;
  put(folder / "grey.exr", half_exr({"Y"}, {0, 0, 1, 0}, {0, 0, 1, 0}, {{0x3c00, 0x4000}}));
  const Image image = read(folder / "grey.exr");
  ASSERT_EQ(image.channels, (Names{"R", "G", "B"}));
  EXPECT_EQ(image.data, (std::vector<float>{1, 1, 1, 2, 2, 2}));
  put(folder / "covered.exr", half_exr({"A", "Y"}, {0, 0, 1, 0}, {0, 0, 1, 0}, {{0x3c00, 0x3800, 0x4000, 0x3c00}}));
  const Image covered = read(folder / "covered.exr");
  ASSERT_EQ(covered.channels, (Names{"R", "G", "B", "A"}));
  EXPECT_EQ(covered.data, (std::vector<float>{2, 2, 2, 1, 1, 1, 1, 0.5f}));
}

TEST(ImageIo, AHeaderThatClaimsTheWorldIsAnErrorAndNotOutOfMemory) {
  const TestFolder folder;
  put(folder / "huge.exr", half_exr({"B", "G", "R"}, {0, 0, 0, 0}, {0, 0, 2000000, 2000000}, {{1, 2, 3}}));
  EXPECT_NE(message_of([&] { read(folder / "huge.exr"); }).find("huge.exr"), std::string::npos);
}

// OpenEXR, Technical Introduction: PXR24 rounds the significand of a float to 15 bits.
TEST(ImageIo, Pxr24RoundsToTwentyFourBitsAndNoLess) {
  const TestFolder folder;
  const Image image = pattern(16, 16, {"R", "G", "B", "A"});
  write(folder / "lossy.exr", image, ExrCompression::Pxr24);
  const Image back = read(folder / "lossy.exr");
  double worst = 0;
  for (std::size_t i = 0; i < image.data.size(); ++i) {
    const double relative = std::abs(static_cast<double>(back.data[i]) - image.data[i]) / std::abs(static_cast<double>(image.data[i]));
    worst = std::max(worst, relative);
    EXPECT_EQ(std::bit_cast<std::uint32_t>(back.data[i]) & 0xffu, 0u) << "the lowest byte is dropped";
  }
  EXPECT_LE(worst, std::exp2(-16.0) * 1.0001);
  EXPECT_GT(worst, std::exp2(-19.0)) << "as if nothing had been rounded";
}

TEST(ImageIo, TheSamePictureGivesTheSameBytes) {
  const TestFolder folder;
  const Image image = pattern(5, 5, {"R", "G", "B", "A"});
  for (const char* extension : {".exr", ".hdr", ".pfm", ".png"}) {
    write(folder / (std::string("first") + extension), image);
    write(folder / (std::string("second") + extension), image);
    EXPECT_EQ(bytes_of(folder / (std::string("first") + extension)), bytes_of(folder / (std::string("second") + extension))) << extension;
  }
  EXPECT_EQ(bytes_of(folder / "first.exr").find(folder.path().filename().string()), std::string::npos)
      << "its place is none of its business";
}

// Ward 1991: 8 bits of significand, common to the three channels.
TEST(ImageIo, HdrKeepsEightBitsAndClipsWhatItCannotHold) {
  const TestFolder folder;
  Image image(4, 1, {"R", "G", "B", "A"});
  image.data = {100.0f, 3.0f, 0.5f, 1, -1.0f, 0.25f, 0.1f, 1, std::numeric_limits<float>::quiet_NaN(), 1.0f, 0.0f, 1, 0, 0, 0, 0};
  write(folder / "light.hdr", image);
  const Image back = read(folder / "light.hdr");
  ASSERT_EQ(back.channels, (Names{"R", "G", "B"}));
  for (int x = 0; x < 4; ++x) {
    float largest = 0;
    for (int c = 0; c < 3; ++c) {
      largest = std::max(largest, image.at(x, 0, c));
    }
    for (int c = 0; c < 3; ++c) {
      const float value = image.at(x, 0, c);
      EXPECT_NEAR(back.at(x, 0, c), value > 0 ? value : 0.0f, largest / 128) << "pixel " << x << " channel " << c;
    }
  }
}

TEST(ImageIo, EveryPngCodeDecodesBySrgbAndComesBack) {
  const TestFolder folder;
  std::vector<std::uint16_t> codes(256 * 3);
  for (std::size_t i = 0; i < 256; ++i) {
    codes[3 * i] = static_cast<std::uint16_t>(i);
    codes[3 * i + 1] = static_cast<std::uint16_t>(255 - i);
    codes[3 * i + 2] = 188;
  }
  const auto bytes = encode_png_codes(16, 16, 3, 8, codes);
  put(folder / "codes.png", bytes.data(), bytes.size());
  const Image image = read(folder / "codes.png");
  ASSERT_EQ(image.channels, (Names{"R", "G", "B"}));
  for (std::size_t i = 0; i < 256; ++i) {
    EXPECT_FLOAT_EQ(image.data[3 * i], static_cast<float>(srgb_to_linear(static_cast<double>(i) / 255))) << "code " << i;
  }
  EXPECT_NEAR(image.data[2], 0.502886, 1e-6) << "IEC 61966-2-1 of 188";
  write(folder / "again.png", image);
  EXPECT_EQ(read(folder / "again.png").data, image.data);
}

TEST(ImageIo, SixteenBitPngKeepsItsCodes) {
  const TestFolder folder;
  const auto bytes = encode_png_codes(2, 1, 3, 16, {0, 1, 258, 32768, 65534, 65535});
  put(folder / "deep.png", bytes.data(), bytes.size());
  const Image image = read(folder / "deep.png");
  const std::vector<int> codes = {0, 1, 258, 32768, 65534, 65535};
  for (std::size_t i = 0; i < codes.size(); ++i) {
    EXPECT_FLOAT_EQ(image.data[i], static_cast<float>(srgb_to_linear(codes[i] / 65535.0)));
  }
}

TEST(ImageIo, GreyAndGreyAlphaPngBecomeColourAndAlphaIsLinearAndMultipliedIn) {
  const TestFolder folder;
  const auto grey = encode_png_codes(1, 1, 1, 8, {128});
  put(folder / "grey.png", grey.data(), grey.size());
  const auto value = static_cast<float>(srgb_to_linear(128.0 / 255));
  EXPECT_EQ(read(folder / "grey.png").data, (std::vector<float>{value, value, value}));
  const auto both = encode_png_codes(1, 1, 2, 8, {128, 51});
  put(folder / "both.png", both.data(), both.size());
  const Image image = read(folder / "both.png");
  ASSERT_EQ(image.channels, (Names{"R", "G", "B", "A"}));
  EXPECT_FLOAT_EQ(image.data[3], 0.2f);
  EXPECT_FLOAT_EQ(image.data[0], static_cast<float>(srgb_to_linear(128.0 / 255) * 0.2));
}

TEST(ImageIo, PngIsStraightAndTheImagePremultiplied) {
  const TestFolder folder;
  const auto bytes = encode_png_codes(2, 1, 4, 8, {255, 188, 10, 128, 200, 100, 50, 0});
  put(folder / "straight.png", bytes.data(), bytes.size());
  const Image image = read(folder / "straight.png");
  EXPECT_FLOAT_EQ(image.data[0], static_cast<float>(128.0 / 255)) << "white at half coverage";
  EXPECT_EQ(image.data[4], 0.0f) << "no coverage, no radiance";
  write(folder / "again.png", image);
  EXPECT_EQ(read(folder / "again.png").data, image.data) << "un-premultiplied on the way out";
  EXPECT_NE(bytes_of(folder / "again.png").find("sRGB"), std::string::npos) << "marked as sRGB";
}

TEST(ImageIo, PngRoundsToTheNearestCodeAndClips) {
  const TestFolder folder;
  Image image(3, 1, {"R", "G", "B"});
  const auto linear = [](double code) { return static_cast<float>(srgb_to_linear(code / 255)); };
  image.data = {linear(100.49), linear(100.51), 2.0f, -1.0f, std::numeric_limits<float>::infinity(), 1.0f, 0, 0, std::nanf("")};
  write(folder / "round.png", image);
  const Image back = read(folder / "round.png");
  EXPECT_FLOAT_EQ(back.data[0], linear(100));
  EXPECT_FLOAT_EQ(back.data[1], linear(101));
  EXPECT_EQ(back.data[2], 1.0f);
  EXPECT_EQ(back.data[3], 0.0f);
  EXPECT_EQ(back.data[4], 1.0f) << "infinity clips";
  EXPECT_EQ((std::vector<float>{back.data[6], back.data[7], back.data[8]}), (std::vector<float>{1, 0, 1})) << "NaN shows as magenta";
}

TEST(ImageIo, JpegIsDecodedFromSrgb) {
  const TestFolder folder;
  // A 1 x 1 baseline grey JPEG of DC 0 (sample 128): tables of one symbol each.
  std::string jpeg("\xff\xd8\xff\xdb\x00\x43\x00", 7);
  jpeg += std::string(64, '\x01');
  jpeg += std::string("\xff\xc0\x00\x0b\x08\x00\x01\x00\x01\x01\x01\x11\x00", 13);
  for (const char* table : {"\x00", "\x10"}) {
    jpeg +=
        std::string("\xff\xc4\x00\x14", 4) + std::string(table, 1) + std::string("\x01", 1) + std::string(15, '\0') + std::string(1, '\0');
  }
  jpeg += std::string("\xff\xda\x00\x08\x01\x01\x00\x00\x3f\x00\x3f\xff\xd9", 13);
  put(folder / "grey.jpg", jpeg);
  const Image image = read(folder / "grey.jpg");
  ASSERT_EQ(image.channels, (Names{"R", "G", "B"}));
  EXPECT_FLOAT_EQ(image.data[0], static_cast<float>(srgb_to_linear(128.0 / 255)));
}

TEST(ImageIo, WhatCannotBeReadIsAnErrorThatNamesFileAndReason) {
  const TestFolder folder;
  put(folder / "picture.gif", "GIF89a");
  put(folder / "empty.exr", "");
  EXPECT_NE(message_of([&] { read(folder / "none.exr"); }).find("none.exr: cannot be read: No such file"), std::string::npos);
  EXPECT_NE(message_of([&] { read(folder / "picture.gif"); }).find("picture.gif: cannot be read: unknown extension"), std::string::npos);
  EXPECT_NE(message_of([&] { read(folder / "empty.exr"); }).find("empty.exr: cannot be read: "), std::string::npos);
  EXPECT_NE(message_of([&] { read(folder.path()); }).find("unknown extension"), std::string::npos);
  std::filesystem::create_directory(folder / "folder.png");
  EXPECT_NE(message_of([&] { read(folder / "folder.png"); }).find("it is a folder"), std::string::npos);
}

TEST(ImageIo, ACutOrForeignFileIsAnErrorAndNeverAPicture) {
  const TestFolder folder;
  const Image image = pattern(32, 32, {"R", "G", "B", "A"});
  for (const char* extension : {".exr", ".hdr", ".pfm", ".png"}) {
    const std::string name = std::string("whole") + extension;
    write(folder / name, image);
    const std::string whole = bytes_of(folder / name);
    for (const double share : {0.02, 0.3, 0.6, 0.9}) {
      const std::string cut = std::string("cut") + extension;
      put(folder / cut, whole.substr(0, static_cast<std::size_t>(static_cast<double>(whole.size()) * share)));
      EXPECT_NE(message_of([&] { read(folder / cut); }).find(cut), std::string::npos) << extension << " cut to " << share;
    }
    const std::string foreign = std::string("foreign") + extension;
    put(folder / foreign, "this is no picture, whatever its name says; " + std::string(2000, '.'));
    EXPECT_NE(message_of([&] { read(folder / foreign); }).find(foreign), std::string::npos) << extension;
  }
}

TEST(ImageIo, APngWithAChangedByteIsAnError) {
  const TestFolder folder;
  write(folder / "whole.png", pattern(32, 32, {"R", "G", "B"}));
  const std::string whole = bytes_of(folder / "whole.png");
  for (const std::size_t at : {std::size_t{17}, std::size_t{30}, whole.size() / 2, whole.size() - 3}) {
    std::string changed = whole;
    changed[at] = static_cast<char>(changed[at] ^ 0x10);
    put(folder / "changed.png", changed);
    EXPECT_NE(message_of([&] { read(folder / "changed.png"); }).find("changed.png: cannot be read: PNG"), std::string::npos)
        << "byte " << at;
  }
}

TEST(ImageIo, AFailedWriteLeavesNothingAndTheOldFileAsItWas) {
  const TestFolder folder;
  const Image grey(2, 2, {"Y"});
  const Image color = pattern(2, 2, {"R", "G", "B"});
  put(folder / "old.png", "old");
  EXPECT_NE(message_of([&] { write(folder / "old.png", grey); }).find("old.png"), std::string::npos);
  EXPECT_EQ(bytes_of(folder / "old.png"), "old");
  std::filesystem::remove(folder / "old.png");
  for (const char* name : {"a.png", "a.hdr", "a.pfm"}) {
    EXPECT_NE(message_of([&] { write(folder / name, grey); }), "") << name << " needs colour";
  }
  Image doubled = color;
  doubled.channels = {"R", "R", "B"};
  EXPECT_NE(message_of([&] { write(folder / "a.exr", doubled); }).find("a.exr"), std::string::npos) << "two channels of one name";
  EXPECT_NE(message_of([&] { write(folder / "a.gif", color); }).find("unknown extension"), std::string::npos);
  EXPECT_NE(message_of([&] { write(folder / "a.exr", Image()); }).find("a.exr"), std::string::npos) << "an empty picture";
  EXPECT_NE(message_of([&] { write(folder / "none" / "a.exr", color); }), "") << "no such folder";
  EXPECT_TRUE(folder.empty());
}

TEST(ImageIo, AWriteLeavesNoOtherFileAndReplacesTheOldOne) {
  const TestFolder folder;
  put(folder / "new.exr", "old");
  write(folder / "new.exr", pattern(2, 2, {"R", "G", "B"}));
  EXPECT_EQ(read(folder / "new.exr").width, 2);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), std::filesystem::directory_iterator()), 1);
}

TEST(ImageIo, PngCodesThatDoNotFitAreAnError) {
  EXPECT_THROW(encode_png_codes(2, 2, 3, 8, {1, 2, 3}), Error);
  EXPECT_THROW(encode_png_codes(1, 1, 1, 8, {256}), Error);
  EXPECT_THROW(encode_png_codes(1, 1, 5, 8, {1, 2, 3, 4, 5}), Error);
  EXPECT_THROW(encode_png_codes(0, 1, 1, 8, {}), Error);
  EXPECT_THROW(encode_png_codes(1, 1, 1, 12, {1}), Error);
}

TEST(ImageIo, ThreadsMayReadAndWriteAtOnce) {
  const TestFolder folder;
  const Image image = pattern(20, 20, {"R", "G", "B", "A"});
  std::vector<int> good(8, 0);
  std::vector<std::thread> threads;
  threads.reserve(good.size());
  for (std::size_t i = 0; i < good.size(); ++i) {
    threads.emplace_back([&, i] {
      const auto file = folder / (std::to_string(i) + ".exr");
      write(file, image);
      good[i] = read(file).data == image.data ? 1 : 0;
    });
  }
  for (std::thread& thread : threads) {
    thread.join();
  }
  EXPECT_EQ(good, std::vector<int>(good.size(), 1));
}

TEST(ImageLoader, AnInstalledProgramNeverReachesIntoTheBuildTree) {
  const auto installed = module_places("/opt/product/bin");
  for (const auto& place : installed) {
    EXPECT_EQ(place.string().rfind("/opt/product/", 0), 0u) << place;
  }
  EXPECT_EQ(module_places("/somewhere/build").size(), installed.size() + 1);
}

}  // namespace
}  // namespace sheen::image
