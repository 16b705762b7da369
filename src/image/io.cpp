#include "image/io.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <fstream>
#include <map>
#include <new>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "image/decode_exr.h"
#include "image/decode_hdr.h"
#include "image/encode.h"
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
  const auto place = [&](const char* name) {
    return static_cast<std::size_t>(std::find(raw.channels.begin(), raw.channels.end(), name) - raw.channels.begin());
  };
  const std::size_t grey = place("Y");
  const std::size_t alpha = place("A");
  if (grey == channels || (channels == 2 && alpha == channels) || channels > 2) {
    return;
  }
  const std::size_t pixels = static_cast<std::size_t>(raw.width) * static_cast<std::size_t>(raw.height);
  const auto expand = [&](auto& values) {
    std::remove_reference_t<decltype(values)> out(pixels * (channels + 2));
    for (std::size_t i = 0; i < pixels; ++i) {
      for (std::size_t c = 0; c < channels + 2; ++c) {
        out[i * (channels + 2) + c] = values[i * channels + (c < 3 ? grey : alpha)];
      }
    }
    values = std::move(out);
  };
  if (raw.bits == 0) {
    expand(raw.values);
  } else {
    expand(raw.codes);
  }
  raw.channels = channels == 2 ? std::vector<std::string>{"R", "G", "B", "A"} : std::vector<std::string>{"R", "G", "B"};
}

/// R, G, B, A first, the others after them in the file's order.
Image in_order(RawPicture raw) {
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
  if (std::is_sorted(order.begin(), order.end())) {
    Image image;
    image.width = raw.width;
    image.height = raw.height;
    image.channels = std::move(names);
    image.data = std::move(raw.values);
    return image;
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

using Decode = std::string (*)(const std::filesystem::path& file, RawPicture& out);

std::string decode_png(const std::filesystem::path& file, RawPicture& out) {
  std::string why = png_flaw(file);
  return why.empty() ? module_for(file).read(file.c_str(), "png", out) : why;
}

std::string decode_jpeg(const std::filesystem::path& file, RawPicture& out) {
  return module_for(file).read(file.c_str(), "jpeg", out);
}

/// What reads a format other than .pfm; nullptr for an extension that is none.
Decode decoder_of(const std::string& extension) {
  static const std::map<std::string, Decode> decoders = {
      {".exr", decode_exr}, {".hdr", decode_hdr}, {".png", decode_png}, {".jpg", decode_jpeg}, {".jpeg", decode_jpeg}};
  const auto found = decoders.find(extension);
  return found == decoders.end() ? nullptr : found->second;
}

Image decode_with(Decode decode, const std::filesystem::path& file) {
  RawPicture raw;
  if (const std::string why = decode(file, raw); !why.empty()) {
    throw Error(file.string() + ": cannot be read: " + why);
  }
  expand_grey(raw);
  if (raw.bits != 0) {
    decode_codes(raw);
  }
  return in_order(std::move(raw));
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

std::vector<std::uint8_t> encode(const std::string& extension, const Image& image, ExrCompression compression) {
  if (extension == ".pfm") {
    return encode_pfm(image);
  }
  if (extension == ".png") {
    return encode_png(image);
  }
  return extension == ".hdr" ? encode_hdr(image) : encode_exr(image, compression);
}

std::vector<std::uint8_t> encode_for(const std::filesystem::path& file, const Image& image, ExrCompression compression) {
  try {
    return encode(lower_extension(file), image, compression);
  } catch (const Error& e) {
    throw Error(file.string() + ": " + e.what());
  }
}

}  // namespace

Image read(const std::filesystem::path& file) {
  const std::string extension = lower_extension(file);
  const Decode decode = decoder_of(extension);
  if (decode == nullptr && extension != ".pfm") {
    throw Error(file.string() + ": cannot be read: unknown extension (known: .exr .hdr .pfm .png .jpg .jpeg)");
  }
  require_readable(file);
  try {
    return extension == ".pfm" ? read_pfm(file) : decode_with(decode, file);
  } catch (const std::bad_alloc&) {
    throw Error(file.string() + ": cannot be read: there is no memory for a picture as large as its header says");
  }
}

void write(const std::filesystem::path& file, const Image& image, ExrCompression compression) {
  const std::string extension = lower_extension(file);
  if (extension != ".exr" && extension != ".hdr" && extension != ".pfm" && extension != ".png") {
    throw Error(file.string() + ": cannot be written: unknown extension (known: .exr .hdr .pfm .png)");
  }
  require_sound(file, image);
  StagedFile staged(file);
  const std::vector<std::uint8_t> bytes = encode_for(file, image, compression);
  staged.fill(bytes.data(), bytes.size());
  staged.commit();
}

}  // namespace sheen::image
