#include "image/io.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <fstream>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "image/loader.h"
#include "image/pfm.h"
#include "image/png_check.h"
#include "image/srgb.h"
#include "image/staged_file.h"

namespace sheen::image {
namespace {

std::string lower_extension(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

/// Fails with the system's reason where the file is missing, a folder, or not to be read by us.
void require_readable(const std::filesystem::path& file) {
  std::error_code error;
  if (std::filesystem::is_directory(file, error)) {
    throw Error(file.string() + ": cannot be read: it is a folder");
  }
  errno = 0;
  const std::ifstream probe(file, std::ios::binary);
  if (!probe) {
    throw Error(file.string() + ": cannot be read: " + std::generic_category().message(errno));
  }
}

const Module& module_for(const std::filesystem::path& file) {
  try {
    return loaded_module();
  } catch (const Error& e) {
    throw Error(file.string() + ": " + e.what());
  }
}

/// Grey pictures become colour: Y (or one nameless channel) is given to R, G and B.
void expand_grey(RawPicture& raw) {
  const std::size_t channels = raw.channels.size();
  if (channels > 2 || raw.channels[0] != "Y" || (channels == 2 && raw.channels[1] != "A")) {
    return;
  }
  const std::size_t pixels = static_cast<std::size_t>(raw.width) * static_cast<std::size_t>(raw.height);
  const auto expand = [&](auto& values) {
    std::remove_reference_t<decltype(values)> out(pixels * (channels + 2));
    for (std::size_t i = 0; i < pixels; ++i) {
      for (std::size_t c = 0; c < channels + 2; ++c) {
        out[i * (channels + 2) + c] = values[i * channels + (c < 3 ? 0 : 1)];
      }
    }
    values = std::move(out);
  };
  if (raw.bits == 0) {
    expand(raw.values);
  } else {
    expand(raw.codes);
  }
  raw.channels.resize(1);
  raw.channels = channels == 2 ? std::vector<std::string>{"R", "G", "B", "A"} : std::vector<std::string>{"R", "G", "B"};
}

/// R, G, B, A first, the others after them in the file's order.
Image in_order(const RawPicture& raw) {
  std::vector<std::size_t> order;
  for (const char* name : {"R", "G", "B", "A"}) {
    const auto at = std::find(raw.channels.begin(), raw.channels.end(), name);
    if (at != raw.channels.end()) {
      order.push_back(static_cast<std::size_t>(at - raw.channels.begin()));
    }
  }
  for (std::size_t c = 0; c < raw.channels.size(); ++c) {
    if (std::find(order.begin(), order.end(), c) == order.end()) {
      order.push_back(c);
    }
  }
  std::vector<std::string> names;
  names.reserve(order.size());
  for (const std::size_t c : order) {
    names.push_back(raw.channels[c]);
  }
  Image image(raw.width, raw.height, std::move(names));
  const std::size_t channels = order.size();
  for (std::size_t i = 0; i < image.data.size(); i += channels) {
    for (std::size_t c = 0; c < channels; ++c) {
      image.data[i + c] = raw.values[i + order[c]];
    }
  }
  return image;
}

/// Codes to linear, premultiplied floats: colour by the sRGB curve in double, alpha as it is, then colour times alpha.
void decode_codes(RawPicture& raw) {
  const double top = raw.bits == 16 ? 65535.0 : 255.0;
  std::vector<double> curve(static_cast<std::size_t>(top) + 1);
  for (std::size_t code = 0; code < curve.size(); ++code) {
    curve[code] = srgb_to_linear(static_cast<double>(code) / top);
  }
  const std::size_t channels = raw.channels.size();
  const auto found = std::find(raw.channels.begin(), raw.channels.end(), "A");
  const auto alpha = static_cast<std::size_t>(found - raw.channels.begin());
  raw.values.resize(raw.codes.size());
  for (std::size_t i = 0; i < raw.codes.size(); i += channels) {
    const double coverage = alpha < channels ? raw.codes[i + alpha] / top : 1.0;
    for (std::size_t c = 0; c < channels; ++c) {
      raw.values[i + c] = static_cast<float>(c == alpha ? coverage : curve[raw.codes[i + c]] * coverage);
    }
  }
  raw.codes.clear();
}

const char* format_of(const std::string& extension) {
  if (extension == ".exr") {
    return "openexr";
  }
  if (extension == ".hdr") {
    return "hdr";
  }
  if (extension == ".png") {
    return "png";
  }
  if (extension == ".jpg" || extension == ".jpeg") {
    return "jpeg";
  }
  return nullptr;
}

void require_sound(const std::filesystem::path& file, const Image& image) {
  const std::size_t expected =
      static_cast<std::size_t>(std::max(image.width, 0)) * static_cast<std::size_t>(std::max(image.height, 0)) * image.channels.size();
  if (expected == 0 || expected != image.data.size()) {
    throw Error(file.string() + ": cannot be written: the picture is empty or its data does not fit its size");
  }
  for (auto name = image.channels.begin(); name != image.channels.end(); ++name) {
    if (std::find(image.channels.begin(), name, *name) != name) {
      throw Error(file.string() + ": cannot be written: two channels are named " + *name);
    }
  }
}

std::array<int, 3> rgb_of(const Image& image, const char* format) {
  const std::array<int, 3> rgb = {image.channel("R"), image.channel("G"), image.channel("B")};
  if (rgb[0] < 0 || rgb[1] < 0 || rgb[2] < 0) {
    throw Error(std::string(format) + " needs the channels R, G and B");
  }
  return rgb;
}

/// What RGBE can hold: no negatives, no NaN, nothing over its largest exponent.
RawPicture rgbe_picture(const Image& image) {
  constexpr float largest = 1.7e38f;  // (255/256) 2^127: Ward 1991, "Real Pixels", Graphics Gems II
  const auto rgb = rgb_of(image, "an .hdr file");
  RawPicture raw;
  raw.width = image.width;
  raw.height = image.height;
  raw.channels = {"R", "G", "B"};
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      for (const int c : rgb) {
        const float value = image.at(x, y, c);
        raw.values.push_back(value > 0 ? std::min(value, largest) : 0.0f);
      }
    }
  }
  return raw;
}

RawPicture png_picture(const Image& image) {
  const auto rgb = rgb_of(image, "a PNG");
  const int alpha = image.channel("A");
  RawPicture raw;
  raw.width = image.width;
  raw.height = image.height;
  raw.bits = 8;
  raw.channels = alpha < 0 ? std::vector<std::string>{"R", "G", "B"} : std::vector<std::string>{"R", "G", "B", "A"};
  const auto code = [](double signal) { return static_cast<std::uint16_t>(std::lround(255.0 * signal)); };
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      std::array<double, 3> color{};
      for (std::size_t c = 0; c < 3; ++c) {
        color[c] = image.at(x, y, rgb[c]);
      }
      const double coverage = alpha < 0 ? 1.0 : image.at(x, y, alpha);
      if (std::isnan(color[0]) || std::isnan(color[1]) || std::isnan(color[2]) || std::isnan(coverage)) {
        raw.codes.insert(raw.codes.end(), {255, 0, 255});
        if (alpha >= 0) {
          raw.codes.push_back(255);
        }
        continue;
      }
      for (const double value : color) {
        raw.codes.push_back(coverage > 0 ? code(linear_to_srgb(value / coverage)) : std::uint16_t{0});
      }
      if (alpha >= 0) {
        raw.codes.push_back(code(std::clamp(coverage, 0.0, 1.0)));
      }
    }
  }
  return raw;
}

std::vector<std::uint8_t> encode(const RawPicture& raw, bool srgb) {
  std::vector<std::uint8_t> bytes;
  const std::string why = loaded_module().encode_png(raw, srgb, bytes);
  if (!why.empty()) {
    throw Error("a PNG cannot be encoded: " + why);
  }
  return bytes;
}

std::vector<std::uint8_t> encode_for(const std::filesystem::path& file, const std::string& extension, const Image& image) {
  try {
    return extension == ".pfm" ? encode_pfm(image) : encode_png(image);
  } catch (const Error& e) {
    throw Error(file.string() + ": " + e.what());
  }
}

void write_through_module(const std::filesystem::path& file, StagedFile& staged, const Image& image, ExrCompression compression) {
  std::string why;
  if (lower_extension(file) == ".hdr") {
    const RawPicture raw = rgbe_picture(image);
    why = module_for(file).write_floats(staged.path().c_str(), "hdr", "", raw);
  } else {
    const RawPicture raw{image.width, image.height, image.channels, 0, image.data, {}};
    why = module_for(file).write_floats(staged.path().c_str(), "openexr", compression == ExrCompression::Pxr24 ? "pxr24" : "zip", raw);
  }
  if (!why.empty()) {
    throw Error(file.string() + ": cannot be written: " + why);
  }
}

}  // namespace

Image read(const std::filesystem::path& file) {
  const std::string extension = lower_extension(file);
  const char* format = format_of(extension);
  if (format == nullptr && extension != ".pfm") {
    throw Error(file.string() + ": cannot be read: unknown extension (known: .exr .hdr .pfm .png .jpg .jpeg)");
  }
  require_readable(file);
  if (extension == ".pfm") {
    return read_pfm(file);
  }
  RawPicture raw;
  std::string why = extension == ".png" ? png_flaw(file) : std::string();
  if (why.empty()) {
    why = module_for(file).read(file.c_str(), format, raw);
  }
  if (!why.empty()) {
    throw Error(file.string() + ": cannot be read: " + why);
  }
  expand_grey(raw);
  if (raw.bits != 0) {
    decode_codes(raw);
  }
  return in_order(raw);
}

void write(const std::filesystem::path& file, const Image& image, ExrCompression compression) {
  const std::string extension = lower_extension(file);
  if (extension != ".exr" && extension != ".hdr" && extension != ".pfm" && extension != ".png") {
    throw Error(file.string() + ": cannot be written: unknown extension (known: .exr .hdr .pfm .png)");
  }
  require_sound(file, image);
  StagedFile staged(file);
  if (extension == ".pfm" || extension == ".png") {
    const std::vector<std::uint8_t> bytes = encode_for(file, extension, image);
    staged.fill(bytes.data(), bytes.size());
  } else {
    write_through_module(file, staged, image, compression);
  }
  staged.commit();
}

std::vector<std::uint8_t> encode_png(const Image& image) {
  return encode(png_picture(image), true);
}

std::vector<std::uint8_t> encode_png_codes(int width, int height, int channels, int bits, const std::vector<std::uint16_t>& codes) {
  const std::array<std::vector<std::string>, 5> names = {{{}, {"Y"}, {"Y", "A"}, {"R", "G", "B"}, {"R", "G", "B", "A"}}};
  if (width <= 0 || height <= 0 || channels < 1 || channels > 4 || (bits != 8 && bits != 16)) {
    throw Error("a PNG cannot be encoded: it holds 1 to 4 channels of 8 or 16 bits and at least one pixel");
  }
  const std::size_t expected = static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * static_cast<std::size_t>(channels);
  if (codes.size() != expected) {
    throw Error("a PNG cannot be encoded: the codes do not fit its size");
  }
  if (bits == 8 && std::any_of(codes.begin(), codes.end(), [](std::uint16_t code) { return code > 255; })) {
    throw Error("a PNG cannot be encoded: a code is over 255");
  }
  return encode({width, height, names[static_cast<std::size_t>(channels)], bits, {}, codes}, false);
}

void preload() {
  start_loading();
}

}  // namespace sheen::image
