#include <algorithm>
#include <cstddef>
#include <exception>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include "image/module.h"

namespace sheen::image {
namespace {

/// A header that claims more samples than this (8 GiB of floats) is taken for corrupt before memory is asked for.
constexpr std::size_t max_samples = std::size_t{1} << 31;

std::string reason(std::string message, const char* otherwise) {
  while (!message.empty() && (message.back() == '\n' || message.back() == ' ')) {
    message.pop_back();
  }
  std::replace(message.begin(), message.end(), '\n', ' ');
  return message.empty() ? otherwise : message;
}

/// Copies the part of the data window that lies in the display window; what the file does not hold is 0.
std::vector<float> over_display_window(const OIIO::ImageSpec& spec, const std::vector<float>& data) {
  const auto channels = static_cast<std::size_t>(spec.nchannels);
  std::vector<float> out(static_cast<std::size_t>(spec.full_width) * static_cast<std::size_t>(spec.full_height) * channels, 0.0f);
  const int left = std::max(spec.x, spec.full_x);
  const int right = std::min(spec.x + spec.width, spec.full_x + spec.full_width);
  if (left >= right) {
    return out;
  }
  for (int y = std::max(spec.y, spec.full_y); y < std::min(spec.y + spec.height, spec.full_y + spec.full_height); ++y) {
    const auto from =
        (static_cast<std::size_t>(y - spec.y) * static_cast<std::size_t>(spec.width) + static_cast<std::size_t>(left - spec.x)) * channels;
    const auto to = (static_cast<std::size_t>(y - spec.full_y) * static_cast<std::size_t>(spec.full_width) +
                     static_cast<std::size_t>(left - spec.full_x)) *
                    channels;
    std::copy_n(data.begin() + static_cast<std::ptrdiff_t>(from), static_cast<std::size_t>(right - left) * channels,
                out.begin() + static_cast<std::ptrdiff_t>(to));
  }
  return out;
}

std::size_t samples(std::int64_t width, std::int64_t height, std::int64_t channels) {
  if (width <= 0 || height <= 0 || channels <= 0) {
    return 0;
  }
  const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  if (pixels > max_samples || pixels * static_cast<std::size_t>(channels) > max_samples) {
    return 0;
  }
  return pixels * static_cast<std::size_t>(channels);
}

std::string read_open(OIIO::ImageInput& input, const OIIO::ImageSpec& spec, const std::string& format, RawPicture& out) {
  if (spec.deep) {
    return "deep pictures are not supported";
  }
  const std::size_t count = samples(spec.width, spec.height, spec.nchannels);
  if (count == 0 || spec.depth > 1) {
    return "its header gives an impossible size";
  }
  out.width = spec.width;
  out.height = spec.height;
  out.channels.assign(spec.channelnames.begin(), spec.channelnames.end());
  const bool integer = spec.format.basetype == OIIO::TypeDesc::UINT8 || spec.format.basetype == OIIO::TypeDesc::UINT16;
  if (integer) {
    out.bits = spec.format.basetype == OIIO::TypeDesc::UINT8 ? 8 : 16;
    out.codes.resize(count);
    if (out.bits == 16) {
      if (!input.read_image(0, 0, 0, -1, OIIO::TypeDesc::UINT16, out.codes.data())) {
        return reason(input.geterror(), "its data is corrupt");
      }
      return {};
    }
    std::vector<std::uint8_t> bytes(count);
    if (!input.read_image(0, 0, 0, -1, OIIO::TypeDesc::UINT8, bytes.data())) {
      return reason(input.geterror(), "its data is corrupt");
    }
    std::copy(bytes.begin(), bytes.end(), out.codes.begin());
    return {};
  }
  out.bits = 0;
  out.values.resize(count);
  if (!input.read_image(0, 0, 0, -1, OIIO::TypeDesc::FLOAT, out.values.data())) {
    return reason(input.geterror(), "its data is corrupt");
  }
  const bool windowed = spec.x != spec.full_x || spec.y != spec.full_y || spec.width != spec.full_width || spec.height != spec.full_height;
  if (format == "openexr" && windowed) {
    if (samples(spec.full_width, spec.full_height, spec.nchannels) == 0) {
      return "its header gives an impossible size";
    }
    out.values = over_display_window(spec, out.values);
    out.width = spec.full_width;
    out.height = spec.full_height;
  }
  return {};
}

std::string read(const char* path, const char* format, RawPicture& out) {
  try {
    const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::create(format);
    if (!input) {
      return reason(OIIO::geterror(), "OpenImageIO has no reader for it");
    }
    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1);  // codes as they are: premultiplying belongs after decoding sRGB
    OIIO::ImageSpec spec;
    if (!input->open(path, spec, config)) {
      return reason(input->geterror(), "not a file of its format");
    }
    return read_open(*input, spec, format, out);
  } catch (const std::exception& e) {
    return reason(e.what(), "its data is corrupt");
  }
}

OIIO::ImageSpec spec_of(const RawPicture& picture, const OIIO::TypeDesc& type) {
  OIIO::ImageSpec spec(picture.width, picture.height, static_cast<int>(picture.channels.size()), type);
  spec.channelnames.assign(picture.channels.begin(), picture.channels.end());
  const auto alpha = std::find(picture.channels.begin(), picture.channels.end(), "A");
  spec.alpha_channel = alpha == picture.channels.end() ? -1 : static_cast<int>(alpha - picture.channels.begin());
  return spec;
}

std::string write_floats(const char* path, const char* format, const char* compression, const RawPicture& picture) {
  try {
    const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(format);
    if (!output) {
      return reason(OIIO::geterror(), "OpenImageIO has no writer for it");
    }
    OIIO::ImageSpec spec = spec_of(picture, OIIO::TypeDesc::FLOAT);
    if (*compression != '\0') {
      spec.attribute("compression", compression);
    }
    // A fixed date: the same picture must give the same bytes on every day.
    spec.attribute("DateTime", "2000:01:01 00:00:00");
    if (!output->open(path, spec)) {
      return reason(output->geterror(), "cannot be opened for writing");
    }
    if (!output->write_image(OIIO::TypeDesc::FLOAT, picture.values.data()) || !output->close()) {
      return reason(output->geterror(), "cannot be written");
    }
    return {};
  } catch (const std::exception& e) {
    return reason(e.what(), "cannot be written");
  }
}

std::string encode_png(const RawPicture& picture, bool srgb, std::vector<std::uint8_t>& bytes) {
  try {
    const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create("png");
    if (!output) {
      return reason(OIIO::geterror(), "OpenImageIO has no PNG writer");
    }
    OIIO::ImageSpec spec = spec_of(picture, picture.bits == 16 ? OIIO::TypeDesc::UINT16 : OIIO::TypeDesc::UINT8);
    spec.attribute("oiio:UnassociatedAlpha", 1);  // the codes are straight already
    if (srgb) {
      spec.attribute("oiio:ColorSpace", "sRGB");
    }
    OIIO::Filesystem::IOVecOutput sink(bytes);
    if (!output->set_ioproxy(&sink)) {
      return "OpenImageIO cannot write PNG to memory";
    }
    if (!output->open("memory.png", spec)) {
      return reason(output->geterror(), "cannot be encoded");
    }
    bool done = false;
    if (picture.bits == 16) {
      done = output->write_image(OIIO::TypeDesc::UINT16, picture.codes.data());
    } else {
      const std::vector<std::uint8_t> narrow(picture.codes.begin(), picture.codes.end());
      done = output->write_image(OIIO::TypeDesc::UINT8, narrow.data());
    }
    if (!done || !output->close()) {
      return reason(output->geterror(), "cannot be encoded");
    }
    return {};
  } catch (const std::exception& e) {
    return reason(e.what(), "cannot be encoded");
  }
}

}  // namespace
}  // namespace sheen::image

extern "C" const sheen::image::Module* sheen_image_module() {
  static constexpr sheen::image::Module module = {sheen::image::read, sheen::image::write_floats, sheen::image::encode_png};
  // The pools would be started for pictures of a few megabytes and outlive them: the calling threads do the work.
  OIIO::attribute("threads", 1);
  return &module;
}
