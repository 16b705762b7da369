#include "conformance/replicas.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace sheen::conformance {
namespace {

constexpr std::array<const char*, 3> colors{"R", "G", "B"};

std::string channel_name(int replica, const char* color) {
  return "replica." + std::to_string(replica) + "." + color;
}

}  // namespace

double granted_to_chance(double shown, double value, double largest) {
  const double p = std::erfc(5.0 / std::sqrt(2.0));
  return std::min(shown, std::sqrt(2 * std::log(2 / p) * largest * std::abs(value))) + std::log(1 / p) * largest;
}

int directions_of_replica(int directions) {
  return std::max(directions / environment_replicas, 1);
}

image::Image draw_replicas(const std::function<image::Image(std::uint64_t seed)>& draw, int replicas, std::uint64_t seed) {
  std::vector<std::string> channels{"R", "G", "B", "A"};
  for (int r = 1; r <= replicas; ++r) {
    for (const char* color : colors) {
      channels.push_back(channel_name(r, color));
    }
  }
  image::Image all;
  for (int r = 1; r <= replicas; ++r) {
    const auto count = static_cast<std::uint64_t>(replicas);
    const std::uint64_t own = seed * count + static_cast<std::uint64_t>(r);
    const image::Image one = draw(own != 0 ? own : ~own);
    if (r == 1) {
      all = image::Image(one.width, one.height, channels);
    }
    for (int y = 0; y < all.height; ++y) {
      for (int x = 0; x < all.width; ++x) {
        for (int c = 0; c < 3; ++c) {
          all.at(x, y, 1 + 3 * r + c) = one.at(x, y, c);
        }
        all.at(x, y, 3) = one.at(x, y, 3);
      }
    }
  }
  const image::Image mean = with_standard_errors(all);
  for (int y = 0; y < all.height; ++y) {
    for (int x = 0; x < all.width; ++x) {
      for (int c = 0; c < 3; ++c) {
        all.at(x, y, c) = mean.at(x, y, c);
      }
    }
  }
  return all;
}

image::Image with_standard_errors(const image::Image& picture) {
  std::array<std::vector<int>, 3> replicas;
  for (std::size_t c = 0; c < 3; ++c) {
    for (int r = 1; picture.channel(channel_name(r, colors.at(c))) >= 0; ++r) {
      replicas.at(c).push_back(picture.channel(channel_name(r, colors.at(c))));
    }
  }
  const std::size_t count = replicas[0].size();
  const int alpha = picture.channel("A");
  if (count < 2 || replicas[1].size() != count || replicas[2].size() != count || alpha < 0) {
    return picture;
  }
  image::Image out(picture.width, picture.height, {"R", "G", "B", "A", "standard_error.R", "standard_error.G", "standard_error.B"});
  const auto n = static_cast<double>(count);
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      for (std::size_t c = 0; c < 3; ++c) {
        double mean = 0;
        for (const int channel : replicas.at(c)) {
          mean += picture.at(x, y, channel) / n;
        }
        double squares = 0;
        for (const int channel : replicas.at(c)) {
          squares += (picture.at(x, y, channel) - mean) * (picture.at(x, y, channel) - mean);
        }
        out.at(x, y, static_cast<int>(c)) = static_cast<float>(mean);
        out.at(x, y, static_cast<int>(4 + c)) = static_cast<float>(std::sqrt(squares / (n * (n - 1))));
      }
      out.at(x, y, 3) = picture.at(x, y, alpha);
    }
  }
  return out;
}

}  // namespace sheen::conformance
