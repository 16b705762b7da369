#include "image/decode_exr.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <new>
#include <vector>

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>

namespace sheen::image {
namespace {

std::size_t samples(const Imath::Box2i& window, std::size_t channels) {
  const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1;
  const std::int64_t height = std::int64_t{window.max.y} - window.min.y + 1;
  return sample_count(width, height, static_cast<std::int64_t>(channels));
}

/// Copies the part of the data window that lies in the display window; what the file does not hold is 0.
std::vector<float> over_display_window(const Imath::Box2i& data, const Imath::Box2i& display, std::size_t channels,
                                       const std::vector<float>& from) {
  std::vector<float> out(samples(display, channels), 0.0f);
  const int left = std::max(data.min.x, display.min.x);
  const int right = std::min(data.max.x, display.max.x);
  if (left > right) {
    return out;
  }
  const auto place = [channels](const Imath::Box2i& window, int x, int y) {
    const auto width = static_cast<std::size_t>(window.max.x - window.min.x + 1);
    return static_cast<std::ptrdiff_t>((static_cast<std::size_t>(y - window.min.y) * width + static_cast<std::size_t>(x - window.min.x)) *
                                       channels);
  };
  for (int y = std::max(data.min.y, display.min.y); y <= std::min(data.max.y, display.max.y); ++y) {
    std::copy_n(from.begin() + place(data, left, y), static_cast<std::size_t>(right - left + 1) * channels,
                out.begin() + place(display, left, y));
  }
  return out;
}

std::string read_pixels(Imf::InputFile& file, RawPicture& out) {
  const Imath::Box2i data = file.header().dataWindow();
  const Imath::Box2i display = file.header().displayWindow();
  const Imf::ChannelList& list = file.header().channels();
  for (auto channel = list.begin(); channel != list.end(); ++channel) {
    if (channel.channel().xSampling != 1 || channel.channel().ySampling != 1) {
      return std::string("subsampled channels are not supported: ") + channel.name();
    }
    out.channels.emplace_back(channel.name());
  }
  const std::size_t channels = out.channels.size();
  if (channels == 0) {
    return "it has no channel";
  }
  if (samples(data, channels) == 0 || samples(display, channels) == 0) {
    return "its header gives an impossible size";
  }
  out.values.resize(samples(data, channels));
  const std::size_t stride = channels * sizeof(float);
  Imf::FrameBuffer pixels;
  for (std::size_t c = 0; c < channels; ++c) {
    const auto row = stride * static_cast<std::size_t>(data.max.x - data.min.x + 1);
    pixels.insert(out.channels[c], Imf::Slice::Make(Imf::FLOAT, out.values.data() + c, data, stride, row));
  }
  file.setFrameBuffer(pixels);
  file.readPixels(data.min.y, data.max.y);
  if (data != display) {
    out.values = over_display_window(data, display, channels, out.values);
  }
  out.width = display.max.x - display.min.x + 1;
  out.height = display.max.y - display.min.y + 1;
  return {};
}

}  // namespace

std::string decode_exr(const std::filesystem::path& path, RawPicture& out) {
  try {
    Imf::InputFile file(path.c_str(), 0);
    return read_pixels(file, out);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& e) {
    // The library begins its message with the file's name, as our caller does.
    std::string why = e.what();
    const std::string name = '"' + path.string() + "\". ";
    if (const std::size_t at = why.find(name); at != std::string::npos) {
      why.erase(0, at + name.size());
    }
    std::replace(why.begin(), why.end(), '\n', ' ');
    return why.empty() ? "its data is corrupt" : why;
  }
}

}  // namespace sheen::image
