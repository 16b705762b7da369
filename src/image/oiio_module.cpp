#include <algorithm>
#include <cstddef>
#include <exception>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <OpenImageIO/imageio.h>

#include "image/module.h"

namespace sheen::image {
namespace {

std::string reason(std::string message, const char* otherwise) {
  while (!message.empty() && (message.back() == '\n' || message.back() == ' ')) {
    message.pop_back();
  }
  std::replace(message.begin(), message.end(), '\n', ' ');
  return message.empty() ? otherwise : message;
}

std::string read_open(OIIO::ImageInput& input, const OIIO::ImageSpec& spec, RawPicture& out) {
  const std::size_t count = sample_count(spec.width, spec.height, spec.nchannels);
  if (count == 0) {
    return "its header gives an impossible size";
  }
  out.width = spec.width;
  out.height = spec.height;
  out.channels.assign(spec.channelnames.begin(), spec.channelnames.end());
  out.bits = spec.format.basetype == OIIO::TypeDesc::UINT16 ? 16 : 8;
  out.codes.resize(count);
  std::vector<std::uint8_t> bytes(out.bits == 8 ? count : 0);
  const bool done = out.bits == 16 ? input.read_image(0, 0, 0, -1, OIIO::TypeDesc::UINT16, out.codes.data())
                                   : input.read_image(0, 0, 0, -1, OIIO::TypeDesc::UINT8, bytes.data());
  if (!done) {
    return reason(input.geterror(), "its data is corrupt");
  }
  if (out.bits == 8) {
    out.codes.assign(bytes.begin(), bytes.end());
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
    return read_open(*input, spec, out);
  } catch (const std::exception& e) {
    return reason(e.what(), "its data is corrupt");
  }
}

}  // namespace
}  // namespace sheen::image

extern "C" const sheen::image::Module* sheen_image_module() {
  static constexpr sheen::image::Module module = {sheen::image::read};
  // The pools would be started for pictures of a few megabytes and outlive them: the calling threads do the work.
  OIIO::attribute("threads", 1);
  return &module;
}
