#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfOutputFile.h>
#include <ImfThreading.h>

#include "image/encode.h"

namespace sheen::image {
namespace {

class MemoryStream : public Imf::OStream {
 public:
  MemoryStream() : Imf::OStream("memory") {}
  void write(const char bytes[], int count) override {
    const auto size = static_cast<std::size_t>(count);
    bytes_.resize(std::max(bytes_.size(), at_ + size));
    std::copy_n(bytes, size, bytes_.begin() + static_cast<std::ptrdiff_t>(at_));
    at_ += size;
  }
  std::uint64_t tellp() override { return at_; }
  void seekp(std::uint64_t position) override { at_ = position; }
  std::vector<std::uint8_t> take() { return std::move(bytes_); }

 private:
  std::vector<std::uint8_t> bytes_;
  std::size_t at_ = 0;
};

/// How many threads the library's own pool has from now on: as many as the machine. Without this it has none.
int pool_of_threads() {
  static const int count = [] {
    const auto threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
    Imf::setGlobalThreadCount(threads);
    return threads;
  }();
  return count;
}

}  // namespace

std::vector<std::uint8_t> encode_exr(const Image& image, ExrCompression compression) {
  try {
    Imf::Header header(image.width, image.height);
    header.compression() = compression == ExrCompression::Pxr24 ? Imf::PXR24_COMPRESSION : Imf::ZIP_COMPRESSION;
    Imf::FrameBuffer pixels;
    const std::size_t stride = image.channels.size() * sizeof(float);
    for (std::size_t c = 0; c < image.channels.size(); ++c) {
      header.channels().insert(image.channels[c], Imf::Channel(Imf::FLOAT));
      // The library's interface to readers and writers is one: it only reads from here.
      auto* first = reinterpret_cast<char*>(const_cast<float*>(image.data.data() + c));
      pixels.insert(image.channels[c], Imf::Slice(Imf::FLOAT, first, stride, stride * static_cast<std::size_t>(image.width)));
    }
    MemoryStream stream;
    {
      Imf::OutputFile file(stream, header, pool_of_threads());
      file.setFrameBuffer(pixels);
      file.writePixels(image.height);
    }  // its destructor writes the table of lines
    return stream.take();
  } catch (const std::exception& e) {
    throw Error(std::string("an EXR cannot be encoded: ") + e.what());
  }
}

}  // namespace sheen::image
