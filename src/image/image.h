#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace sheen::image {

/// A picture in linear 32-bit floats, rows from the top, channels interleaved. RGB is radiance over black (premultiplied), A is coverage.
/// The first channels are named "R","G","B" and, where there is coverage, "A"; others ("bound.R", "excluded", ...) may follow.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::string> channels;
  std::vector<float> data;  ///< width * height * channels.size()

  Image() = default;
  /// A picture of zeros.
  Image(int width_, int height_, std::vector<std::string> channels_)
      : width(width_),
        height(height_),
        channels(std::move(channels_)),
        data(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_) * channels.size(), 0.0f) {}

  /// Index of the channel of that name, or -1.
  int channel(const std::string& name) const {
    for (std::size_t i = 0; i < channels.size(); ++i) {
      if (channels[i] == name) {
        return static_cast<int>(i);
      }
    }
    return -1;
  }
  /// Value of channel index c at column x, row y from the top.
  float& at(int x, int y, int c) { return data[offset(x, y) + static_cast<std::size_t>(c)]; }
  float at(int x, int y, int c) const { return data[offset(x, y) + static_cast<std::size_t>(c)]; }

 private:
  std::size_t offset(int x, int y) const {
    return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) * channels.size();
  }
};

}  // namespace sheen::image
