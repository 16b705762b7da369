#include "image/compared.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "image/io.h"

namespace sheen::image {
namespace {

/// Under it a relative error says more of the driver's last bit than of the picture.
constexpr double least_reference = 1e-3;

std::string size_text(const Image& image) {
  return std::to_string(image.width) + " x " + std::to_string(image.height);
}

void require_sound(const Image& image, const char* which) {
  const std::size_t expected =
      static_cast<std::size_t>(std::max(image.width, 0)) * static_cast<std::size_t>(std::max(image.height, 0)) * image.channels.size();
  if (expected != image.data.size()) {
    throw Error(std::string("the ") + which + "'s data does not fit its size");
  }
}

}  // namespace

Compared::Compared(const Image& candidate, const Image& reference)
    : candidate_(candidate), reference_(reference), candidate_alpha_(candidate.channel("A")), reference_alpha_(reference.channel("A")) {
  if (candidate.width != reference.width || candidate.height != reference.height) {
    throw Error("the candidate is " + size_text(candidate) + ", the reference " + size_text(reference) + ": sizes must be equal");
  }
  require_sound(candidate, "candidate");
  require_sound(reference, "reference");
  for (const char* name : {"R", "G", "B", "A"}) {
    const std::pair<int, int> pair(candidate.channel(name), reference.channel(name));
    if (pair.first >= 0 && pair.second >= 0) {
      channels_.push_back(pair);
    }
  }
  if (channels_.empty()) {
    throw Error("candidate and reference have none of the channels R, G, B, A in common");
  }
}

Standing Compared::standing(int x, int y) const {
  for (const auto& [c, r] : channels_) {
    if (!std::isfinite(candidate_.at(x, y, c)) || !std::isfinite(reference_.at(x, y, r))) {
      return Standing::Nonfinite;
    }
  }
  if (candidate_alpha_ < 0 && reference_alpha_ < 0) {
    return Standing::Compared;
  }
  const bool covered = (candidate_alpha_ >= 0 && candidate_.at(x, y, candidate_alpha_) > 0) ||
                       (reference_alpha_ >= 0 && reference_.at(x, y, reference_alpha_) > 0);
  return covered ? Standing::Compared : Standing::Uncovered;
}

double Compared::error(int x, int y, std::pair<int, int> channel) const {
  return std::abs(static_cast<double>(candidate_.at(x, y, channel.first)) - static_cast<double>(reference_.at(x, y, channel.second)));
}

double Compared::relative_error(int x, int y, std::pair<int, int> channel) const {
  return error(x, y, channel) / std::max(std::abs(static_cast<double>(reference_.at(x, y, channel.second))), least_reference);
}

}  // namespace sheen::image
