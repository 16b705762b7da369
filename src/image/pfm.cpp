#include "image/pfm.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <sstream>
#include <string>
#include <system_error>

#include "image/io.h"
#include "image/rgb_channels.h"

namespace sheen::image {
namespace {

struct Header {
  int channels = 0, width = 0, height = 0;
  bool little_endian = false;
  std::size_t size = 0;  ///< bytes before the data
};

Header parse_header(const std::filesystem::path& file, const std::vector<char>& bytes) {
  const auto fail = [&](const char* rule) -> Error { return Error(file.string() + ": PFM header: " + rule); };
  std::array<std::string, 4> words;
  std::size_t at = 0;
  const auto space = [](char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; };
  for (std::string& word : words) {
    while (at < bytes.size() && space(bytes[at])) {
      ++at;
    }
    while (at < bytes.size() && !space(bytes[at]) && word.size() < 64) {
      word += bytes[at++];
    }
  }
  if (words[0] != "PF" && words[0] != "Pf") {
    throw fail("does not start with PF or Pf");
  }
  if (at >= bytes.size() || !space(bytes[at])) {
    throw fail("ends early");
  }
  Header header;
  header.channels = words[0] == "PF" ? 3 : 1;
  header.size = at + 1;
  double scale = 0;
  const auto number = [](const std::string& word, auto& value) {
    std::istringstream stream(word);
    stream.imbue(std::locale::classic());
    return static_cast<bool>(stream >> value) && stream.eof();
  };
  if (!number(words[1], header.width) || !number(words[2], header.height) || header.width <= 0 || header.height <= 0) {
    throw fail("width and height must be positive whole numbers");
  }
  if (!number(words[3], scale) || scale == 0 || !std::isfinite(scale)) {
    throw fail("the scale must be a number other than 0");
  }
  header.little_endian = scale < 0;
  return header;
}

float float_at(const char* bytes, bool little_endian) {
  std::array<char, 4> raw{};
  std::memcpy(raw.data(), bytes, raw.size());
  if (little_endian != (std::endian::native == std::endian::little)) {
    raw = {raw[3], raw[2], raw[1], raw[0]};
  }
  return std::bit_cast<float>(raw);
}

}  // namespace

Image read_pfm(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::error_code unknown;  // of what is no regular file
  std::vector<char> bytes;
  if (const std::uintmax_t size = std::filesystem::file_size(file, unknown); !unknown) {
    bytes.resize(size);
    stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  } else {
    bytes.assign(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
  }
  if (stream.bad() || (!unknown && !stream)) {
    throw Error(file.string() + ": cannot be read");
  }
  const Header header = parse_header(file, bytes);
  const auto width = static_cast<std::size_t>(header.width);
  const auto height = static_cast<std::size_t>(header.height);
  const auto channels = static_cast<std::size_t>(header.channels);
  const std::size_t available = (bytes.size() - header.size) / (channels * sizeof(float));
  if (available / width < height) {
    throw Error(file.string() + ": PFM data ends early");
  }
  Image image(header.width, header.height, {"R", "G", "B"});
  const bool as_in_memory = channels == 3 && header.little_endian == (std::endian::native == std::endian::little);
  for (std::size_t y = 0; y < height; ++y) {
    const char* row = bytes.data() + header.size + (height - 1 - y) * width * channels * sizeof(float);
    if (as_in_memory) {
      std::memcpy(image.data.data() + y * width * 3, row, width * 3 * sizeof(float));
      continue;
    }
    for (std::size_t x = 0; x < width; ++x) {
      for (std::size_t c = 0; c < 3; ++c) {
        const std::size_t stored = channels == 3 ? c : 0;
        image.data[(y * width + x) * 3 + c] = float_at(row + (x * channels + stored) * sizeof(float), header.little_endian);
      }
    }
  }
  return image;
}

std::vector<std::uint8_t> encode_pfm(const Image& image) {
  const std::array<int, 3> rgb = rgb_channels(image, "a PFM");
  const std::string header = "PF\n" + std::to_string(image.width) + " " + std::to_string(image.height) + "\n-1.0\n";
  std::vector<std::uint8_t> bytes(header.begin(), header.end());
  bytes.reserve(bytes.size() + static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) * 12);
  for (int y = image.height - 1; y >= 0; --y) {
    for (int x = 0; x < image.width; ++x) {
      for (const int c : rgb) {
        const auto bits = std::bit_cast<std::uint32_t>(image.at(x, y, c));
        for (unsigned shift = 0; shift < 32; shift += 8) {
          bytes.push_back(static_cast<std::uint8_t>(bits >> shift));
        }
      }
    }
  }
  return bytes;
}

}  // namespace sheen::image
